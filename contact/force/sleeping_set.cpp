#include "contact/force/sleeping_set.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "contact/patch/point_motions.hpp"
#include "contact/point/point_method.hpp"

namespace microslip::contact {
namespace {

// More sums than this cost more memory than they save time; smaller ones are added up as fast as
// they are looked up.
constexpr Eigen::Index largest_n_groups = 256;
constexpr Eigen::Index smallest_group = 16;

/// What a spread moves every point at most along one direction [m], n_points.
Eigen::VectorXd reach_of(const Eigen::MatrixXd& shape, const MotionSet& motions) {
  if (shape.size() == 0 || motions.spread.size() == 0) return Eigen::VectorXd::Zero(shape.rows());
  return (shape * motions.spread).cwiseAbs().rowwise().sum();
}

Eigen::Index n_groups(Eigen::Index n, Eigen::Index group) { return (n + group - 1) / group; }

}  // namespace

void PatchMotion::set(const ModalShapes& shapes, const Harmonics& q) {
  require_harmonics(q, shapes.u.cols());
  u.noalias() = shapes.u * q.rows().transpose();
  v.noalias() = shapes.v * q.rows().transpose();
  if (shapes.w.size() > 0) w.noalias() = shapes.w * q.rows().transpose();
}

PointRows PatchMotion::of(Eigen::Index point) const {
  const Eigen::Index at = point * u.cols();
  return {u.data() + at, v.data() + at, w.size() > 0 ? w.data() + at : nullptr};
}

void PatchMotion::copy(Eigen::Index point, Harmonics& result) const {
  if (result.rows().rows() != u.cols() || result.n_signals() != n_point_signals) {
    result = Harmonics(static_cast<int>(u.cols() / 2), n_point_signals);
  }
  result.rows().col(0) = u.row(point).transpose();
  result.rows().col(1) = v.row(point).transpose();
  if (w.size() > 0) result.rows().col(2) = w.row(point).transpose();
}

SleepingSet::SleepingSet(const RestingPoints& points, const ModalShapes& shapes) {
  const Eigen::Index n = points.weights.size();
  group_ = std::max(smallest_group, (n + largest_n_groups - 1) / largest_n_groups);
  state_.assign(points.ranges.size(), SleepState::awake);
  awake_.resize(points.ranges.size());
  std::iota(awake_.begin(), awake_.end(), Eigen::Index{0});
  part_.resize(static_cast<std::size_t>(n_groups(n, group_)));
  rows_.resize(n_point_signals * group_, shapes.u.cols());
}

void SleepingSet::decide(const PatchMotion& motion, double frequency, const RestingPoints& points) {
  const auto& ranges = points.ranges;
  if (table_.n_harmonics != motion.n_harmonics()) table_ = PhaseTable(motion.n_harmonics());
  next_.resize(ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    next_[i] =
        ranges[i].has_value()
            ? sleep_state(*ranges[i], motion.of(static_cast<Eigen::Index>(i)), table_, frequency)
            : SleepState::awake;
  }
}

void SleepingSet::look_at(const PatchMotion& motion, double frequency, const RestingPoints& points,
                          const ModalShapes& shapes) {
  decide(motion, frequency, points);
  if (next_ == state_) return;
  const auto n = static_cast<Eigen::Index>(next_.size());
  std::swap(state_, next_);  // next_ is what was
  sum_.stiffness.setZero(shapes.u.cols(), shapes.u.cols());
  sum_.mean.setZero(shapes.u.cols());
  for (Eigen::Index g = 0; g < n_groups(n, group_); ++g) {
    const Eigen::Index begin = g * group_;
    const Eigen::Index end = std::min(n, begin + group_);
    if (!std::equal(state_.begin() + begin, state_.begin() + end, next_.begin() + begin))
      add_up(g, points, shapes);
    const SleepingPart& part = part_[static_cast<std::size_t>(g)];
    if (part.mean.size() == 0) continue;
    sum_.stiffness += part.stiffness;
    sum_.mean += part.mean;
  }
  awake_.clear();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (state_[static_cast<std::size_t>(i)] == SleepState::awake) awake_.push_back(i);
  }
}

