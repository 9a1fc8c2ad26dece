/// @file
/// Consistent nodal loads of a traction on a surface.
#pragma once

#include <Eigen/Core>

#include "mesh/face_frame.hpp"
#include "mesh/surface.hpp"

namespace microslip::fem {

/// Share ∫ N_i dA of each mesh node in the area of a surface [m²], size nodes.rows(), 0 off the
/// surface. A uniform traction τ loads node i with τ times its share.
/// @param nodes  all mesh nodes [m].
/// @note May be zero or negative at the corners of quadratic faces; the sum is the area.
[[nodiscard]] Eigen::VectorXd nodal_areas(const Eigen::MatrixX3d& nodes,
                                          const mesh::Surface& surface);

/// Load vectors of a unit traction along p, q and r, at every place those of its own: 3
/// nodes.rows() × 3 [N per Pa].
[[nodiscard]] Eigen::MatrixX3d uniform_tractions(const Eigen::MatrixX3d& nodes,
                                                 const mesh::Surface& surface,
                                                 const mesh::FaceFrame& frame);

/// Load vector ∫ N_i n dA of a unit traction along the outward normal n, wherever it points:
/// 3 nodes.rows() [m²].
/// @note Of a closed surface the forces sum to zero.
[[nodiscard]] Eigen::VectorXd normal_traction(const Eigen::MatrixX3d& nodes,
                                              const mesh::Surface& surface);

}  // namespace microslip::fem
