#include "pipelines/response/harmonics_check.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include <fmt/format.h>

#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/peak_about.hpp"
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

/// Where the peak with more harmonics is too far for Newton's method.
void trace_about_peak(const ReducedModel& model, double load,
                      const solver::ContinuationOptions& options, CurveResult& result) {
  solver::RicherPeak& richer = *result.richer;
  const solver::ResponsePoint own = *highest_peak(result.curve);
  const auto begin = std::chrono::steady_clock::now();
  const auto peak = peak_about(model, load, options, own.frequency);
  richer.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!peak || peak->amplitude < solver::another_peak * own.amplitude) return;
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
