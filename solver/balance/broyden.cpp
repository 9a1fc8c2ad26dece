#include "solver/balance/broyden.hpp"

#include <utility>

namespace microslip::solver {

Eigen::VectorXd Broyden::solve(const Eigen::VectorXd& f) const {
  Eigen::VectorXd y = inverse_(f);
  for (std::size_t j = 0; j + 1 < steps_.size(); ++j) {
    y += steps_[j + 1] * (steps_[j].dot(y) / steps_[j].squaredNorm());
  }
  return y;
}

Eigen::VectorXd Broyden::step(const Eigen::VectorXd& f) {
  Eigen::VectorXd next = -solve(f);
  if (!steps_.empty()) {
    const Eigen::VectorXd& last = steps_.back();
    next /= 1.0 - last.dot(next) / last.squaredNorm();
  }
  steps_.push_back(next);
  return next;
}

}  // namespace microslip::solver
