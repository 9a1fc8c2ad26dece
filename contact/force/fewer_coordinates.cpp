#include "contact/force/fewer_coordinates.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <Eigen/Eigenvalues>

namespace microslip::contact {
namespace {

/// Rows of `vector`, blocks of T's rows, each times T.
Eigen::VectorXd to_modes(const Eigen::VectorXd& vector, const Eigen::MatrixXd& T) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::VectorXd result(vector.size() / T.rows() * T.cols());
  const Eigen::Index n = vector.size() / T.rows();
  Eigen::Map<Rows>(result.data(), n, T.cols()).noalias() =
      Eigen::Map<const Rows>(vector.data(), n, T.rows()) * T;
  return result;
}

/// The largest factor by which T lengthens a vector.
double spectral_norm(const Eigen::MatrixXd& T) {
  const Eigen::MatrixXd square = T * T.transpose();
  return std::sqrt(square.selfadjointView<Eigen::Lower>().operatorNorm());
}

}  // namespace

FewerCoordinates::FewerCoordinates(Eigen::MatrixXd of_modes, std::unique_ptr<ModalForce> force)
    : ModalForce(of_modes.cols()),
      of_modes_(std::move(of_modes)),
      norm_(spectral_norm(of_modes_)),
      force_(std::move(force)) {
  if (force_->n_modes() != of_modes_.rows()) {
    throw std::invalid_argument("FewerCoordinates: a force of another number of coordinates");
  }
}

Harmonics FewerCoordinates::coordinates(const Harmonics& q) const {
  Harmonics x(q.n_harmonics(), of_modes_.rows());
  x.rows().noalias() = q.rows() * of_modes_.transpose();
  return x;
}

std::unique_ptr<ModalForce::Workspace> FewerCoordinates::workspace() const {
  return force_->workspace();
}

CycleReport FewerCoordinates::report(const Harmonics& q, double frequency, Workspace& work) const {
  return force_->report(coordinates(q), frequency, work);
}

double FewerCoordinates::work_error(const Harmonics& q, double frequency, Workspace& work) const {
  return force_->work_error(coordinates(q), frequency, work);
}

void FewerCoordinates::states(const Harmonics& q, double frequency, ContactStates& result,
                              Workspace& work) const {
  force_->states(coordinates(q), frequency, result, work);
}

Eigen::MatrixXd FewerCoordinates::stuck_stiffness() const {
  return of_modes_.transpose() * force_->stuck_stiffness() * of_modes_;
}

LinearState FewerCoordinates::linear_state_of(const MotionSet& motions) const {
  MotionSet seen{coordinates(motions.centre), norm_ * motions.radius};
  if (motions.spread.size() > 0) seen.spread = of_modes_ * motions.spread;
  return force_->linear_state_of(seen);
}

ForceAndJacobian FewerCoordinates::evaluated(const Harmonics& q, double frequency,
                                             const Asked& asked, Workspace& work) const {
  ForceAndJacobian few = force_->evaluate(coordinates(q), frequency, asked, work);
  ForceAndJacobian result;
  result.force = Harmonics(few.force.n_harmonics(), n_modes());
  result.force.rows().noalias() = few.force.rows() * of_modes_;
  result.frequency_derivative = to_modes(few.frequency_derivative, of_modes_);
  result.defect = norm_ * few.defect;
  FewerDerivatives derivatives{of_modes_, std::move(few.jacobian)};
  if (asked.fewer) {
    result.fewer = std::make_shared<const FewerDerivatives>(std::move(derivatives));
  } else {
    result.jacobian = derivatives.expanded();
  }
  return result;
}

}  // namespace microslip::contact
