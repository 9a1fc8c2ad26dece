#include "contact/numerics/hessenberg_problem.hpp"

#include <cstddef>
#include <utility>

#include "contact/numerics/lapack.hpp"

namespace microslip::contact {

HessenbergProblem::HessenbergProblem(Eigen::MatrixXd A)
    : n_(static_cast<int>(A.rows())),
      reduced_(std::move(A)),
      scale_(n_),
      tau_(n_),
      real_(n_),
      imaginary_(n_) {}

bool HessenbergProblem::find_values() {
  int info = 0;
  dgebal_("S", &n_, reduced_.data(), &n_, &low_, &high_, scale_.data(), &info);
  const int n_work = 34 * n_;  // blocks of 32
  Eigen::VectorXd work(n_work);
  dgehrd_(&n_, &low_, &high_, reduced_.data(), &n_, tau_.data(), work.data(), &n_work, &info);
  hessenberg_ = reduced_.triangularView<Eigen::Upper>();
  hessenberg_.diagonal(-1) = reduced_.diagonal(-1);
  Eigen::MatrixXd swept = hessenberg_;
  const int no = 0;
  const int one = 1;
  dlahqr_(&no, &no, &n_, &low_, &high_, swept.data(), &n_, real_.data(), imaginary_.data(), &one,
          &n_, nullptr, &one, &info);
  return info == 0;
}

Eigen::VectorXcd HessenbergProblem::values() const {
  Eigen::VectorXcd values(n_);
  values.real() = real_;
  values.imag() = imaginary_;
  return values;
}

bool HessenbergProblem::find_vectors(const std::vector<int>& chosen, Eigen::MatrixXcd& vectors) {
  vectors = Eigen::MatrixXcd::Zero(n_, n_);
  Eigen::MatrixXd columns(n_, n_columns(chosen));
  if (columns.cols() == 0) return true;
  if (!find_columns(chosen, columns)) return false;
  spread(chosen, columns, vectors);
  return true;
}

int HessenbergProblem::n_columns(const std::vector<int>& chosen) const {
  int n = 0;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const bool of_pair = imaginary_[static_cast<Eigen::Index>(i)] != 0.0;
    n += chosen[i] == 0 ? 0 : (of_pair ? 2 : 1);
  }
  return n;
}

/// Of pairs the real and the imaginary part, in the order of the values.
bool HessenbergProblem::find_columns(std::vector<int> chosen, Eigen::MatrixXd& columns) {
  const auto n_columns = static_cast<int>(columns.cols());
  std::vector<int> failed(static_cast<std::size_t>(n_columns));
  Eigen::VectorXd work(n_ * (n_ + 2));
  Eigen::VectorXd apart = real_;  // where values are close
  const int one = 1;
  int found = 0;
  int info = 0;
  dhsein_("R", "N", "N", chosen.data(), &n_, hessenberg_.data(), &n_, apart.data(),
          imaginary_.data(), nullptr, &one, columns.data(), &n_, &n_columns, &found, work.data(),
          nullptr, failed.data(), &info);
  if (info != 0 || found != n_columns) return false;
  const auto n_work = static_cast<int>(work.size());
  dormhr_("L", "N", &n_, &n_columns, &low_, &high_, reduced_.data(), &n_, tau_.data(),
          columns.data(), &n_, work.data(), &n_work, &info);
  dgebak_("S", "R", &n_, &low_, &high_, scale_.data(), &n_columns, columns.data(), &n_, &info);
  return true;
}

/// From columns to the places of their values.
void HessenbergProblem::spread(const std::vector<int>& chosen, const Eigen::MatrixXd& columns,
                               Eigen::MatrixXcd& vectors) const {
  Eigen::Index column = 0;
  for (Eigen::Index i = 0; i < n_; ++i) {
    if (chosen[static_cast<std::size_t>(i)] == 0) continue;
    vectors.col(i).real() = columns.col(column++);
    if (imaginary_[i] != 0.0) {
      vectors.col(i).imag() = columns.col(column++);
      vectors.col(i + 1) = vectors.col(i).conjugate().normalized();
    }
    vectors.col(i).normalize();
  }
}

}  // namespace microslip::contact
