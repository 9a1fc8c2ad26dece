#include "pipelines/accuracy/with_effect.hpp"

#include <algorithm>
#include <utility>

#include "pipelines/accuracy/limit_resonances.hpp"
#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/peak_about.hpp"
#include "pipelines/system/deadline.hpp"

namespace microslip::pipelines {

std::optional<solver::PeakOfBoth> at_its_frequency(const solver::Scene& own,
                                                   solver::ContinuationOptions options,
                                                   const solver::ResponsePoint& point,
                                                   const solver::OtherModel& with) {
  options.frequency_begin = options.frequency_end = point.frequency;
  solver::ResponseCurve alone;
  alone.points = {point};
  alone.points.front().mark = solver::PointMark::none;  // of a peak the frequency would move
  return solver::peak_elsewhere(own, options, alone, {with.scene, with.embedding, 1.0});
}

double seconds_of_trace(const SceneDescription& scene) {
  return std::min(bearable, scene.response->time_budget);
}

std::optional<solver::ResponseCurve> traced_with(const solver::OtherModel& with,
                                                 solver::ContinuationOptions options,
                                                 const solver::ResponseCurve& own, double seconds) {
  if (own.seconds > seconds) return std::nullopt;
  const TimeLimit limit(seconds);
  options.stop = [&limit, stop = options.stop] { return limit.is_over() || stop(); };
  solver::ResponseCurve curve = curve_for_its_peak(with.scene, std::move(options));
  if (!curve.complete || highest_peak(curve)->mark != solver::PointMark::peak) return std::nullopt;
  return curve;
}

std::optional<solver::ResponsePoint> peak_only_with(const solver::Scene& own,
                                                    const solver::OtherModel& with,
                                                    const solver::ContinuationOptions& options,
                                                    const solver::ResponseCurve& curve,
                                                    double amplitude, double seconds) {
  const Range range = range_of(options);
  if (range.is_point() || !resonates_only_with(own, with, range, amplitude)) return std::nullopt;
  const auto whole = traced_with(with, options, curve, seconds);
  if (!whole || !(highest_peak(*whole)->amplitude > amplitude)) return std::nullopt;
  return *highest_peak(*whole);
}

double load_with(const ReducedModel& richer, const ReducedModel& model, double load) {
  return load == model.static_preload ? richer.static_preload.value_or(load) : load;
}

}  // namespace microslip::pipelines
