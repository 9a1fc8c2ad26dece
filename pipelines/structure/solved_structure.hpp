/// @file
/// The finite-element half of a scene, kept so that other contact data need no new modes.
#pragma once

#include <filesystem>
#include <memory>

#include "mesh/mesh.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/structure/structure_stage.hpp"

namespace microslip::pipelines {

struct CoarserMeshes;
struct MeshAnswers;

/// None yet.
[[nodiscard]] std::shared_ptr<MeshAnswers> no_answers();

struct SolvedStructure {
  mesh::Mesh mesh;
  StructureModes modes;
  /// Those that the modes are extrapolated from (extrapolated_modes.hpp); nullptr: they are not.
  std::shared_ptr<const CoarserMeshes> coarser{};
  /// What was asked about its mesh (larger_elements.hpp); copies share it.
  std::shared_ptr<MeshAnswers> answers = no_answers();
};

/// Mesh and modes from the beginning. @param mesh_file  where the mesher writes.
/// @param cores  above 1: what the modes are extrapolated from may be solved beside them.
/// @throws as obtain_mesh(), check_names(), solve_structure().
[[nodiscard]] SolvedStructure solved_structure(const SceneDescription& scene,
                                               const std::filesystem::path& mesh_file,
                                               int cores = 1);

/// The same on a mesh that is there.
[[nodiscard]] SolvedStructure solved_on(mesh::Mesh mesh, const SceneDescription& scene,
                                        int cores = 1);

}  // namespace microslip::pipelines
