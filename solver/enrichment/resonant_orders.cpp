#include "solver/enrichment/resonant_orders.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact/dense.hpp"

namespace microslip::solver {
namespace {

constexpr double half_bandwidths = 3.0;

/// Contact stiffness on the first harmonic, averaged over its phase, symmetric part [1/s²].
Eigen::MatrixXd held_stiffness(const HarmonicBalance& balance, const Eigen::MatrixXd& jacobian,
                               double frequency) {
  const Eigen::Index n = balance.scene().n_modes();
  const Eigen::Index s = balance.orders_begin();
  Eigen::MatrixXd stiffness =
      0.5 * (jacobian.block(s, s, n, n) + jacobian.block(s + n, s + n, n, n));
  stiffness.diagonal().array() -=
      balance.scene().natural_frequency.array().square() - frequency * frequency;
  return 0.5 * (stiffness + stiffness.transpose());
}

/// Orders that may resonate with the structure under one contact stiffness.
void add_resonant(const HarmonicBalance& balance, const BranchVector& at,
                  const Eigen::MatrixXd& stiffness, const Harmonics& force, double least_response,
                  std::vector<int>& orders) {
  const Scene& scene = balance.scene();
  Eigen::MatrixXd matrix = stiffness;
  matrix.diagonal() += scene.natural_frequency.cwiseAbs2();
  const auto modes = contact::symmetric_pairs(matrix);
  if (!modes) return;  // not finite: nothing is known of it
  const Eigen::VectorXd rates = 2.0 * scene.damping_ratio.cwiseProduct(scene.natural_frequency);
  for (Eigen::Index j = 0; j < matrix.rows(); ++j) {
    const double natural = std::sqrt(std::max(0.0, modes->values[j]));
    const Eigen::VectorXd shape = modes->vectors.col(j);
    const double rate = shape.cwiseAbs2().dot(rates);  // 2 ζ_j ω_j
    for (int k = 1; k <= force.n_harmonics(); ++k) {
      const double frequency = k * at.parameter;
      if (std::abs(frequency - natural) > half_bandwidths * 0.5 * rate) continue;
      const double drive = std::hypot(force.sine(k).dot(shape), force.cosine(k).dot(shape));
      if (drive >= least_response * rate * frequency) orders.push_back(k);
    }
  }
}

}  // namespace

std::vector<int> resonant_orders(const HarmonicBalance& balance, const BranchVector& at,
                                 const Eigen::MatrixXd& jacobian, const Harmonics& force,
                                 double least) {
  const Eigen::Index n = balance.scene().n_modes();
  const double response = least * at.x.segment(balance.orders_begin(), 2 * n).norm();
  std::vector<int> orders;
  for (const Eigen::MatrixXd& stiffness :
       {Eigen::MatrixXd(Eigen::MatrixXd::Zero(n, n)), balance.stuck_stiffness(),
        held_stiffness(balance, jacobian, at.parameter)}) {
    add_resonant(balance, at, stiffness, force, response, orders);
  }
  std::sort(orders.begin(), orders.end());
  orders.erase(std::unique(orders.begin(), orders.end()), orders.end());
  return orders;
}

}  // namespace microslip::solver
