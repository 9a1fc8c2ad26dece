#include "solver/balance/linear_resonance.hpp"

#include <algorithm>
#include <cmath>

#include "contact/dense.hpp"

namespace microslip::solver {
namespace {

// Of an eigenvector of length one: less is rounding.
constexpr double negligible = 1e-14;

/// Excitation of a unit shape by one harmonic, against all of that harmonic.
double excited_share(const Harmonics& excitation, int order, const Eigen::VectorXd& shape) {
  const auto rows = excitation.rows().middleRows(2 * order - 1, 2);
  const double all = rows.norm();
  return all > 0.0 ? (rows * shape).norm() / all : 0.0;
}

}  // namespace

std::optional<double> unbounded_resonance(const Scene& scene, const Eigen::MatrixXd& stiffness,
                                          double begin, double end) {
  const Eigen::ArrayXd omega = scene.natural_frequency.array();
  Eigen::MatrixXd total = stiffness;
  total.diagonal() += omega.square().matrix();
  const auto modes = contact::symmetric_pairs(total);
  if (!modes) return std::nullopt;
  const auto [low, high] = std::minmax(begin, end);
  std::optional<double> first;
  for (Eigen::Index i = 0; i < omega.size(); ++i) {
    const Eigen::VectorXd shape = modes->vectors.col(i);
    const double resonance = std::sqrt(std::max(0.0, modes->values[i]));
    const double damping = (shape.array().square() * scene.damping_ratio.array() * omega).sum();
    if (damping > negligible * resonance) continue;
    for (int order = 1; order <= scene.excitation.n_harmonics(); ++order) {
      const double frequency = resonance / order;
      if (frequency < low || frequency > high) continue;
      if (excited_share(scene.excitation, order, shape) <= negligible) continue;
      const bool nearer = !first || std::abs(frequency - begin) < std::abs(*first - begin);
      if (nearer) first = frequency;
    }
  }
  return first;
}

}  // namespace microslip::solver
