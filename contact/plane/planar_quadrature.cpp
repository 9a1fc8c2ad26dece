#include "contact/plane/planar_quadrature.hpp"

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

}  // namespace microslip::contact
