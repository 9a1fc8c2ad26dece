/// @file
/// A force asked once, with a workspace of its own: as a test asks where nothing is to be
/// remembered.
#pragma once

#include <numeric>

#include "contact/modal_force.hpp"

namespace microslip::tests {

/// Derivatives by all rows of a motion.
[[nodiscard]] inline contact::Asked by_all_rows(const contact::Harmonics& q) {
  contact::Asked asked;
  asked.rows.resize(static_cast<std::size_t>(q.rows().rows()));
  std::iota(asked.rows.begin(), asked.rows.end(), Eigen::Index{0});
  return asked;
}

[[nodiscard]] inline contact::ForceAndJacobian evaluate(const contact::ModalForce& force,
                                                        const contact::Harmonics& q,
                                                        double frequency,
                                                        const contact::Asked& asked) {
  return force.evaluate(q, frequency, asked, *force.workspace());
}
[[nodiscard]] inline contact::ForceAndJacobian evaluate(const contact::ModalForce& force,
                                                        const contact::Harmonics& q,
                                                        double frequency) {
  return evaluate(force, q, frequency, by_all_rows(q));
}
/// What went before is remembered.
[[nodiscard]] inline contact::ForceAndJacobian evaluate(const contact::ModalForce& force,
                                                        const contact::Harmonics& q,
                                                        double frequency,
                                                        contact::ModalForce::Workspace& work) {
  return force.evaluate(q, frequency, by_all_rows(q), work);
}

[[nodiscard]] inline contact::CycleReport report(const contact::ModalForce& force,
                                                 const contact::Harmonics& q, double frequency) {
  return force.report(q, frequency, *force.workspace());
}

[[nodiscard]] inline contact::ContactStates states(const contact::ModalForce& force,
                                                   const contact::Harmonics& q, double frequency) {
  contact::ContactStates result;
  force.states(q, frequency, result, *force.workspace());
  return result;
}

}  // namespace microslip::tests
