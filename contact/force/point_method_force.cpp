#include "contact/force/point_method_force.hpp"

#include <optional>
#include <utility>

#include "contact/force/point_projection.hpp"

namespace microslip::contact {
namespace {

RestingPoints at_rest(Eigen::VectorXd weights,
                      const std::vector<std::shared_ptr<const PointMethod>>& methods) {
  const auto n = static_cast<Eigen::Index>(methods.size());
  RestingPoints points{std::move(weights), Eigen::VectorXd(n), Eigen::MatrixX3d(n, 3), {}};
  for (Eigen::Index i = 0; i < n; ++i) {
    const PointMethod& method = *methods[static_cast<std::size_t>(i)];
    points.reference_load[i] = method.reference_load();
    points.stuck_stiffness.row(i) = method.stuck_stiffness().transpose();
    points.ranges.push_back(method.linear_range());
  }
  return points;
}

}  // namespace

PointMethodForce::PointMethodForce(Eigen::VectorXd weights,
                                   std::vector<std::shared_ptr<const PointMethod>> methods,
                                   ModalShapes shapes)
    : PointwiseForce(at_rest(std::move(weights), methods), std::move(shapes)),
      methods_(std::move(methods)),
      shape_{&this->shapes().u, &this->shapes().v} {
  if (this->shapes().w.size() > 0) shape_.push_back(&this->shapes().w);
}

ForceAndJacobian PointMethodForce::awake_force(double frequency, const Asked& asked,
                                               PointwiseWork& work) const {
  const int n_harmonics = work.motion.n_harmonics();
  if (asked.n_harmonics > n_harmonics) return wider_force(frequency, asked.n_harmonics, work);
  PointProjection sum;
  sum.start(shape_, n_harmonics, asked.rows);
  Harmonics at;
  PointTraction traction;
  for (const Eigen::Index i : work.sleep.awake()) {
    const PointMethod& method = *methods_[static_cast<std::size_t>(i)];
    work.motion.copy(i, at);
    traction.defect = 0.0;  // a method that is exact does not mention it
    if (asked.rows.empty()) {
      method.traction_alone(at, frequency, traction);
    } else {
      method.traction(at, frequency, traction);
    }
    sum.add(i, points().weights[i], points().reference_load[i], traction);
    keep(i, {traction.regime, traction.period}, work);
  }
  return sum.take();
}

void PointMethodForce::find_states(double frequency, PointwiseWork& work) const {
  Harmonics at;
  PointTraction traction;
  for (const Eigen::Index i : work.sleep.awake()) {
    work.motion.copy(i, at);
    methods_[static_cast<std::size_t>(i)]->states(at, frequency, traction);
    keep(i, {traction.regime, traction.period}, work);
  }
}

/// Harmonics that the motion does not have: the force alone.
ForceAndJacobian PointMethodForce::wider_force(double frequency, int n_harmonics,
                                               const PointwiseWork& work) const {
  ForceAndJacobian result{Harmonics(n_harmonics, n_modes()), {}, {}};
  Harmonics at;
  for (const Eigen::Index i : work.sleep.awake()) {
    work.motion.copy(i, at);
    Harmonics force =
        methods_[static_cast<std::size_t>(i)]->force_up_to(at, frequency, n_harmonics);
    force.rows()(0, 1) -= points().reference_load[i];
    for (std::size_t s = 0; s < shape_.size(); ++s) {
      result.force.rows() +=
          points().weights[i] * force.rows().col(static_cast<Eigen::Index>(s)) * shape_[s]->row(i);
    }
  }
  return result;
}

void PointMethodForce::add_cycles(std::span<const Eigen::Index> points, double frequency,
                                  PointwiseWork& work, ReportSum& sum) const {
  Harmonics at;
  for (const Eigen::Index i : points) {
    work.motion.copy(i, at);
    const PointHistory history =
        methods_[static_cast<std::size_t>(i)]->history(at, frequency, {}, 0);
    sum.add(history.segments, history.dissipated_energy, this->points().weights[i]);
  }
}

}  // namespace microslip::contact
