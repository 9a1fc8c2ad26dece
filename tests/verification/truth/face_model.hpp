/// @file
/// The default blade with every freedom of its contact face kept: the structural half of the truth.
///
/// Free modes φ (clamped root, no contact) and, for every nodal force e_j on the contact face
/// (three directions) and for the excitation, the attachment shape
///
///   ψ_j = (K⁻¹ − Σ_n φ_n φ_nᵀ/ω_n²) e_j.
///
/// The small problem ΨᵀKΨ v = ω̃² ΨᵀMΨ v turns the ψ into further modes; K and M are diagonal on
/// all of them together. Nothing is fitted on the face, no node is left out, and the response to
/// any force on the face is exact at rest; what the omitted modes add in motion is O((ω/ω_N)⁴).
/// Every shape, free or attachment, has the damping ratio of the scene.
///
/// Source: Craig, Structural Dynamics (1981), ch. 19 (attachment modes, Rubin's method); K, M, free
/// modes and static solutions come from fem/, contact/ and solver/ are not used.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace microslip::truth {

struct FaceModelOptions {
  double element_size = 0.010;   ///< [m]
  Eigen::Index n_modes = 60;     ///< free modes
  double damping_ratio = 0.002;  ///< ζ of every shape [-]
  Eigen::Vector3d force_direction{1.0, 0.0, 0.0};
  double force_amplitude = 0.5;  ///< at B and at B' each [N]
  int subdivision = 3;           ///< each face becomes subdivision² triangles
};

struct FaceModel {
  Eigen::VectorXd frequency;  ///< ω [rad/s], n_shapes, free modes first
  double damping_ratio = 0.0;
  Eigen::VectorXd force;   ///< φᵀF, n_shapes [N/√kg]
  Eigen::VectorXd output;  ///< φ at A along x, n_shapes [1/√kg]
  /// n_shapes × 3 n_nodes [1/√kg]: motion of the nodes of the face along p, then q, then r.
  Eigen::MatrixXd at_face;
  Eigen::SparseMatrix<double, Eigen::RowMajor>
      to_points;            ///< n_points × n_nodes: tri6 interpolation
  Eigen::VectorXd weights;  ///< of the points [m²], n_points

  [[nodiscard]] Eigen::Index n_nodes() const { return at_face.cols() / 3; }
};

/// Meshes the default blade and reduces it. p = +y, q = +x (outward), r = −z.
[[nodiscard]] FaceModel build_face_model(const FaceModelOptions& options);

}  // namespace microslip::truth
