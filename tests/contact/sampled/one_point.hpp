/// @file
/// A patch of one point whose modes are its own motion:
/// what the lanes make of a case of tests/support.
#pragma once

#include <utility>

#include "contact/sampled/patch_force.hpp"
#include "support/motion_cases.hpp"

namespace microslip::test {

/// Two modes, u and v, or three: u, v, w.
inline contact::sampled::PatchForce one_point(const contact::SurfaceLaw& surface, int n_signals,
                                              int instants) {
  contact::ModalShapes shapes;
  shapes.u = Eigen::RowVectorXd::Unit(n_signals, 0);
  shapes.v = Eigen::RowVectorXd::Unit(n_signals, 1);
  if (n_signals == 3) shapes.w = Eigen::RowVectorXd::Unit(n_signals, 2);
  return {Eigen::VectorXd::Ones(1), {surface}, std::move(shapes), instants};
}

/// The motion of a case as modal coordinates.
inline contact::Harmonics modal(const contact::Harmonics& motion, int n_signals) {
  contact::Harmonics q(motion.n_harmonics(), n_signals);
  q.rows() = motion.rows().leftCols(n_signals);
  return q;
}

}  // namespace microslip::test
