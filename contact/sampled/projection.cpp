#include "contact/sampled/projection.hpp"

#include <algorithm>
#include <utility>

#include "contact/lanes/product_kernels.hpp"

namespace microslip::contact::sampled {
namespace {

constexpr std::size_t waiting_points = 16;

void add_to(std::vector<double>& to, const std::vector<double>& from) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += from[i];
}

// Rows of whole packs, with room behind the last.
std::size_t padded(std::size_t n) { return (n + product_slack + 7) / 8 * 8; }

}  // namespace

void Projection::start(const ModalShapes& shapes, const Instants& of_motion,
                       const Instants& of_force, const std::vector<Eigen::Index>& rows) {
  shapes_ = &shapes;
  motion_ = &of_motion;
  force_ = &of_force;
  rows_ = rows;
  asked_.clear();
  for (const Eigen::Index row : rows) {
    asked_.push_back(of_motion.split(static_cast<std::size_t>(row)));
  }
  std::sort(asked_.begin(), asked_.end());
  all_ = asked_.size() == of_motion.n_rows();
  n_modes_ = static_cast<std::size_t>(shapes.u.cols());
  n_directions_ = shapes.w.size() > 0 ? 2 : 1;
  n_waiting_ = 0;
  any_by_frequency_ = any_derivative_ = false;
  const std::size_t n_pairs = n_modes_ * (n_modes_ + 1) / 2;
  const std::size_t n_columns = asked_.size() * n_modes_;
  const std::size_t block_rows = waiting_points * n_directions_;
  force_size_ = {n_modes_, of_force.n_rows(), padded(n_modes_), padded(of_force.n_rows())};
  pair_size_ = {n_pairs, of_motion.n_moments(), padded(n_pairs), padded(of_motion.n_moments())};
  size_ = {n_modes_, n_columns, padded(n_modes_), padded(n_columns)};
  spread_block_ = block_rows * size_.stride;
  phi_t_.assign(block_rows * force_size_.phi_stride, 0.0);
  phi_v_.assign(waiting_points * force_size_.phi_stride, 0.0);
  pairs_.assign(waiting_points * pair_size_.phi_stride, 0.0);
  for (auto& shape : shape_) shape.assign(force_size_.phi_stride, 0.0);
  tangential_.assign(block_rows * force_size_.stride, 0.0);
  by_frequency_.assign(block_rows * force_size_.stride, 0.0);
  normal_.assign(waiting_points * force_size_.stride, 0.0);
  moments_.assign(waiting_points * pair_size_.stride, 0.0);
  spread_.resize(asked_.size() * spread_block_);
  compact_.resize(3 * (of_motion.n_rows() + 8));
  force_sum_.assign(n_modes_ * force_size_.stride, 0.0);
  by_frequency_sum_.assign(n_modes_ * force_size_.stride, 0.0);
  pair_sum_.assign(n_pairs * pair_size_.stride, 0.0);
  sum_.assign(asked_.size() * n_modes_ * size_.stride, 0.0);
}

void Projection::add(Eigen::Index point, double weight, double reference_load,
                     const std::array<const double*, 3>& sums, std::size_t stride,
                     const PointDerivatives* derivatives) {
  for (std::size_t m = 0; m < n_modes_; ++m) {
    const auto mode = static_cast<Eigen::Index>(m);
    shape_[0][m] = shapes_->u(point, mode);
    shape_[1][m] = shapes_->v(point, mode);
    if (n_directions_ == 2) shape_[2][m] = shapes_->w(point, mode);
  }
  const std::size_t row = n_waiting_ * n_directions_;
  for (std::size_t d = 0; d < n_directions_; ++d) {
    double* phi = phi_t_.data() + (row + d) * force_size_.phi_stride;
    for (std::size_t m = 0; m < n_modes_; ++m) phi[m] = weight * shape_[2 * d][m];
    double* to = tangential_.data() + (row + d) * force_size_.stride;
    for (std::size_t k = 0; k < force_->n_rows(); ++k) to[k] = sums[2 * d][k * stride];
  }
  double* phi = phi_v_.data() + n_waiting_ * force_size_.phi_stride;
  for (std::size_t m = 0; m < n_modes_; ++m) phi[m] = weight * shape_[1][m];
  double* to = normal_.data() + n_waiting_ * force_size_.stride;
  for (std::size_t k = 0; k < force_->n_rows(); ++k) to[k] = sums[1][k * stride];
  to[0] -= reference_load / force_->norm(0);
  if (!asked_.empty()) {
    any_derivative_ = true;
    double* pair = pairs_.data() + n_waiting_ * pair_size_.phi_stride;
    for (std::size_t a = 0; a < n_modes_; ++a) {
      for (std::size_t b = 0; b <= a; ++b) *pair++ = phi[a] * shape_[1][b];
    }
    std::copy_n(derivatives->normal_moments, pair_size_.n_columns,
                moments_.data() + n_waiting_ * pair_size_.stride);
    spread(*derivatives);
  }
  if (++n_waiting_ == waiting_points) flush();
}

