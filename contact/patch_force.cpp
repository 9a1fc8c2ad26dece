#include "contact/patch_force.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact/cycle_report.hpp"
#include "contact/friction_cycle.hpp"
#include "contact/point_motions.hpp"

namespace microslip::contact {
namespace {

void require_shape(const char* name, const Eigen::MatrixXd& shape, Eigen::Index rows,
                   Eigen::Index columns) {
  if (shape.rows() != rows || shape.cols() != columns) {
    throw std::invalid_argument("PatchForce: mode shapes " + std::string(name) + " are " +
                                std::to_string(shape.rows()) + " x " +
                                std::to_string(shape.cols()) + ", expected " +
                                std::to_string(rows) + " x " + std::to_string(columns));
  }
  if (!shape.allFinite()) {
    throw std::invalid_argument("PatchForce: mode shapes " + std::string(name) +
                                " have a value that is not finite");
  }
}

}  // namespace

PatchForce::PatchForce(ContactPatch patch, ModalShapes shapes)
    : patch_(std::move(patch)), shapes_(std::move(shapes)) {
  require_shape("u", shapes_.u, patch_.n_points(), shapes_.u.cols());
  require_shape("v", shapes_.v, patch_.n_points(), shapes_.u.cols());
}

Eigen::Index PatchForce::n_modes() const { return shapes_.u.cols(); }

ForceAndJacobian PatchForce::evaluate(const Harmonics& q, double /*frequency*/) const {
  const Eigen::Index N = n_modes();
  const std::vector<PointMotion> motions = point_motions(shapes_, q);
  ForceAndJacobian result{Harmonics(1, N), Eigen::MatrixXd::Zero(3 * N, 3 * N),
                          Eigen::VectorXd::Zero(3 * N)};
  for (std::size_t point = 0; point < motions.size(); ++point) {
    const auto i = static_cast<Eigen::Index>(point);
    const FrictionCycle cycle = friction_cycle(patch_.points()[point], motions[point]);
    const double w = patch_.weights()[i];
    Eigen::MatrixXd phi = Eigen::MatrixXd::Zero(6, 3 * N);
    for (Eigen::Index k = 0; k < 3; ++k) {
      phi.block(k, k * N, 1, N) = shapes_.u.row(i);
      phi.block(3 + k, k * N, 1, N) = shapes_.v.row(i);
    }
    Eigen::Matrix<double, 6, 1> f;
    f << cycle.friction.mean, cycle.friction.sin, cycle.friction.cos,
        cycle.normal.mean - std::max(patch_.points()[point].preload, 0.0), cycle.normal.sin,
        cycle.normal.cos;
    result.force.vector() += w * phi.transpose() * f;
    result.jacobian += w * phi.transpose() * cycle.jacobian * phi;
  }
  return result;
}

CycleReport PatchForce::report(const Harmonics& q, double /*frequency*/) const {
  return cycle_report(patch_, point_motions(shapes_, q));
}

Eigen::MatrixXd PatchForce::stuck_stiffness() const {
  Eigen::VectorXd k_u(patch_.n_points());
  Eigen::VectorXd k_v(patch_.n_points());
  for (Eigen::Index i = 0; i < patch_.n_points(); ++i) {
    const PointParameters& point = patch_.points()[static_cast<std::size_t>(i)];
    const double weight = patch_.weights()[i];
    k_u[i] = point.friction_coefficient > 0.0 ? weight * point.tangential_stiffness : 0.0;
    k_v[i] = weight * point.normal_stiffness;
  }
  return shapes_.u.transpose() * k_u.asDiagonal() * shapes_.u +
         shapes_.v.transpose() * k_v.asDiagonal() * shapes_.v;
}

}  // namespace microslip::contact
