#include "solver/balance/condensed.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace microslip::solver {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Unknowns = std::vector<Index>;

Index n_few(const CondensedJacobian& parts) { return parts.contact->jacobian.rows(); }

/// T of every row block.
MatrixXd to_few(const CondensedJacobian& parts, const MatrixXd& y) {
  const MatrixXd& T = parts.contact->of_modes;
  const Index blocks = y.rows() / T.cols();
  MatrixXd z(blocks * T.rows(), y.cols());
  for (Index i = 0; i < blocks; ++i) {
    z.middleRows(i * T.rows(), T.rows()).noalias() = T * y.middleRows(i * T.cols(), T.cols());
  }
  return z;
}

/// Tᵀ of every row block.
MatrixXd to_modes(const CondensedJacobian& parts, const MatrixXd& z) {
  const MatrixXd& T = parts.contact->of_modes;
  const Index blocks = z.rows() / T.rows();
  MatrixXd y(blocks * T.cols(), z.cols());
  for (Index i = 0; i < blocks; ++i) {
    y.middleRows(i * T.cols(), T.cols()).noalias() =
        T.transpose() * z.middleRows(i * T.rows(), T.rows());
  }
  return y;
}

/// T D_h⁻¹ Tᵀ K.
MatrixXd compliance_times_contact(const CondensedJacobian& parts, const PairedDiagonal& inverse) {
  const MatrixXd& T = parts.contact->of_modes;
  const MatrixXd& K = parts.contact->jacobian;
  const Index r = T.rows();
  const Index N = T.cols();
  const auto seen = [&](const VectorXd& entries, Index first) -> MatrixXd {
    return T * entries.segment(first, N).asDiagonal() * T.transpose();
  };
  MatrixXd result(K.rows(), K.cols());
  const Index first_sine = inverse.orders_begin / N;
  if (first_sine > 0) result.topRows(r).noalias() = seen(inverse.diagonal, 0) * K.topRows(r);
  for (Index s = first_sine; s * r < K.rows(); s += 2) {
    const Index c = s + 1;
    const auto of_sine = K.middleRows(s * r, r);
    const auto of_cosine = K.middleRows(c * r, r);
    auto sine = result.middleRows(s * r, r);
    auto cosine = result.middleRows(c * r, r);
    sine.noalias() = seen(inverse.diagonal, s * N) * of_sine;
    sine.noalias() += seen(inverse.coupling, s * N) * of_cosine;
    cosine.noalias() = seen(inverse.diagonal, c * N) * of_cosine;
    cosine.noalias() += seen(inverse.coupling, c * N) * of_sine;
  }
  return result;
}

/// Over (y_e, z): [D_e, T_eᵀ K; −T_e, 1 + T D_h⁻¹ Tᵀ K].
MatrixXd few_equations(const CondensedJacobian& parts, const PairedDiagonal& inverse,
                       const Unknowns& kept) {
  const MatrixXd& T = parts.contact->of_modes;
  const MatrixXd& K = parts.contact->jacobian;
  const Index N = T.cols();
  const Index r = T.rows();
  const auto n_kept = static_cast<Index>(kept.size());
  MatrixXd matrix = MatrixXd::Zero(n_kept + K.rows(), n_kept + K.rows());
  for (Index e = 0; e < n_kept; ++e) {
    const Index unknown = kept[static_cast<std::size_t>(e)];
    const Index block = unknown / N;
    const auto shape = T.col(unknown % N);
    matrix.row(e).tail(K.cols()).noalias() = shape.transpose() * K.middleRows(block * r, r);
    matrix.block(n_kept + block * r, e, r, 1) = -shape;
    matrix(e, e) = parts.own.diagonal[unknown];
    if (unknown < parts.own.orders_begin) continue;
    const bool is_sine = (unknown - parts.own.orders_begin) / N % 2 == 0;
    const Index other = is_sine ? unknown + N : unknown - N;
    const auto partner = std::ranges::lower_bound(kept, other);
    matrix(e, std::distance(kept.begin(), partner)) = parts.own.coupling[unknown];
  }
  matrix.bottomRightCorner(K.rows(), K.cols()) = compliance_times_contact(parts, inverse);
  matrix.diagonal().tail(K.rows()).array() += 1.0;
  return matrix;
}

