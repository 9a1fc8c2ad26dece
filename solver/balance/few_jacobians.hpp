/// @file
/// A corrector for steps along a branch that evaluates one Jacobian:
/// forces alone cost several times less.
///
///   y_i → y_{i+1} by Broyden's method (broyden.hpp) with factors of another place, where some are
///   at hand, until ‖R‖ is small enough that the Jacobian there is as good as that of the solution;
///   J there, and Broyden's method from it until ‖R‖ meets the tolerance.
///
/// Where the residual does not fall as it should (a kink, a turn), a new Jacobian at the best point
/// found; what is far from any solution is left to Newton's method with its line search.
#pragma once

#include "solver/balance/branch_factors.hpp"
#include "solver/balance/newton.hpp"
#include "solver/continuation_options.hpp"

namespace microslip::solver {

/// @param nearby  factors of another place of the branch: by them forces alone lead to where the
///                Jacobian is worth its price. Null: it is made at the start.
/// @return as solve_newton(), not polished. Residual and force are those of the point; its
///         derivatives those of the point the last Jacobian was made at,
///         if the residual there was below 3e-4 of its scale.
[[nodiscard]] NewtonResult solve_with_few_jacobians(
    const EconomicSystem& system, const BranchVector& start, const BranchVector& constraint,
    const Scaling& scaling, const NewtonOptions& options, const BranchFactors* nearby = nullptr);

/// On the plane of the constraint, by the corrector that the forces of the scene call for.
[[nodiscard]] NewtonResult solve_balance(HarmonicBalance& balance,
                                         ContinuationOptions::Corrector corrector,
                                         const BranchVector& guess, const BranchVector& constraint,
                                         const Scaling& scaling, const NewtonOptions& options,
                                         const BranchFactors* nearby = nullptr);

}  // namespace microslip::solver
