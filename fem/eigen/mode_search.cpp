#include "fem/eigen/mode_search.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include "fem/elements/number_text.hpp"
#include "fem/petsc/columns.hpp"
#include "fem/petsc/factorisation.hpp"
#include "fem/petsc/petsc_check.hpp"
#include "fem/petsc_error.hpp"

namespace microslip::fem {
namespace {

// Neighbours nearer than this (relative) are one cluster: far above the error of a computed λ,
// about 1e-16 λ_max/λ ≈ 1e-7 on fine meshes, so that no shift in a gap can miscount.
constexpr double cluster_width = 1e-4;

// Middle of the first gap with n or more values below it: values found, then lower estimates of
// what comes next. A gap that is not there after all (an estimate above the value it stands for)
// only makes the count larger, and what is missing is searched.
std::optional<double> shift_in_gap(const Eigen::VectorXd& found, const Eigen::VectorXd& beyond,
                                   Eigen::Index n, Eigen::Index space) {
  Eigen::VectorXd values(found.size() + beyond.size());
  values << found, beyond;
  double below = n == 0 ? 0.0 : values.head(n).maxCoeff();
  for (Eigen::Index k = n; k < values.size(); ++k) {
    if (values[k] - below > cluster_width * values[k]) return 0.5 * (below + values[k]);
    below = std::max(below, values[k]);
  }
  if (found.size() == space) return below * (1.0 + cluster_width);
  return std::nullopt;
}

Eigen::MatrixXd side_by_side(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd both(a.rows(), a.cols() + b.cols());
  both << a, b;
  return both;
}

// One refinement; what rounding mixed in of the rigid motions, magnified by the inverse there,
// goes.
EigenPairs refine_beside(const Eigen::MatrixXd& rigid, const FeSystem& system,
                         const LinearSolver& inverse, const Eigen::MatrixXd& vectors) {
  EigenPairs pairs = refine(system, inverse, vectors);
  if (rigid.cols() > 0) {
    pairs.vectors -=
        rigid * inner_products(rigid, multiply(system.mass_matrix.get(), pairs.vectors));
  }
  return pairs;
}

class Stopwatch {
 public:
  [[nodiscard]] double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Y += a X, both of one pattern. On several ranks the slower way, row by row: told that the
// patterns are the same, MatAXPY of MATMPISBAIJ (PETSc 3.18) adds as many numbers as there are
// blocks, a ninth.
void add_same_pattern(Mat Y, double a, Mat X) {
  PetscBool is_parallel = PETSC_FALSE;
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(Y), MATMPISBAIJ, &is_parallel));
  check(
      MatAXPY(Y, a, X, is_parallel == PETSC_TRUE ? SUBSET_NONZERO_PATTERN : SAME_NONZERO_PATTERN));
}

[[noreturn]] void report_missed(Eigen::Index found, Eigen::Index counted, double shift) {
  throw EigenError("eigen-missed-mode: " + std::to_string(found) +
                   " modes found below omega^2 = " + number_text(shift) +
                   " rad^2/s^2, the inertia of K - omega^2 M counts " + std::to_string(counted));
}

}  // namespace

MatHandle shifted_stiffness(const FeSystem& system, double shift) {
  MatHandle shifted;
  check(MatDuplicate(system.stiffness.get(), MAT_COPY_VALUES, shifted.out()));
  add_same_pattern(shifted.get(), -shift, system.mass_matrix.get());
  check(MatSetOption(shifted.get(), MAT_SYMMETRIC, PETSC_TRUE));
  return shifted;
}

Eigen::Index count_below(const FeSystem& system, double shift) {
  return Factorisation(shifted_stiffness(system, shift).get(), FactorKind::inertia_only)
      .inertia()
      .negative;
}

CountedPairs find_elastic_modes(const FeSystem& system, const LinearSolver& inverse, double shift,
                                Eigen::Index n, const Eigen::MatrixXd& rigid, ModeCount counting) {
  constexpr int max_rounds = 5;
  const Eigen::Index space = 3 * system.dofs.n_free_nodes() - rigid.cols();
  Stopwatch watch;
  CountedPairs result;
  const auto search = [&](Eigen::Index n_missing) {
    const Eigen::MatrixXd known = side_by_side(rigid, result.pairs.vectors);
    const FoundPairs more = lowest_pairs(system, inverse, shift, n_missing, known);
    result.pairs = refine_beside(rigid, system, inverse,
                                 side_by_side(result.pairs.vectors, more.pairs.vectors));
    result.search_seconds += watch.lap();
    return more.beyond;
  };
  const auto place_count = [&](double count_shift) {
    result.count_shift = count_shift;
    if (counting == ModeCount::later) return;
    result.n_counted = count_below(system, count_shift);
    result.inertia_seconds += watch.lap();
  };
  result.pairs.vectors.resize(rigid.rows(), 0);
  Eigen::VectorXd beyond = search(std::max<Eigen::Index>(n, 1));
  if (counting == ModeCount::none) return result;
  std::optional<double> gap;
  for (int round = 0; round < max_rounds; ++round) {
    Eigen::Index n_missing = 1;  // none is, but the gap is not seen yet
    if (!gap) {
      gap = shift_in_gap(result.pairs.values, beyond, n, space);
      if (gap) place_count(*gap);
    }
    if (gap) {
      result.n_below = (result.pairs.values.array() < *gap).count();
      if (counting == ModeCount::later) return result;
      n_missing = result.n_counted - rigid.cols() - result.n_below;
      if (n_missing == 0) return result;
      if (n_missing < 0) break;
    }
    beyond = search(n_missing);
  }
  report_missed(rigid.cols() + result.n_below, result.n_counted, result.count_shift);
}

}  // namespace microslip::fem
