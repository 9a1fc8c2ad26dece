#include "pipelines/model_family.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <utility>
#include <variant>

#include "pipelines/contact_effects.hpp"
#include "pipelines/contact_stage.hpp"
#include "pipelines/scene_file.hpp"
#include "pipelines/temporary_folder.hpp"

namespace microslip::pipelines {
namespace {

/// Keys behind which mesh, modes or residual flexibility are others.
bool changes_structure(std::string_view key) {
  constexpr std::array<std::string_view, 5> structural{"model.", "material.", "supports.",
                                                       "contact.surface", "contact.slip_direction"};
  return std::any_of(structural.begin(), structural.end(),
                     [&](std::string_view start) { return key.starts_with(start); });
}

}  // namespace

SolvedStructure solved_structure(const SceneDescription& scene,
                                 const std::filesystem::path& mesh_file) {
  mesh::Mesh mesh = obtain_mesh(scene, mesh_file);
  check_names(mesh, scene);
  StructureModes modes = solve_structure(mesh, scene);
  return {std::move(mesh), std::move(modes)};
}

ReducedModel model_of(const SceneDescription& scene, const SolvedStructure* structure,
                      std::vector<std::string>& warnings) {
  ReducedModel model;
  if (structure == nullptr) {
    model = reduced_model(std::get<ModalModel>(scene.model));
  } else {
    const auto& residual = structure->modes.residual;
    model = reduce_to_contact(structure->mesh, scene, structure->modes.basis,
                              residual ? &*residual : nullptr, warnings);
  }
  model.effects = contact_effects(model, scene);
  return model;
}

ModelFamily::ModelFamily(const SceneDescription& scene, std::string key, const ReducedModel& model,
                         std::shared_ptr<const SolvedStructure> structure)
    : scene_(scene),
      key_(std::move(key)),
      second_direction_(model.effects.second_direction),
      structure_(std::move(structure)) {}

const ReducedModel& ModelFamily::at(double value) {
  const auto known = models_.find(value);
  if (known != models_.end()) return known->second;
  const SceneDescription changed = with_value(scene_, key_, value);
  std::vector<std::string> warnings;  // those of the scene itself are told already
  ReducedModel model;
  if (structure_ != nullptr && changes_structure(key_)) {
    const TemporaryFolder folder;
    const SolvedStructure own = solved_structure(changed, folder.path() / "mesh.msh");
    model = model_of(changed, &own, warnings);
  } else {
    model = model_of(changed, structure_.get(), warnings);
  }
  model.effects.second_direction = second_direction_;
  return models_.emplace(value, std::move(model)).first->second;
}

}  // namespace microslip::pipelines
