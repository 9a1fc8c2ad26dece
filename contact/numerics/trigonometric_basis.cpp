#include "contact/trigonometric_basis.hpp"

#include <cmath>

namespace microslip::contact {

void trigonometric_basis(int n_harmonics, double phase, Eigen::VectorXd& value) {
  value.resize(2 * n_harmonics + 1);
  value[0] = 1.0;
  const double s1 = std::sin(phase);
  const double c1 = std::cos(phase);
  double s = s1;
  double c = c1;
  for (int h = 1; h <= n_harmonics; ++h) {
    value[2 * h - 1] = s;
    value[2 * h] = c;
    const double next = s * c1 + c * s1;
    c = c * c1 - s * s1;
    s = next;
  }
}

void basis_rate(const Eigen::VectorXd& value, Eigen::VectorXd& rate) {
  rate.resize(value.size());
  rate[0] = 0.0;
  for (Eigen::Index h = 1; 2 * h < value.size(); ++h) {
    const auto order = static_cast<double>(h);
    rate[2 * h - 1] = order * value[2 * h];
    rate[2 * h] = -order * value[2 * h - 1];
  }
}

}  // namespace microslip::contact
