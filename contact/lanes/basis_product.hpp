/// @file
/// A sum of outer products Σ w b fᵀ of the Fourier functions b of many instants with rows f: the
/// rows are gathered and multiplied at once, which vectors of the widest instruction set do.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace microslip::contact {

class BasisProduct {
 public:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// Zero. @param n_basis, n_columns  lengths of b and f.
  void start(Eigen::Index n_basis, Eigen::Index n_columns);
  /// @return f, to be written before the next call.
  [[nodiscard]] Eigen::Map<Eigen::RowVectorXd> add(const Eigen::VectorXd& basis, double weight);
  /// n_basis × n_columns.
  [[nodiscard]] Rows sum();

 private:
  void multiply();

  Eigen::Index n_basis_ = 0;
  Eigen::Index n_columns_ = 0;
  Eigen::Index stride_ = 0;  // of f and of the sum
  Eigen::Index n_rows_ = 0;
  std::vector<double> basis_;
  std::vector<double> rows_;
  std::vector<double> sum_;
};

}  // namespace microslip::contact