MatrixXd rows_of(const MatrixXd& B, const Unknowns& rows) { return B(rows, Eigen::all); }

/// What few equations tell of all unknowns themselves: those kept, and the last.
void put_in(const MatrixXd& few, const Unknowns& kept, MatrixXd& all) {
  for (std::size_t e = 0; e < kept.size(); ++e) all.row(kept[e]) = few.row(static_cast<Index>(e));
  all.bottomRows(1) = few.bottomRows(1);
}

}  // namespace

contact::LuFactors BorderedFactors::factorised(const BalanceEvaluation& at, const BranchVector& row,
                                               const Scaling& scaling,
                                               std::optional<Condensed>& condensed) {
  const CondensedJacobian* parts = at.jacobian.parts();
  if (parts == nullptr) return contact::LuFactors(bordered(at, row, scaling));
  const double scale = scaling.x / scaling.residual;
  PairedDiagonal inverse = parts->own.inverse_without(parts->resonant);
  const Unknowns& kept = parts->resonant;
  const auto n_kept = static_cast<Index>(kept.size());
  const Index n = n_kept + n_few(*parts);
  MatrixXd matrix(n + 1, n + 1);
  matrix.topLeftCorner(n, n) = few_equations(*parts, inverse, kept);
  matrix.topRows(n_kept) *= scale;
  inverse.diagonal /= scale;
  inverse.coupling /= scale;
  VectorXd by_parameter = at.parameter_derivative * (scaling.parameter / scaling.residual);
  // Column of the parameter, and the row.
  const MatrixXd moved = inverse.times(by_parameter);
  const MatrixXd held = inverse.transposed().times(row.x);
  matrix.col(n).head(n_kept) = by_parameter(kept);
  matrix.col(n).segment(n_kept, n_few(*parts)) = to_few(*parts, moved);
  matrix.row(n).head(n_kept) = row.x(kept).transpose();
  matrix.row(n).segment(n_kept, n_few(*parts)).noalias() =
      -scale * (to_few(*parts, held).transpose() * parts->contact->jacobian);
  matrix(n, n) = row.parameter - row.x.dot(moved.col(0));
  const VectorXd sizes = matrix.cwiseAbs().rowwise().maxCoeff();
  const VectorXd of_rows = (sizes.array() > 0.0).select(sizes, 1.0);
  matrix = of_rows.cwiseInverse().asDiagonal() * matrix;
  condensed = Condensed{*parts, std::move(inverse), scale, std::move(by_parameter), row, of_rows};
  return contact::LuFactors(matrix);
}

BorderedFactors::BorderedFactors(const BalanceEvaluation& at, const BranchVector& row,
                                 const Scaling& scaling)
    : factors_(factorised(at, row, scaling, condensed_)) {}

MatrixXd BorderedFactors::solve(const Eigen::Ref<const MatrixXd>& B) const {
  if (!condensed_) return factors_.solve(B);
  const auto& [parts, inverse, scale, by_parameter, row, of_rows] = *condensed_;
  const Unknowns& kept = parts.resonant;
  const auto n_kept = static_cast<Index>(kept.size());
  const Index size = B.rows() - 1;
  const MatrixXd f = B.topRows(size);
  const MatrixXd alone = inverse.times(f);  // D_h⁻¹ f_h
  MatrixXd right(of_rows.size(), B.cols());
  right.topRows(n_kept) = rows_of(f, kept);
  right.middleRows(n_kept, n_few(parts)) = to_few(parts, alone);
  right.bottomRows(1) = B.bottomRows(1) - row.x.transpose() * alone;
  const MatrixXd few = factors_.solve(of_rows.cwiseInverse().asDiagonal() * right);
  const MatrixXd force = parts.contact->jacobian * few.middleRows(n_kept, n_few(parts));
  MatrixXd result(B.rows(), B.cols());
  result.topRows(size) =
      alone - inverse.times(scale * to_modes(parts, force) + by_parameter * few.bottomRows(1));
  put_in(few, kept, result);
  return result;
}

