/// @file
/// Stiffness and mass of another code (scene/matrix_files.hpp) on the nodes of the mesh of a scene.
#pragma once

#include "fem/given_matrices.hpp"
#include "mesh/mesh.hpp"
#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

/// Those of a scene on the nodes of its mesh, in SI.
/// @throws SceneError  files that cannot be used, matrices of different sizes, nodes that mesh and
///         table do not share, as check_matrices() (matrix_checks.hpp).
[[nodiscard]] fem::GivenMatrices matrices_of(const mesh::Mesh& mesh, const SceneDescription& scene);

}  // namespace microslip::pipelines
