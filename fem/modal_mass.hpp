/// @file
/// Modal masses and strain energies of given shapes: what modes from elsewhere are checked by.
///
///   G = ΦᵀMΦ = Σ_e Σ_ij m_ij Σ_d φ_id φ_jdᵀ,   m_ij = ∫ ρ N_i N_j dV of element e   [kg]
///
/// with the consistent mass of the elements (fem/elements/element_matrices.hpp).
/// Modes of M have G = I.
#pragma once

#include <Eigen/Core>

#include "fem/material.hpp"
#include "mesh/mesh.hpp"

namespace microslip::fem {

/// @param density  ρ [kg/m³], > 0, of the whole mesh.
/// @param shapes   Φ [1/√kg], 3 n_nodes × n, x y z per mesh node.
/// @return  G, n × n.
/// @throws std::invalid_argument  a density out of range, or another number of rows.
/// @note A translation by 1 has the mass of the mesh.
[[nodiscard]] Eigen::MatrixXd modal_mass(const mesh::Mesh& mesh, double density,
                                         const Eigen::MatrixXd& shapes);

/// φᵀKφ of every shape with the stiffness of a body of one material, held by nothing [N/m per kg].
/// @param material  its E and ν; the density does not matter.  @param shapes  as above.
/// @throws std::invalid_argument  as above.
[[nodiscard]] Eigen::VectorXd modal_stiffness(const mesh::Mesh& mesh, const Material& material,
                                              const Eigen::MatrixXd& shapes);

}  // namespace microslip::fem
