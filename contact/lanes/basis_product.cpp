#include "contact/lanes/basis_product.hpp"

#include <cstddef>

#include "contact/lanes/product_kernels.hpp"

namespace microslip::contact {
namespace {

constexpr Eigen::Index most_rows = 256;  // that stay in the cache

}  // namespace

void BasisProduct::start(Eigen::Index n_basis, Eigen::Index n_columns) {
  n_basis_ = n_basis;
  n_columns_ = n_columns;
  stride_ = n_columns + static_cast<Eigen::Index>(sampled::product_slack);
  n_rows_ = 0;
  basis_.resize(static_cast<std::size_t>(most_rows * n_basis_));
  rows_.resize(static_cast<std::size_t>(most_rows * stride_));
  sum_.assign(static_cast<std::size_t>(n_basis_ * stride_), 0.0);
}

Eigen::Map<Eigen::RowVectorXd> BasisProduct::add(const Eigen::VectorXd& basis, double weight) {
  if (n_rows_ == most_rows) multiply();
  Eigen::Map<Eigen::VectorXd>(basis_.data() + n_rows_ * n_basis_, n_basis_) = weight * basis;
  return {rows_.data() + n_rows_++ * stride_, n_columns_};
}

void BasisProduct::multiply() {
  const auto size = [](Eigen::Index n) { return static_cast<std::size_t>(n); };
  sampled::product_kernels().product(
      {size(n_basis_), size(n_columns_), size(n_basis_), size(stride_)}, size(n_rows_),
      basis_.data(), rows_.data(), sum_.data());
  n_rows_ = 0;
}

BasisProduct::Rows BasisProduct::sum() {
  multiply();
  return Eigen::Map<const Rows, 0, Eigen::OuterStride<>>(sum_.data(), n_basis_, n_columns_,
                                                         Eigen::OuterStride<>(stride_));
}

}  // namespace microslip::contact
