#include "solver/time/time_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "contact/dense.hpp"

namespace microslip::solver {
namespace {

void check(const Scene& scene, double frequency) {
  const Eigen::Index n = scene.n_modes();
  require_for_time(
      std::isfinite(frequency) && frequency > 0.0,
      "frequency = " + std::to_string(frequency) + " rad/s must be finite and above 0");
  require_for_time(n >= 1, "no modes");
  require_for_time(scene.damping_ratio.size() == n && scene.output.size() == n &&
                       scene.excitation.n_signals() == n,
                   "damping ratios, output and excitation must have one entry per mode (" +
                       std::to_string(n) + ")");
  require_for_time(
      scene.natural_frequency.allFinite() && (scene.natural_frequency.array() >= 0.0).all(),
      "natural frequencies must be finite and at least 0");
  require_for_time(scene.damping_ratio.allFinite() && scene.output.allFinite() &&
                       scene.excitation.rows().allFinite(),
                   "damping ratios, output and excitation must be finite");
  require_for_time(scene.transient != nullptr || scene.contact == nullptr,
                   "the contact of this scene is not available in time");
  require_for_time(scene.transient == nullptr || scene.transient->n_modes() == n,
                   "the contact has another number of modes");
}

/// Largest |λ| of q̈ + C q̇ + S q = 0.
double spectral_radius(const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& damping) {
  const Eigen::Index n = damping.size();
  Eigen::MatrixXd first_order = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  first_order.topRightCorner(n, n).setIdentity();
  first_order.bottomLeftCorner(n, n) = -stiffness;
  first_order.bottomRightCorner(n, n).diagonal() = -damping;
  const auto values = contact::general_eigenvalues(first_order);
  if (!values) throw std::invalid_argument("the eigenvalues of the linear limit do not converge");
  return values->cwiseAbs().maxCoeff();
}

/// Sines of the others would take most of the time that a few modes take.
std::vector<int> driven_harmonics(const Harmonics& excitation) {
  std::vector<int> driven;
  for (int h = 1; h <= excitation.n_harmonics(); ++h) {
    if ((excitation.rows().middleRows(2 * h - 1, 2).array() != 0.0).any()) driven.push_back(h);
  }
  return driven;
}

}  // namespace

void require_for_time(bool condition, const std::string& message) {
  if (!condition) throw std::invalid_argument("time integration: " + message);
}

TimeSystem::TimeSystem(const Scene& scene, double frequency)
    : scene_(scene), frequency_(frequency) {
  check(scene, frequency);
  driven_ = driven_harmonics(scene.excitation);
  stiffness_ = scene.natural_frequency.array().square();
  damping_ = 2.0 * scene.damping_ratio.array() * scene.natural_frequency.array();
  const Eigen::MatrixXd free = stiffness_.asDiagonal();
  largest_frequency_ = spectral_radius(free, damping_);
  if (scene.transient) {
    largest_frequency_ = std::max(
        largest_frequency_, spectral_radius(free + scene.transient->stuck_stiffness(), damping_));
  }
}

double TimeSystem::period() const { return 2.0 * std::numbers::pi / frequency_; }

Eigen::VectorXd TimeSystem::excitation(double time) const {
  const auto& rows = scene_.excitation.rows();
  Eigen::VectorXd force = rows.row(0).transpose();
  for (const int h : driven_) {
    const double angle = h * frequency_ * time;
    force.noalias() += std::sin(angle) * rows.row(2 * h - 1).transpose();
    force.noalias() += std::cos(angle) * rows.row(2 * h).transpose();
  }
  return force;
}

Eigen::VectorXd TimeSystem::acceleration(double time, const ModalMotion& motion,
                                         const Eigen::VectorXd& contact_force) const {
  return excitation(time) - damping_.cwiseProduct(motion.velocity) -
         stiffness_.cwiseProduct(motion.q) - contact_force;
}

int TimeSystem::least_steps() const {
  const double steps = std::ceil(period() * largest_frequency_ / largest_step_ratio);
  return static_cast<int>(
      std::clamp(steps, 1.0, static_cast<double>(std::numeric_limits<int>::max())));
}

}  // namespace microslip::solver
