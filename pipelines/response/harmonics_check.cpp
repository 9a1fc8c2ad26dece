#include "pipelines/response/harmonics_check.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include <fmt/format.h>

#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/sampled_curve.hpp"
#include "pipelines/response/solver_scenes.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/interrupt.hpp"

namespace microslip::pipelines {
int harmonics_to_check(const ReducedModel& model, const SceneDescription& scene) {
  const HarmonicSettings& harmonics = scene.settings.harmonics;
  constexpr int most_harmonics = 99;  // of a scene
  if (harmonics.chosen() || !harmonics.checked || model.patches.empty()) return 0;
  const int highest = std::min(harmonics.highest + harmonics_of_a_check, most_harmonics);
  return highest > harmonics.highest + harmonics_of_a_check / 2 ? highest : 0;
}

namespace {

/// The highest peak of a curve traced with more harmonics about the one that the curve has: where
/// that is too far for Newton's method.
void trace_about_peak(const ReducedModel& model, double load, solver::ContinuationOptions options,
                      CurveResult& result) {
  constexpr double beside =
      0.015;  // of the frequency: some resonance widths of a lightly damped blade
  solver::RicherPeak& richer = *result.richer;
  const solver::ResponsePoint own = *highest_peak(result.curve);
  for (double* end : {&options.frequency_begin, &options.frequency_end}) {
    *end = std::clamp(*end, (1.0 - beside) * own.frequency, (1.0 + beside) * own.frequency);
  }
  const auto begin = std::chrono::steady_clock::now();
  const solver::ResponseCurve curve =
      solver::trace_response(balanced_scene(model, load, options), options,
                             [&options](const auto&) { return !options.stop(); });
  richer.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const solver::ResponsePoint* peak = peak_above_all(curve);
  if (!curve.complete || peak == nullptr) return;
  if (peak->amplitude < solver::another_peak * own.amplitude) return;
  richer.frequency = peak->frequency;
  richer.amplitude = peak->amplitude;
  richer.dissipated_energy = peak->energy.friction;
  richer.change = 1.0 - own.amplitude / peak->amplitude;
}

}  // namespace

void check_harmonics(ReducedModel model, const SceneDescription& scene, double load,
                     CurveResult& result, const std::function<bool()>& stop) {
  solver::ResponseCurve& curve = result.curve;
  const int highest = harmonics_to_check(model, scene);
  if (highest == 0 || !curve.certificate.empty() || curve.points.empty()) return;
  if (curve.diagnosis == solver::Diagnosis::interrupted || interrupt_requested() || cut_short())
    return;
  model.effects.n_harmonics = highest;
  model = model_of(std::move(model), curve);
  solver::ContinuationOptions options = continuation_options(scene, model);
  options.search_starts = 0;
  options.judge_stability = false;
  options.stop = [&stop, others = options.stop] { return stop() || others(); };
  result.richer = solver::richer_peak(solver_scene(model, load), options, curve, highest);
  const bool missed = result.richer && !result.richer->change;
  if (missed && options.frequency_begin != options.frequency_end) {
    options.n_harmonics = highest;
    options.orders.clear();
    trace_about_peak(model, load, options, result);
  }
  if (result.richer && !result.richer->change && options.stop()) {
    result.richer.reset();  // not known, which is another thing than not found
    curve.message += fmt::format("{}stopped before its harmonics were checked",
                                 curve.message.empty() ? "" : "; ");
  }
}

}  // namespace microslip::pipelines
