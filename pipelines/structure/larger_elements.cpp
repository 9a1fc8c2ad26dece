#include "pipelines/structure/larger_elements.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <system_error>
#include <utility>

#include "contact/spare_cores.hpp"
#include "fem/blas_threads.hpp"
#include "fem/ranks.hpp"
#include "mesh/mesh_error.hpp"
#include "pipelines/structure/extrapolated_modes.hpp"
#include "pipelines/structure/solver_memory.hpp"
#include "pipelines/structure/static_preload.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/interrupt.hpp"
#include "pipelines/system/machine.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/temporary_folder.hpp"

namespace microslip::pipelines {
namespace {

constexpr std::array factors{2.0, 4.0};

SceneDescription with_larger_elements(const SceneDescription& scene, double factor,
                                      Eigen::Index n_modes) {
  SceneDescription larger = with_elements_scaled(scene, factor);
  larger.accuracy.extrapolation = false;
  larger.settings.basis.n_modes = static_cast<int>(n_modes);
  larger.settings.basis.reach = 0.0;
  return larger;
}

bool holds_both(const mesh::Mesh& mesh, fem::SolverKind solver) {
  constexpr double both = 1.25;  // elements of 2h: a fifth of the unknowns
  const SolverMemory memory = solver_memory(mesh, solver);
  return both * memory.needed_mb() <= memory.available.megabytes;
}

bool may_begin(const SceneDescription& scene, const mesh::Mesh& mesh, int cores) {
  return is_extrapolated(scene) && cores > 1 && describe_machine().cores > 1 &&
         !fem::started_as_rank() && std::isinf(seconds_left()) && !has_static_preload(scene) &&
         holds_both(mesh, scene.settings.basis.solver);
}

mesh::Mesh own_mesh(const SceneDescription& scene) {
  const TemporaryFolder folder;
  mesh::Mesh mesh = obtain_mesh(scene, folder.path() / "mesh.msh");
  check_names(mesh, scene);
  return mesh;
}

}  // namespace

SolvedStructure on_larger_elements(const SceneDescription& scene, double factor,
                                   Eigen::Index n_modes) {
  const SceneDescription larger = with_larger_elements(scene, factor, n_modes);
  const fem::OneBlasThread one;
  return solved_on(own_mesh(larger), larger);
}

const SolvedStructure& on_larger_elements(const SceneDescription& scene,
                                          const SolvedStructure& structure, double factor,
                                          Eigen::Index n_modes) {
  auto& known = structure.answers->larger;
  const std::pair place{factor, n_modes};
  const auto found = known.find(place);
  if (found != known.end()) return found->second;
  return known.emplace(place, on_larger_elements(scene, factor, n_modes)).first->second;
}

const FrequencyExcess& frequency_excess(const SolvedStructure& structure,
                                        const SceneDescription& scene) {
  std::optional<FrequencyExcess>& known = structure.answers->excess;
  if (!known) known = frequency_excess(structure.mesh, structure.modes, scene);
  return *known;
}

std::shared_ptr<MeshAnswers> no_answers() { return std::make_shared<MeshAnswers>(); }

LargerElements::LargerElements(const SceneDescription& scene, const mesh::Mesh& mesh, int cores,
                               std::filesystem::path program)
    : scene_(scene) {
  if (!may_begin(scene, mesh, cores)) return;
  try {
    if (program.empty()) program = solver_program();
    const fem::OneBlasThread as_there;
    elsewhere_ = {arithmetic(),
                  [program](const StructureTask& task) { return solve_in_process(task, program); }};
    worker_ = std::jthread([this](const std::stop_token& stop) { solve_beside(stop); });
    began_ = true;
  } catch (const mesh::MeshError&) {    // no program
  } catch (const std::system_error&) {  // no thread
  }
}

void LargerElements::solve_beside(const std::stop_token& stop) {
  const StopOfThread own(stop);
  const contact::CoreShare core(contact::CoreShare::Kind::taken);
  try {
    for (std::size_t i = 0; i < factors.size(); ++i) {
      const SceneDescription larger =
          with_larger_elements(scene_, factors[i], scene_.settings.basis.n_modes);
      meshes_[i] = own_mesh(larger);
      if (scene_.settings.basis.reach > 0.0) continue;  // how many is known after the fine mesh's
      modes_[i] = solve_structure(*meshes_[i], larger, elsewhere_);
    }
  } catch (const std::exception&) {  // who wants them solves them, and says what is wrong
  }
}

SolvedStructure LargerElements::taken(std::size_t i, Eigen::Index n_modes) {
  if (worker_.joinable()) worker_.join();
  if (interrupt_requested()) throw InterruptedError("interrupted");
  if (!meshes_[i]) return on_larger_elements(scene_, factors[i], n_modes);
  mesh::Mesh mesh = std::move(*meshes_[i]);
  meshes_[i].reset();
  if (modes_[i] && n_modes == scene_.settings.basis.n_modes) {
    return {std::move(mesh), std::move(*modes_[i])};
  }
  const fem::OneBlasThread one;
  return solved_on(std::move(mesh), with_larger_elements(scene_, factors[i], n_modes));
}

}  // namespace microslip::pipelines
