#include "fem/eigen/attachment.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "fem/elements/symmetric_pairs.hpp"
#include "fem/petsc/columns.hpp"

namespace microslip::fem {
namespace {

Eigen::MatrixXd symmetric(const Eigen::MatrixXd& A) { return 0.5 * (A + A.transpose()); }

Eigen::MatrixXd beside(const Eigen::MatrixXd& left, const Eigen::MatrixXd& right) {
  Eigen::MatrixXd both(right.rows(), left.cols() + right.cols());
  if (left.cols() > 0) both.leftCols(left.cols()) = left;
  both.rightCols(right.cols()) = right;
  return both;
}

Eigen::VectorXd energy_norms(const Eigen::MatrixXd& X, Mat K) {
  return inner_products(X, multiply(K, X)).diagonal().cwiseMax(0.0).cwiseSqrt();
}

/// K-orthonormal columns that span what X spans, largest remaining part first.
Eigen::MatrixXd independent_columns(Eigen::MatrixXd X, Mat K, double tolerance) {
  Eigen::MatrixXd chosen(X.rows(), 0);
  Eigen::VectorXd norms = energy_norms(X, K);
  std::vector<Eigen::Index> left;
  for (Eigen::Index j = 0; j < X.cols(); ++j) {
    if (!(norms[j] > 0.0)) continue;
    X.col(j) /= norms[j];  // its own size must not matter: forces and tractions have other units
    left.push_back(j);
  }
  while (!left.empty()) {
    norms = energy_norms(X(Eigen::all, left), K);
    Eigen::Index pivot = 0;
    if (norms.maxCoeff(&pivot) < tolerance) break;
    const Eigen::Index column = left[static_cast<std::size_t>(pivot)];
    chosen = beside(chosen, X.col(column) / norms[pivot]);
    left.erase(left.begin() + pivot);
    // Against all chosen so far, not the last alone: what rounding left of earlier ones goes too.
    if (!left.empty()) {
      const Eigen::MatrixXd rest = X(Eigen::all, left);
      X(Eigen::all, left) = rest - chosen * inner_products(chosen, multiply(K, rest));
    }
  }
  return chosen;
}

}  // namespace

void StaticShapes::append(const StaticShapes& more) {
  loads = beside(loads, more.loads);
  shapes = beside(shapes, more.shapes);
  const Eigen::Index n = stiffness.size();
  stiffness.conservativeResize(n + more.stiffness.size());
  stiffness.tail(more.stiffness.size()) = more.stiffness;
}

RitzShapes ritz_shapes(const FeSystem& system, const StaticShapes& set,
                       const Eigen::MatrixXd& modes, double tolerance) {
  const Mat K = system.stiffness.get();
  const Mat M = system.mass_matrix.get();
  Eigen::MatrixXd Q = independent_columns(set.shapes, K, tolerance);
  if (Q.cols() == 0) return {Eigen::VectorXd(0), Q};
  const Eigen::MatrixXd M_modes = multiply(M, modes);
  for (int pass = 0; pass < 2; ++pass) {  // the second removes what rounding left of the first
    Q -= modes * inner_products(M_modes, Q);
    Q = mass_orthonormal(M, Q);
  }
  const Eigen::MatrixXd energy = symmetric(inner_products(Q, multiply(K, Q)));
  const SymmetricPairs eigen = symmetric_pairs(energy);
  return {eigen.values.cwiseSqrt(), Q * eigen.vectors};
}

double missed_share(const Eigen::MatrixXd& flexibility, Eigen::Index n_lower,
                    const Eigen::VectorXd& local_stiffness) {
  const Eigen::Index n_last = flexibility.rows() - n_lower;
  if (n_last == 0) return 0.0;
  // In tractions of unit energy in the local springs: t = √k s. Then E = I + √k C √k.
  const Eigen::VectorXd root = local_stiffness.cwiseSqrt();
  const Eigen::MatrixXd C = symmetric(root.asDiagonal() * flexibility * root.asDiagonal());
  const auto B = C.bottomRightCorner(n_last, n_last);
  Eigen::MatrixXd missed = B;
  if (n_lower > 0) {
    const SymmetricPairs lower = symmetric_pairs(C.topLeftCorner(n_lower, n_lower));
    const double floor = 1e-12 * lower.values.maxCoeff();  // below: no flexibility but rounding
    for (Eigen::Index i = 0; i < n_lower; ++i) {
      if (!(lower.values[i] > floor)) continue;
      const Eigen::VectorXd reached = C.bottomLeftCorner(n_last, n_lower) * lower.vectors.col(i);
      missed -= reached * reached.transpose() / lower.values[i];
    }
  }
  const Eigen::MatrixXd whole = Eigen::MatrixXd::Identity(n_last, n_last) + B;
  return std::clamp(pencil_eigenvalues(symmetric(missed), whole).maxCoeff(), 0.0, 1.0);
}

AttachmentSet attachment_set(const ShapesOfDegree& solve, const AttachmentOptions& options) {
  AttachmentSet set;
  if (options.degree) {
    if (*options.degree < 0) {
      throw std::invalid_argument("degree of the tractions = " + std::to_string(*options.degree) +
                                  ", at least 0");
    }
    for (int degree = 0; degree <= *options.degree; ++degree) set.shapes.append(solve(degree));
    set.degree = *options.degree;
    set.missed_share = std::numeric_limits<double>::quiet_NaN();
    return set;
  }
  set.shapes = solve(0);
  while (true) {
    StaticShapes next = set.shapes;
    next.append(solve(set.degree + 1));
    const Eigen::MatrixXd flexibility = inner_products(next.loads, next.shapes);
    set.missed_share = missed_share(flexibility, set.shapes.loads.cols(), next.stiffness);
    if (set.missed_share <= options.missed_tolerance || set.degree >= options.max_degree) {
      set.richer = std::move(next);
      return set;
    }
    set.shapes = std::move(next);
    ++set.degree;
  }
}

}  // namespace microslip::fem
