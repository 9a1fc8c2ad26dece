#include "contact/force/vibration_alone.hpp"

#include <utility>

namespace microslip::contact {

Harmonics without_mean(Harmonics q) {
  q.rows().row(0).setZero();
  return q;
}

VibrationAlone::VibrationAlone(std::unique_ptr<ModalForce> force)
    : ModalForce(force->n_modes()), force_(std::move(force)) {}

std::unique_ptr<ModalForce::Workspace> VibrationAlone::workspace() const {
  return force_->workspace();
}

CycleReport VibrationAlone::report(const Harmonics& q, double frequency, Workspace& work) const {
  return force_->report(without_mean(q), frequency, work);
}

double VibrationAlone::work_error(const Harmonics& q, double frequency, Workspace& work) const {
  return force_->work_error(without_mean(q), frequency, work);
}

void VibrationAlone::states(const Harmonics& q, double frequency, ContactStates& result,
                            Workspace& work) const {
  force_->states(without_mean(q), frequency, result, work);
}

Eigen::MatrixXd VibrationAlone::stuck_stiffness() const { return force_->stuck_stiffness(); }

LinearState VibrationAlone::linear_state_of(const MotionSet& motions) const {
  return force_->linear_state_of({without_mean(motions.centre), motions.radius, motions.spread});
}

ForceAndJacobian VibrationAlone::evaluated(const Harmonics& q, double frequency, const Asked& asked,
                                           Workspace& work) const {
  ForceAndJacobian result = force_->evaluate(without_mean(q), frequency, asked, work);
  // Rows are ascending: the mean, if it is asked for, is the first.
  if (asked.rows.empty() || asked.rows.front() != 0) return result;
  if (result.fewer) {
    FewerDerivatives fewer = *result.fewer;
    fewer.jacobian.leftCols(fewer.of_modes.rows()).setZero();
    result.fewer = std::make_shared<const FewerDerivatives>(std::move(fewer));
  } else {
    result.jacobian.leftCols(n_modes()).setZero();
  }
  return result;
}

}  // namespace microslip::contact
