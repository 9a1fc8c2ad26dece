#include "solver/balance/balance_jacobian.hpp"

namespace microslip::solver {

Eigen::MatrixXd PairedDiagonal::times(const Eigen::MatrixXd& B) const {
  const Eigen::Index N = n_modes;
  Eigen::MatrixXd result = diagonal.asDiagonal() * B;
  for (Eigen::Index s = orders_begin; s < diagonal.size(); s += 2 * N) {
    const Eigen::Index c = s + N;
    result.middleRows(s, N) += coupling.segment(s, N).asDiagonal() * B.middleRows(c, N);
    result.middleRows(c, N) += coupling.segment(c, N).asDiagonal() * B.middleRows(s, N);
  }
  return result;
}

void PairedDiagonal::add_to(Eigen::MatrixXd& matrix) const {
  const Eigen::Index N = n_modes;
  matrix.diagonal() += diagonal;
  for (Eigen::Index s = orders_begin; s < diagonal.size(); s += 2 * N) {
    matrix.block(s, s + N, N, N).diagonal() += coupling.segment(s, N);
    matrix.block(s + N, s, N, N).diagonal() += coupling.segment(s + N, N);
  }
}

PairedDiagonal PairedDiagonal::transposed() const {
  PairedDiagonal result = *this;
  const Eigen::Index N = n_modes;
  for (Eigen::Index s = orders_begin; s < diagonal.size(); s += 2 * N) {
    result.coupling.segment(s, N).swap(result.coupling.segment(s + N, N));
  }
  return result;
}

PairedDiagonal PairedDiagonal::inverse_without(const std::vector<Eigen::Index>& rows) const {
  const Eigen::Index N = n_modes;
  PairedDiagonal result{N, orders_begin, Eigen::VectorXd::Zero(diagonal.size()),
                        Eigen::VectorXd::Zero(diagonal.size())};
  std::vector<char> is_left_out(static_cast<std::size_t>(diagonal.size()));
  for (const Eigen::Index row : rows) is_left_out[static_cast<std::size_t>(row)] = 1;
  for (Eigen::Index i = 0; i < orders_begin; ++i) {
    if (is_left_out[static_cast<std::size_t>(i)] == 0) result.diagonal[i] = 1.0 / diagonal[i];
  }
  for (Eigen::Index block = orders_begin; block < diagonal.size(); block += 2 * N) {
    for (Eigen::Index s = block; s < block + N; ++s) {
      const Eigen::Index c = s + N;
      if (is_left_out[static_cast<std::size_t>(s)] != 0) continue;
      const double determinant = diagonal[s] * diagonal[c] - coupling[s] * coupling[c];
      result.diagonal[s] = diagonal[c] / determinant;
      result.diagonal[c] = diagonal[s] / determinant;
      result.coupling[s] = -coupling[s] / determinant;
      result.coupling[c] = -coupling[c] / determinant;
    }
  }
  return result;
}

bool BalanceJacobian::all_finite() const {
  if (!parts_) return dense_.allFinite();
  return parts_->own.diagonal.allFinite() && parts_->own.coupling.allFinite() &&
         parts_->contact->jacobian.allFinite();
}

const Eigen::MatrixXd& BalanceJacobian::dense() const {
  if (!parts_ || dense_.size() > 0) return dense_;
  dense_ = parts_->contact->expanded();
  parts_->own.add_to(dense_);
  return dense_;
}

}  // namespace microslip::solver
