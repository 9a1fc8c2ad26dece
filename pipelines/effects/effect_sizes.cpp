#include "pipelines/effects/effect_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "pipelines/description/curve_request.hpp"
#include "pipelines/description/effects_left_out.hpp"
#include "pipelines/effects/effect_indicators.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/model/curve_load.hpp"

namespace microslip::pipelines {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

/// ∬ n₀' dA at load 1, of points that press.
double force_at_unit_load(const ReducedModel& model) {
  if (in_newtons(model)) return 1.0;
  double force = 0.0;
  for (const contact::Patch& patch : model.patches) {
    force += patch.cells.preload_field.cwiseMax(0.0).dot(patch.cells.weights);
  }
  return force;
}

/// That presses [N]; 0: none does.
double smallest_force(const ReducedModel& model, const SceneDescription& scene) {
  double smallest = no_limit;
  for (const double load : loads_of(model, scene)) {
    if (load > 0.0) smallest = std::min(smallest, load);
  }
  return std::isfinite(smallest) ? smallest * force_at_unit_load(model) : 0.0;
}

double over(double part, double whole) { return whole > 0.0 ? part / whole : no_limit; }

/// Of a load that presses, on one patch [-].
double share_of(const ReducedModel& model, std::size_t patch) {
  double all = 0.0;
  double own = 0.0;
  for (std::size_t k = 0; k < model.patches.size(); ++k) {
    const contact::PatchSamples& cells = model.patches[k].cells;
    const double share = in_newtons(model) ? model.patches[k].load_share
                                           : cells.preload_field.cwiseMax(0.0).dot(cells.weights);
    all += share;
    if (k == patch) own = share;
  }
  return all > 0.0 ? own / all : 0.0;
}

/// Over the load that turning changes, the largest of all patches. @param force  of all [N].
double largest_turning(const ReducedModel& model, const std::vector<double>& turning,
                       double force) {
  double most = 0.0;
  for (std::size_t k = 0; k < turning.size(); ++k) {
    if (turning[k] > 0.0) most = std::max(most, over(turning[k], share_of(model, k) * force));
  }
  return most;
}

/// That of the motion: 0 without normal motion, or where the places of points are not known.
double turning_size(const ReducedModel& model, const SceneDescription& scene) {
  if (setting_of(scene, "normal_motion") == "off") return 0.0;
  return largest_turning(model, turning_forces(model, scene), smallest_force(model, scene));
}

/// Root mean square of the pressure's variation over its mean, the largest of all patches, over √3:
/// of a pressure that varies linearly its moment over load times half the size.
double uneven_pressure(const ReducedModel& model) {
  double most = 0.0;
  for (const contact::Patch& patch : model.patches) {
    const Eigen::VectorXd& weights = patch.cells.weights;
    const Eigen::ArrayXd pressure = patch.cells.preload_field.array().max(0.0);
    const double mean = weights.dot(pressure.matrix()) / weights.sum();
    if (!(mean > 0.0)) continue;
    const double square = weights.dot((pressure / mean - 1.0).square().matrix()) / weights.sum();
    most = std::max(most, std::sqrt(square / 3.0));
  }
  return most;
}

double half_size(const Eigen::VectorXd& places) {
  return 0.5 * (places.maxCoeff() - places.minCoeff());
}

}  // namespace

double turning_size(const ReducedModel& model, double load, const Eigen::VectorXcd& motion) {
  std::vector<double> turning;
  for (const contact::Patch& patch : model.patches) turning.push_back(turning_force(patch, motion));
  return largest_turning(model, turning, load * force_at_unit_load(model));
}

double roughness_height(const SceneDescription& scene) {
  double height = 0.0;
  for (const contact::SurfaceRules& rules : surface_rules(as_written(scene))) {
    if (rules.roughness) height = std::max(height, rules.roughness->height());
  }
  return height;
}

double roughness_size(const ReducedModel& model, const SceneDescription& scene) {
  return over(roughness_height(scene) * total_normal_stiffness(model),
              smallest_force(model, scene));
}

std::optional<double> tilt_size(const ReducedModel& model, const SceneDescription& scene) {
  if (!scene.areas && !scene.contacts.empty()) return std::nullopt;
  if (!scene.areas) {
    const SceneDescription with = with_effect(scene, "moments");
    return tilt_size(reduced_model(with), with);
  }
  double most =
      std::max({turning_size(model, scene), uneven_pressure(model), uneven_motion(model, scene)});
  const double force = smallest_force(model, scene);
  for (const contact::Patch& patch : model.patches) {
    for (const contact::TiltedArea& area : patch.tilted_areas) {
      const double load = area.share * force;
      for (const auto& [moment, places] :
           {std::pair{area.moment[0], &area.r}, std::pair{area.moment[1], &area.p}}) {
        if (moment != 0.0) {
          most = std::max(most, over(std::abs(moment), load * half_size(*places)));
        }
      }
    }
  }
  return most;
}

}  // namespace microslip::pipelines
