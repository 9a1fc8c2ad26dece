/// @file
/// Mass-normalised modes of a structure without contact: Kφ = ω²Mφ, ΦᵀMΦ = I; behind them
/// attachment shapes, if there are any: the static answer of what the modes leave out
/// (fem/attachment.hpp), diagonal in K with ω̃² and orthogonal to the modes.
#pragma once

#include <Eigen/Core>

namespace microslip::fem {

struct ModalBasis {
  /// ω [rad/s], n_modes, ascending, 0 for rigid-body modes; then ω̃ of the attachment shapes.
  Eigen::VectorXd frequency;
  Eigen::MatrixXd
      shapes;  ///< Φ [1/√kg], (3 · n_nodes) × n_modes, x y z per mesh node, 0 at supports
  /// ‖Kφ − ω²Mφ‖ / ‖Kφ‖ of each mode (rigid: over ‖K‖‖φ‖) [-], n_free():
  /// attachment shapes are no pairs.
  Eigen::VectorXd residual;
  Eigen::Index n_rigid_body = 0;
  /// Eigenvalues below a shift just above the last mode, by the inertia of LDLᵀ: equals n_modes (+
  /// a cluster that straddles the shift), else an eigen-missed-mode error was thrown. −1: not
  /// counted, as of an iterative solution.
  Eigen::Index inertia_count = 0;
  Eigen::Index n_attachment = 0;  ///< the last columns are attachment shapes

  [[nodiscard]] Eigen::Index n_free() const { return frequency.size() - n_attachment; }
};

/// Flexibility on a surface of the modes left out, for uniform traction (theory section 14): row
/// sums c = ∫ C_res dA' along p, q, r at the nodes of the surface [m³/N], n_surface_nodes × 3. May
/// be negative in places.
struct ResidualFlexibility {
  Eigen::MatrixX3d row_sums;  ///< without rows where every place has axes of its own
  /// There: displacement of each node under traction along p, then q, then r [m³/N],
  /// n_surface_nodes × 9; what of it goes along the axes of a place is the row sum there.
  Eigen::MatrixXd displacements{};
};

}  // namespace microslip::fem