MatrixXd BorderedFactors::solve_transposed(const Eigen::Ref<const MatrixXd>& B) const {
  if (!condensed_) return factors_.solve_transposed(B);
  const auto& [parts, inverse, scale, by_parameter, row, of_rows] = *condensed_;
  const Unknowns& kept = parts.resonant;
  const auto n_kept = static_cast<Index>(kept.size());
  const Index size = B.rows() - 1;
  const PairedDiagonal turned = inverse.transposed();
  const MatrixXd g = B.topRows(size);
  const MatrixXd alone = turned.times(g);  // D_h⁻ᵀ g_h
  MatrixXd right(of_rows.size(), B.cols());
  right.topRows(n_kept) = rows_of(g, kept);
  right.middleRows(n_kept, n_few(parts)).noalias() =
      -scale * (parts.contact->jacobian.transpose() * to_few(parts, alone));
  right.bottomRows(1) = B.bottomRows(1) - by_parameter.transpose() * alone;
  const MatrixXd few = of_rows.cwiseInverse().asDiagonal() * factors_.solve_transposed(right);
  MatrixXd result(B.rows(), B.cols());
  result.topRows(size) =
      alone + turned.times(to_modes(parts, few.middleRows(n_kept, n_few(parts))) -
                           row.x * few.bottomRows(1));
  put_in(few, kept, result);
  return result;
}

namespace {

/// With a row and a column that change nothing.
BorderedFactors factors_alone(const BalanceJacobian& jacobian, Index size) {
  BalanceEvaluation at;
  at.jacobian = jacobian;
  at.parameter_derivative = VectorXd::Zero(size);
  return {at, {VectorXd::Zero(size), 1.0}, {}};
}

}  // namespace

BranchVector newton_step(const BalanceEvaluation& at, const BranchVector& row,
                         const Scaling& scaling) {
  const Eigen::Index n = at.residual.size();
  VectorXd right(n + 1);
  right << -at.residual / scaling.residual, 0.0;
  const VectorXd y = BorderedFactors(at, row, scaling).solve(right);
  return {y.head(n) * scaling.x, y[n] * scaling.parameter};
}

VectorXd solved(const BalanceJacobian& jacobian, const VectorXd& b) {
  if (jacobian.parts() == nullptr) return contact::solved(jacobian.dense(), b);
  VectorXd right(b.size() + 1);
  right << b, 0.0;
  return factors_alone(jacobian, b.size()).solve(right).topRows(b.size());
}

double sign_of_determinant(const BalanceJacobian& jacobian) {
  const CondensedJacobian* parts = jacobian.parts();
  if (parts == nullptr) return contact::LuFactors(jacobian.dense()).sign_of_determinant();
  return factors_alone(jacobian, parts->own.diagonal.size()).sign_of_determinant();
}

MatrixXd schur_complement(const BalanceJacobian& jacobian, const Unknowns& low) {
  Unknowns high;
  MatrixXd whole;
  Unknowns first = low;  // places of those that stay
  const CondensedJacobian* parts = jacobian.parts();
  Unknowns kept;
  if (parts != nullptr) std::ranges::set_union(low, parts->resonant, std::back_inserter(kept));
  const auto few = [&] { return static_cast<Index>(kept.size()) + n_few(*parts); };
  if (parts != nullptr && few() < parts->own.diagonal.size()) {
    whole = few_equations(*parts, parts->own.inverse_without(kept), kept);
    for (Index& unknown : first) {
      unknown = std::distance(kept.begin(), std::ranges::lower_bound(kept, unknown));
    }
  } else {
    whole = jacobian.dense();
  }
  for (Index i = 0; i < whole.rows(); ++i) {
    if (!std::ranges::binary_search(first, i)) high.push_back(i);
  }
  MatrixXd result = whole(first, first);
  if (high.empty()) return result;
  result -= whole(first, high) * contact::solved(whole(high, high), MatrixXd(whole(high, first)));
  return result;
}

}  // namespace microslip::solver
