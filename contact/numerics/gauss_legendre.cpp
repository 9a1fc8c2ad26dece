#include "contact/numerics/gauss_legendre.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace microslip::contact {
namespace {

struct Legendre {
  double value;
  double slope;
};

Legendre legendre(int n, double x) {
  double before = 1.0;
  double value = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k;
    before = value;
    value = next;
  }
  return {value, n * (x * value - before) / (x * x - 1.0)};
}

}  // namespace

LineRule gauss_legendre(int order) {
  if (order < 1) {
    throw std::invalid_argument("gauss_legendre: order " + std::to_string(order) +
                                ", must be at least 1");
  }
  LineRule rule{Eigen::VectorXd(order), Eigen::VectorXd(order)};
  for (int i = 0; i < order; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (order + 0.5));
    // Newton from this start converges quadratically; six steps exhaust double precision.
    for (int step = 0; step < 6; ++step) {
      const Legendre p = legendre(order, x);
      x -= p.value / p.slope;
    }
    const double slope = legendre(order, x).slope;
    rule.nodes[i] = 0.5 * (1.0 + x);
    rule.weights[i] = 1.0 / ((1.0 - x * x) * slope * slope);
  }
  rule.weights /= rule.weights.sum();
  return rule;
}

}  // namespace microslip::contact
