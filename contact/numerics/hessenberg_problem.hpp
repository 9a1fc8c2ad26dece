/// @file
/// Eigenvalues of a real matrix by its Hessenberg form, and vectors of some of them: a vector costs
/// n² operations there, all of them as much as the values. By LAPACK; not to be called without.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace microslip::contact {

class HessenbergProblem {
 public:
  /// @param A  square and finite.
  explicit HessenbergProblem(Eigen::MatrixXd A);

  /// By single double-shift sweeps: what LAPACK chooses takes twice the time from 76 rows on.
  /// @return false: they do not converge.
  [[nodiscard]] bool find_values();
  /// After find_values(); conjugates one behind the other.
  [[nodiscard]] Eigen::VectorXcd values() const;

  /// By inverse iteration.
  /// @param chosen   a number per value, 1: wanted; of a pair its first, its conjugate comes along.
  /// @param vectors  n × n: wanted ones with ‖·‖ = 1, others 0.
  /// @return false: one does not converge.
  [[nodiscard]] bool find_vectors(const std::vector<int>& chosen, Eigen::MatrixXcd& vectors);

 private:
  [[nodiscard]] int n_columns(const std::vector<int>& chosen) const;
  [[nodiscard]] bool find_columns(std::vector<int> chosen, Eigen::MatrixXd& columns);
  void spread(const std::vector<int>& chosen, const Eigen::MatrixXd& columns,
              Eigen::MatrixXcd& vectors) const;

  int n_;
  Eigen::MatrixXd reduced_;  ///< H, and below it the reflectors of Q
  Eigen::MatrixXd hessenberg_;
  Eigen::VectorXd scale_;
  Eigen::VectorXd tau_;
  Eigen::VectorXd real_;
  Eigen::VectorXd imaginary_;
  int low_ = 1;
  int high_ = 1;
};

}  // namespace microslip::contact
