#include "pipelines/stages/model_stages.hpp"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "fem/ranks.hpp"
#include "pipelines/description/damping_ratios.hpp"
#include "pipelines/effects/effects.hpp"
#include "pipelines/effects/simulated_scene.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/model/scene_places.hpp"
#include "pipelines/model/scene_warnings.hpp"
#include "pipelines/questions/questions.hpp"
#include "pipelines/stages/stage_seconds.hpp"
#include "pipelines/structure/extrapolated_modes.hpp"
#include "pipelines/structure/larger_elements.hpp"
#include "pipelines/structure/memory_before_mesh.hpp"
#include "pipelines/structure/mesh_excess.hpp"
#include "pipelines/structure/solver_time.hpp"
#include "pipelines/structure/static_preload.hpp"
#include "pipelines/structure/structure_stage.hpp"
#include "pipelines/text/rounded.hpp"

namespace microslip::pipelines {
namespace {

void tell_ranks(Progress& progress) {
  if (fem::n_ranks() == 1) return;
  progress.info(fmt::format(
      "{} MPI ranks solve for modes together and share the curves, rank 0 does the rest",
      fem::n_ranks()));
  if (fem::n_ranks_here() <= fem::n_cores()) return;
  progress.warning(fmt::format(
      "{} MPI ranks share {} cores of this machine and wait for each other: {} would be faster",
      fem::n_ranks_here(), fem::n_cores(), fem::n_cores()));
}

/// Of a mesh it takes seconds where modes are many.
SimulatedScene telling_model_of(const SceneDescription& scene, const SolvedStructure* structure,
                                Progress& progress, std::vector<std::string>& warnings) {
  if (structure == nullptr)
    return simulated(scene, model_of(scene, structure, warnings), structure);
  const Progress::Part part = progress.part(
      fmt::format("linear limits of {} modes", structure->modes.basis.frequency.size()));
  return simulated(scene, model_of(scene, structure, warnings), structure);
}

/// Of a large mesh it takes seconds.
MeshExcess telling_mesh_excess(const SolvedStructure& structure, const SceneDescription& scene,
                               Progress& progress) {
  if (!has_elements_of_file(scene)) return {};
  const Progress::Part part = progress.part("jumps of stress between elements");
  return mesh_excess(frequency_excess(structure, scene), scene);
}

}  // namespace

StructurePointer solved_structure(const SceneDescription& scene, int cores, RunRecord& record) {
  ask(record.progress(), scene);
  tell_ranks(record.progress());
  if (std::holds_alternative<ModalModel>(scene.model)) return nullptr;
  record.stage("mesh");
  record.progress().expect(mesh_seconds(scene));
  record.keep_inputs(scene);
  const auto finished = record.finished_mesh();
  if (!finished) require_memory_before_mesh(scene);
  mesh::Mesh mesh =
      finished ? reread_mesh(scene, *finished) : obtain_mesh(scene, record.mesh_file());
  check_names(mesh, scene);
  record.keep_mesh(mesh, scene.material.density);
  record.keep_inputs(scene);
  for (const std::string& line : describe_places(mesh, scene)) record.progress().info(line);
  ask(record.progress(), scene, mesh);
  record.stage("modes");
  if (given_modes(scene) == nullptr) {
    const double n_dofs = 3.0 * static_cast<double>(mesh.n_nodes());
    const double larger = is_extrapolated(scene) ? larger_elements_seconds(n_dofs, scene) : 0.0;
    record.progress().expect(modes_seconds(n_dofs, scene.settings.basis) +
                             equilibrium_seconds(n_dofs, scene) + larger);
  }
  std::optional<StructureModes> modes = record.finished_modes();
  LargerElements larger(scene, mesh, modes ? 1 : cores);  // beside what is to be solved
  if (!modes) modes = solve_structure(mesh, scene);
  for (const std::string& warning : modes->warnings) record.progress().warning(warning);
  if (!scene.modes.residual_note.empty()) record.progress().info(scene.modes.residual_note);
  record.keep_modes(mesh, *modes,
                    damping_ratios(scene.modes, modes->basis.frequency, modes->basis.n_attachment));
  SolvedStructure structure{std::move(mesh), std::move(*modes)};
  const MeshExcess excess = telling_mesh_excess(structure, scene, record.progress());
  if (!excess.text.empty()) record.progress().info(excess.text);
  if (!excess.warning.empty()) record.progress().warning(excess.warning);
  if (const std::string text = extrapolate_modes(structure, scene, larger); !text.empty()) {
    record.progress().info(text);
  }
  record.stage("contact");
  return std::make_shared<const SolvedStructure>(std::move(structure));
}

void add_model(Solution& solution, RunRecord& record) {
  const StructurePointer& structure = solution.structure;
  std::vector<std::string> warnings = scene_warnings(solution.scene);
  SimulatedScene chosen =
      telling_model_of(solution.scene, structure.get(), record.progress(), warnings);
  solution.scene = std::move(chosen.scene);
  solution.model = std::move(chosen.model);
  const SceneDescription& scene = solution.scene;
  const ReducedModel& model = solution.model;
  for (const std::string& warning : warnings) record.progress().warning(warning);
  if (model.static_preload) {
    record.progress().info(
        describe_static_preload(structure->mesh, scene, *structure->modes.static_face));
  }
  ask(record.progress(), scene, model);
  if (model.effects.second_direction) {
    record.progress().info(fmt::format(
        "friction along r is simulated: motion along r is {} of that along p. The table of "
        "effects tells what that takes; effects.second_direction = \"off\" leaves it out",
        percent_text(model.effects.motion_ratio)));
  }
  std::vector<EffectRecord> effects =
      effects_of(scene, &model, structure ? &structure->mesh : nullptr);
  if (structure) tell_moments_left_out(scene, *structure, effects);
  record.keep_effects(std::move(effects));
  record.keep_model(model);
  if (structure) record.keep_structure(structure->mesh, structure->modes.basis);
}

}  // namespace microslip::pipelines
