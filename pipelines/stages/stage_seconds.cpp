#include "pipelines/stages/stage_seconds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "pipelines/accuracy/models_left_out.hpp"
#include "pipelines/description/curve_request.hpp"
#include "pipelines/description/effects_left_out.hpp"
#include "pipelines/description/element_count.hpp"
#include "pipelines/effects/curve_cost.hpp"
#include "pipelines/effects/effect_choice.hpp"
#include "pipelines/effects/effect_indicators.hpp"
#include "pipelines/structure/extrapolated_modes.hpp"
#include "pipelines/structure/solver_time.hpp"
#include "pipelines/system/machine_speed.hpp"

namespace microslip::pipelines {
namespace {

ResponseSeconds seconds_of(const ReducedModel& model, const SceneDescription& scene) {
  return response_seconds(scene, decided_curve_effects(scene, model));
}

/// What curves by harmonic balance under a load have taken.
double seconds_spent_on(const std::vector<CurveResult>& curves) {
  double spent = 0.0;
  for (const CurveResult& one : curves) {
    const bool balanced = !one.integrated && std::holds_alternative<double>(one.load);
    if (balanced) spent += one.curve.seconds;
  }
  return spent;
}

/// Cores that share the curves.
double cores_in_use(const SceneDescription& scene, int jobs) {
  const auto n_curves = static_cast<double>(curve_requests(scene).size());
  return std::clamp(static_cast<double>(jobs), 1.0, std::max(1.0, n_curves));
}

}  // namespace

double coarser_meshes_seconds(double degrees_of_freedom, const SceneDescription& scene) {
  if (!scene.accuracy.error_budget || largest_factor(scene) < 2.0) return 0.0;
  if (in_time(scene) || only_limits(scene)) return 0.0;
  if (is_extrapolated(scene)) return 0.0;  // they are solved with the modes
  return larger_elements_seconds(degrees_of_freedom, scene);
}

double modes_again_seconds(double degrees_of_freedom, const SceneDescription& scene,
                           const ReducedModel* model) {
  if (!scene.accuracy.error_budget || !(degrees_of_freedom > 0.0)) return 0.0;
  constexpr std::array may_change_modes{"residual", "centrifugal", "local_frames"};
  std::vector<std::string> names;
  if (model != nullptr) names = effects_left_out(*model, scene);
  double n = 0.0;
  for (const char* name : may_change_modes) {
    if (!leaving_out_changes_modes(name, scene)) continue;
    const bool known = std::ranges::find(names, name) != names.end();
    if (known || (model == nullptr && left_out(scene, name) != nullptr)) n += 1.0;
  }
  if (n > 0.0 && std::max(static_cast<double>(names.size()), n) > 1.0) n += 1.0;  // all together
  return n * modes_seconds(degrees_of_freedom, scene.settings.basis);
}

double mesh_seconds(const SceneDescription& scene) {
  const auto* blade = std::get_if<BladeModel>(&scene.model);
  if (blade == nullptr) return 0.0;
  constexpr double freedoms_in_cube = 32.0;  // of an edge: 69 000 of 3 mm in the default blade
  return machine_slowness() * per_meshed_freedom * freedoms_in_cube *
         blade_volume(blade->geometry) / std::pow(blade->sizes.element_size, 3.0);
}

double curves_seconds(const ReducedModel& model, const SceneDescription& scene, int jobs) {
  return seconds_of(model, scene).curves / cores_in_use(scene, jobs);
}

double accuracy_seconds(const ReducedModel& model, const SceneDescription& scene,
                        const std::vector<CurveResult>& curves, double degrees_of_freedom,
                        int jobs) {
  if (!scene.accuracy.error_budget) return 0.0;
  constexpr double share_of_a_curve = 0.6;  // on a mesh: 0.3 to 0.95 were measured
  const double at_least =
      scene.contacts.empty() ? 0.0 : share_of_a_curve * seconds_spent_on(curves);
  return std::max(seconds_of(model, scene).errors, at_least) / cores_in_use(scene, jobs) +
         coarser_meshes_seconds(degrees_of_freedom, scene) +
         modes_again_seconds(degrees_of_freedom, scene, &model);
}

double optimum_seconds(const ReducedModel& model, const SceneDescription& scene,
                       const std::vector<CurveResult>& curves, bool bracket) {
  // Of the default study with nine harmonics and with those that 2 % need: 1.4 and 0.83.
  constexpr double times_the_curves = 1.1;
  const ResponseSeconds seconds = seconds_of(model, scene);
  const double at_least =
      has_short_search(scene) ? times_the_curves * seconds_spent_on(curves) : 0.0;
  return std::max(seconds.best_value + (bracket ? seconds.bracket : 0.0), at_least);
}

}  // namespace microslip::pipelines
