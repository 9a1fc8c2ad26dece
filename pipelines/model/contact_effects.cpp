#include "pipelines/model/contact_effects.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "contact/force/any_harmonics_force.hpp"
#include "contact/line/event_law.hpp"
#include "contact/force/law_patch_force.hpp"
#include "contact/force/patch_force.hpp"
#include "contact/sampled/patch_force.hpp"
#include "contact/transient/patch_transient.hpp"
#include "contact/plane/planar_cycle.hpp"
#include "contact/transient/planar_transient.hpp"
#include "contact/line/surface_event_law.hpp"
#include "pipelines/model/point_parameters.hpp"
#include "pipelines/model/motion_along_r.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

// As far as the residual of the balance is driven down: coarser, its noise turns branches back.
constexpr double planar_tolerance = 1e-11;
// Fewer points are solved event by event as fast as that matters, and to rounding.
constexpr Eigen::Index least_points_in_lanes = 48;
constexpr int instants_per_period = 512;

std::string setting_of(const SceneDescription& scene, const char* name) {
  for (const auto& [effect, setting] : scene.effects) {
    if (effect == name) return setting;
  }
  return "auto";
}

/// Constants of a point have its bodies in series; rough surfaces change their part alone.
contact::SurfaceLaw surface_law(const contact::PointParameters& point, double second_stiffness,
                                const contact::FrictionLaw& friction, const ContactEffects& effects,
                                const Eigen::Vector3d& compliance) {
  if (!effects.roughness || !effects.local_normal_stiffness) {
    return {point, second_stiffness, friction, effects.roughness};
  }
  contact::PointParameters local = point;
  local.tangential_stiffness = *effects.local_tangential_stiffness;
  local.normal_stiffness = *effects.local_normal_stiffness;
  return {local, local.tangential_stiffness, friction, effects.roughness,
          {compliance[0], compliance[1], compliance[2]}};
}

}  // namespace

ContactEffects contact_effects(const ReducedModel& model, const SceneDescription& scene) {
  ContactEffects effects;
  effects.n_harmonics = scene.response ? scene.response->harmonics : 1;
  if (scene.response && scene.response->method == ResponseDescription::Method::time) {
    effects.n_harmonics = std::max(effects.n_harmonics, least_harmonics_of_time);
  }
  effects.normal_motion = setting_of(scene, "normal_motion") != "off";
  effects.friction_law = scene.laws.friction;
  effects.roughness = scene.laws.roughness;
  const std::string setting = setting_of(scene, "second_direction");
  effects.motion_ratio = motion_ratio_along_r(model, scene);
  const bool meshed = model.vertices.rows() > 0;
  // Motion of given modes along r is meant, unless it is rounding.
  const bool called_for = effects.motion_ratio > (meshed ? negligible_motion_along_r : 1e-9);
  effects.second_direction =
      setting == "on" || (setting == "auto" && called_for && model.weights.size() > 0);
  if (effects.second_direction && !(model.second_stiffness.minCoeff() >= 0.0)) {
    throw RefusedError(fmt::format(
        "residual flexibility makes the contact stiffness along r not positive (smallest {:.3g} N/m^3): "
        "give a finite local stiffness and modes.residual = \"attachment\", or more modes",
        model.second_stiffness.minCoeff()));
  }
  if (effects.roughness && meshed) {
    effects.local_tangential_stiffness = scene.contact->tangential_stiffness;
    effects.local_normal_stiffness = scene.contact->normal_stiffness;
    if (!effects.local_tangential_stiffness || !effects.local_normal_stiffness) {
      throw RefusedError(
          "contact.roughness: rough surfaces need a stiffness of full contact; give normal_stiffness and "
          "tangential_stiffness in N/m^3 instead of \"rigid\"");
    }
  }
  return effects;
}

bool is_sampled(const ReducedModel& model) {
  return model.weights.size() >= least_points_in_lanes && !model.effects.closed_form() &&
         !model.effects.second_direction;
}

