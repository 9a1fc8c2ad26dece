#include "pipelines/response/harmonics_check.hpp"

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/peak_about.hpp"
#include "pipelines/response/sampled_curve.hpp"
#include "pipelines/response/solver_scenes.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/interrupt.hpp"

namespace microslip::pipelines {
namespace {

constexpr int most_harmonics = 99;  // of a scene

}  // namespace

int harmonics_to_check(const ReducedModel& model, const SceneDescription& scene) {
  const HarmonicSettings& harmonics = scene.settings.harmonics;
  const bool is_asked = harmonics.checked && scene.accuracy.error_budget;
  if (harmonics.chosen() || !is_asked || model.patches.empty()) return 0;
  const int highest = std::min(harmonics.highest + harmonics_of_a_check, most_harmonics);
  return highest > harmonics.highest + harmonics_of_a_check / 2 ? highest : 0;
}

namespace {

/// The harmonics that the peak was asked with.
solver::ContinuationOptions with_all(solver::ContinuationOptions options,
                                     const solver::RicherPeak& richer) {
  options.n_harmonics = richer.highest;
  options.orders.clear();
  if (richer.beyond.empty()) return options;
  for (int k = 1; k <= richer.highest; ++k) options.orders.push_back(k);
  options.orders.insert(options.orders.end(), richer.beyond.begin(), richer.beyond.end());
  options.n_harmonics = options.orders.back();
  options.without_mean = false;
  return options;
}

/// For the peak with more harmonics.
void take(const solver::ResponsePoint& peak, CurveResult& result) {
  solver::RicherPeak& richer = *result.richer;
  richer.frequency = peak.frequency;
  richer.amplitude = peak.amplitude;
  richer.dissipated_energy = peak.energy.friction;
  richer.change = 1.0 - highest_peak(result.curve)->amplitude / peak.amplitude;
}

/// Where the peak with more harmonics is too far for Newton's method.
void trace_about_peak(const ReducedModel& model, double load,
                      const solver::ContinuationOptions& options, CurveResult& result) {
  solver::RicherPeak& richer = *result.richer;
  const solver::ResponsePoint own = *highest_peak(result.curve);
  const auto begin = std::chrono::steady_clock::now();
  const auto peak = peak_about(model, load, options, own.frequency);
  richer.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!peak || peak->amplitude < solver::another_peak * own.amplitude) return;
  take(*peak, result);
}

/// Another peak than that which is known, which the same harmonics make lower.
bool is_another(const solver::ResponseCurve& curve, const solver::ResponsePoint& highest,
                double known) {
  const solver::ResponsePoint* same = nearest_peak(curve, known);
  return same != nullptr && same != &highest && same->amplitude < highest.amplitude;
}

/// Next to a resonance of a harmonic that was not given the curve may be highest elsewhere.
void trace_resonances(const solver::Scene& scene, solver::ContinuationOptions options, int highest,
                      CurveResult& result) {
  constexpr double worth_a_curve = 0.05;  // of the amplitude
  solver::RicherPeak& richer = *result.richer;
  const std::vector<int> more =
      solver::resonant_harmonics(scene, options, result.curve, highest, worth_a_curve);
  if (more.empty()) return;
  const auto begin = std::chrono::steady_clock::now();
  options = solver::with_harmonics_of(scene, options, result.curve);
  options.orders.insert(options.orders.end(), more.begin(), more.end());
  std::ranges::sort(options.orders);
  options.n_harmonics = options.orders.back();
  const solver::ResponseCurve curve = curve_for_its_peak(scene, options);
  richer.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!curve.complete) richer.change.reset();
  if (curve.points.empty()) return;
  const solver::ResponsePoint& peak = *highest_peak(curve);
  // Less is the peak that is known already, with fewer harmonics.
  const bool is_higher = peak.amplitude > (1.0 + worth_a_curve) * richer.amplitude;
  if (!richer.change) return;
  if (is_higher || is_another(curve, peak, richer.frequency)) take(peak, result);
}

}  // namespace

void check_harmonics(ReducedModel model, const SceneDescription& scene, double load,
                     CurveResult& result, const std::function<bool()>& stop) {
  solver::ResponseCurve& curve = result.curve;
  const int highest = harmonics_to_check(model, scene);
  if (highest == 0 || !curve.certificate.empty() || curve.points.empty()) return;
  if (curve.diagnosis == solver::Diagnosis::interrupted || interrupt_requested() || cut_short())
    return;
  const int next = std::min(highest + harmonics_of_a_check, most_harmonics);
  model.effects.n_harmonics = next;
  model = model_of(std::move(model), curve);
  solver::ContinuationOptions options = continuation_options(scene, model);
  options.stop = [&stop, others = options.stop] { return stop() || others(); };
  result.richer = solver::richer_peak(solver_scene(model, load), options, curve, highest, next);
  const solver::ContinuationOptions asked = options;
  const bool missed = result.richer && !result.richer->change;
  if (missed && options.frequency_begin != options.frequency_end) {
    options = with_all(std::move(options), *result.richer);
    trace_about_peak(model, load, options, result);
  }
  const bool is_found = result.richer && result.richer->change;
  if (is_found) trace_resonances(solver_scene(model, load), asked, highest, result);
  if (result.richer && !result.richer->change && options.stop()) {
    result.richer.reset();  // not known, which is another thing than not found
    curve.message += fmt::format("{}stopped before its harmonics were checked",
                                 curve.message.empty() ? "" : "; ");
  }
}

}  // namespace microslip::pipelines
