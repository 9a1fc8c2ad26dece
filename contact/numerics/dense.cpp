#include "contact/dense.hpp"

#include <sys/mman.h>
#include <sys/resource.h>

#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <unsupported/Eigen/MatrixFunctions>

#include "contact/numerics/hessenberg_problem.hpp"
#include "contact/numerics/lapack.hpp"

namespace microslip::contact {

namespace {

// Rows from which LAPACK, tuned for the processor, beats Eigen's code for any processor: three
// times at 270.
constexpr Eigen::Index large = 64;

/// OpenBLAS asks for a buffer of 128 MB for every thread that calls it, and where the address space
/// is limited (`ulimit -v`) and has none it asks for ever.
bool has_room_for_lapack() {
  static const bool has_room = [] {
    constexpr std::size_t enough = std::size_t{1} << 30U;  // bytes: eight threads
    rlimit space{};
    if (getrlimit(RLIMIT_AS, &space) != 0 || space.rlim_cur == RLIM_INFINITY) return true;
    void* const probe = mmap(nullptr, enough, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return probe != MAP_FAILED && munmap(probe, enough) == 0;
  }();
  return has_room;
}

bool is_large(const Eigen::MatrixXd& A) {
  return has_lapack && A.rows() >= large && has_room_for_lapack();
}

// LAPACK's small-bulge sweeps begin at 76 rows and take twice the time of Eigen's single ones
// there; at 100 rows they take a third more still.
constexpr Eigen::Index large_problem = 128;

bool is_large_problem(const Eigen::MatrixXd& A) {
  return has_lapack && A.rows() >= large_problem && has_room_for_lapack();
}

template <class Matrix>
std::optional<Matrix> inverse_of(const Matrix& A) {
  const Eigen::PartialPivLU<Matrix> factors(A);
  if ((factors.matrixLU().diagonal().array() == 0.0).any()) return std::nullopt;
  return factors.inverse();
}

/// Eigenvalues, and vectors where `vectors` is not null. @return false: they do not converge.
bool general_problem(Eigen::MatrixXd A, Eigen::VectorXcd& values, Eigen::MatrixXd* vectors) {
  if (!A.allFinite()) return false;
  const int n = static_cast<int>(A.rows());
  const int one = 1;
  const int n_work = 34 * n;  // blocks of 32 and what vectors need
  int info = 0;
  Eigen::VectorXd real(n);
  Eigen::VectorXd imaginary(n);
  Eigen::VectorXd work(n_work);
  if (vectors != nullptr) vectors->resize(n, n);
  dgeev_("N", vectors != nullptr ? "V" : "N", &n, A.data(), &n, real.data(), imaginary.data(),
         nullptr, &one, vectors != nullptr ? vectors->data() : nullptr,
         vectors != nullptr ? &n : &one, work.data(), &n_work, &info);
  values.resize(n);
  values.real() = real;
  values.imag() = imaginary;
  return info == 0;
}

/// Columns of pairs are real and imaginary parts.
Eigen::MatrixXcd complex_vectors(const Eigen::VectorXcd& values, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXcd vectors = columns.cast<std::complex<double>>();
  for (Eigen::Index i = 0; i + 1 < values.size(); ++i) {
    if (values[i].imag() == 0.0) continue;
    vectors.col(i).imag() = columns.col(i + 1);
    vectors.col(i + 1) = vectors.col(i).conjugate();
    ++i;
  }
  return vectors;
}

Eigen::MatrixXd no_solution(const Eigen::Ref<const Eigen::MatrixXd>& B) {
  return Eigen::MatrixXd::Constant(B.rows(), B.cols(), std::numeric_limits<double>::quiet_NaN());
}

/// The last column of Q in A P = Q R.
/// @param A  m × (m − 1).
/// @return none: its columns depend on one another, to rounding.
std::optional<Eigen::VectorXd> last_of_q(Eigen::MatrixXd A) {
  if (!A.allFinite()) return std::nullopt;
  const int m = static_cast<int>(A.rows());
  const int n = static_cast<int>(A.cols());
  const int one = 1;
  const int n_work = 2 * n + 32 * (n + 1);  // blocks of 32
  int info = 0;
  Eigen::VectorXi pivots = Eigen::VectorXi::Zero(n);
  Eigen::VectorXd tau(n);
  Eigen::VectorXd work(n_work);
  dgeqp3_(&m, &n, A.data(), &m, pivots.data(), tau.data(), work.data(), &n_work, &info);
  const auto diagonal = A.diagonal().cwiseAbs();
  const double rounding = std::numeric_limits<double>::epsilon() * n;
  if (!(diagonal.minCoeff() > rounding * diagonal.maxCoeff())) return std::nullopt;
  Eigen::VectorXd y = Eigen::VectorXd::Unit(m, m - 1);
  dormqr_("L", "N", &m, &one, &n, A.data(), &m, tau.data(), y.data(), &m, work.data(), &n_work,
          &info);
  return y;
}

double sign_of(double pivot) { return pivot > 0.0 ? 1.0 : (pivot < 0.0 ? -1.0 : 0.0); }

}  // namespace

/// One of the two is used.
struct LuFactors::Factors {
  Eigen::PartialPivLU<Eigen::MatrixXd> small;
  Eigen::MatrixXd large;
  Eigen::VectorXi pivots;

  [[nodiscard]] const Eigen::MatrixXd& triangles() const {
    return large.size() > 0 ? large : small.matrixLU();
  }
  [[nodiscard]] bool has_zero_pivot() const {
    return (triangles().diagonal().array() == 0.0).any();
  }

