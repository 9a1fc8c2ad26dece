#include "pipelines/effects/motion_along_r.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "pipelines/model/linear_limits.hpp"

namespace microslip::pipelines {
namespace {

constexpr int n_sampled_frequencies = 200;

bool rubs(const contact::PatchSamples& cells, Eigen::Index point) {
  return cells.has_friction(point) &&
         (cells.stiffness(point, 0) > 0.0 || cells.stiffness(point, 2) > 0.0);
}

bool any_rubbing_motion_along_r(const contact::PatchSamples& cells) {
  if (cells.shapes.w.size() == 0) return false;
  for (Eigen::Index i = 0; i < cells.size(); ++i) {
    if (rubs(cells, i) && (cells.shapes.w.row(i).array() != 0.0).any()) return true;
  }
  return false;
}

/// Over the area of all patches.
double rms(const ReducedModel& model, Eigen::MatrixXd contact::ModalShapes::*shape,
           const Eigen::VectorXcd& q) {
  double sum = 0.0;
  for (const contact::Patch& patch : model.patches) {
    const Eigen::VectorXcd motion = (patch.cells.shapes.*shape).cast<std::complex<double>>() * q;
    sum += patch.cells.weights.dot(motion.cwiseAbs2());
  }
  return std::sqrt(sum);
}

struct PatchMotion {
  double along_p = 0.0;
  double along_r = 0.0;

  [[nodiscard]] double ratio() const {
    if (along_r == 0.0) return 0.0;
    return along_p > 0.0 ? along_r / along_p : std::numeric_limits<double>::infinity();
  }
};

/// Nothing where the response has no bound, at a resonance without damping.
PatchMotion motion_at(const ReducedModel& model, const Eigen::MatrixXd& stiffness,
                      double frequency) {
  const Eigen::VectorXcd q = linear_response(model, stiffness, frequency);
  if (!q.allFinite()) return {};
  return {rms(model, &contact::ModalShapes::u, q), rms(model, &contact::ModalShapes::w, q)};
}

/// A peak that moves along r counts by itself, however small beside another one of the range.
double largest_ratio(const ReducedModel& model, const Eigen::MatrixXd& stiffness, double low,
                     double high) {
  PatchMotion most_along_p;
  PatchMotion most_along_r;
  for (int i = 0; i < n_sampled_frequencies; ++i) {
    const double frequency = low + (high - low) * i / (n_sampled_frequencies - 1);
    const PatchMotion motion = motion_at(model, stiffness, frequency);
    if (motion.along_p > most_along_p.along_p) most_along_p = motion;
    if (motion.along_r > most_along_r.along_r) most_along_r = motion;
  }
  double ratio = std::max(most_along_p.ratio(), most_along_r.ratio());
  for (const double resonance : resonances(model, stiffness)) {
    if (resonance < low || resonance > high) continue;
    ratio = std::max(ratio, motion_at(model, stiffness, resonance).ratio());
  }
  return ratio;
}

}  // namespace

double motion_ratio_along_r(const ReducedModel& model, const SceneDescription& scene) {
  if (!scene.response || !can_rub_along_r(model)) return 0.0;
  const auto [low, high] =
      std::minmax(scene.response->frequency_begin_hz, scene.response->frequency_end_hz);
  const double to_angular = 2.0 * std::numbers::pi;
  const Eigen::Index n = model.frequency.size();
  double ratio = 0.0;
  for (const Eigen::MatrixXd& stiffness :
       std::array<Eigen::MatrixXd, 2>{Eigen::MatrixXd::Zero(n, n), stuck_stiffness(model, true)}) {
    ratio = std::max(ratio, largest_ratio(model, stiffness, to_angular * low, to_angular * high));
  }
  return ratio;
}

bool can_rub_along_r(const ReducedModel& model) {
  return std::ranges::any_of(model.patches, [](const contact::Patch& patch) {
    return any_rubbing_motion_along_r(patch.cells);
  });
}

}  // namespace microslip::pipelines
