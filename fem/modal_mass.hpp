/// @file
/// Modal masses of given shapes: what the normalisation of modes from elsewhere is checked by.
///
///   G = ΦᵀMΦ = Σ_e Σ_ij m_ij Σ_d φ_id φ_jdᵀ,   m_ij = ∫ ρ N_i N_j dV of element e   [kg]
///
/// with the consistent mass of the elements (fem/elements/element_matrices.hpp). Modes of M have G = I.
#pragma once

#include <Eigen/Core>

#include "mesh/mesh.hpp"

namespace microslip::fem {

/// @param density  ρ [kg/m³], > 0, of the whole mesh.
/// @param shapes   Φ [1/√kg], 3 n_nodes × n, x y z per mesh node.
/// @return  G, n × n.
/// @throws std::invalid_argument  a density out of range, or another number of rows.
/// @note A translation by 1 has the mass of the mesh.
[[nodiscard]] Eigen::MatrixXd modal_mass(const mesh::Mesh& mesh, double density,
                                         const Eigen::MatrixXd& shapes);

}  // namespace microslip::fem
