#include "pipelines/effects/model_family.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/model/contact_coordinates.hpp"
#include "pipelines/model/contact_factors.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/model/linear_limits.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "pipelines/structure/extrapolated_modes.hpp"
#include "pipelines/structure/static_preload.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/temporary_folder.hpp"

namespace microslip::pipelines {
namespace {

/// Keys behind which mesh, modes or residual flexibility are others.
bool changes_structure(std::string_view key) {
  if (key.starts_with("contact")) {  // contact.surface, contact[1].surface
    return key.ends_with(".surface") || key.find(".slip_direction") != key.npos;
  }
  constexpr std::array<std::string_view, 5> structural{
      "model.", "material.", "supports.", "static.",
      "excitation."};  // the forces: static shapes of theirs may stand behind the modes
  return std::any_of(structural.begin(), structural.end(),
                     [&](std::string_view start) { return key.starts_with(start); });
}

/// Of sixteen digits nothing is left of the modes beside a contact that stiff: a search for the
/// first solution does not end.
void refuse_stiffest(const ReducedModel& model) {
  constexpr double most = 1e12;
  if (model.patches.empty() || model.frequency.size() == 0) return;
  const double contact = stuck_stiffness(model).cwiseAbs().maxCoeff();
  const double modes = model.frequency.cwiseAbs2().maxCoeff();
  if (!(modes > 0.0) || contact <= most * modes) return;
  throw RefusedError(fmt::format(
      "contact stiffness is {:.1e} times that of the stiffest mode, beyond {:.0e}: nothing of the "
      "modes is left beside it; are the units of tangential_stiffness and normal_stiffness right?",
      contact / modes, most));
}

}  // namespace

ReducedModel model_on_basis(const SceneDescription& scene, const SolvedStructure& structure,
                            const fem::ModalBasis& basis, std::vector<std::string>& warnings) {
  ReducedModel model =
      reduce_to_contact(structure.mesh, scene, basis, structure.modes.residuals, warnings);
  if (structure.modes.static_face) {
    set_static_preload(model, structure.mesh, scene, *structure.modes.static_face);
    std::ranges::move(static_preload_questions(model, scene), std::back_inserter(warnings));
  }
  return model;
}

ReducedModel model_of(const SceneDescription& scene, const SolvedStructure* structure,
                      std::vector<std::string>& warnings) {
  ReducedModel model = structure == nullptr
                           ? reduced_model(scene)
                           : model_on_basis(scene, *structure, structure->modes.basis, warnings);
  refuse_stiffest(model);
  model.effects = contact_effects(model, scene);
  model.coordinates = contact_coordinates(model, scene);
  return model;
}

ReducedModel model_with(const Discretisation& settings, const SceneDescription& scene,
                        const SolvedStructure* structure, std::vector<std::string>& warnings) {
  if (settings.patches.size() != scene.contacts.size()) {
    throw std::invalid_argument(fmt::format("settings for {} patches, the scene has {}",
                                            settings.patches.size(), scene.contacts.size()));
  }
  SceneDescription other = scene;
  other.settings = settings;
  if (settings.basis == scene.settings.basis) return model_of(other, structure, warnings);
  if (structure == nullptr)
    throw std::invalid_argument("settings with another basis of given modes");
  const SolvedStructure solved = solved_on(structure->mesh, other);
  return model_of(other, &solved, warnings);
}

ModelFamily::ModelFamily(const SceneDescription& scene, std::string key, const ReducedModel& model,
                         std::shared_ptr<const SolvedStructure> structure)
    : scene_(scene),
      key_(std::move(key)),
      effects_(model.effects),
      structure_(std::move(structure)) {}

ModelFamily::Structure ModelFamily::structure_at(double value, const SceneDescription& changed) {
  if (structure_ == nullptr || !changes_structure(key_)) return structure_;
  const auto known = structures_.find(value);
  if (known != structures_.end()) return known->second;
  const TemporaryFolder folder;
  auto own = std::make_shared<const SolvedStructure>(
      solved_likewise(changed, *structure_, folder.path() / "mesh.msh"));
  // The values of a first scan are asked for again with every factor, those that follow are not.
  constexpr std::size_t n_kept = 16;
  if (structures_.size() < n_kept) structures_.emplace(value, own);
  return own;
}

ReducedModel ModelFamily::reduced(SceneDescription changed, double stiffness_factor,
                                  const SolvedStructure* structure) const {
  if (stiffness_factor != 1.0) changed = with_stiffness_keys(changed, stiffness_factor);
  std::vector<std::string> warnings;  // those of the scene itself are told already
  ReducedModel model = model_of(changed, structure, warnings);
  model.effects.second_direction = effects_.second_direction;
  model.effects.normal_motion = effects_.normal_motion;
  model.coordinates = contact_coordinates(model, scene_);
  return model;
}

const ReducedModel& ModelFamily::at(double value, double stiffness_factor) {
  const std::pair place{value, stiffness_factor};
  const auto known = models_.find(place);
  if (known != models_.end()) return known->second;
  SceneDescription changed = scene_at(value);
  const Structure structure = structure_at(value, changed);
  return models_.emplace(place, reduced(std::move(changed), stiffness_factor, structure.get()))
      .first->second;
}

SceneDescription ModelFamily::scene_at(double value) const {
  return with_value(scene_, key_, value);
}

std::shared_ptr<const SolvedStructure> ModelFamily::structure_at(double value) {
  return structure_at(value, scene_at(value));
}

const ReducedModel& ModelFamily::as_given(double stiffness_factor) {
  const auto known = given_.find(stiffness_factor);
  if (known != given_.end()) return known->second;
  return given_.emplace(stiffness_factor, reduced(scene_, stiffness_factor, structure_.get()))
      .first->second;
}

}  // namespace microslip::pipelines
