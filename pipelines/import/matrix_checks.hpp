/// @file
/// Whether stiffness and mass of another code fit each other and the body they are said to be of.
///
/// A body that moves as a whole is not strained: away from what is held K t = 0 for translations
/// and rotations t, node by node. Columns of the table of nodes that were exchanged turn a rotation
/// into a strain, whose forces stand on the surface. The mass of a translation is the same along x,
/// y and z.
#pragma once

#include <filesystem>
#include <string>

#include "fem/given_matrices.hpp"
#include "mesh/mesh.hpp"

namespace microslip::pipelines {

/// Files the matrices are from, for messages.
struct MatrixSources {
  std::filesystem::path stiffness, mass, nodes;
};

/// @param matrices  on the nodes of the mesh; rows of what is held are empty.
/// @throws SceneError  a diagonal entry that is not above 0: which; K and M exchanged;
///         displacements that do not fit.
void check_matrices(const mesh::Mesh& mesh, const fem::GivenMatrices& matrices,
                    const MatrixSources& sources);

/// Mass of what is free to move [kg]: along the axis on which most is.
[[nodiscard]] double free_mass(const fem::GivenMatrices& matrices);

/// A question where that mass is none of a body of that volume, else "".
[[nodiscard]] std::string mass_question(const mesh::Mesh& mesh, const fem::GivenMatrices& matrices);

}  // namespace microslip::pipelines
