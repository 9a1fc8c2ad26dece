#include "contact/force/motion_of_points.hpp"

#include <utility>

#include <Eigen/QR>

namespace microslip::contact {
namespace {

constexpr Eigen::Index few_modes = 8;
constexpr double worth_it = 0.5;  // coordinates over modes
constexpr double rounding = 1e-15;

/// Rows of unit length of all shapes, one after the other, transposed; those that vanish left out.
Eigen::MatrixXd directions(const ModalShapes& shapes) {
  Eigen::MatrixXd rows(shapes.u.cols(), shapes.u.rows() + shapes.v.rows() + shapes.w.rows());
  Eigen::Index n = 0;
  for (const Eigen::MatrixXd* shape : {&shapes.u, &shapes.v, &shapes.w}) {
    for (Eigen::Index i = 0; i < shape->rows(); ++i) {
      const double length = shape->row(i).stableNorm();
      if (length > 0.0) rows.col(n++) = shape->row(i).transpose() / length;
    }
  }
  return rows.leftCols(n);
}

}  // namespace

MotionCoordinates motion_of_points(const ModalShapes& shapes) {
  const Eigen::Index n_modes = shapes.u.cols();
  if (n_modes < few_modes) return {};
  const Eigen::MatrixXd rows = directions(shapes);
  if (rows.cols() == 0) return {};
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(rows);
  factors.setThreshold(rounding * static_cast<double>(n_modes));
  const Eigen::Index rank = factors.rank();
  if (static_cast<double>(rank) > worth_it * static_cast<double>(n_modes)) return {};
  Eigen::MatrixXd motion = factors.householderQ() * Eigen::MatrixXd::Identity(n_modes, rank);
  Eigen::MatrixXd of_modes = motion.transpose();
  return {std::move(of_modes), std::move(motion)};
}

}  // namespace microslip::contact
