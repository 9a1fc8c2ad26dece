/// @file
/// The steady friction cycle of a single contact point, by whichever method its motion calls for:
///
///   motion along r as well      located events in the plane, to 1e-12 of its force scale
///                               (contact/plane)
///   several harmonics           event by event (contact/line)
///   one harmonic                closed form with its Jacobian (contact/closed_form), instants by
///                               the events
#pragma once

#include <optional>

#include <Eigen/Core>

#include "contact/closed_form/friction_cycle.hpp"
#include "contact/harmonics.hpp"
#include "contact/point/point_method.hpp"

namespace microslip::contact {

struct PointCycle {
  PointHistory history;
  std::optional<CycleJacobian> jacobian;  ///< of a motion of one harmonic along p only
};

/// @param point             constants, in the ranges of ContactPatch.
/// @param second_stiffness  along r [N/m³], ≥ 0.
/// @param motion            u, v, w; H ≥ 1, finite [m].
/// @param n_harmonics       of the force in the result, ≥ 1.
/// @param phases            instants asked for [rad], any.
[[nodiscard]] PointCycle point_cycle(const PointParameters& point, double second_stiffness,
                                     const Harmonics& motion, int n_harmonics,
                                     const Eigen::VectorXd& phases);

}  // namespace microslip::contact
