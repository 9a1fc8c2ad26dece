#include "fem/block_krylov.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include <Eigen/Eigenvalues>

#include "fem/columns.hpp"
#include "fem/petsc_error.hpp"

namespace microslip::fem {
namespace {

constexpr double tolerance = 1e-9;    // of (2) over θ, as for Krylov–Schur
constexpr double rough = 1e-4;        // of the pairs above: their λ is then good to 1e-8
constexpr double dependence = 1e-12;  // a column that lost this much to others is one of them
constexpr int max_steps = 300;
// Right-hand sides at a time. Wider blocks cost less each but need more of them: at 103 000 degrees
// of freedom ten modes take 2.4, 1.9, 2.1, 2.2 s of one core with 3, 4, 6, 8, and 4.2 s one by one.
constexpr Eigen::Index block_size = 4;

// Numbers in [−1, 1) that depend on the place only (splitmix64): the same on any number of ranks.
double noise(std::uint64_t place) {
  std::uint64_t z = (place + 1) * 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1.0;
}

Eigen::MatrixXd start_block(const DofMap& dofs, Eigen::Index n_columns) {
  Eigen::MatrixXd X(dofs.n_local_dofs(), n_columns);
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    for (Eigen::Index j = 0; j < n_columns; ++j) {
      X(i, j) = noise(static_cast<std::uint64_t>((3 * dofs.first() + i) * n_columns + j));
    }
  }
  return X;
}

// M-orthonormal columns and their products with M, growing to the right.
class Basis {
 public:
  Basis(Mat M, const Eigen::MatrixXd& deflation, Eigen::Index capacity)
      : M_(M), n_known_(deflation.cols()), n_(deflation.cols()) {
    V_.resize(deflation.rows(), n_known_ + capacity);
    MV_.resize(deflation.rows(), n_known_ + capacity);
    V_.leftCols(n_known_) = deflation;
    MV_.leftCols(n_known_) = multiply(M, deflation);
  }
  [[nodiscard]] Eigen::Index size() const { return n_ - n_known_; }
  [[nodiscard]] auto columns(Eigen::Index first, Eigen::Index n) const {
    return V_.middleCols(n_known_ + first, n);
  }
  [[nodiscard]] auto products(Eigen::Index first, Eigen::Index n) const {
    return MV_.middleCols(n_known_ + first, n);
  }

  // Takes out of W what the basis holds, twice; returns the coefficients, deflated ones left out.
  [[nodiscard]] Eigen::MatrixXd orthogonalise(Eigen::MatrixXd& W) const {
    Eigen::MatrixXd coefficients = Eigen::MatrixXd::Zero(n_, W.cols());
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::MatrixXd C = inner_products(MV_.leftCols(n_), W);
      W.noalias() -= V_.leftCols(n_) * C;
      coefficients += C;
    }
    return coefficients.bottomRows(size());
  }

  // Appends the directions of W (orthogonal to the basis) by Gram–Schmidt within the block; W =
  // V₊β. Columns that depend on the others add none.
  [[nodiscard]] Eigen::MatrixXd append(const Eigen::MatrixXd& W) {
    const Eigen::VectorXd before = column_norms(W);
    const Eigen::Index first = n_;
    Eigen::MatrixXd beta = Eigen::MatrixXd::Zero(W.cols(), W.cols());
    for (Eigen::Index j = 0; j < W.cols() && n_ < V_.cols(); ++j) {
      Eigen::MatrixXd w = W.col(j);
      for (int pass = 0; pass < 2 && n_ > first; ++pass) {
        const Eigen::MatrixXd c = inner_products(MV_.middleCols(first, n_ - first), w);
        w.noalias() -= V_.middleCols(first, n_ - first) * c;
        beta.col(j).head(n_ - first) += c;
      }
      if (column_norms(w)[0] <= dependence * before[j]) continue;
      const Eigen::MatrixXd Mw = multiply(M_, w);
      const double norm = std::sqrt(inner_products(w, Mw)(0, 0));
      V_.col(n_) = w / norm;
      MV_.col(n_) = Mw / norm;
      beta(n_ - first, j) = norm;
      ++n_;
    }
    return beta.topRows(n_ - first);
  }

