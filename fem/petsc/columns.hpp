/// @file
/// Tall matrices spread over the ranks by rows: plain Eigen columns that hold the rows of this
/// rank. All functions are collective over PETSC_COMM_WORLD.
#pragma once

#include <Eigen/Core>

#include "fem/petsc/handle.hpp"

namespace microslip::fem {

/// A Vec that shares the memory of one local column; the column must outlive it.
[[nodiscard]] VecHandle view_column(Eigen::Ref<Eigen::VectorXd> local);

/// A X.
[[nodiscard]] Eigen::MatrixXd multiply(Mat A, const Eigen::MatrixXd& X);

/// XᵀY, complete on every rank.
[[nodiscard]] Eigen::MatrixXd inner_products(const Eigen::MatrixXd& X, const Eigen::MatrixXd& Y);

/// Euclidean norm of each column.
[[nodiscard]] Eigen::VectorXd column_norms(const Eigen::MatrixXd& X);

/// Columns that span what X spans, with XᵀMX = I. X must have full rank.
[[nodiscard]] Eigen::MatrixXd mass_orthonormal(Mat M, const Eigen::MatrixXd& X);

}  // namespace microslip::fem
