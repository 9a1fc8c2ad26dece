/// @file
/// The one Fourier convention of the project (theory section 0).
///
///   y(θ) = y₀ + Σ_h ( y_sh sin hθ + y_ch cos hθ ),    θ = ωt,  h = 1 … H
///
/// A `Harmonics` holds these numbers for several signals (modes) at once:
/// rows [y₀, y_s1, y_c1, y_s2, y_c2, …], one column per signal, stored row by row, so that
/// `vector()` is [all means, all sin θ, all cos θ, …], the order of unknowns in the solver.
#pragma once

#include <Eigen/Core>

namespace microslip::contact {

class Harmonics {
 public:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  Harmonics() = default;
  /// Zero signals. @param n_harmonics H ≥ 0. @param n_signals ≥ 0.
  Harmonics(int n_harmonics, Eigen::Index n_signals);
  /// @param vector  size (2H+1) · n_signals, in the order of `vector()`.
  /// @throws std::invalid_argument  the size does not fit.
  Harmonics(int n_harmonics, Eigen::Index n_signals,
            const Eigen::Ref<const Eigen::VectorXd>& vector);

  [[nodiscard]] int n_harmonics() const { return static_cast<int>((rows_.rows() - 1) / 2); }
  [[nodiscard]] Eigen::Index n_signals() const { return rows_.cols(); }

  /// (2H+1) × n_signals.
  [[nodiscard]] const Matrix& rows() const { return rows_; }
  [[nodiscard]] Matrix& rows() { return rows_; }

  [[nodiscard]] auto mean() const { return rows_.row(0); }
  [[nodiscard]] auto sine(int h = 1) const { return rows_.row(2 * h - 1); }
  [[nodiscard]] auto cosine(int h = 1) const { return rows_.row(2 * h); }

  /// All coefficients as one vector, size (2H+1) · n_signals.
  [[nodiscard]] Eigen::Map<const Eigen::VectorXd> vector() const {
    return {rows_.data(), rows_.size()};
  }
  [[nodiscard]] Eigen::Map<Eigen::VectorXd> vector() { return {rows_.data(), rows_.size()}; }

  /// Values of every signal at phase θ [rad], size n_signals.
  [[nodiscard]] Eigen::VectorXd at(double phase) const;

 private:
  Matrix rows_;
};

}  // namespace microslip::contact
