/// @file
/// One element at a finite displacement: its internal force and the tangent of that,
/// total Lagrangian.
///
///   F = I + Σ u_i g_iᵀ,   E = ½(FᵀF − I),   S = λ tr(E) I + 2μ E                              (1)
///   f_i = ∫ F S g_i dV                                                                       (2)
///   T_ij = ∂f_i/∂u_j = ∫ [λ a_i a_jᵀ + μ a_j a_iᵀ + μ (g_i·g_j) FFᵀ + (g_i·S g_j) I] dV      (3)
///
/// g = ∇N in the undeformed element, a_i = F g_i. Of (3) the first three terms are the stiffness of
/// element_matrices.hpp in the place the element has moved to, the last is the geometric stiffness
/// of its stresses. The material is that of St Venant and Kirchhoff: linear between S and E, so
/// that small strains under any rotation are those of linear elasticity. Points of integration:
/// stiffness_rule(). (2) and (3) are the first and second derivatives of the energy ∫ ½ S:E dV.
#pragma once

#include <Eigen/Core>

#include "fem/elements/element_matrices.hpp"

namespace microslip::fem {

struct DeformedElement {
  Eigen::Matrix3Xd force;   ///< f [N], a column per node
  NodeBlocks tangent;       ///< T [N/m], 3n × 3n, symmetric
  double strain = 0.0;      ///< ‖E‖, largest at the points of integration
  bool inside_out = false;  ///< det F ≤ 0 at one of them
};

/// @param nodes         undeformed coordinates [m], n × 3, project order.
/// @param displacement  of its nodes [m], n × 3.
/// @param result        resized as needed; reuse it over elements.
/// @note Without displacement f = 0 and T is the stiffness. A rigid rotation leaves f = 0.
void deform_element(mesh::ElementType type, const Eigen::MatrixX3d& nodes,
                    const Eigen::MatrixX3d& displacement, const Material& material, Tet10Rule rule,
                    DeformedElement& result);

}  // namespace microslip::fem
