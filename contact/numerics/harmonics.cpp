#include "contact/harmonics.hpp"

#include <stdexcept>
#include <string>

#include "contact/trigonometric_basis.hpp"

namespace microslip::contact {

Harmonics::Harmonics(int n_harmonics, Eigen::Index n_signals) {
  if (n_harmonics < 0 || n_signals < 0) {
    throw std::invalid_argument("Harmonics: n_harmonics = " + std::to_string(n_harmonics) +
                                ", n_signals = " + std::to_string(n_signals) +
                                "; both must be at least 0");
  }
  rows_ = Matrix::Zero(2 * n_harmonics + 1, n_signals);
}

Harmonics::Harmonics(int n_harmonics, Eigen::Index n_signals,
                     const Eigen::Ref<const Eigen::VectorXd>& vector)
    : Harmonics(n_harmonics, n_signals) {
  if (vector.size() != rows_.size()) {
    throw std::invalid_argument("Harmonics: vector of size " + std::to_string(vector.size()) +
                                ", expected " + std::to_string(rows_.size()));
  }
  this->vector() = vector;
}

Eigen::VectorXd Harmonics::at(double phase) const {
  Eigen::VectorXd basis;
  trigonometric_basis(n_harmonics(), phase, basis);
  return rows_.transpose() * basis;
}

}  // namespace microslip::contact
