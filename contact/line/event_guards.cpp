#include "contact/line/event_guards.hpp"

#include <cmath>

namespace microslip::contact {

void set_event_guards(const PointParameters& point, const Harmonics& motion, EventGuards& guards) {
  const auto& rows = motion.rows();
  const int degree = motion.n_harmonics();
  const double k_u = point.tangential_stiffness;
  const double k_v = point.normal_stiffness;
  const double mu_k_v = point.friction_coefficient * k_v;
  for (TrigonometricPolynomial* p :
       {&guards.spring, &guards.load, &guards.positive, &guards.negative}) {
    p->reset(degree);
  }
  // Rounded once: a mean approach that nearly cancels the rest load keeps all its digits.
  guards.load.set_mean(std::fma(k_v, rows(0, 1), point.rest_load));
  guards.limit = point.friction_coefficient * guards.load.mean();
  guards.spring_mean = k_u * rows(0, 0);
  for (int h = 1; h <= degree; ++h) {
    const double v_sin = motion.sine(h)[1];
    const double v_cos = motion.cosine(h)[1];
    const double sin = k_u * motion.sine(h)[0];
    const double cos = k_u * motion.cosine(h)[0];
    guards.spring.set(h, sin, cos);
    guards.load.set(h, k_v * v_sin, k_v * v_cos);
    guards.positive.set(h, sin - mu_k_v * v_sin, cos - mu_k_v * v_cos);
    guards.negative.set(h, sin + mu_k_v * v_sin, cos + mu_k_v * v_cos);
  }
  guards.positive_rate.set_derivative(guards.positive);
  guards.negative_rate.set_derivative(guards.negative);
}

}  // namespace microslip::contact
