/// @file
/// Attachment shapes: static answers of what the modes leave out to tractions on a face and to
/// given forces, so that a few more unknowns carry the forces from one part of a contact face to
/// another (theory section
/// 14.1).
///
///   ψ_j = (K⁻¹ − Σ_n φ_nφ_nᵀ/ω_n²) f_j,     f_j = ∫ Nᵀ t_j dA along p, q and r, given forces
///
/// ψ_j are M- and K-orthogonal to the modes kept. Dependent ones are dropped, the rest made
/// M-orthonormal and diagonal in K: (ΨᵀKΨ) v = ω̃² (ΨᵀMΨ) v. A model with them answers statically
/// to every f_j without error.
///
/// **The degree of the tractions.** Orthonormal tractions t of degree d + 1 (∫ t_i t_j dA = δ_ij)
/// work on
///   E = 1/k_local + C_BB              their own flexibility: local springs in series with the body
///   S = C_BB − C_BA C_AA⁻¹ C_AB       what of it no traction up to degree d reaches
/// with C = FᵀΨ, A the tractions up to d and B those of degree d + 1. The largest eigenvalue of S v
/// = s E v is the share of the flexibility a contact would miss under its worst traction of that
/// degree; it does not depend on axes or units, and it is small only where neither the modes nor
/// the shapes are missing anything. (The stuck limit cannot see this: there the traction is
/// smooth.) `degree` without value takes the lowest degree with s ≤ missed_tolerance.
///
/// s is a worst case: of a traction that is all of degree d + 1, and of the residual flexibility
/// alone, which is itself a small part of what moves the patch near a resonance. Default blade, 10
/// mm, ten modes, gap to stuck, largest error of a peak against forty modes and degree 3:
///   degree   s       amplitude   frequency
///   0        0.23    1.8e-4      4e-6
///   1        0.07    5.5e-6      6e-7
///
/// Source: Craig, Structural Dynamics (1981), residual attachment modes; the indicator is our own.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "fem/modal_basis.hpp"
#include "mesh/face_frame.hpp"
#include "mesh/surface.hpp"

namespace microslip::fem {

struct AttachmentOptions {
  std::optional<int> degree;      ///< of the tractions, ≥ 0; without value: chosen
  double missed_tolerance = 0.3;  ///< largest share s of a chosen degree [-]
  int max_degree = 4;             ///< highest that is chosen
};

/// A contact face that takes tractions.
struct AttachmentFace {
  const mesh::Surface& surface;  ///< of the mesh, borrowed
  mesh::FaceFrame frame;
  /// Of the contact along p, q, r [N/m³], ≥ 0: judges which tractions matter.
  Eigen::Vector3d local_stiffness = Eigen::Vector3d::Zero();
};

/// The shapes of one degree more, which choosing the degree has solved for anyway.
struct RicherBasis {
  ModalBasis basis;
  Eigen::MatrixXd embedding;  ///< of the coordinates of the leaner basis, N_richer × N
};

/// Modes with attachment shapes behind them.
struct AttachedBasis {
  ModalBasis basis;
  int degree = 0;                       ///< of the tractions
  double missed_share = 0.0;            ///< s of that degree [-]; NaN where the degree was given
  Eigen::Index n_dropped = 0;           ///< loads whose shapes depend on others
  std::optional<RicherBasis> richer{};  ///< none where the degree was given
};

}  // namespace microslip::fem
