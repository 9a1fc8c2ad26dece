#include "pipelines/accuracy/left_out.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>
#include <utility>

#include "pipelines/model/contact_coordinates.hpp"
#include "pipelines/model/effect_choice.hpp"
#include "pipelines/response/response_stage.hpp"
#include "solver/richer_peak.hpp"

namespace microslip::pipelines {
namespace {

struct WithEffect {
  std::string name;
  ReducedModel model;
};

bool all_patches(const ReducedModel& model, int axis, double least) {
  return std::ranges::all_of(model.patches, [&](const contact::Patch& patch) {
    return patch.cells.stiffness.col(axis).minCoeff() >= least;
  });
}

std::vector<WithEffect> models_with(const ReducedModel& model, const SceneDescription& scene) {
  std::vector<WithEffect> others;
  const auto add = [&](const char* name, bool ContactEffects::*effect) {
    WithEffect& other = others.emplace_back(WithEffect{name, model});
    other.model.effects.*effect = true;
    other.model.coordinates = contact_coordinates(other.model, scene);
  };
  const auto moves = [](const contact::Patch& patch) {
    return !patch.cells.stiffness.col(1).isZero(0.0) && !patch.cells.shapes.v.isZero(0.0);
  };
  if (!model.effects.normal_motion && std::ranges::any_of(model.patches, moves)) {
    add("normal_motion", &ContactEffects::normal_motion);
  }
  const bool forbidden = setting_of(scene, "second_direction") == "off" &&
                         model.effects.motion_ratio > least_motion_along_r(scene);
  if (forbidden && !model.effects.second_direction && all_patches(model, 2, 0.0)) {
    add("second_direction", &ContactEffects::second_direction);
  }
  return others;
}

}  // namespace

std::vector<ErrorRow> rows_left_out(const ReducedModel& model, const SceneDescription& scene,
                                    const CurveResult& result) {
  const auto* load = std::get_if<double>(&result.preload);
  const solver::ResponsePoint* peak = highest_peak(result.curve);
  if (load == nullptr || peak == nullptr || result.integrated || !(peak->amplitude > 0.0))
    return {};
  solver::ContinuationOptions options = continuation_options(scene, model);
  options.search_starts = 0;
  const solver::Scene own = solver_scene(model, *load);
  std::vector<ErrorRow> rows;
  for (const WithEffect& other : models_with(model, scene)) {
    const auto begin = std::chrono::steady_clock::now();
    const solver::Scene with = solver_scene(other.model, *load);
    const auto both = solver::peak_elsewhere(own, options, result.curve, {.scene = with});
    constexpr double not_found = std::numeric_limits<double>::infinity();
    const double amplitude = both ? both->other_amplitude / both->amplitude - 1.0 : not_found;
    const double frequency = both ? both->other_frequency / both->frequency - 1.0 : not_found;
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    rows.push_back(
        {result.name, peak_amplitude_goal, other.name, amplitude, both.has_value(), seconds});
    rows.push_back(
        {result.name, peak_frequency_goal, other.name, frequency, both.has_value(), seconds});
  }
  return rows;
}

}  // namespace microslip::pipelines
