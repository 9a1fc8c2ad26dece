/// @file
/// Stability of a solution (theory section 17), as far as the Jacobian of the balance can tell it.
///
/// One harmonic: its slow flow. Amplitudes vary slowly against the cycle, so that the steady-cycle
/// force applies,
///
///   B̈ + C Ḃ + Ω B + G_b = Q_b,      (2ikωI + C) Ȧ^(k) + (Ω − k²ω² + ikωC) A^(k) + G^(k) = Q^(k)
///
/// linearised. Stable: no eigenvalue that is slow against the cycle (|Im λ| < ω/4) grows, and det
/// ∂R/∂x, whose sign changes at folds and simple branch points, is not negative.
///
/// Several: Hill's quadratic eigenproblem (∂R/∂x + λΔ + λ²I) p = 0, Δ made of C and 2kω, whose
/// eigenvectors p tell the 2 n_modes exponents that are no copies λ ± ikω of others: those centred
/// on harmonic 0. Modes far above all harmonics answer
/// quasi-statically, and where 80 states do not hold all harmonics the highest. A real
/// exponent that grows, or a negative determinant, is unstable. The Jacobian of a hysteretic force
/// is that for perturbations of the period of the motion; where a pair with Im λ ≠ 0 grows it
/// cannot tell, and the point is not assessed. With no exponent growing it is called stable, which
/// pairs of a hysteretic force do not prove either: where the scene can be integrated in time, the
/// multipliers of its period map judge them (floquet.hpp). A linear structure, without contact or
/// with one that is known to be a spring (S = Sᵀ ≥ 0), needs none of this: with every natural
/// frequency and damping ratio above 0 all its perturbations decay.
#pragma once

#include <limits>
#include <memory>
#include <optional>

#include <Eigen/Core>

#include "solver/balance/harmonic_balance.hpp"
#include "solver/response_curve.hpp"

namespace microslip::solver {

/// A balance reduced to some harmonics of some modes: what is left out follows without inertia or
/// memory of its own, which keeps the zeros of the determinant (condensed.hpp).
struct ReducedBalance {
  bool has_mean = true;
  std::vector<int> orders;
  std::vector<Eigen::Index> modes;
  Eigen::MatrixXd jacobian;
};

struct StabilityReport {
  Stability stability = Stability::not_assessed;
  StabilityBasis basis = StabilityBasis::slow_flow;
  double determinant_sign = 0.0;  ///< of ∂R/∂x: 1, −1, or 0 where it is singular
  double growth = 0.0;  ///< largest real part in the slow flow [rad/s], −∞: there is none
  /// How near, in frequency, a resonance of the linearised structure is, or how wide [rad/s].
  double nearest = 0.0;
  /// Of slow_flow_stability(), which hill_stability() goes on from.
  std::shared_ptr<const ReducedBalance> reduced{};
};

/// @param jacobian  of the point, or of one from which the solution was reached in a step or two
///                  (few_jacobians.hpp): then the verdict may be that of the neighbour within 3e-4
///                  of a fold.
/// By the slow flow alone: what one harmonic is judged by,
/// and the width of resonances for any number.
[[nodiscard]] StabilityReport slow_flow_stability(const HarmonicBalance& balance,
                                                  const BalanceJacobian& jacobian, double frequency,
                                                  std::optional<double> determinant_sign = {});

/// The same judged by Hill's exponents where there are several harmonics and neither the scene nor
/// every motion near by is proved a damped linear one: every point stuck, or every point open.
/// Where the set leaves the mean out, motions change sign after half a period: then by the mean and
/// even harmonics of a perturbation, which have all exponents that odd ones have. Contact that does
/// not answer the mean knows motions that repeat, and what drifts slowly from them: by the slow
/// flow.
/// @param q     harmonics of the point.
/// @param slow  slow_flow_stability() of the same point.
[[nodiscard]] StabilityReport hill_stability(const HarmonicBalance& balance, const Harmonics& q,
                                             double frequency, StabilityReport slow);

/// Of Hill's exponents that are centred on harmonic 0 [rad/s]; −∞: there is none.
struct HillGrowth {
  double largest = -std::numeric_limits<double>::infinity();
  double real = -std::numeric_limits<double>::infinity();  ///< of the real ones
};

/// @param reduced  that of slow_flow_stability().   @return none: they do not converge.
[[nodiscard]] std::optional<HillGrowth> hill_growth(const HarmonicBalance& balance,
                                                    const Harmonics& q, double frequency,
                                                    const ReducedBalance& reduced);

/// Of a scene without contact, or with one that is a spring; empty: not damped, or not known to be
/// such a scene. det ∂R/∂x = |det D|² > 0.
[[nodiscard]] std::optional<StabilityReport> damped_linear_stability(
    const HarmonicBalance& balance);

/// What a verdict may cost.
enum class PeriodMapEffort {
  /// Modes, two states each, and points of friction along a line together at most 16: some 2 ms.
  every_point,
  /// 60 states that move in the period, 100 points; states times points at most 600 where periods
  /// are differenced (floquet.hpp): 0.01 to 2 s, for peaks and single solutions.
  few_points,
};

/// Several harmonics in a scene with `transient`: what Hill's problem does not call unstable is
/// judged by the multipliers of the period map that are not real and positive. Within `distance` of
/// the unit circle, and at least 1e-4, they tell nothing and the point is not assessed. Real
/// positive ones are those of the determinant. Left as it is: what is proved, one harmonic, and
/// scenes too large for the effort.
/// @param hill  hill_stability() of the same point.
/// @param q     its harmonics.
[[nodiscard]] StabilityReport stability_in_time(const HarmonicBalance& balance, const Harmonics& q,
                                                double frequency, StabilityReport hill,
                                                PeriodMapEffort effort);

/// hill_stability() and stability_in_time(). Where every point may have its period map, that comes
/// first: Hill's exponents are asked only where it is not known or has a real multiplier above 1
/// though the determinant is positive.
/// @param slow  slow_flow_stability() of the same point.
[[nodiscard]] StabilityReport judged_stability(const HarmonicBalance& balance, const Harmonics& q,
                                               double frequency, StabilityReport slow,
                                               PeriodMapEffort effort);

/// slow_flow_stability() and hill_stability().
[[nodiscard]] StabilityReport assess_stability(const HarmonicBalance& balance,
                                               const BalanceJacobian& jacobian, const Harmonics& q,
                                               double frequency);

}  // namespace microslip::solver
