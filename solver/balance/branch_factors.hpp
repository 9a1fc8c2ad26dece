/// @file
/// Factors of [∂R/∂y; row] at one place of a branch, in scaled variables (newton.hpp). They serve
/// other rows, and other places near by, where Broyden's method mends them (few_jacobians.hpp).
#pragma once

#include "solver/balance/condensed.hpp"
#include "solver/balance/newton.hpp"

namespace microslip::solver {

class BranchFactors {
 public:
  /// @param at   with its derivatives.
  /// @param row  at less than 90° to the tangent of the branch, where there is one.
  BranchFactors(const BalanceEvaluation& at, BranchVector row, const Scaling& scaling);

  /// Where the factors were made, at less than 90° to their row.
  [[nodiscard]] Tangent tangent() const;
  [[nodiscard]] const Scaling& scaling() const { return scaling_; }
  /// [∂R/∂y; row]⁻¹ f. @param f, row  in variables of `scaling`; n + 1 numbers each.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& f, const BranchVector& row,
                                      const Scaling& scaling) const;

 private:
  BorderedFactors factors_;
  BranchVector row_;
  Scaling scaling_;
  Eigen::VectorXd along_;  // [∂R/∂y; row]⁻¹ (0, 1): along the branch
};

}  // namespace microslip::solver
