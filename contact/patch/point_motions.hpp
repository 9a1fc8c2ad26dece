/// @file
/// Motion of the points of a patch from the modal coordinates: u = Φ_u q, v = Φ_v q, harmonic by
/// harmonic (theory section 13).
#pragma once

#include <vector>

#include "contact/harmonics.hpp"
#include "contact/patch.hpp"
#include "contact/point/point_motion.hpp"

namespace microslip::contact {

/// @throws std::invalid_argument  q has another number of harmonics than 1 or of modes than the
///         shapes.
void require_single_harmonic(const Harmonics& q, Eigen::Index n_modes);

/// @throws std::invalid_argument  q has no harmonic, or another number of modes than the shapes.
void require_harmonics(const Harmonics& q, Eigen::Index n_modes);

/// @param shapes  n_points × n_modes.   @param q  H = 1, n_modes.   @return n_points.
[[nodiscard]] std::vector<PointMotion> point_motions(const ModalShapes& shapes, const Harmonics& q);

/// The same for any number of harmonics and both tangential directions: u, v, w of each point.
/// @param shapes  n_points × n_modes; w may be empty: no motion along r.
/// @param q       H ≥ 1, n_modes.   @return n_points, three signals each.
/// @throws std::invalid_argument  H = 0, or another number of modes.
[[nodiscard]] std::vector<Harmonics> general_motions(const ModalShapes& shapes, const Harmonics& q);

}  // namespace microslip::contact
