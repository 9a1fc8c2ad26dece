#include "pipelines/model/contact_factors.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "pipelines/model/curve_load.hpp"
#include "pipelines/scene/scene_file.hpp"

namespace microslip::pipelines {
namespace {

/// 1/k = 1/k_local + c: the factor is that of k_local.
void multiply_local_stiffness(contact::PatchSamples& samples, double factor) {
  const bool in_series = samples.compliance.rows() > 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (Eigen::Index i = 0; i < samples.stiffness.rows(); ++i) {
      double& stiffness = samples.stiffness(i, axis);
      const double body = in_series ? samples.compliance(i, axis) : 0.0;
      stiffness *= factor / (1.0 + (factor - 1.0) * stiffness * body);
    }
  }
}

}  // namespace

StiffnessPlace stiffness_place(const SceneDescription& scene) {
  if (!scene.contacts.empty()) {
    const bool rigid = std::ranges::all_of(scene.contacts, [](const ContactDescription& contact) {
      return !contact.normal_stiffness && !contact.tangential_stiffness;
    });
    return rigid ? StiffnessPlace::none : StiffnessPlace::keys;
  }
  const auto* modal = std::get_if<ModalModel>(&scene.model);
  if (modal == nullptr || modal->points.empty()) return StiffnessPlace::none;
  return modal->local_stiffness ? StiffnessPlace::keys : StiffnessPlace::points;
}

SceneDescription with_stiffness_keys(const SceneDescription& scene, double factor) {
  if (scene.contacts.empty()) {
    const double local = std::get<ModalModel>(scene.model).local_stiffness.value();
    return with_value(scene, "contact.tangential_stiffness", factor * local);
  }
  SceneDescription changed = scene;
  for (ContactDescription& contact : changed.contacts) {
    for (auto* stiffness : {&contact.normal_stiffness, &contact.tangential_stiffness}) {
      if (*stiffness) **stiffness *= factor;
    }
  }
  return changed;
}

ReducedModel with_point_stiffness(ReducedModel model, double factor, double load) {
  for (contact::Patch& patch : model.patches) {
    const Eigen::VectorXd before = patch.cells.stiffness.col(1);
    multiply_local_stiffness(patch.cells, factor);
    for (Eigen::Index i = 0; i < before.size(); ++i) {
      // A gap is −rest load over the stiffness, residual flexibility included: the length stays.
      double& rest_load = patch.cells.preload_field[i];
      const bool is_gap = load * rest_load < 0.0 && before[i] > 0.0;
      if (is_gap) rest_load *= patch.cells.stiffness(i, 1) / before[i];
    }
    multiply_local_stiffness(patch.vertices, factor);
  }
  return model;
}

ReducedModel with_friction(ReducedModel model, double factor) {
  for (contact::Patch& patch : model.patches) {
    patch.cells.friction *= factor;
    patch.vertices.friction *= factor;
  }
  return model;
}

double with_same_gap(double load, const ReducedModel& from, const ReducedModel& to) {
  if (load >= 0.0 || !in_newtons(from)) return load;
  const double total = total_normal_stiffness(from);
  return total > 0.0 ? load * total_normal_stiffness(to) / total : load;
}

std::string no_friction_factor(const ReducedModel& model) {
  if (model.patches.empty()) return "there is no contact";
  const bool law = std::ranges::any_of(
      model.patches, [](const contact::Patch& patch) { return patch.rules.friction.has_value(); });
  return law ? "friction is a law of the slip speed" : "";
}

std::string no_stiffness_factor(const ReducedModel& model, const SceneDescription& scene) {
  if (model.patches.empty()) return "there is no contact";
  if (is_rough(model)) return "it follows from the law of the rough surfaces";
  if (stiffness_place(scene) != StiffnessPlace::none) return "";
  return "the contact is rigid: its stiffness is the residual flexibility of the bodies, which is "
         "known";
}

}  // namespace microslip::pipelines
