/// @file
/// The instants θ_i = 2πi/n of a period and the functions of the Fourier convention there, in the
/// order [1, sin θ … sin Hθ, cos θ … cos Hθ] ("split": a row of products of two of them is then
/// made of slices):
///
///   T_k(θ_i),   T_k'(θ_i),   Σ_{j<i} cos mθ_j,   Σ_{j<i} sin mθ_j      m = 0 … 2H
///
/// and those rows: Σ_i W_i T_k T_l for weights W known by their moments Σ_i W_i cos mθ_i,
/// Σ_i W_i sin mθ_i.
#pragma once

#include <cstddef>
#include <vector>

namespace microslip::contact::sampled {

class Instants {
 public:
  Instants() = default;
  /// @param n  ≥ 2 (2H + 1).   @param n_harmonics  H ≥ 0.
  /// @throws std::invalid_argument  too few instants; names both.
  Instants(int n, int n_harmonics);

  [[nodiscard]] std::size_t size() const { return n_; }
  [[nodiscard]] int n_harmonics() const { return n_harmonics_; }
  /// 2H + 1.
  [[nodiscard]] std::size_t n_rows() const { return n_rows_; }
  /// cos 0 … cos 2H, sin 1 … sin 2H: 4H + 1.
  [[nodiscard]] std::size_t n_moments() const { return 2 * n_rows_ - 1; }
  /// T, n × n_rows, row by row.
  [[nodiscard]] const double* basis() const { return basis_.data(); }
  [[nodiscard]] const double* basis(std::size_t i) const { return basis_.data() + i * n_rows_; }
  /// T', likewise.
  [[nodiscard]] const double* rates() const { return rates_.data(); }
  [[nodiscard]] const double* rates(std::size_t i) const { return rates_.data() + i * n_rows_; }
  /// Functions of moments at one instant, and their sums over the instants before it (i = n:
  /// over all).
  [[nodiscard]] const double* moment_basis(std::size_t i) const {
    return moment_basis_.data() + i * n_moments();
  }
  [[nodiscard]] const double* sums(std::size_t i) const { return sums_.data() + i * n_moments(); }
  /// Row of `Harmonics` in split order.
  [[nodiscard]] std::size_t split(std::size_t row) const {
    if (row == 0) return 0;
    const std::size_t h = (row + 1) / 2;
    return row % 2 == 1 ? h : static_cast<std::size_t>(n_harmonics_) + h;
  }
  /// What makes Σ_i f_i T_k a Fourier coefficient.
  [[nodiscard]] double norm(std::size_t k) const {
    return (k == 0 ? 1.0 : 2.0) / static_cast<double>(n_);
  }

 private:
  std::size_t n_ = 0;
  int n_harmonics_ = 0;
  std::size_t n_rows_ = 0;
  std::vector<double> basis_;
  std::vector<double> rates_;
  std::vector<double> moment_basis_;
  std::vector<double> sums_;
};

/// Moments of a weight, made symmetric so that products of T_k with all T_l are sums of slices.
class Products {
 public:
  void reset(int n_harmonics);
  /// @param moments  in the order of Instants.
  void set(const double* moments);
  /// result_l = Σ_i W_i T_k T_l, l = 0 … 2H.
  void row(std::size_t k, double* result) const;

 private:
  std::size_t n_harmonics_ = 0;
  std::vector<double> cos_;  // m = −2H … 2H
  std::vector<double> sin_;
};

}  // namespace microslip::contact::sampled
