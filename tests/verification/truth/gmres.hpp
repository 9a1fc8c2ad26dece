/// @file
/// GMRES without restart, right preconditioned (Saad & Schultz, SIAM J. Sci. Stat. Comput.
/// 7 (1986)).
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/QR>

namespace microslip::truth {

using Operator = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

struct GmresResult {
  Eigen::VectorXd x;
  int iterations = 0;
  double residual = 0.0;  ///< relative to ‖b‖
};

/// Solves A x = b, x = P y. Stops at ‖b − Ax‖ ≤ tolerance ‖b‖ or after `most` vectors.
[[nodiscard]] inline GmresResult gmres(const Operator& A, const Operator& P,
                                       const Eigen::VectorXd& b, double tolerance, int most) {
  const double size = b.norm();
  if (size == 0.0) return {Eigen::VectorXd::Zero(b.size()), 0, 0.0};
  std::vector<Eigen::VectorXd> V{b / size};
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(most + 1, most);
  Eigen::VectorXd y;
  GmresResult result;
  for (int j = 0; j < most; ++j) {
    Eigen::VectorXd w = A(P(V[static_cast<std::size_t>(j)]));
    for (int pass = 0; pass < 2; ++pass) {  // twice is enough
      for (int i = 0; i <= j; ++i) {
        const double h = V[static_cast<std::size_t>(i)].dot(w);
        H(i, j) += h;
        w -= h * V[static_cast<std::size_t>(i)];
      }
    }
    H(j + 1, j) = w.norm();
    const Eigen::MatrixXd small = H.topLeftCorner(j + 2, j + 1);
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(j + 2);
    rhs[0] = size;
    y = small.householderQr().solve(rhs);
    result.iterations = j + 1;
    result.residual = (rhs - small * y).norm() / size;
    if (result.residual <= tolerance || H(j + 1, j) <= 1e-14 * size) break;
    V.push_back(w / H(j + 1, j));
  }
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(b.size());
  for (Eigen::Index i = 0; i < y.size(); ++i) sum += y[i] * V[static_cast<std::size_t>(i)];
  result.x = P(sum);
  return result;
}

}  // namespace microslip::truth
