/// @file
/// Broyden's method: steps to a zero of f from an inverse that is right near by,
///
///   H_0 given,  s_i = −H_i f_i,  H_{i+1} f = H_i f + s_{i+1} (s_iᵀ H_i f) / (s_iᵀ s_i)
///
/// with f evaluated where the last step has led.
///
/// Source: C. G. Broyden, Math. Comp. 19 (1965) 577–593; in the form of C. T. Kelley, Iterative
/// Methods for Linear and Nonlinear Equations, SIAM 1995, section 7.3.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace microslip::solver {

class Broyden {
 public:
  using Inverse = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

  /// @param inverse  H_0.
  explicit Broyden(Inverse inverse) : inverse_(std::move(inverse)) {}

  /// The next step, which is to be taken whole. Not finite: the updates have lost rank.
  /// @param f  where the step before has led.
  [[nodiscard]] Eigen::VectorXd step(const Eigen::VectorXd& f);

 private:
  /// H f.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& f) const;

  Inverse inverse_;
  std::vector<Eigen::VectorXd> steps_;
};

}  // namespace microslip::solver
