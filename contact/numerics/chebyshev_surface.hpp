/// @file
/// Polynomials on [−1, 1] and [−1, 1]² in Chebyshev form, and all their zeros: what the fitted rule
/// knows of a guard inside one cell.
///
///   g(x, y) = Σ_ij c_ij T_i(x) T_j(y),      |T| ≤ 1, so |g − c₀₀| ≤ Σ' |c_ij|                       (1)
///
/// (1) decides where there can be no zero; zeros of a line are found between those of its derivative,
/// so that no pair is missed.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace microslip::contact {

/// Points cos(πk/N), k = 0 … N, at which a polynomial of degree N is sampled.
[[nodiscard]] const Eigen::VectorXd& chebyshev_points(int degree);
/// Values at these points → coefficients, (N+1) × (N+1).
[[nodiscard]] const Eigen::MatrixXd& chebyshev_transform(int degree);

/// Coefficients of the derivative, one fewer (at least 1).
[[nodiscard]] Eigen::VectorXd chebyshev_derivative(const Eigen::VectorXd& coefficients);
[[nodiscard]] double chebyshev_value(const Eigen::VectorXd& coefficients, double x);
/// Zeros in [−1, 1], ascending; zeros of even order may appear once or not at all (they do not change
/// the sign). None for the zero polynomial.
/// @param noise  share of Σ |c| below which the highest coefficients do not count.
[[nodiscard]] std::vector<double> chebyshev_roots(const Eigen::VectorXd& coefficients,
                                                  double noise = 1e-16);

class ChebyshevSurface {
 public:
  ChebyshevSurface() = default;
  /// @param coefficients  c_ij, i along x, j along y, both of the same degree.
  explicit ChebyshevSurface(Eigen::MatrixXd coefficients) : c_(std::move(coefficients)) {}
  /// @param values  at chebyshev_points(degree) in x (rows) and y (columns).
  static ChebyshevSurface through(const Eigen::MatrixXd& values);

  [[nodiscard]] const Eigen::MatrixXd& coefficients() const { return c_; }
  [[nodiscard]] int degree() const { return static_cast<int>(c_.rows()) - 1; }
  [[nodiscard]] double value(double x, double y) const;
  /// Coefficients in y on the line x = const.
  [[nodiscard]] Eigen::VectorXd column(double x) const;
  [[nodiscard]] ChebyshevSurface derivative_x() const;
  [[nodiscard]] ChebyshevSurface derivative_y() const;
  [[nodiscard]] ChebyshevSurface transposed() const { return ChebyshevSurface(c_.transpose()); }
  /// On the quarters of the square, each scaled to [−1, 1]²: (−,−), (+,−), (−,+), (+,+).
  [[nodiscard]] std::array<ChebyshevSurface, 4> quarters() const;
  /// Without the highest degrees, as far as |c_ij| ≤ noise there; at least of degree 2.
  [[nodiscard]] ChebyshevSurface trimmed(double noise) const;
  /// Of a degree at least as high, filled with zeros.
  [[nodiscard]] ChebyshevSurface raised_to(int degree) const;
  /// Σ |c_ij| without c₀₀.
  [[nodiscard]] double variation() const;
  /// Σ |c_ij| over the two highest degrees in x or y: about what the next ones would add.
  [[nodiscard]] double tail() const;

 private:
  Eigen::MatrixXd c_;
};

/// Isolated common zeros of f and g in [−1, 1]², each as (x, y). Where the zero lines run together
/// along a stretch there is nothing isolated to find, and the search ends early with what it has.
[[nodiscard]] std::vector<Eigen::Vector2d> common_roots(const ChebyshevSurface& f,
                                                        const ChebyshevSurface& g);

}  // namespace microslip::contact
