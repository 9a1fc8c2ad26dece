/// @file
/// Whether memory is clearly too little, told before the mesh is made: a geometry meshed here is
/// meshed coarsely first, and what the memory of that mesh grows to is a lower estimate: about half
/// of what the mesh will tell (pipelines.test_memory_before_mesh).
///
///   n ≥ 20 V/h³                                                                                (1)
///   M ≥ matrices (n/n_c) + factor (n/n_c)^1.25                                                 (2)
///
/// for elements of edge h in a volume V, where a mesh of n_c unknowns is forecast to take matrices
/// and factor (fem/memory_forecast.hpp). (1): 32 V/h³ of the default blade at 3 mm, 22 at 1.1 mm,
/// where nodes inside outnumber those on the surface. (2): the exponent is 4/3 of a compact body;
/// of the blade 1.21 from 117 000 to 323 000 unknowns, 1.37 from there to a million (costs.md).
#pragma once

#include <optional>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/structure/solver_memory.hpp"

namespace microslip::pipelines {

struct MemoryBeforeMesh {
  double degrees_of_freedom = 0.0;  ///< at least
  SolverMemory memory;              ///< at least
};

/// @return empty: the scene is not meshed here, or no coarse mesh can be made of it.
/// @throws mesh::MeshRoomError, SceneError  as obtain_mesh().
[[nodiscard]] std::optional<MemoryBeforeMesh> memory_before_mesh(const SceneDescription& scene);

/// @throws fem::MemoryError  that is more than there is, so that the forecast, about twice as
///         much, is clearly more. Where the mesh is kept by an earlier run,
///         require_memory() tells better.
/// @note Costs nothing where memory holds any body of so many unknowns, else a second or two.
void require_memory_before_mesh(const SceneDescription& scene);

}  // namespace microslip::pipelines
