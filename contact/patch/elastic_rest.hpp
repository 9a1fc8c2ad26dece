/// @file
/// Contact points of an elastic body at rest against the ground under static loads: one-sided springs on freedoms
/// whose flexibility is known.
///
///   v = v⁰ − C Bᵀ f,   f_i = w_i k_i max(0, a_i),   a = B v − g                                        (1)
///
/// v are the normal displacements of n freedoms of the face, v⁰ what they would be without contact, C their
/// flexibility, a_i the approach of a contact point: negative where it is open by −a_i. (1) makes the convex
/// energy ½(v − v⁰)ᵀC⁻¹(v − v⁰) + Σ ½ w k max(0, a)² smallest, so that there is one solution. With the set A of
/// closed points held it is linear,
///
///   (I + C D) v = v⁰ + C Bᵀ_A W K g_A,   D = Bᵀ_A W K B_A                                             (2)
///
/// and Newton's method goes from set to set, each step to the least energy along it: it ends after finitely many.
///
/// Source: theory section 2.1; our own.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace microslip::contact {

/// Normal freedoms of a face, positive towards the ground, under loads that act without contact.
struct ElasticFace {
  Eigen::MatrixXd flexibility;  ///< C [m/N], n × n, symmetric, not negative
  Eigen::VectorXd approach;     ///< v⁰ [m], n
};

/// Contact points between the face and the ground.
struct SpringLayer {
  Eigen::SparseMatrix<double> to_points;  ///< B [-], n_points × n
  Eigen::VectorXd weights;                ///< w [m²], n_points, ≥ 0
  Eigen::VectorXd stiffness;              ///< k [N/m³], n_points, ≥ 0
  Eigen::VectorXd gap;  ///< g [m] of the undeformed body, n_points; negative: interference
};

/// Solves (1).
/// @return v [m], n.
/// @throws std::invalid_argument  sizes differ.
/// @throws std::runtime_error     no set of closed points is found in 200 steps; with forces.
/// @note Without gap the solution is homogeneous: s v⁰ gives s v for every s ≥ 0.
[[nodiscard]] Eigen::VectorXd elastic_rest(const ElasticFace& face, const SpringLayer& layer);

}  // namespace microslip::contact
