#include "contact/closed_form/slip_functions.hpp"

#include <cmath>

namespace microslip::contact {
namespace {

__extension__ using Quad = __float128;

double length(double x, double y) { return std::sqrt(x * x + y * y); }

// One Newton step from the double root doubles the digits.
Quad root(Quad x) {
  const Quad guess = std::sqrt(static_cast<double>(x));
  return guess > 0 ? guess + (x - guess * guess) / (2 * guess) : guess;
}

Direction direction(double sin, double cos, double size) {
  return size > 0.0 ? Direction{sin / size, cos / size} : Direction{};
}

// Where a difference has lost four digits or more, sixteen digits of its terms are not enough.
bool near_a_limit(const SlipFunctions& w) {
  constexpr double share = 1e-4;
  const double size = w.positive + w.negative;
  const double slip = share * size;
  const double load = share * w.load_amplitude;
  const double rest = share * (2.0 * std::abs(w.limit) + std::abs(w.difference));
  return std::abs(w.excess) < slip || w.positive < slip || w.negative < slip ||
         std::abs(w.above_open) < load || std::abs(w.below_closed) < load ||
         std::abs(w.rest_positive) < rest || std::abs(w.rest_negative) < rest;
}

SlipFunctions refined(const PointParameters& point, const PointMotion& motion) {
  const Quad ku = point.tangential_stiffness;
  const Quad kv = point.normal_stiffness;
  const Quad mu = point.friction_coefficient;
  const Quad as = ku * motion.u_sin;
  const Quad ac = ku * motion.u_cos;
  const Quad bs = mu * kv * motion.v_sin;
  const Quad bc = mu * kv * motion.v_cos;
  const Quad n0 = point.rest_load + kv * motion.v_mean;
  const Quad vs = motion.v_sin;
  const Quad vc = motion.v_cos;
  const Quad B = kv * root(vs * vs + vc * vc);
  const Quad L1 = root((as - bs) * (as - bs) + (ac - bc) * (ac - bc));
  const Quad L2 = root((as + bs) * (as + bs) + (ac + bc) * (ac + bc));
  const Quad sum = L1 + L2;

  SlipFunctions w;
  w.bias_load = static_cast<double>(n0);
  w.load_amplitude = static_cast<double>(B);
  w.above_open = static_cast<double>(B + n0);
  w.below_closed = static_cast<double>(B - n0);
  w.limit = static_cast<double>(mu * n0);
  w.positive = static_cast<double>(L1);
  w.negative = static_cast<double>(L2);
  const Quad difference = sum > 0 ? 4 * (as * bs + ac * bc) / sum : 0;
  w.difference = static_cast<double>(difference);
  w.excess = static_cast<double>(sum - 2 * mu * n0);
  w.rest_positive = static_cast<double>(2 * mu * n0 - difference);
  w.rest_negative = static_cast<double>(2 * mu * n0 + difference);
  w.end_of_positive =
      direction(static_cast<double>(as - bs), static_cast<double>(ac - bc), w.positive);
  w.end_of_negative =
      direction(static_cast<double>(-as - bs), static_cast<double>(-ac - bc), w.negative);
  w.largest_load = direction(motion.v_sin, motion.v_cos, length(motion.v_sin, motion.v_cos));
  return w;
}

}  // namespace

SlipFunctions slip_functions(const PointParameters& point, const PointMotion& motion) {
  const double ku = point.tangential_stiffness;
  const double kv = point.normal_stiffness;
  const double coupling = point.friction_coefficient * kv;
  const double as = ku * motion.u_sin;
  const double ac = ku * motion.u_cos;
  const double bs = coupling * motion.v_sin;
  const double bc = coupling * motion.v_cos;
  const double v_amplitude = length(motion.v_sin, motion.v_cos);

  SlipFunctions w;
  // Rounded once: a mean approach that nearly cancels the rest load keeps all its digits.
  w.bias_load = std::fma(kv, motion.v_mean, point.rest_load);
  w.load_amplitude = kv * v_amplitude;
  w.above_open = w.load_amplitude + w.bias_load;
  w.below_closed = w.load_amplitude - w.bias_load;
  w.limit = point.friction_coefficient * w.bias_load;
  w.positive = length(as - bs, ac - bc);
  w.negative = length(as + bs, ac + bc);
  const double sum = w.positive + w.negative;
  // Quotients before products: |b| ≤ sum / 2, so nothing underflows that matters.
  w.difference = sum > 0.0 ? 4.0 * (as * (bs / sum) + ac * (bc / sum)) : 0.0;
  w.excess = sum - 2.0 * w.limit;
  w.rest_positive = 2.0 * w.limit - w.difference;
  w.rest_negative = 2.0 * w.limit + w.difference;
  if (near_a_limit(w)) {
    return refined(point, motion);
  }
  w.end_of_positive = direction(as - bs, ac - bc, w.positive);
  w.end_of_negative = direction(-as - bs, -ac - bc, w.negative);
  w.largest_load = direction(motion.v_sin, motion.v_cos, v_amplitude);
  return w;
}

}  // namespace microslip::contact