  // Keeps the combinations S of the first columns and the last block.
  void restart(const Eigen::MatrixXd& S, Eigen::Index last_block) {
    const Eigen::MatrixXd V_kept = columns(0, S.rows()) * S;
    const Eigen::MatrixXd MV_kept = products(0, S.rows()) * S;
    const Eigen::MatrixXd V_last = columns(size() - last_block, last_block);
    const Eigen::MatrixXd MV_last = products(size() - last_block, last_block);
    V_.middleCols(n_known_, S.cols()) = V_kept;
    MV_.middleCols(n_known_, S.cols()) = MV_kept;
    V_.middleCols(n_known_ + S.cols(), last_block) = V_last;
    MV_.middleCols(n_known_ + S.cols(), last_block) = MV_last;
    n_ = n_known_ + S.cols() + last_block;
  }

 private:
  Mat M_;
  Eigen::Index n_known_;
  Eigen::Index n_;
  Eigen::MatrixXd V_;
  Eigen::MatrixXd MV_;
};

// Ritz pairs of the projected operator, largest θ first.
struct Ritz {
  Eigen::VectorXd theta;
  Eigen::MatrixXd s;

  explicit Ritz(const Eigen::MatrixXd& T) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 * (T + T.transpose()));
    theta = eigen.eigenvalues().reverse();
    s = eigen.eigenvectors().rowwise().reverse();
  }
  // Pairs in front that meet a tolerance; (2) with the last block of the rows of s.
  [[nodiscard]] Eigen::Index n_converged(const Eigen::MatrixXd& beta, double allowed) const {
    const Eigen::MatrixXd rest = beta * s.bottomRows(beta.cols());
    Eigen::Index n = 0;
    while (n < theta.size() && theta[n] > 0.0 && rest.col(n).norm() <= allowed * theta[n]) ++n;
    return n;
  }
};

}  // namespace

EigenPairs lowest_pairs_by_blocks(const FeSystem& system, const Factorisation& inverse,
                                  double shift, Eigen::Index n_wanted,
                                  const Eigen::MatrixXd& deflation) {
  const Eigen::Index space = 3 * system.dofs.n_free_nodes() - deflation.cols();
  const Eigen::Index n = std::min(n_wanted, space);
  const Eigen::Index capacity = std::min(space, 2 * n + 6 * block_size);
  Basis basis(system.mass_matrix.get(), deflation, capacity);
  Eigen::MatrixXd W = start_block(system.dofs, std::min(block_size, space));
  static_cast<void>(basis.orthogonalise(W));
  Eigen::Index last = basis.append(W).rows();
  Eigen::MatrixXd T(0, 0);
  Eigen::Index n_converged = 0;
  for (int step = 0; step < max_steps; ++step) {
    const Eigen::Index done = T.rows();
    W = inverse.solve(basis.products(done, last));
    const Eigen::MatrixXd C = basis.orthogonalise(W);
    T.conservativeResize(done + last, done + last);
    T.rightCols(last) = C;
    T.bottomLeftCorner(last, done) = C.topRows(done).transpose();
    const Eigen::MatrixXd beta = basis.append(W);
    const Ritz ritz(T);
    n_converged = ritz.n_converged(beta, tolerance);
    const bool exhausted = beta.rows() == 0;  // V spans an invariant subspace
    const Eigen::Index n_usable = exhausted ? T.rows() : ritz.n_converged(beta, rough);
    if (exhausted || (n_converged >= n && n_usable > n)) {
      return {(shift + ritz.theta.head(n_usable).cwiseInverse().array()).matrix(),
              basis.columns(0, T.rows()) * ritz.s.leftCols(n_usable)};
    }
    last = beta.rows();
    if (basis.size() + last <= capacity || capacity == space) continue;
    const Eigen::Index kept = std::min(n + block_size, T.rows());
    basis.restart(ritz.s.leftCols(kept), last);
    T = ritz.theta.head(kept).asDiagonal();
  }
  throw EigenError("eigen-not-converged: " + std::to_string(n) + " modes requested, " +
                   std::to_string(n_converged) + " converged at tolerance 1e-9");
}

}  // namespace microslip::fem
