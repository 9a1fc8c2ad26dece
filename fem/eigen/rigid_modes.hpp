/// @file
/// Motions that strain nothing, found from geometry before anything is factorised: each part of the
/// mesh (elements joined by common nodes) has six rigid-body motions, less what its supports hold.
///
/// Known beforehand, the rigid modes need not be found as a multiple eigenvalue at zero, where
/// rounding would decide what is zero.
#pragma once

#include <Eigen/Core>

#include "fem/assembly/fe_system.hpp"

namespace microslip::fem {

/// Free rigid-body motions, rows of this rank × number of motions, M-orthonormal. None for a body
/// that is held at three or more nodes not on one line.
/// @note Hinges inside a part (elements that share only an edge or a corner) are not seen here.
[[nodiscard]] Eigen::MatrixXd rigid_body_modes(const mesh::Mesh& mesh, const FeSystem& system);

/// Upper bound of the lowest elastic eigenvalue ω² [rad²/s²] of a body with rigid-body modes:
/// Rayleigh–Ritz over all displacement fields quadratic in x, y, z. Of the right order for any
/// compact or slender body: a scale for the shift.
[[nodiscard]] double elastic_scale(const Eigen::MatrixX3d& nodes, const FeSystem& system,
                                   Eigen::Index n_rigid);

}  // namespace microslip::fem
