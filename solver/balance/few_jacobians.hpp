/// @file
/// A corrector for steps along a branch that evaluates one Jacobian:
/// forces alone cost several times less.
///
///   J₀ at the guess y₀;   J₀ s₀ = −R(y₀);   J_{i+1} = J_i + R_{i+1} s_iᵀ / (s_iᵀ s_i)
///
/// until ‖R‖ meets the tolerance. Where the residual does not fall as it should (a kink, a turn), a
/// new Jacobian at the best point found; what is far from any solution is left to Newton's method
/// with its line search.
///
/// Source: C. G. Broyden, Math. Comp. 19 (1965) 577–593; in the form of C. T. Kelley, Iterative
/// Methods for Linear and Nonlinear Equations, SIAM 1995, section 7.3.
#pragma once

#include "solver/balance/newton.hpp"
#include "solver/continuation_options.hpp"

namespace microslip::solver {

/// @return as solve_newton(), not polished. Residual and force are those of the point; its
///         derivatives those of the point the last Jacobian was made at,
///         if the residual there was below 3e-4 of its scale.
[[nodiscard]] NewtonResult solve_with_few_jacobians(const EconomicSystem& system,
                                                    const BranchVector& start,
                                                    const BranchVector& constraint,
                                                    const Scaling& scaling,
                                                    const NewtonOptions& options);

/// On the plane of the constraint, by the corrector that the forces of the scene call for.
[[nodiscard]] NewtonResult solve_balance(HarmonicBalance& balance,
                                         ContinuationOptions::Corrector corrector,
                                         const BranchVector& guess, const BranchVector& constraint,
                                         const Scaling& scaling, const NewtonOptions& options);

}  // namespace microslip::solver
