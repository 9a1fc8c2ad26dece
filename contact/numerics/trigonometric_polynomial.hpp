/// @file
/// Trigonometric polynomials, and a root of one in a bracket.
///
///   p(θ) = p₀ + Σ_h ( p_sh sin hθ + p_ch cos hθ ) = p₀ + Im Σ_h C_h z^h
///   C_h = p_sh + i p_ch,   z = e^{iθ}
#pragma once

#include <cstddef>
#include <vector>

namespace microslip::contact {

class TrigonometricPolynomial {
 public:
  struct Jet {
    double value = 0.0;
    double slope = 0.0;  ///< dp/dθ
  };

  /// Value and derivatives at one phase.
  struct Taylor {
    double value = 0.0;
    double slope = 0.0;
    double second = 0.0;
    double third = 0.0;
  };

  TrigonometricPolynomial() = default;

  /// Zero of the given degree; storage is used again.
  void reset(int degree);
  /// Coefficients of sin hθ and cos hθ, 1 ≤ h ≤ degree.
  void set(int h, double sin, double cos);
  void set_mean(double mean) { mean_ = mean; }

  [[nodiscard]] int degree() const { return static_cast<int>(sin_.size()); }
  /// Highest harmonic that is not zero, 0 for a constant.
  [[nodiscard]] int order() const;
  [[nodiscard]] double mean() const { return mean_; }
  [[nodiscard]] double sin(int h) const { return sin_[static_cast<std::size_t>(h) - 1]; }
  [[nodiscard]] double cos(int h) const { return cos_[static_cast<std::size_t>(h) - 1]; }
  /// All of them, from the first harmonic on.
  [[nodiscard]] const double* sines() const { return sin_.data(); }
  [[nodiscard]] const double* cosines() const { return cos_.data(); }
  /// Σ h^power (|p_sh| + |p_ch|): bounds the derivative of that order.
  [[nodiscard]] double bound(int power) const;

  [[nodiscard]] double value(double phase) const;
  [[nodiscard]] Jet jet(double phase) const;
  [[nodiscard]] Taylor taylor(double phase) const;
  /// Becomes dp/dθ of another one.
  void set_derivative(const TrigonometricPolynomial& other);

 private:
  double mean_ = 0.0;
  std::vector<double> sin_;
  std::vector<double> cos_;
};

/// From `x` to the root of p − level between low and high; p − level > 0 at the lower end if
/// `low_positive`, and not at the other, or the other way round. One Taylor expansion leaves the
/// error M step⁴/24 over the slope: two or three are enough.
/// @param fourth  M = p.bound(4).
[[nodiscard]] double root_within(const TrigonometricPolynomial& p, double fourth, double level,
                                 double low, double high, bool low_positive, double x);

/// Where p passes `level` on [low, high], given that it does: p − level > 0 at one end only.
/// @param at_low, at_high  p − level at the ends.
/// @return the phase, to rounding.
[[nodiscard]] double crossing(const TrigonometricPolynomial& p, double level, double low,
                              double high, double at_low, double at_high);

}  // namespace microslip::contact
