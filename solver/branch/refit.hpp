/// @file
/// Solving on a force whose discretisation follows the motion (ModalForce::refit): it is frozen while
/// equations are solved, fitted anew to the result, and what was solved is solved again until fitting no
/// longer changes the force. For every other force all of this does nothing.
#pragma once

#include <vector>

#include "solver/branch/branch_walker.hpp"
#include "solver/balance/harmonic_balance.hpp"
#include "solver/balance/newton.hpp"

namespace microslip::solver {

/// What became of a fit.
struct RefitReport {
  bool is_replaced = false;  ///< solve again
  bool is_kept = false;  ///< what was to be solved again was not: the discretisation is the old one
  double change = 0.0;   ///< contact::Refit::change
};

/// Asks the force of a balance to suit points of a branch. Refits are counted from
/// ModalForce::begin_point().
[[nodiscard]] RefitReport refit_to(const HarmonicBalance& balance,
                                   const std::vector<BranchVector>& points);

/// The same for the step a walker has just taken, both ends of it, which are solved for again.
/// @param points  further points of the step.
[[nodiscard]] RefitReport refit_step(BranchWalker& walker, const HarmonicBalance& balance,
                                     std::vector<BranchVector> points);

struct RefittedSolution {
  NewtonResult solution;
  double change = 0.0;  ///< of the last fit: an estimate of the error of the force
  bool settled =
      true;  ///< false: on the last discretisation no solution was found; it is not in use
  int iterations = 0;
  int evaluations = 0;
};

/// A solution at its frequency on a discretisation fitted to it.
/// @param tolerance  of Newton's method.
[[nodiscard]] RefittedSolution settle_force(const HarmonicBalance& balance, NewtonResult solution,
                                            double tolerance);

}  // namespace microslip::solver
