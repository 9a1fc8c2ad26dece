#include "pipelines/scene/bar_modes.hpp"

#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace microslip::pipelines {
namespace {

/// ∫₀ᴸ φ_n dx.
Eigen::VectorXd shape_integrals(const Bar& bar, const BarModes& modes) {
  const auto mean_cosine = [](double z) { return z == 0.0 ? 1.0 : std::sin(z) / z; };
  return bar.length * modes.amplitude.cwiseProduct(modes.root.unaryExpr(mean_cosine));
}

}  // namespace

double bar_root(double kappa, int number) {
  const double base = static_cast<double>(number - 1) * std::numbers::pi;
  double low = 0.0;
  double high = 0.5 * std::numbers::pi;
  if (std::isinf(kappa)) return base + high;
  if (kappa == 0.0) return base;
  // z = kπ + y: z sin y − κ cos y grows from −κ to z on 0 < y < π/2. Halved until nothing lies
  // between.
  for (double y = std::midpoint(low, high); y > low && y < high; y = std::midpoint(low, high)) {
    const bool below = (base + y) * std::sin(y) < kappa * std::cos(y);
    (below ? low : high) = y;
  }
  return base + std::midpoint(low, high);
}

BarModes bar_modes(const Bar& bar, const std::vector<int>& numbers) {
  const double kappa = bar.end_stiffness * bar.length / (bar.youngs_modulus * bar.area);
  const double mass = bar.density * bar.area * bar.length;
  const auto n = static_cast<Eigen::Index>(numbers.size());
  BarModes modes{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const double z = bar_root(kappa, numbers[static_cast<std::size_t>(i)]);
    const double share = z == 0.0 ? 2.0 : 1.0 + std::sin(2.0 * z) / (2.0 * z);
    modes.root[i] = z;
    modes.frequency[i] = z / bar.length * std::sqrt(bar.youngs_modulus / bar.density);
    modes.amplitude[i] = std::sqrt(2.0 / (mass * share));
  }
  return modes;
}

Eigen::MatrixXd bar_shapes(const Bar& bar, const BarModes& modes, const Eigen::VectorXd& x) {
  const Eigen::VectorXd from_right = (1.0 - x.array() / bar.length).matrix();
  const Eigen::MatrixXd argument = from_right * modes.root.transpose();
  return argument.array().cos().matrix() * modes.amplitude.asDiagonal();
}

Eigen::VectorXd bar_residual_flexibility(const Bar& bar, const BarModes& modes,
                                         const Eigen::VectorXd& x) {
  if (bar.end_stiffness == 0.0) {
    if ((modes.root.array() != 0.0).all()) {
      throw std::invalid_argument(
          "bar: a free bar without its rigid-body mode has no residual "
          "flexibility");
    }
    return Eigen::VectorXd::Zero(x.size());
  }
  const double EA = bar.youngs_modulus * bar.area;
  const Eigen::VectorXd weight =
      shape_integrals(bar, modes).cwiseQuotient(modes.frequency.cwiseAbs2());
  const Eigen::VectorXd kept = bar_shapes(bar, modes, x) * weight;
  const Eigen::ArrayXd all =
      bar.length / bar.end_stiffness + (x.array() * bar.length - 0.5 * x.array().square()) / EA;
  return all.matrix() - kept;
}

}  // namespace microslip::pipelines
