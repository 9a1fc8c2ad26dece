#include "pipelines/stages/first_settings.hpp"

#include <cmath>

#include "pipelines/description/curve_request.hpp"
#include "pipelines/effects/curve_cost.hpp"

namespace microslip::pipelines {
namespace {

constexpr int several = 9;    // of the default blade: peaks right to some per cent
constexpr double most = 0.8;  // of the budget: a curve that lacks time falls back to one alone

double seconds_of_curves(const SceneDescription& scene) {
  const bool along_r = scene.settings.second_direction == Discretisation::Choice::on;
  const ResponseSeconds seconds = response_seconds(scene, curve_effects(scene, along_r));
  return seconds.curves + seconds.errors;
}

}  // namespace

SceneDescription first_settings(SceneDescription scene) {
  const double budget = scene.accuracy.budget;
  const bool by_time = std::isfinite(budget) && scene.accuracy.tolerance > 0.0;
  if (!by_time || !scene.settings.harmonics.chosen()) return scene;
  if (only_limits(scene)) return scene;
  scene.settings.harmonics = {.highest = several, .or_one = true};
  if (!(seconds_of_curves(scene) < most * budget)) scene.settings.harmonics = {.highest = 1};
  return scene;
}

}  // namespace microslip::pipelines