  [[nodiscard]] Eigen::MatrixXd solve(const char* transposed, Eigen::MatrixXd B) const {
    const int n = static_cast<int>(large.rows());
    const int n_right = static_cast<int>(B.cols());
    int info = 0;
    dgetrs_(transposed, &n, &n_right, large.data(), &n, pivots.data(), B.data(), &n, &info);
    return B;
  }
};

LuFactors::LuFactors(const Eigen::MatrixXd& A) : factors_(std::make_unique<Factors>()) {
  if (!is_large(A)) {
    factors_->small.compute(A);
    return;
  }
  const int n = static_cast<int>(A.rows());
  int info = 0;
  factors_->large = A;
  factors_->pivots.resize(n);
  dgetrf_(&n, &n, factors_->large.data(), &n, factors_->pivots.data(), &info);
}
LuFactors::~LuFactors() = default;
LuFactors::LuFactors(LuFactors&&) noexcept = default;
LuFactors& LuFactors::operator=(LuFactors&&) noexcept = default;

Eigen::MatrixXd LuFactors::solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const {
  if (factors_->has_zero_pivot()) return no_solution(B);
  return factors_->large.size() > 0 ? factors_->solve("N", B) : factors_->small.solve(B);
}

Eigen::MatrixXd LuFactors::solve_transposed(const Eigen::Ref<const Eigen::MatrixXd>& B) const {
  if (factors_->has_zero_pivot()) return no_solution(B);
  return factors_->large.size() > 0 ? factors_->solve("T", B)
                                    : factors_->small.transpose().solve(B);
}

double LuFactors::sign_of_determinant() const {
  const bool is_large = factors_->large.size() > 0;
  double sign = 1.0;
  if (is_large) {
    for (Eigen::Index i = 0; i < factors_->pivots.size(); ++i) {
      if (factors_->pivots[i] != i + 1) sign = -sign;
    }
  } else {
    sign = static_cast<double>(factors_->small.permutationP().determinant());
  }
  const Eigen::VectorXd pivots = factors_->triangles().diagonal();
  for (const double pivot : pivots) sign *= sign_of(pivot);
  return sign;
}

Eigen::MatrixXd solved(const Eigen::MatrixXd& A, const Eigen::Ref<const Eigen::MatrixXd>& B) {
  return LuFactors(A).solve(B);
}

Eigen::MatrixXcd solved(const Eigen::MatrixXcd& A, const Eigen::Ref<const Eigen::MatrixXcd>& B) {
  return A.partialPivLu().solve(B);
}

std::optional<Eigen::MatrixXd> inverted(const Eigen::MatrixXd& A) { return inverse_of(A); }

std::optional<Eigen::MatrixXcd> inverted(const Eigen::MatrixXcd& A) { return inverse_of(A); }

Eigen::Index nullity(const Eigen::MatrixXd& A) {
  return Eigen::FullPivLU<Eigen::MatrixXd>(A).dimensionOfKernel();
}

std::optional<Eigen::VectorXd> null_direction(const Eigen::MatrixXd& A) {
  if (is_large(A)) return last_of_q(A.transpose());
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(A.transpose());
  if (factors.rank() < A.rows()) return std::nullopt;
  const Eigen::MatrixXd Q = factors.householderQ();
  return Q.col(A.rows());
}

std::optional<Eigen::VectorXd> symmetric_eigenvalues(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A, Eigen::EigenvaluesOnly);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return solver.eigenvalues();
}

std::optional<SymmetricPairs> symmetric_pairs(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return SymmetricPairs{solver.eigenvalues(), solver.eigenvectors()};
}

std::optional<SymmetricPairs> symmetric_pairs(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(K, M);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return SymmetricPairs{solver.eigenvalues(), solver.eigenvectors()};
}

bool is_positive_definite(const Eigen::MatrixXd& A) { return A.llt().info() == Eigen::Success; }

std::optional<Eigen::VectorXcd> general_eigenvalues(const Eigen::MatrixXd& A) {
  if (is_large_problem(A)) {
    Eigen::VectorXcd values;
    if (!general_problem(A, values, nullptr)) return std::nullopt;
    return values;
  }
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A, false);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return solver.eigenvalues();
}

std::optional<GeneralPairs> general_pairs(const Eigen::MatrixXd& A) {
  if (is_large_problem(A)) {
    GeneralPairs pairs;
    Eigen::MatrixXd columns;
    if (!general_problem(A, pairs.values, &columns)) return std::nullopt;
    pairs.vectors = complex_vectors(pairs.values, columns);
    return pairs;
  }
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return GeneralPairs{solver.eigenvalues(), solver.eigenvectors()};
}

std::optional<GeneralPairs> general_pairs(const Eigen::MatrixXd& A,
                                          const std::function<bool(std::complex<double>)>& wanted) {
  if (!has_lapack) {
    auto all = general_pairs(A);
    for (Eigen::Index i = 0; all && i < A.rows(); ++i) {
      const std::complex<double> value = all->values[i];
      if (!wanted(value.imag() < 0.0 ? std::conj(value) : value)) all->vectors.col(i).setZero();
    }
    return all;
  }
  if (!A.allFinite()) return std::nullopt;
  HessenbergProblem problem(A);
  if (!problem.find_values()) return std::nullopt;
  GeneralPairs pairs{problem.values(), {}};
  std::vector<int> chosen(static_cast<std::size_t>(A.rows()));
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    const std::complex<double> value = pairs.values[i];
    chosen[static_cast<std::size_t>(i)] = value.imag() >= 0.0 && wanted(value) ? 1 : 0;
  }
  if (!problem.find_vectors(chosen, pairs.vectors)) return std::nullopt;
  return pairs;
}

Eigen::MatrixXd exponential(const Eigen::MatrixXd& A) { return A.exp(); }

}  // namespace microslip::contact
