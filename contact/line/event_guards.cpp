#include "contact/line/event_guards.hpp"

#include <cmath>

namespace microslip::contact {
namespace {

// The cycle is homogeneous of degree one in motion and preload: forces that would be subnormal, or
// whose products would overflow, are found at another amplitude, by a power of two.
constexpr double lift = 0x1p500;

double scale_of(const PointParameters& point, const Harmonics& motion) {
  const double u = motion.rows().col(0).cwiseAbs().sum();
  const double v = motion.rows().col(1).cwiseAbs().sum();
  const double size =
      point.tangential_stiffness * u + point.normal_stiffness * v + std::abs(point.preload);
  if (size < 1e-250 && u < 1e100 && v < 1e100) {
    return lift;
  }
  return size > 1e140 ? 1.0 / lift : 1.0;
}

}  // namespace

void set_event_guards(const PointParameters& point, const Harmonics& motion, EventGuards& guards) {
  const auto& rows = motion.rows();
  const int degree = motion.n_harmonics();
  const double k_u = point.tangential_stiffness;
  const double k_v = point.normal_stiffness;
  const double mu_k_v = point.friction_coefficient * k_v;
  const double scale = scale_of(point, motion);
  guards.scale = scale;
  for (TrigonometricPolynomial* p :
       {&guards.spring, &guards.load, &guards.positive, &guards.negative}) {
    p->reset(degree);
  }
  // Rounded once: a mean approach that nearly cancels the preload keeps all its digits.
  guards.load.set_mean(std::fma(k_v, scale * rows(0, 1), scale * point.preload));
  guards.limit = point.friction_coefficient * guards.load.mean();
  guards.spring_mean = k_u * (scale * rows(0, 0));
  for (int h = 1; h <= degree; ++h) {
    const double v_sin = scale * motion.sine(h)[1];
    const double v_cos = scale * motion.cosine(h)[1];
    const double sin = k_u * (scale * motion.sine(h)[0]);
    const double cos = k_u * (scale * motion.cosine(h)[0]);
    guards.spring.set(h, sin, cos);
    guards.load.set(h, k_v * v_sin, k_v * v_cos);
    guards.positive.set(h, sin - mu_k_v * v_sin, cos - mu_k_v * v_cos);
    guards.negative.set(h, sin + mu_k_v * v_sin, cos + mu_k_v * v_cos);
  }
  guards.positive_rate.set_derivative(guards.positive);
  guards.negative_rate.set_derivative(guards.negative);
}

}  // namespace microslip::contact
