#include "solver/balance/branch_factors.hpp"

#include <utility>

namespace microslip::solver {
namespace {

double product(const BranchVector& row, const Eigen::VectorXd& y) {
  const Eigen::Index n = row.x.size();
  return row.x.dot(y.head(n)) + row.parameter * y[n];
}

}  // namespace

BranchFactors::BranchFactors(const BalanceEvaluation& at, BranchVector row, const Scaling& scaling)
    : factors_(at, row, scaling),
      row_(std::move(row)),
      scaling_(scaling),
      along_(factors_.solve(Eigen::VectorXd::Unit(row_.x.size() + 1, row_.x.size()))) {}

Tangent BranchFactors::tangent() const {
  if (!along_.allFinite()) return {row_, 0.0};  // it turns by a right angle here: go on straight
  const Eigen::Index n = row_.x.size();
  const double size = along_.norm();
  // det [D; tᵀ] has the sign of det [D; rowᵀ] because t·row > 0.
  return {{along_.head(n) / size, along_[n] / size}, factors_.sign_of_determinant()};
}

/// Another row is a change of rank one, another scaling one of rows and columns.
Eigen::VectorXd BranchFactors::solve(const Eigen::VectorXd& f, const BranchVector& row,
                                     const Scaling& scaling) const {
  const Eigen::Index n = row.x.size();
  const double of_x = scaling_.x / scaling.x;
  const double of_parameter = scaling_.parameter / scaling.parameter;
  const BranchVector own{row.x * of_x, row.parameter * of_parameter};
  Eigen::VectorXd right = f;
  right.head(n) *= scaling.residual / scaling_.residual;
  Eigen::VectorXd y = factors_.solve(right);
  y += along_ * ((f[n] - product(own, y)) / product(own, along_));
  y.head(n) *= of_x;
  y[n] *= of_parameter;
  return y;
}

}  // namespace microslip::solver