void Projection::spread(const PointDerivatives& derivatives) {
  const std::size_t n = motion_->n_rows();
  const std::size_t n_signals = n_directions_ == 2 ? 3 : 2;
  for (std::size_t d = 0; d < n_directions_; ++d) {
    const std::size_t row = n_waiting_ * n_directions_ + d;
    for (std::size_t k = 0; k < asked_.size(); ++k) {
      std::array<const double*, 3> from{};
      for (std::size_t s = 0; s < n_signals; ++s) {
        const double* whole = derivatives.friction[d][s] + asked_[k] * derivatives.stride;
        from[s] = whole;
        if (all_) continue;
        double* some = compact_.data() + s * (n + 8);
        for (std::size_t l = 0; l < asked_.size(); ++l) some[l] = whole[asked_[l]];
        from[s] = some;
      }
      product_kernels().spread(n_signals, n_modes_, asked_.size(), from, shape_,
                               spread_.data() + k * spread_block_ + row * size_.stride);
    }
    double* to = by_frequency_.data() + row * force_size_.stride;
    if (derivatives.by_frequency[d] == nullptr) {
      std::fill_n(to, n, 0.0);
      continue;
    }
    any_by_frequency_ = true;
    std::copy_n(derivatives.by_frequency[d], n, to);
  }
}

void Projection::flush() {
  const std::size_t n = std::exchange(n_waiting_, 0);
  if (n == 0) return;
  const auto& product = product_kernels().product;
  const std::size_t rows = n * n_directions_;
  product(force_size_, rows, phi_t_.data(), tangential_.data(), force_sum_.data());
  product(force_size_, n, phi_v_.data(), normal_.data(), force_sum_.data());
  if (!any_derivative_) return;
  if (any_by_frequency_) {
    product(force_size_, rows, phi_t_.data(), by_frequency_.data(), by_frequency_sum_.data());
  }
  product(pair_size_, n, pairs_.data(), moments_.data(), pair_sum_.data());
  for (std::size_t k = 0; k < asked_.size(); ++k) {
    product(size_, rows, phi_t_.data(), spread_.data() + k * spread_block_,
            sum_.data() + k * n_modes_ * size_.stride);
  }
}

void Projection::join(Projection& other) {
  flush();
  other.flush();
  add_to(force_sum_, other.force_sum_);
  if (rows_.empty()) return;
  for (const auto sum :
       {&Projection::by_frequency_sum_, &Projection::pair_sum_, &Projection::sum_}) {
    add_to(this->*sum, other.*sum);
  }
}

ForceAndJacobian Projection::take() {
  flush();
  const auto N = static_cast<Eigen::Index>(n_modes_);
  const auto n = static_cast<Eigen::Index>(rows_.size()) * N;
  ForceAndJacobian result{Harmonics(force_->n_harmonics(), N), Eigen::MatrixXd(n, n),
                          Eigen::VectorXd::Zero(n), 0.0};
  for (std::size_t row = 0; row < force_->n_rows(); ++row) {
    const std::size_t k = force_->split(row);
    for (std::size_t m = 0; m < n_modes_; ++m) {
      result.force.rows()(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(m)) =
          force_->norm(k) * force_sum_[m * force_size_.stride + k];
    }
  }
  if (rows_.empty()) return result;
  add_friction(result);
  add_normal(result);
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const std::size_t k = motion_->split(static_cast<std::size_t>(rows_[row]));
    for (std::size_t m = 0; m < n_modes_; ++m) {
      result.frequency_derivative[static_cast<Eigen::Index>(row * n_modes_ + m)] =
          motion_->norm(k) * by_frequency_sum_[m * force_size_.stride + k];
    }
  }
  return result;
}

/// Writes every entry.
void Projection::add_friction(ForceAndJacobian& result) const {
  const std::size_t n = rows_.size();
  std::vector<std::size_t> place(n);  // of a row asked for among those in split order
  for (std::size_t row = 0; row < n; ++row) {
    const std::size_t k = motion_->split(static_cast<std::size_t>(rows_[row]));
    place[row] = static_cast<std::size_t>(std::lower_bound(asked_.begin(), asked_.end(), k) -
                                          asked_.begin());
  }
  for (std::size_t l = 0; l < n; ++l) {
    for (std::size_t m = 0; m < n_modes_; ++m) {
      double* column = result.jacobian.col(static_cast<Eigen::Index>(l * n_modes_ + m)).data();
      const double* from = sum_.data() + m * n + place[l];
      for (std::size_t k = 0; k < n; ++k) {
        const double norm = motion_->norm(asked_[place[k]]);
        const double* row = from + place[k] * n_modes_ * size_.stride;
        for (std::size_t i = 0; i < n_modes_; ++i) {
          *column++ = norm * row[i * size_.stride];
        }
      }
    }
  }
}

void Projection::add_normal(ForceAndJacobian& result) const {
  const std::size_t n = rows_.size();
  std::vector<std::size_t> split(n);
  for (std::size_t l = 0; l < n; ++l) split[l] = motion_->split(static_cast<std::size_t>(rows_[l]));
  Products products;
  products.reset(motion_->n_harmonics());
  std::vector<double> row(motion_->n_rows());
  std::size_t pair = 0;
  for (std::size_t a = 0; a < n_modes_; ++a) {
    for (std::size_t b = 0; b <= a; ++b, ++pair) {
      products.set(pair_sum_.data() + pair * pair_size_.stride);
      for (std::size_t k = 0; k < n; ++k) {
        products.row(split[k], row.data());
        const double norm = motion_->norm(split[k]);
        for (std::size_t l = 0; l < n; ++l) {
          const double value = norm * row[split[l]];
          const auto i = static_cast<Eigen::Index>(k * n_modes_);
          const auto j = static_cast<Eigen::Index>(l * n_modes_);
          const auto first = static_cast<Eigen::Index>(a);
          const auto second = static_cast<Eigen::Index>(b);
          result.jacobian(i + first, j + second) += value;
          if (a != b) result.jacobian(i + second, j + first) += value;
        }
      }
    }
  }
}

}  // namespace microslip::contact::sampled
