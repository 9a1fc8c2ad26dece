#include "contact/planar_quadrature.hpp"

namespace microslip::contact {
namespace {

GaussNodes make_nodes() {
  GaussNodes rule;
  for (int i = 0; i < n_gauss; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n_gauss + 0.5));
    double slope = 0.0;
    double below = 0.0;
    double two_below = 0.0;
    for (int iteration = 0; iteration < 20; ++iteration) {
      double before = 1.0;
      double value = x;
      for (int k = 2; k <= n_gauss; ++k) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
        two_below = before;
        before = value;
        value = next;
      }
      below = before;  // P_7; two_below is P_6
      slope = n_gauss * (x * value - before) / (x * x - 1.0);
      x -= value / slope;
    }
    const auto at = static_cast<std::size_t>(i);
    rule.node[at] = x;
    rule.weight[at] = 2.0 / ((1.0 - x * x) * slope * slope);
    rule.top[at] = (n_gauss - 0.5) * rule.weight[at] * below;
    rule.second[at] = (n_gauss - 1.5) * rule.weight[at] * two_below;
  }
  return rule;
}

}  // namespace

const GaussNodes& gauss_nodes() {
  static const GaussNodes rule = make_nodes();
  return rule;
}

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
