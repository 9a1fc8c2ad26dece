#include "contact/patch/point_motions.hpp"

#include <stdexcept>
#include <string>

#include "contact/point/point_method.hpp"

namespace microslip::contact {

void require_single_harmonic(const Harmonics& q, Eigen::Index n_modes) {
  if (q.rows().rows() != 3 || q.n_signals() != n_modes) {
    throw std::invalid_argument(
        "friction patch: motion with n_harmonics = " + std::to_string(q.n_harmonics()) + " of " +
        std::to_string(q.n_signals()) + " modes, expected 1 of " + std::to_string(n_modes));
  }
}

void require_harmonics(const Harmonics& q, Eigen::Index n_modes) {
  if (q.n_harmonics() < 1 || q.n_signals() != n_modes) {
    throw std::invalid_argument(
        "friction patch: motion with n_harmonics = " + std::to_string(q.n_harmonics()) + " of " +
        std::to_string(q.n_signals()) + " modes, expected at least 1 of " +
        std::to_string(n_modes));
  }
}

std::vector<PointMotion> point_motions(const ModalShapes& shapes, const Harmonics& q) {
  require_single_harmonic(q, shapes.u.cols());
  const Eigen::MatrixXd u = shapes.u * q.rows().transpose();
  const Eigen::MatrixXd v = shapes.v * q.rows().transpose();
  std::vector<PointMotion> motions(static_cast<std::size_t>(u.rows()));
  for (std::size_t point = 0; point < motions.size(); ++point) {
    const auto i = static_cast<Eigen::Index>(point);
    motions[point] = {u(i, 0), u(i, 1), u(i, 2), v(i, 0), v(i, 1), v(i, 2)};
  }
  return motions;
}

std::vector<Harmonics> general_motions(const ModalShapes& shapes, const Harmonics& q) {
  require_harmonics(q, shapes.u.cols());
  const Eigen::MatrixXd u = shapes.u * q.rows().transpose();
  const Eigen::MatrixXd v = shapes.v * q.rows().transpose();
  const Eigen::MatrixXd w = shapes.w.size() > 0 ? Eigen::MatrixXd(shapes.w * q.rows().transpose())
                                                : Eigen::MatrixXd::Zero(u.rows(), u.cols());
  std::vector<Harmonics> motions;
  motions.reserve(static_cast<std::size_t>(u.rows()));
  for (Eigen::Index i = 0; i < u.rows(); ++i) {
    Harmonics& motion = motions.emplace_back(q.n_harmonics(), n_point_signals);
    motion.rows().col(0) = u.row(i).transpose();
    motion.rows().col(1) = v.row(i).transpose();
    motion.rows().col(2) = w.row(i).transpose();
  }
  return motions;
}

}  // namespace microslip::contact
