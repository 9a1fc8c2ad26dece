/// @file
/// Trigonometric polynomials and all their sign changes in a period.
///
///   p(θ) = p₀ + Σ_h ( p_sh sin hθ + p_ch cos hθ ) = p₀ + Im Σ_h C_h z^h,   C_h = p_sh + i p_ch, z = e^{iθ}
///
/// Sign changes are isolated, not looked for: on a cell of width d the cubic through values and slopes
/// at its ends misses p by no more than M d⁴/384, its derivatives by √3 M d³/216 and M d²/12, with
/// M = Σ h⁴ |C_h| ≥ |p⁗|. A cell is done when these bounds prove that p keeps its sign, or its slope
/// does, or its curvature does; else it is halved. Pairs of sign changes however close are found, down
/// to rounding of p.
///
/// Source: error constants of cubic Hermite interpolation: G. Birkhoff, A. Priver, J. Math. and Phys. 46
/// (1967) 440–447.
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

/// Where p > 0 begins (rising) or ends.
struct SignChange {
  double phase = 0.0;  ///< in [0, 2π]
  bool rising = false;
};

/// All phases at which the answer to p > 0 changes, in order; up and down alternate around the period.
/// @param changes  written whole; storage is used again.
/// @note To rounding of p: where p touches zero within that, a pair may be found or not.
void find_sign_changes(const TrigonometricPolynomial& p, std::vector<SignChange>& changes);

/// Where p passes `level` on [low, high], given that it does: p − level > 0 at one end only.
/// @param at_low, at_high  p − level at the ends.
/// @return the phase, to rounding.
[[nodiscard]] double crossing(const TrigonometricPolynomial& p, double level, double low,
                              double high, double at_low, double at_high);

}  // namespace microslip::contact
