/// @file
/// Friction coefficient as a function of the speed of slip.
///
///   constant      μ(σ) = μ₀
///   exponential   μ(σ) = μ∞ + (μ₀ − μ∞) e^{−λσ}                                              (1)
///   hyperbolic    μ(σ) = μ₀ / (1 + pσ)                                                       (2)
///
/// σ is the imposed relative tangential speed in physical time, not that of the slider: with a
/// spring in series a coefficient that falls with the slider's speed has no unique force (theory
/// section 10).
///
/// Source: paper B, after eq 5; theory section 10.
#pragma once

#include <vector>

namespace microslip::contact {

/// μ at one speed, with its derivative.
struct FrictionCoefficient {
  double value = 0.0;    ///< μ [-]
  double by_rate = 0.0;  ///< dμ/dσ [s/m]
};

class FrictionLaw {
 public:
  /// @param coefficient  μ₀ ≥ 0, finite.
  /// @throws std::invalid_argument  out of range; names the quantity and the value. So the others.
  [[nodiscard]] static FrictionLaw constant(double coefficient);
  /// (1): λ = 0 keeps μ₀; λ → ∞ gives μ∞ at every speed above 0. μ∞ may exceed μ₀;
  /// μ₀ = 0 below μ∞ is friction that never sticks: scenes refuse it.
  /// @param at_rest   μ₀ ≥ 0.   @param at_speed  μ∞ ≥ 0.   @param decay  λ ≥ 0 [s/m].
  [[nodiscard]] static FrictionLaw exponential(double at_rest, double at_speed, double decay);
  /// (2): p = 0 keeps μ₀.
  /// @param at_rest  μ₀ ≥ 0.   @param decay  p ≥ 0 [s/m].
  [[nodiscard]] static FrictionLaw hyperbolic(double at_rest, double decay);

  /// @param rate  σ ≥ 0 [m/s]. Exact at 0: μ₀; no overflow turns into NaN.
  [[nodiscard]] FrictionCoefficient at(double rate) const;
  /// Speeds between which polynomials of degree 11 are μ to 2e-7, in ascending order and
  /// below `fastest`; none where it hardly changes up to there. Beyond the last μ is constant (1)
  /// or below 1e-6 μ₀ and falls by 64 from one to the next (2).
  /// @param fastest  [m/s]; may be infinite.   @param speeds  written whole [m/s].
  void grades(double fastest, std::vector<double>& speeds) const;
  /// μ₀ [-].
  [[nodiscard]] double at_rest() const { return at_rest_; }
  /// Whether μ is above 0 at any speed.
  [[nodiscard]] bool has_friction() const { return at_rest_ > 0.0 || is_rate_dependent(); }
  /// False where (1) or (2) is constant.
  [[nodiscard]] bool is_rate_dependent() const { return kind_ != Kind::constant; }

 private:
  enum class Kind : unsigned char { constant, exponential, hyperbolic };

  FrictionLaw(Kind kind, double at_rest, double at_speed, double decay)
      : kind_(kind), at_rest_(at_rest), at_speed_(at_speed), decay_(decay) {}

  Kind kind_;
  double at_rest_;
  double at_speed_;
  double decay_;
};

}  // namespace microslip::contact
