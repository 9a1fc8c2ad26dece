#include "contact/force/point_projection.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace microslip::contact {
namespace {

// Large enough for products to be fast, small enough for their rows to stay in cache.
constexpr std::size_t block_points = 16;

std::size_t padded(std::size_t n) {
  return (n + projection_lanes - 1) / projection_lanes * projection_lanes;
}

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Block = Eigen::Map<const RowMajor, 0, Eigen::OuterStride<>>;

// The first rows and columns of an array [row][stride].
Block block_of(const std::vector<double>& values, std::size_t n_rows, std::size_t n_columns,
               std::size_t stride) {
  return {values.data(), static_cast<Eigen::Index>(n_rows), static_cast<Eigen::Index>(n_columns),
          Eigen::OuterStride<>(static_cast<Eigen::Index>(stride))};
}

}  // namespace

void PointProjection::start(const std::vector<const Eigen::MatrixXd*>& shapes, int n_harmonics,
                            const std::vector<Eigen::Index>& rows) {
  shapes_ = &shapes;
  rows_ = rows;
  const Eigen::Index N = shapes.front()->cols();
  n_all_ = static_cast<std::size_t>(2 * n_harmonics + 1);
  size_.n_modes = static_cast<std::size_t>(N);
  size_.n_signals = shapes.size();
  size_.n_rows = rows.size();
  size_.phi_stride = padded(size_.n_modes);
  size_.stride = padded(size_.n_rows * size_.n_modes + projection_lanes);
  const std::size_t block_rows = block_points * size_.n_signals;
  size_.block = block_rows * size_.stride;
  n_waiting_ = 0;
  any_jacobian_ = false;
  depends_on_frequency_ = false;
  defect_ = 0.0;
  phi_.assign(block_rows * size_.phi_stride, 0.0);
  force_.resize(block_rows * n_all_);
  by_frequency_.resize(block_rows * n_all_);
  coefficients_.resize(size_.n_rows * size_.n_signals * size_.n_rows * size_.n_signals);
  spread_.resize(size_.n_rows * size_.block);
  jacobian_.assign(size_.n_rows * size_.n_modes * size_.stride, 0.0);
  force_sum_ = Harmonics(n_harmonics, N);
  by_frequency_sum_ = Harmonics(n_harmonics, N);
}

void PointProjection::add(Eigen::Index point, double weight, double reference_load,
                          const PointTraction& traction) {
  double shape = 0.0;
  for (std::size_t s = 0; s < size_.n_signals; ++s) {
    double* row = phi(n_waiting_ + s);
    for (std::size_t m = 0; m < size_.n_modes; ++m) {
      row[m] = (*(*shapes_)[s])(point, static_cast<Eigen::Index>(m));
      shape += row[m] * row[m];
    }
  }
  if (traction.defect > 0.0) defect_ += weight * traction.defect * std::sqrt(shape);
  add_forces(weight, reference_load, traction);
  if (size_.n_rows > 0) {
    const bool touches = traction.regime != CycleRegime::separated;
    any_jacobian_ = any_jacobian_ || touches;
    if (touches)
      gather(weight, traction.jacobian);
    else
      std::fill(coefficients_.begin(), coefficients_.end(), 0.0);
    projection_kernels().spread(size_, phi(n_waiting_), coefficients_.data(),
                                spread_.data() + n_waiting_ * size_.stride);
  }
  n_waiting_ += size_.n_signals;
  if (n_waiting_ == block_points * size_.n_signals) flush();
}

void PointProjection::add_forces(double weight, double reference_load,
                                 const PointTraction& traction) {
  const bool depends = !traction.frequency_derivative.isZero(0.0);
  if (depends && !depends_on_frequency_) std::fill(by_frequency_.begin(), by_frequency_.end(), 0.0);
  depends_on_frequency_ = depends_on_frequency_ || depends;
  const double* force = traction.force.rows().data();
  for (std::size_t s = 0; s < size_.n_signals; ++s) {
    double* row = force_.data() + (n_waiting_ + s) * n_all_;
    for (std::size_t k = 0; k < n_all_; ++k) row[k] = weight * force[n_point_signals * k + s];
    if (s == 1) row[0] = weight * (force[1] - reference_load);
    if (!depends_on_frequency_) continue;
    double* derivative = by_frequency_.data() + (n_waiting_ + s) * n_all_;
    for (std::size_t k = 0; k < n_all_; ++k) {
      derivative[k] = weight * traction.frequency_derivative.data()[n_point_signals * k + s];
    }
  }
}

void PointProjection::gather(double weight, const Eigen::MatrixXd& jacobian) {
  const auto column_step = static_cast<std::size_t>(jacobian.rows());
  double* to = coefficients_.data();
  for (const Eigen::Index k : rows_) {
    for (std::size_t s = 0; s < size_.n_signals; ++s) {
      const double* row = jacobian.data() + n_point_signals * k + static_cast<Eigen::Index>(s);
      for (const Eigen::Index l : rows_) {
        const double* from = row + static_cast<std::size_t>(n_point_signals * l) * column_step;
        for (std::size_t t = 0; t < size_.n_signals; ++t) *to++ = weight * from[t * column_step];
      }
    }
  }
}

void PointProjection::flush() {
  const std::size_t n = std::exchange(n_waiting_, 0);
  if (n == 0) return;
  const Block shapes = block_of(phi_, n, size_.n_modes, size_.phi_stride);
  force_sum_.rows().noalias() += block_of(force_, n, n_all_, n_all_).transpose() * shapes;
  if (depends_on_frequency_) {
    by_frequency_sum_.rows().noalias() +=
        block_of(by_frequency_, n, n_all_, n_all_).transpose() * shapes;
  }
  if (!std::exchange(any_jacobian_, false)) return;
  for (std::size_t k = 0; k < size_.n_rows; ++k) {
    projection_kernels().add(size_, n, phi_.data(), spread_.data() + k * size_.block,
                             jacobian_.data() + k * size_.n_modes * size_.stride);
  }
}

ForceAndJacobian PointProjection::take() {
  flush();
  const auto N = static_cast<Eigen::Index>(size_.n_modes);
  const std::size_t n = size_.n_rows * size_.n_modes;
  ForceAndJacobian result{std::move(force_sum_), block_of(jacobian_, n, n, size_.stride),
                          Eigen::VectorXd(static_cast<Eigen::Index>(n)), defect_};
  Eigen::Index at = 0;
  for (const Eigen::Index row : rows_) {
    result.frequency_derivative.segment(at, N) = by_frequency_sum_.rows().row(row).transpose();
    at += N;
  }
  return result;
}

}  // namespace microslip::contact
