#include "solver/balance/linear_resonance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

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

/// Of the modes with a stiffness added.
std::optional<contact::SymmetricPairs> modes_with(const Scene& scene, Eigen::MatrixXd stiffness) {
  stiffness.diagonal() += scene.natural_frequency.cwiseAbs2();
  return contact::symmetric_pairs(stiffness);
}

/// ζω of a shape.
double decay_of(const Scene& scene, const Eigen::VectorXd& shape) {
  return shape.cwiseAbs2().dot(scene.damping_ratio.cwiseProduct(scene.natural_frequency));
}

}  // namespace

std::optional<double> unbounded_resonance(const Scene& scene, const Eigen::MatrixXd& stiffness,
                                          double begin, double end) {
  const auto modes = modes_with(scene, stiffness);
  if (!modes) return std::nullopt;
  const auto [low, high] = std::minmax(begin, end);
  std::optional<double> first;
  for (Eigen::Index i = 0; i < modes->values.size(); ++i) {
    const Eigen::VectorXd shape = modes->vectors.col(i);
    const double resonance = std::sqrt(std::max(0.0, modes->values[i]));
    if (decay_of(scene, shape) > negligible * resonance) continue;
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

double DrivenResonances::distance(double omega) const {
  if (frequency.size() == 0) return std::numeric_limits<double>::infinity();
  return ((frequency - omega).square() + half_width.square()).sqrt().minCoeff();
}

std::optional<double> DrivenResonances::first_within(double from, double to) const {
  std::optional<double> first;
  for (const double one : frequency) {
    const bool is_between = (one - from) * (to - one) > 0.0;
    if (is_between && (!first || std::abs(one - from) < std::abs(*first - from))) first = one;
  }
  return first;
}

DrivenResonances driven_resonances(const Scene& scene, const Eigen::MatrixXd& stiffness) {
  const auto modes = modes_with(scene, stiffness);
  if (!modes) return {};
  std::vector<double> frequencies, half_widths;
  for (Eigen::Index i = 0; i < modes->values.size(); ++i) {
    const Eigen::VectorXd shape = modes->vectors.col(i);
    for (int order = 1; order <= scene.excitation.n_harmonics(); ++order) {
      if (excited_share(scene.excitation, order, shape) <= negligible) continue;
      frequencies.push_back(std::sqrt(std::max(0.0, modes->values[i])) / order);
      half_widths.push_back(decay_of(scene, shape) / order);
    }
  }
  const auto array = [](const std::vector<double>& all) {
    return Eigen::Map<const Eigen::ArrayXd>(all.data(), static_cast<Eigen::Index>(all.size()));
  };
  return {array(frequencies), array(half_widths)};
}

}  // namespace microslip::solver
