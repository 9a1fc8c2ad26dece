/// @file
/// Consistent loads of polynomial tractions on a surface (theory section 14.1).
///
///   t_k(x),  k = 1 … (d+1)(d+2)/2:   ∫ t_i t_j dA = δ_ij
///   a_ki = ∫ N_i t_k dA                                        consistent share of node i
///
/// The t_k span all polynomials of total degree ≤ d.
///
/// Products of Legendre polynomials along the principal axes of the surface, of a curved one in its
/// mean plane, scaled by its second moments, made orthonormal over the surface in order of degree:
/// well conditioned on any patch, and neither the span of a degree nor the polynomials themselves
/// (but for their signs) know which way the contact axes point.
#pragma once

#include <Eigen/Core>

#include "mesh/face_frame.hpp"
#include "mesh/surface.hpp"

namespace microslip::fem {

/// Number of polynomials in two variables of total degree ≤ `degree`; 0 below degree 0.
[[nodiscard]] constexpr Eigen::Index n_polynomials(int degree) {
  return degree < 0 ? 0 : static_cast<Eigen::Index>(degree + 1) * (degree + 2) / 2;
}

/// Load vectors of the orthonormal tractions along p, q and r, at every place those of its own, 3
/// nodes.rows() × 3 n_polynomials(degree) [N for a traction of mean square 1 Pa²/m²]; column 3k + d
/// is polynomial k along axis d. Polynomials are in order of degree:
/// those of a lower degree stand first, unchanged.
/// @param nodes  all mesh nodes [m].   @param degree  ≥ 0.
/// @throws std::invalid_argument  degree < 0, or a surface without area in two directions.
/// @note On a closed or folded surface polynomials may depend on each other:
///       the columns of those that do are zero.
/// @note Degree 0 is uniform_tractions() / √area.
[[nodiscard]] Eigen::MatrixXd polynomial_tractions(const Eigen::MatrixX3d& nodes,
                                                   const mesh::Surface& surface,
                                                   const mesh::FaceFrame& frame, int degree);

}  // namespace microslip::fem
