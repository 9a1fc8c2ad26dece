/// @file
/// A corrector for steps along a branch that evaluates one Jacobian: forces alone cost several times less.
///
///   B₀ from a solved point near by;   B₀ s₀ = −R(y₀);   B_{i+1} = B_i + R_{i+1} s_iᵀ / (s_iᵀ s_i)     (Broyden)
///
/// until ‖R‖ meets the tolerance; there the Jacobian. Where the residual does not fall as it should (a kink, a
/// turn), what remains is Newton's method from the best point found.
///
/// Source: C. G. Broyden, Math. Comp. 19 (1965) 577–593; in the form of C. T. Kelley, Iterative Methods for
/// Linear and Nonlinear Equations, SIAM 1995, section 7.3.
#pragma once

#include "solver/balance/newton.hpp"

namespace microslip::solver {

/// A system with its residual alone, which may leave the derivatives empty.
struct EconomicSystem {
  ParametricSystem whole;
  ParametricSystem residual;
};

/// @param near   evaluation with its Jacobian at a point close by.
/// @return as solve_newton(), not polished.
[[nodiscard]] NewtonResult solve_with_few_jacobians(
    const EconomicSystem& system, const BranchVector& start, const BranchVector& constraint,
    const Scaling& scaling, const NewtonOptions& options, const BalanceEvaluation& near);

}  // namespace microslip::solver
