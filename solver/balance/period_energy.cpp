#include "solver/balance/period_energy.hpp"

#include <cmath>
#include <numbers>

namespace microslip::solver {

double period_work(const Harmonics& q, const Harmonics& force) {
  double sum = 0.0;
  for (int k = 1; k <= q.n_harmonics(); ++k) {
    sum += k * (q.sine(k).dot(force.cosine(k)) - q.cosine(k).dot(force.sine(k)));
  }
  return std::numbers::pi * sum;
}

double damping_work(const Harmonics& q, const Scene& scene, double frequency) {
  const Eigen::ArrayXd damping =
      2.0 * scene.damping_ratio.array() * scene.natural_frequency.array();
  double sum = 0.0;
  for (int k = 1; k <= q.n_harmonics(); ++k) {
    const Eigen::ArrayXd square =
        (q.sine(k).array().square() + q.cosine(k).array().square()).transpose();
    sum += k * k * (damping * square).sum();
  }
  return std::numbers::pi * frequency * sum;
}

double dissipated(HarmonicBalance& balance, const Harmonics& q, double frequency, double work,
                  double slip_work) {
  constexpr double same = 1e-4;  // both tell the same, the force more exactly
  if (std::abs(work - slip_work) <= same * slip_work) return work;
  return std::isinf(balance.work_error(q, frequency)) ? slip_work : work;
}

PeriodEnergy period_energy(HarmonicBalance& balance, const Eigen::VectorXd& x, double frequency) {
  const Harmonics q = balance.harmonics(x);
  PeriodEnergy energy{.damping = damping_work(q, balance.scene(), frequency)};
  if (balance.scene().contact) {
    const double work = period_work(q, balance.contact_force(x, frequency, q.n_harmonics()));
    const double slip_work = balance.report(q, frequency).slip_work;
    energy.friction = dissipated(balance, q, frequency, work, slip_work);
  }
  return energy;
}

}  // namespace microslip::solver