void SleepingSet::add_up(Eigen::Index group, const RestingPoints& points,
                         const ModalShapes& shapes) {
  const Eigen::Index begin = group * group_;
  const Eigen::Index end = std::min(static_cast<Eigen::Index>(state_.size()), begin + group_);
  SleepingPart& part = part_[static_cast<std::size_t>(group)];
  part.stiffness.setZero(shapes.u.cols(), shapes.u.cols());
  part.mean.setZero(shapes.u.cols());
  n_rows_ = 0;
  for (Eigen::Index i = begin; i < end; ++i) add_point(i, points, shapes, part);
  if (n_rows_ == 0) return;
  part.stiffness.selfadjointView<Eigen::Lower>().rankUpdate(rows_.topRows(n_rows_).transpose());
  part.stiffness.triangularView<Eigen::StrictlyUpper>() = part.stiffness.transpose();
}

void SleepingSet::add_point(Eigen::Index point, const RestingPoints& points,
                            const ModalShapes& shapes, SleepingPart& part) {
  const auto i = static_cast<std::size_t>(point);
  const double weight = points.weights[point];
  if (state_[i] == SleepState::awake || weight == 0.0) return;
  const double load = state_[i] == SleepState::stuck ? points.ranges[i]->rest_load : 0.0;
  part.mean += weight * (load - points.reference_load[point]) * shapes.v.row(point).transpose();
  if (state_[i] == SleepState::open) return;
  const Eigen::Vector3d& k = points.ranges[i]->stiffness;
  const auto add = [&](double stiffness, const Eigen::MatrixXd& phi) {
    if (stiffness == 0.0 || phi.size() == 0) return;
    rows_.row(n_rows_++) = std::sqrt(weight * stiffness) * phi.row(point);
  };
  add(k[0], shapes.u);
  add(k[1], shapes.v);
  add(k[2], shapes.w);
}

const SleepingPart* SleepingSet::part() const {
  return awake_.size() < state_.size() ? &sum_ : nullptr;
}

LinearState linear_state(const RestingPoints& points, const ModalShapes& shapes,
                         const MotionSet& motions) {
  PatchMotion motion;
  motion.set(shapes, motions.centre);
  const int n_harmonics = motions.centre.n_harmonics();
  const PhaseTable table(n_harmonics);
  const Eigen::VectorXd u = reach_of(shapes.u, motions);
  const Eigen::VectorXd v = reach_of(shapes.v, motions);
  const Eigen::VectorXd w = reach_of(shapes.w, motions);
  bool stuck = true;
  bool open = true;
  for (Eigen::Index i = 0; i < points.weights.size() && (stuck || open); ++i) {
    const std::optional<LinearRange>& range = points.ranges[static_cast<std::size_t>(i)];
    if (points.weights[i] == 0.0) continue;
    if (!range.has_value()) return LinearState::unknown;
    if (range->sticks_linearly && !range->rubs() && range->stiffness[1] == 0.0) continue;
    const Eigen::Vector3d sizes(shapes.u.row(i).norm(), shapes.v.row(i).norm(),
                                w.size() > 0 ? shapes.w.row(i).norm() : 0.0);
    const Eigen::Vector3d reach(u[i], v[i], w.size() > 0 ? w[i] : 0.0);
    LinearReserve reserve = reserve_of_ball(*range, sizes, n_harmonics, motions.radius);
    const LinearReserve beside = reserve_of_reach(*range, reach);
    reserve.stuck += beside.stuck;
    reserve.open += beside.open;
    const SleepState state = sleep_state(*range, motion.of(i), table, 0.0, reserve);
    const bool any_speed = !range->friction.is_rate_dependent();
    stuck = stuck && any_speed && state == SleepState::stuck && range->rest_load >= 0.0;
    open = open && state == SleepState::open && points.reference_load[i] == 0.0;
  }
  if (stuck) return LinearState::stuck;
  return open ? LinearState::free : LinearState::unknown;
}

}  // namespace microslip::contact
