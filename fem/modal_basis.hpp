/// @file
/// Mass-normalised modes of a structure without contact: Kφ = ω²Mφ, ΦᵀMΦ = I.
#pragma once

#include <Eigen/Core>

namespace microslip::fem {

struct ModalBasis {
  Eigen::VectorXd frequency;  ///< ω [rad/s], ascending, n_modes; 0 for rigid-body modes
  Eigen::MatrixXd shapes;     ///< Φ [1/√kg], (3 · n_nodes) × n_modes, x y z per mesh node, 0 at supports
  Eigen::VectorXd residual;   ///< ‖Kφ − ω²Mφ‖ / ‖Kφ‖ of each pair (rigid: over ‖K‖‖φ‖) [-]
  Eigen::Index n_rigid_body = 0;
  /// Eigenvalues below a shift just above the last mode, by the inertia of LDLᵀ: equals n_modes (+ a
  /// cluster that straddles the shift), else an eigen-missed-mode error was thrown.
  Eigen::Index inertia_count = 0;
};

/// Flexibility on a surface of the modes left out, for uniform traction (theory section 14): row sums
/// c = ∫ C_res dA' along p, q, r at the nodes of the surface [m³/N], n_surface_nodes × 3. May be
/// negative in places.
struct ResidualFlexibility {
  Eigen::MatrixX3d row_sums;
};

}  // namespace microslip::fem
