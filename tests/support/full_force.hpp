/// @file
/// A ModalForce made for tests that always knows all its derivatives.
#pragma once

#include <algorithm>
#include <utility>

#include "contact/modal_force.hpp"

namespace microslip::tests {

class FullForce : public contact::ModalForce {
 public:
  using ModalForce::ModalForce;

 private:
  /// Force and derivatives with the harmonics of q.
  [[nodiscard]] virtual contact::ForceAndJacobian by_all(const contact::Harmonics& q,
                                                         double frequency) const = 0;
  [[nodiscard]] contact::ForceAndJacobian evaluated(const contact::Harmonics& q, double frequency,
                                                    const contact::Asked& asked,
                                                    Workspace& /*work*/) const override {
    contact::Harmonics wide(std::max(q.n_harmonics(), asked.n_harmonics), n_modes());
    wide.rows().topRows(q.rows().rows()) = q.rows();
    return contact::restricted(by_all(wide, frequency), asked.rows);
  }
};

}  // namespace microslip::tests
