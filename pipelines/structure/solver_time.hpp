/// @file
/// How long modes take, told before they are solved for: what has begun cannot be asked to end.
#pragma once

#include "mesh/mesh.hpp"
#include "pipelines/description/discretisation.hpp"
#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

/// Seconds of one core of this machine, right within a factor of two. Directly: with the count that
/// none is missed; the factorisations of a three-dimensional mesh grow as n². Iteratively: as n,
/// for the steps hardly grow with the mesh.
[[nodiscard]] double modes_seconds(double degrees_of_freedom, const BasisSettings& basis);

/// What a static equilibrium adds to the modes: that of a rotating body, a contact pressed at rest.
[[nodiscard]] double equilibrium_seconds(double degrees_of_freedom, const SceneDescription& scene);

/// Of a mesh that is made here, of one freedom, where machine_slowness() is 1.
inline constexpr double per_meshed_freedom = 7e-5;

/// Of a mesh that is made here, or read, its modes, equilibria and linear limits.
[[nodiscard]] double mesh_and_modes_seconds(double degrees_of_freedom,
                                            const SceneDescription& scene);

/// The same of elements twice and four times as large, both. @param degrees_of_freedom  of the mesh
///                                                                                    at hand.
[[nodiscard]] double larger_elements_seconds(double degrees_of_freedom,
                                             const SceneDescription& scene);

/// @throws ExhaustedError  half of the forecast, which it may be wrong by,
///         is more than the budget of time leaves.
void require_time(const mesh::Mesh& mesh, const BasisSettings& basis);

}  // namespace microslip::pipelines
