#include "pipelines/model/contact_factors.hpp"

#include <array>
#include <utility>
#include <variant>

#include "pipelines/scene/scene_file.hpp"

namespace microslip::pipelines {

StiffnessPlace stiffness_place(const SceneDescription& scene) {
  if (scene.contact) {
    const bool rigid = !scene.contact->normal_stiffness && !scene.contact->tangential_stiffness;
    return rigid ? StiffnessPlace::none : StiffnessPlace::keys;
  }
  const auto* modal = std::get_if<ModalModel>(&scene.model);
  if (modal == nullptr || modal->points.empty()) return StiffnessPlace::none;
  return modal->local_stiffness ? StiffnessPlace::keys : StiffnessPlace::points;
}

SceneDescription with_stiffness_keys(const SceneDescription& scene, double factor) {
  if (!scene.contact) {
    const double local = std::get<ModalModel>(scene.model).local_stiffness.value();
    return with_value(scene, "contact.tangential_stiffness", factor * local);
  }
  SceneDescription changed = scene;
  for (auto* stiffness :
       {&changed.contact->normal_stiffness, &changed.contact->tangential_stiffness}) {
    if (*stiffness) **stiffness *= factor;
  }
  return changed;
}

ReducedModel with_point_stiffness(ReducedModel model, double factor, double load) {
  for (Eigen::Index i = 0; i < model.preload.size(); ++i) {
    if (load * model.preload[i] < 0.0) model.preload[i] *= factor;
  }
  const std::array<Eigen::VectorXd*, 3> points{&model.tangential_stiffness, &model.normal_stiffness,
                                               &model.second_stiffness};
  for (std::size_t axis = 0; axis < points.size(); ++axis) {
    Eigen::VectorXd& stiffness = *points[axis];
    for (Eigen::Index i = 0; i < stiffness.size(); ++i) {
      const double body = model.compliance.rows() > 0 ? model.compliance(i, static_cast<Eigen::Index>(axis)) : 0.0;
      // 1/k = 1/k_local + c: the factor is that of k_local.
      stiffness[i] *= factor / (1.0 + (factor - 1.0) * stiffness[i] * body);
    }
  }
  for (Eigen::VectorXd* stiffness : {&model.vertex_tangential_stiffness, &model.vertex_second_stiffness,
                                     &model.vertex_normal_stiffness}) {
    *stiffness *= factor;
  }
  return model;
}

ReducedModel with_friction(ReducedModel model, double factor) {
  model.friction_coefficient *= factor;
  model.vertex_friction_coefficient *= factor;
  return model;
}

double with_same_gap(double load, const ReducedModel& from, const ReducedModel& to) {
  if (load >= 0.0 || from.load_measure != LoadMeasure::force) return load;
  const double total = from.normal_stiffness.dot(from.weights);
  return total > 0.0 ? load * to.normal_stiffness.dot(to.weights) / total : load;
}

std::string no_friction_factor(const ReducedModel& model) {
  if (model.weights.size() == 0) return "there is no contact";
  return model.effects.friction_law ? "friction is a law of the slip speed" : "";
}

std::string no_stiffness_factor(const ReducedModel& model, const SceneDescription& scene) {
  if (model.weights.size() == 0) return "there is no contact";
  if (model.effects.roughness) return "it follows from the law of the rough surfaces";
  if (stiffness_place(scene) != StiffnessPlace::none) return "";
  return "the contact is rigid: its stiffness is the residual flexibility of the bodies, which is known";
}

}  // namespace microslip::pipelines
