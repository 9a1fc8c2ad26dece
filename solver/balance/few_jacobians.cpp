#include "solver/balance/few_jacobians.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "contact/dense.hpp"

namespace microslip::solver {
namespace {

constexpr int most_updates = 9;
constexpr double falls = 0.3;  // a residual that falls by less asks for a Jacobian of its own
constexpr double jumps =
    3e-2;  // a predictor farther off, over the scale of forces, is no place for a chord

using Factors = contact::LuFactors;

class Corrector {
 public:
  Corrector(const EconomicSystem& system, const BranchVector& constraint, const Scaling& scaling,
            const NewtonOptions& options)
      : system_(system),
        constraint_(constraint),
        scaling_(scaling),
        options_(options),
        tolerance_(std::max(options.tolerance, scaling.rounding)) {}

  NewtonResult run(const BranchVector& start, const BalanceEvaluation& near) {
    point_ = start;
    if (!approach(factors_of(near))) return newton_from(point_);
    NewtonResult at = evaluated(system_.whole, point_);
    if (!(at.residual <= tolerance_)) return newton_from(point_);
    at.converged = true;
    at.iterations = iterations_;
    at.evaluations = evaluations_;
    return at;
  }

 private:
  [[nodiscard]] Factors factors_of(const BalanceEvaluation& at) const {
    const Eigen::Index n = at.jacobian.rows();
    Eigen::MatrixXd matrix(n + 1, n + 1);
    matrix.topLeftCorner(n, n) = at.jacobian * (scaling_.x / scaling_.residual);
    matrix.topRightCorner(n, 1) =
        at.parameter_derivative * (scaling_.parameter / scaling_.residual);
    matrix.row(n) << constraint_.x.transpose(), constraint_.parameter;
    return Factors(matrix);
  }

  [[nodiscard]] Eigen::VectorXd step(const Factors& factors, const BalanceEvaluation& at) const {
    Eigen::VectorXd right(at.residual.size() + 1);
    right << -at.residual / scaling_.residual, 0.0;
    return factors.solve(right);
  }

  [[nodiscard]] BranchVector moved_by(const Eigen::VectorXd& scaled) const {
    const Eigen::Index n = point_.x.size();
    return {point_.x + scaling_.x * scaled.head(n),
            point_.parameter + scaling_.parameter * scaled[n]};
  }

  [[nodiscard]] NewtonResult evaluated(const ParametricSystem& system, BranchVector point) {
    NewtonResult result;
    result.point = std::move(point);
    result.evaluation = system(result.point.x, result.point.parameter);
    ++evaluations_;
    const double size = result.evaluation.residual.norm() + result.evaluation.defect;
    result.residual =
        std::isfinite(size) ? size / scaling_.residual : std::numeric_limits<double>::infinity();
    return result;
  }

  /// Broyden's method by forces alone; the best point is left in point_. True: it meets the tolerance.
  bool approach(const Factors& chord) {
    std::vector<Eigen::VectorXd> steps;
    double before = std::numeric_limits<double>::infinity();
    BranchVector last;
    for (int i = 0; i <= most_updates; ++i) {
      const NewtonResult here = evaluated(system_.residual, point_);
      if (here.residual <= tolerance_) return true;
      if (i == 0 && here.residual > jumps) return false;
      if (i > 0 && !(here.residual < falls * before)) {
        if (!(here.residual < before)) point_ = std::move(last);
        return false;
      }
      before = here.residual;
      last = point_;
      Eigen::VectorXd next = step(chord, here.evaluation);
      for (std::size_t j = 0; j + 1 < steps.size(); ++j) {
        next += steps[j + 1] * (steps[j].dot(next) / steps[j].squaredNorm());
      }
      if (!steps.empty()) {
        next /= 1.0 - steps.back().dot(next) / steps.back().squaredNorm();
      }
      if (!next.allFinite()) return false;
      point_ = moved_by(next);
      steps.push_back(std::move(next));
      ++iterations_;
    }
    return false;
  }

  [[nodiscard]] NewtonResult newton_from(const BranchVector& start) const {
    NewtonResult result = solve_newton(system_.whole, start, constraint_, scaling_, options_);
    result.evaluations += evaluations_;
    return result;
  }

  const EconomicSystem& system_;
  const BranchVector& constraint_;
  const Scaling& scaling_;
  const NewtonOptions& options_;
  double tolerance_;
  BranchVector point_;
  int iterations_ = 0;
  int evaluations_ = 0;
};

}  // namespace

NewtonResult solve_with_few_jacobians(const EconomicSystem& system, const BranchVector& start,
                                      const BranchVector& constraint, const Scaling& scaling,
                                      const NewtonOptions& options, const BalanceEvaluation& near) {
  return Corrector(system, constraint, scaling, options).run(start, near);
}

}  // namespace microslip::solver
