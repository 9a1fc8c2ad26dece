/// @file
/// Stiffness and consistent mass of one isotropic, linear elastic element.
///
///   K_ij = ∫ [λ g_i g_jᵀ + μ g_j g_iᵀ + μ (g_i·g_j) I] dV     (3 × 3 per node pair, g = ∇N)   (1)
///   m_ij = ∫ ρ N_i N_j dV,   M_ij = m_ij I                                                  (2)
///
/// with Lamé's λ = Eν/((1+ν)(1−2ν)), μ = E/(2(1+ν)). (1) needs only S = ∫ g gᵀ dV over the
/// 3n-vector g of all gradients: λ, its transposed blocks and their traces give K.
///
/// Quadrature. (2) is a polynomial in the reference coordinates, of pyramids in the collapsed ones,
/// and integrated exactly for every shape. (1) is exact on parallelepipeds, wedges between parallel
/// equal triangles, pyramids on parallelograms, straight-sided tetrahedra, and rational otherwise:
///   tet4      1 point            tet10      straight edges: 4 points, curved: 14 points
///   hex8      2³ points          hex20      3³ points
///   wedge6    3 × 2 points       wedge15    6 × 3 points
///   pyramid5  2³ points          pyramid13  3³ points (collapsed Gauss–Jacobi)
/// For every shape with straight edges ∫ g dV is exact: a patch of them carries uniform strain.
/// Hex8, like wedge6 and pyramid5, is fully integrated, without incompatible modes or B-bar: honest
/// and convergent, but stiff in bending and near ν = ½; prefer quadratic elements there.
///
/// Source: Hughes, The Finite Element Method (1987), sections 2.7 and 3.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "fem/elements/quadrature.hpp"
#include "fem/material.hpp"
#include "mesh/element_type.hpp"

namespace microslip::fem {

/// How tet10 is integrated. `accurate` is the rule above. `four_point` takes four points for K and
/// M of every tet10, as CalculiX does, and is there to be compared with it: the mass is then too
/// small for the shortest waves and curved edges count for less. The two differ by discretisation
/// error (on a coarse twisted plate by 2e-3 in the tenth frequency) and agree as the mesh is
/// refined.
enum class Tet10Rule : std::uint8_t { accurate, four_point };

/// Points at which (1) is integrated, as tabulated above.
/// @param nodes  n × 3 [m]: straight or curved edges, of tet10 alone.
[[nodiscard]] const QuadratureRule& stiffness_rule(mesh::ElementType type,
                                                   const Eigen::MatrixX3d& nodes, Tet10Rule rule);

/// 3 × 3 blocks per pair of nodes, as PETSc takes them.
using NodeBlocks = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct ElementMatrices {
  NodeBlocks stiffness;  ///< 3n × 3n [N/m]
  Eigen::MatrixXd mass;  ///< n × n [kg]: the same for x, y and z
};

/// @param type   element type with n nodes.
/// @param nodes  coordinates of its nodes [m], n × 3, project order.
/// @param material  ranges are checked by check_material, not here.
/// @param result  resized as needed; reuse it over elements to spare allocations.
/// @note K annihilates the six rigid-body motions to rounding;
///       the sum of m_ij is ρ times the volume.
void element_matrices(mesh::ElementType type, const Eigen::MatrixX3d& nodes,
                      const Material& material, Tet10Rule rule, ElementMatrices& result);

/// @throws std::invalid_argument  E ≤ 0, ν outside (−1, 0.5), ρ ≤ 0 or not finite: names the
///         quantity, its value and the range.
void check_material(const Material& material);

}  // namespace microslip::fem