contact::ModalShapes simulated_shapes(const ReducedModel& model, bool on_vertices) {
  contact::ModalShapes shapes = on_vertices ? model.vertex_shapes : model.shapes;
  if (!model.effects.second_direction) shapes.w.resize(0, 0);
  return shapes;
}

contact::SurfaceLaw surface_of_point(const ReducedModel& model,
                                     const contact::PointParameters& point, Eigen::Index row,
                                     bool on_vertices) {
  const Eigen::VectorXd& second =
      on_vertices ? model.vertex_second_stiffness : model.second_stiffness;
  const Eigen::MatrixX3d& compliance = on_vertices ? model.vertex_compliance : model.compliance;
  const bool slides = point.friction_coefficient > 0.0;
  const contact::FrictionLaw friction =
      slides && model.effects.friction_law
          ? *model.effects.friction_law
          : contact::FrictionLaw::constant(point.friction_coefficient);
  return surface_law(
      point, second[row], friction, model.effects,
      compliance.rows() > 0 ? Eigen::Vector3d(compliance.row(row)) : Eigen::Vector3d::Zero());
}

std::vector<contact::SurfaceLaw> point_surfaces(const ReducedModel& model, double load,
                                                bool on_vertices) {
  const std::vector<contact::PointParameters> points = point_parameters(model, load, on_vertices);
  std::vector<contact::SurfaceLaw> surfaces;
  surfaces.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (model.effects.simple_laws()) {
      surfaces.emplace_back(points[i], 0.0);
    } else {
      surfaces.push_back(surface_of_point(model, points[i], static_cast<Eigen::Index>(i), on_vertices));
    }
  }
  return surfaces;
}

std::vector<std::shared_ptr<const contact::PointLaw>> point_laws(const ReducedModel& model,
                                                                 double load, bool on_vertices) {
  const std::vector<contact::PointParameters> points = point_parameters(model, load, on_vertices);
  const ContactEffects& effects = model.effects;
  std::vector<std::shared_ptr<const contact::PointLaw>> laws;
  laws.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const contact::PointParameters& point = points[i];
    const auto row = static_cast<Eigen::Index>(i);
    if (effects.simple_laws()) {
      laws.push_back(std::make_shared<contact::EventLaw>(point));
      continue;
    }
    const contact::SurfaceLaw surface = surface_of_point(model, point, row, on_vertices);
    if (effects.second_direction) {
      laws.push_back(std::make_shared<contact::PlanarLaw>(surface, planar_tolerance));
    } else {
      laws.push_back(std::make_shared<contact::SurfaceEventLaw>(surface));
    }
  }
  return laws;
}

std::unique_ptr<contact::ModalForce> contact_force(const ReducedModel& model, double load) {
  if (model.weights.size() == 0) return nullptr;
  if (is_sampled(model)) {
    return std::make_unique<contact::sampled::PatchForce>(
        model.weights, point_surfaces(model, load, false), simulated_shapes(model, false),
        contact::sampled::Options{.instants = instants_per_period});
  }
  if (model.effects.closed_form()) {
    return std::make_unique<contact::PatchForce>(
        contact::ContactPatch(model.weights, point_parameters(model, load, false)),
        simulated_shapes(model, false));
  }
  if (model.effects.simple_laws()) {
    return std::make_unique<contact::AnyHarmonicsForce>(
        contact::ContactPatch(model.weights, point_parameters(model, load, false)),
        simulated_shapes(model, false));
  }
  return std::make_unique<contact::LawPatchForce>(model.weights, point_laws(model, load, false),
                                                  simulated_shapes(model, false));
}

std::unique_ptr<contact::TransientForce> transient_force(const ReducedModel& model, double load) {
  if (model.weights.size() == 0) return nullptr;
  const ContactEffects& effects = model.effects;
  if (effects.second_direction || effects.friction_law || effects.roughness) {
    return std::make_unique<contact::PlanarTransient>(
        model.weights, point_surfaces(model, load, false), simulated_shapes(model, false));
  }
  return std::make_unique<contact::PatchTransient>(
      contact::ContactPatch(model.weights, point_parameters(model, load, false)),
      simulated_shapes(model, false));
}

}  // namespace microslip::pipelines
