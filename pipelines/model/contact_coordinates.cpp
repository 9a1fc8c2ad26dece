#include "pipelines/model/contact_coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "contact/dense.hpp"
#include "pipelines/model/linear_limits.hpp"

namespace microslip::pipelines {
namespace {

// Contact stiffness times compliance of what is left out. Its force is missing in the balance, and
// the residual of a curve does not tell: with 1e-4 up to 2e-2 of the excitation on the default
// blade, with this less than sampling leaves.
constexpr double tolerance = 1e-6;
constexpr double least_damping = 1e-4;

/// Square roots of compliances [s]. The harmonic that meets a resonance far above the range is
/// small: as 1/k² of the first.
Eigen::VectorXd compliances(const ReducedModel& model, double low, double high) {
  Eigen::VectorXd roots(model.frequency.size());
  for (Eigen::Index n = 0; n < roots.size(); ++n) {
    const double resonance = std::max(model.frequency[n], low);
    const double order = std::max(1.0, resonance / high);
    const double gain = 0.5 / std::max(model.damping_ratio[n], least_damping) / (order * order);
    roots[n] = std::sqrt(std::max(1.0, gain)) / resonance;
  }
  return roots;
}

}  // namespace

contact::MotionCoordinates contact_coordinates(const ReducedModel& model,
                                               const SceneDescription& scene) {
  if (model.patches.empty() || !scene.response) return {};
  const auto [low, high] =
      std::minmax(scene.response->frequency_begin_hz, scene.response->frequency_end_hz);
  constexpr double to_angular = 2.0 * std::numbers::pi;
  const Eigen::VectorXd root = compliances(model, to_angular * low, to_angular * high);
  const auto pairs = contact::symmetric_pairs(
      root.asDiagonal() * stuck_stiffness(model, model.effects.second_direction) *
      root.asDiagonal());
  if (!pairs) return {};
  double left_out = 0.0;
  Eigen::Index first = 0;
  while (first + 1 < root.size() && left_out + std::max(0.0, pairs->values[first]) <= tolerance) {
    left_out += std::max(0.0, pairs->values[first++]);
  }
  if (first == 0) return {};
  const Eigen::MatrixXd kept = pairs->vectors.rightCols(root.size() - first);
  return {kept.transpose() * root.cwiseInverse().asDiagonal(), root.asDiagonal() * kept};
}

}  // namespace microslip::pipelines
