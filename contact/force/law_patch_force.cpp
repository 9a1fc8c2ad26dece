#include "contact/force/law_patch_force.hpp"

#include <optional>
#include <utility>

namespace microslip::contact {
namespace {

/// Of rough surfaces the range tells where they are open alone, nothing of friction.
bool is_frictionless(const std::optional<LinearRange>& range) {
  return range && range->sticks_linearly && !range->rubs();
}

RestingPoints at_rest(Eigen::VectorXd weights,
                      const std::vector<std::shared_ptr<const PointLaw>>& laws) {
  const auto n = static_cast<Eigen::Index>(laws.size());
  RestingPoints points{std::move(weights), Eigen::VectorXd(n), Eigen::MatrixX3d(n, 3), {}, {}};
  for (Eigen::Index i = 0; i < n; ++i) {
    const PointLaw& law = *laws[static_cast<std::size_t>(i)];
    points.load_at_rest[i] = law.load_at_rest();
    points.stuck_stiffness.row(i) = law.stuck_stiffness().transpose();
    points.ranges.push_back(law.linear_range());
    points.frictionless.push_back(is_frictionless(points.ranges.back()));
  }
  return points;
}

}  // namespace

LawPatchForce::LawPatchForce(Eigen::VectorXd weights,
                             std::vector<std::shared_ptr<const PointLaw>> laws, ModalShapes shapes)
    : PointwiseForce(at_rest(std::move(weights), laws), std::move(shapes)),
      laws_(std::move(laws)),
      shape_{&this->shapes().u, &this->shapes().v} {
  if (this->shapes().w.size() > 0) shape_.push_back(&this->shapes().w);
}

ForceAndJacobian LawPatchForce::awake_force(double frequency, const Asked& asked) {
  const int n_harmonics = motion().n_harmonics();
  if (asked.n_harmonics > n_harmonics) return wider_force(frequency, asked.n_harmonics);
  sum_.start(shape_, n_harmonics, asked.rows);
  for (const Eigen::Index i : awake()) {
    const PointLaw& law = *laws_[static_cast<std::size_t>(i)];
    motion().copy(i, point_motion_);
    traction_.defect = 0.0;  // a law that is exact does not mention it
    law.traction(point_motion_, frequency, traction_);
    sum_.add(i, points().weights[i], points().load_at_rest[i], traction_);
    keep(i, {traction_.regime, traction_.period});
  }
  return sum_.take();
}

/// Harmonics that the motion does not have: the force alone.
ForceAndJacobian LawPatchForce::wider_force(double frequency, int n_harmonics) {
  ForceAndJacobian result{Harmonics(n_harmonics, n_modes()), {}, {}};
  for (const Eigen::Index i : awake()) {
    motion().copy(i, point_motion_);
    Harmonics force =
        laws_[static_cast<std::size_t>(i)]->force_up_to(point_motion_, frequency, n_harmonics);
    force.rows()(0, 1) -= points().load_at_rest[i];
    for (std::size_t s = 0; s < shape_.size(); ++s) {
      result.force.rows() +=
          points().weights[i] * force.rows().col(static_cast<Eigen::Index>(s)) * shape_[s]->row(i);
    }
  }
  return result;
}

void LawPatchForce::add_cycles(std::span<const Eigen::Index> points, double frequency,
                               ReportSum& sum) {
  for (const Eigen::Index i : points) {
    motion().copy(i, point_motion_);
    const PointHistory history =
        laws_[static_cast<std::size_t>(i)]->history(point_motion_, frequency, {}, 0);
    sum.add(history.segments, history.dissipated_energy, this->points().weights[i]);
  }
}

}  // namespace microslip::contact
