/// @file
/// Newton's method for a residual that is only piecewise smooth, on the plane through the first
/// iterate that a constraint row spans: the corrector of continuation,
/// and at fixed parameter the plain solver.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>

#include <Eigen/Core>

#include "solver/balance/harmonic_balance.hpp"

namespace microslip::solver {

/// R(x, p) and its derivatives.
using ParametricSystem =
    std::function<BalanceEvaluation(const Eigen::VectorXd& x, double parameter)>;

/// A system with its residual alone, which may leave the derivatives empty and costs several times
/// less.
struct EconomicSystem {
  ParametricSystem whole;
  ParametricSystem residual;
};

/// Sizes that make unknowns, parameter and residual numbers of order one. All > 0.
struct Scaling {
  double x = 1.0;
  double parameter = 1.0;
  double residual = 1.0;
  /// Size of rounding errors of the residual, over `residual`: nothing smaller is asked for. ≥ 0
  double rounding = 0.0;
};

/// A point of the branch, or a direction: (x, p).
struct BranchVector {
  Eigen::VectorXd x;
  double parameter = 0.0;
};

/// Of ‖R‖ / scaling.residual: below it what is left is rounding of sums.
inline constexpr double rounding_of_residual = 2e-15;

struct NewtonOptions {
  double tolerance = 1e-11;  ///< of ‖R‖ / scaling.residual; at least scaling.rounding
  /// What is converged is solved on to this, or to scaling.rounding, while that pays.
  double polished_to = rounding_of_residual;
  int max_iterations = 15;  ///< 0: no step of Newton's method (few_jacobians.hpp)
  /// Asked between steps, which of a fine patch take up to a second: true ends them, not converged.
  const std::function<bool()>* stop = nullptr;
  /// Steps of the line search among them: no step of Newton's method begins beyond.
  int max_evaluations = std::numeric_limits<int>::max();
  [[nodiscard]] bool is_stopped() const { return stop != nullptr && *stop && (*stop)(); }
};

class BranchFactors;

/// Tangent of the branch in scaled variables, of length one.
struct Tangent {
  BranchVector direction;
  double orientation = 0.0;  ///< sign of det [∂R/∂y; tᵀ]: constant along a branch, kinks included
};

struct NewtonResult {
  BranchVector point;
  BalanceEvaluation evaluation;  ///< at `point`
  double residual = 0.0;         ///< ‖R‖ / scaling.residual
  int iterations = 0;            ///< Newton steps until the tolerance was met
  int evaluations = 0;
  bool converged = false;
  /// Of the Jacobian of `evaluation` with the constraint, where they were made: they tell the
  /// tangent and serve places near by.
  std::shared_ptr<const BranchFactors> factors;
};

/// Steps satisfy c_x·Δx/σ_x + c_p Δp/σ_p = 0. After a tolerance below 5e-11 is met the iteration
/// goes on to `polished_to` while the residual still falls.
/// A coarser tolerance is meant as it stands.
/// @param constraint  (c_x, c_p) in scaled variables; (0, 1) holds the parameter.
[[nodiscard]] NewtonResult solve_newton(const ParametricSystem& system, const BranchVector& start,
                                        const BranchVector& constraint, const Scaling& scaling,
                                        const NewtonOptions& options);

/// The same from a point that is evaluated already; `evaluations` counts those that follow.
[[nodiscard]] NewtonResult solve_newton(const ParametricSystem& system, NewtonResult start,
                                        const BranchVector& constraint, const Scaling& scaling,
                                        const NewtonOptions& options);

/// The same, where the line search shortens its steps by residuals alone.
[[nodiscard]] NewtonResult solve_newton(const EconomicSystem& system, NewtonResult start,
                                        const BranchVector& constraint, const Scaling& scaling,
                                        const NewtonOptions& options);

/// A point with its residual, ∞ where something is not finite; counts nothing.
[[nodiscard]] NewtonResult evaluated_at(const ParametricSystem& system, BranchVector point,
                                        const Scaling& scaling);

/// [∂R/∂x σ_x/ρ   ∂R/∂p σ_p/ρ]
/// [    c_x           c_p     ]     ρ the scale of the residual, c a row in scaled variables
[[nodiscard]] Eigen::MatrixXd bordered(const BalanceEvaluation& at, const BranchVector& row,
                                       const Scaling& scaling);

/// Newton at a fixed parameter.
[[nodiscard]] NewtonResult solve_newton(const ParametricSystem& system, const BranchVector& start,
                                        const Scaling& scaling, const NewtonOptions& options);

/// @param previous  last tangent; the new one makes an angle below 90° with it.
[[nodiscard]] Tangent branch_tangent(const BalanceEvaluation& at, const BranchVector& previous,
                                     const Scaling& scaling);

/// Null vector of [∂R/∂x σ_x, ∂R/∂p σ_p], of length one, with the sign that gives det [∂R/∂y; tᵀ]
/// the sign of `orientation`. Empty: the Jacobian is not finite or loses rank twice.
[[nodiscard]] std::optional<BranchVector> null_vector(const BalanceEvaluation& at,
                                                      const Scaling& scaling, double orientation);

}  // namespace microslip::solver
