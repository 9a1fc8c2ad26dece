#include "pipelines/accuracy/errors_in_time.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/response_stage.hpp"

namespace microslip::pipelines {
namespace {

/// Motions next to one another in frequency, the largest in the middle.
using Three = std::array<const solver::ResponsePoint*, 3>;

std::optional<Three> about_largest(const solver::ResponseCurve& curve) {
  const auto& points = curve.points;
  const solver::ResponsePoint* top = highest_peak(curve);
  if (top == nullptr || top == &points.front() || top == &points.back()) return std::nullopt;
  const auto i = static_cast<std::size_t>(top - points.data());
  return Three{&points[i - 1], top, &points[i + 1]};
}

}  // namespace

std::optional<solver::ResponsePoint> integrated_with_events(const ReducedModel& model,
                                                            const SceneDescription& scene,
                                                            const CurveResult& result,
                                                            double load) {
  const solver::ResponsePoint& top = *highest_peak(result.curve);
  SceneDescription again = scene;
  ResponseDescription& response = *again.response;
  response.frequency_begin_hz = response.frequency_end_hz =
      top.frequency / (2.0 * std::numbers::pi);
  response.steps_per_period = 0;
  const solver::ResponseCurve curve = integrated_elsewhere(model, again, load, top, {});
  if (!curve.complete || curve.points.empty()) return std::nullopt;
  return curve.points.front();
}

std::optional<TopBetween> top_between(const solver::ResponseCurve& curve) {
  constexpr double jump = 0.5;  // of the amplitude
  const std::optional<Three> three = about_largest(curve);
  if (!three) return std::nullopt;
  const auto& [before, top, after] = *three;
  const double least = jump * top->amplitude;
  if (!(before->amplitude > least) || !(after->amplitude > least)) return std::nullopt;
  const double left = top->frequency - before->frequency;  // negative of a sweep downwards
  const double right = after->frequency - top->frequency;
  const double rise = (top->amplitude - before->amplitude) / left;
  const double fall = (after->amplitude - top->amplitude) / right;
  const double slope = (rise * right + fall * left) / (left + right);
  const double curvature = (fall - rise) / (left + right);  // half the second derivative
  if (!(curvature < 0.0)) return TopBetween{};              // as high as those beside it
  return TopBetween{-0.5 * slope / curvature / top->frequency,
                    -0.25 * slope * slope / curvature / top->amplitude};
}

}  // namespace microslip::pipelines
