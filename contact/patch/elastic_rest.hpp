/// @file
/// Contact points of an elastic body at rest against the ground under static loads: surfaces that
/// cannot pull, on freedoms whose flexibility is known.
///
///   v = v⁰ − C Bᵀ f,   f_i = w_i n_i,   n_i = k_i δ_i(a_i),   a = B v − g                      (1)
///
/// v are the normal displacements of n freedoms of the face, v⁰ what they would be without contact,
/// C their flexibility, a_i the approach of a contact point: negative where it is open by −a_i.
/// δ(a) = max(0, a) of smooth surfaces; of rough ones it is that of
/// contact/surface/rough_surface.hpp. (1) makes the convex energy ½(v − v⁰)ᵀC⁻¹(v − v⁰) + Σ w k ∫δ
/// da smallest, so that there is one solution. Linear about a state a*,
///
///   (I + C D) v = v⁰ + C Bᵀ W [k δ'(a*) (a* + g) − n(a*)],   D = Bᵀ W k δ'(a*) B              (2)
///
/// and Newton's method goes from state to state, each step to the least energy along it. Of smooth
/// surfaces a state is the set of closed points, and it ends after finitely many.
///
/// Source: theory section 2.1; our own.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "contact/surface/rough_surface.hpp"

namespace microslip::contact {

/// Normal freedoms of a face, positive towards the ground, under loads that act without contact.
struct ElasticFace {
  Eigen::MatrixXd flexibility;  ///< C [m/N], n × n, symmetric, not negative
  Eigen::VectorXd approach;     ///< v⁰ [m], n
};

/// Contact points between the face and the ground.
struct ContactLayer {
  Eigen::SparseMatrix<double> to_points;  ///< B [-], n_points × n
  Eigen::VectorXd weights;                ///< w [m²], n_points, ≥ 0
  Eigen::VectorXd stiffness;  ///< k [N/m³], n_points, ≥ 0; of rough surfaces in full contact
  Eigen::VectorXd gap;        ///< g [m] of the undeformed body, n_points; negative: interference
  std::vector<RoughSurface> surfaces;  ///< δ, n_points; empty: all smooth
};

struct ElasticRest {
  Eigen::VectorXd displacement;  ///< v [m], n
  Eigen::VectorXd approach;      ///< a [m], n_points
  Eigen::VectorXd pressure;      ///< n [Pa], n_points, ≥ 0
};

/// Solves (1).
/// @throws std::invalid_argument  sizes differ.
/// @throws std::runtime_error     no state in balance is found in 200 steps; with forces.
/// @note Smooth surfaces without gap: the solution is homogeneous:
///       s v⁰ gives s v and s n for every s ≥ 0.
[[nodiscard]] ElasticRest elastic_rest(const ElasticFace& face, const ContactLayer& layer);

}  // namespace microslip::contact
