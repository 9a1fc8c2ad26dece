#include "contact/force/law_patch_force.hpp"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact/force/cycle_report.hpp"
#include "contact/patch/mode_shape_check.hpp"

namespace microslip::contact {
namespace {

void require(bool condition, const std::string& message) {
  if (!condition) {
    throw std::invalid_argument("LawPatchForce: " + message);
  }
}

void add_sleeping(ForceAndJacobian& result, const SleepingPart& part, const Harmonics& q,
                  const std::vector<Eigen::Index>& rows) {
  const Eigen::Index n = part.mean.size();
  result.force.rows().noalias() += q.rows() * part.stiffness;  // symmetric
  result.force.rows().row(0) += part.mean.transpose();
  for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(rows.size()); ++k) {
    result.jacobian.block(k * n, k * n, n, n) += part.stiffness;
  }
}

// The one segment of a point asleep. Without friction the law says whether it calls that slip.
std::optional<CycleSegment> asleep(const std::optional<LinearRange>& range, SleepState state) {
  constexpr double two_pi = 2.0 * std::numbers::pi;
  if (state == SleepState::open) return CycleSegment{ContactState::separated, 0.0, two_pi, 0.0};
  if (state == SleepState::awake || !range->rubs()) return std::nullopt;
  return CycleSegment{ContactState::stick, 0.0, two_pi, 0.0};
}

}  // namespace

LawPatchForce::LawPatchForce(Eigen::VectorXd weights,
                             std::vector<std::shared_ptr<const PointLaw>> laws, ModalShapes shapes)
    : weights_(std::move(weights)), laws_(std::move(laws)), shapes_(std::move(shapes)) {
  const Eigen::Index n = weights_.size();
  require(n >= 1 && static_cast<Eigen::Index>(laws_.size()) == n,
          std::to_string(n) + " weights for " + std::to_string(laws_.size()) + " laws");
  require(weights_.allFinite() && weights_.minCoeff() >= 0.0, "a weight is negative or not finite");
  require_mode_shape("LawPatchForce", "u", shapes_.u, n, shapes_.u.cols());
  require_mode_shape("LawPatchForce", "v", shapes_.v, n, shapes_.u.cols());
  shape_ = {&shapes_.u, &shapes_.v};
  if (shapes_.w.size() > 0) {
    require_mode_shape("LawPatchForce", "w", shapes_.w, n, shapes_.u.cols());
    shape_.push_back(&shapes_.w);
  }
  sleep_ = SleepingLaws(weights_, laws_, shapes_);
  const double area = weights_.sum();
  for (Eigen::Index i = 0; i < n; ++i) {
    all_states_.push_back({area > 0.0 ? weights_[i] / area : 0.0, {}});
  }
}

ForceAndJacobian LawPatchForce::evaluate(const Harmonics& q, double frequency) const {
  std::vector<Eigen::Index> all(static_cast<std::size_t>(q.rows().rows()));
  std::iota(all.begin(), all.end(), Eigen::Index{0});
  return evaluate_rows(q, frequency, all);
}

ForceAndJacobian LawPatchForce::evaluate_rows(const Harmonics& q, double frequency,
                                              const std::vector<Eigen::Index>& rows) const {
  motion_.set(shapes_, q);
  sleep_.look_at(motion_, frequency, shapes_);
  sum_.start(shape_, q.n_harmonics(), rows);
  begin_states(q, frequency);
  for (const Eigen::Index i : sleep_.awake()) {
    const PointLaw& law = *laws_[static_cast<std::size_t>(i)];
    motion_.copy(i, point_motion_);
    traction_.defect = 0.0;  // a law that is exact does not mention it
    law.traction(point_motion_, frequency, traction_);
    sum_.add(i, weights_[i], law.load_at_rest(), traction_);
    const CycleStates cycle{traction_.regime, traction_.period};
    // Of rough surfaces the range tells where they are open alone, nothing of friction.
    const std::optional<LinearRange>& range = sleep_.range(i);
    const bool frictionless = range && range->sticks_linearly && !range->rubs();
    all_states_[static_cast<std::size_t>(i)].cycle = frictionless ? cycle.without_slip() : cycle;
  }
  ForceAndJacobian result = sum_.take();
  if (const SleepingPart* part = sleep_.part()) add_sleeping(result, *part, q, rows);
  return result;
}

Harmonics LawPatchForce::force_up_to(const Harmonics& q, double frequency, int n_harmonics) const {
  motion_.set(shapes_, q);
  sleep_.look_at(motion_, frequency, shapes_);
  Harmonics sum(n_harmonics, n_modes());
  for (const Eigen::Index i : sleep_.awake()) {
    const PointLaw& law = *laws_[static_cast<std::size_t>(i)];
    motion_.copy(i, point_motion_);
    Harmonics force = law.force_up_to(point_motion_, frequency, n_harmonics);
    force.rows()(0, 1) -= law.load_at_rest();
    for (std::size_t s = 0; s < shape_.size(); ++s) {
      sum.rows() +=
          weights_[i] * force.rows().col(static_cast<Eigen::Index>(s)) * shape_[s]->row(i);
    }
  }
  if (const SleepingPart* part = sleep_.part()) {
    sum.rows().topRows(q.rows().rows()).noalias() += q.rows() * part->stiffness;  // symmetric
    sum.rows().row(0) += part->mean.transpose();
  }
  return sum;
}

CycleReport LawPatchForce::report(const Harmonics& q, double frequency) const {
  PatchMotion motion;
  motion.set(shapes_, q);
  const std::vector<SleepState> states = sleep_.states(motion, frequency);
  ReportSum sum;
  Harmonics point_motion;
  for (std::size_t point = 0; point < laws_.size(); ++point) {
    const auto i = static_cast<Eigen::Index>(point);
    if (weights_[i] == 0.0) continue;
    if (const std::optional<CycleSegment> segment = asleep(sleep_.range(i), states[point])) {
      sum.add({&*segment, 1}, 0.0, weights_[i]);
      continue;
    }
    motion.copy(i, point_motion);
    const PointHistory history = laws_[point]->history(point_motion, frequency, {}, 0);
    sum.add(history.segments, history.dissipated_energy, weights_[i]);
  }
  CycleReport report = sum.result();
  const auto n_awake = std::count(states.begin(), states.end(), SleepState::awake);
  report.awake_share = static_cast<double>(n_awake) / static_cast<double>(states.size());
  return report;
}

/// Those of the points asleep; the others follow as they are evaluated.
void LawPatchForce::begin_states(const Harmonics& q, double frequency) const {
  states_q_ = q;
  states_frequency_ = frequency;
  for (std::size_t i = 0; i < all_states_.size(); ++i) {
    const SleepState state = sleep_.state(static_cast<Eigen::Index>(i));
    if (state == SleepState::awake) continue;
    const bool stuck = state == SleepState::stuck;
    all_states_[i].cycle = {stuck ? CycleRegime::full_stick : CycleRegime::separated,
                            PeriodStates(stuck ? ContactState::stick : ContactState::separated)};
  }
}

void LawPatchForce::states(const Harmonics& q, double frequency, ContactStates& result) const {
  const bool known = frequency == states_frequency_ && q.rows().rows() == states_q_.rows().rows() &&
                     q.vector() == states_q_.vector();
  if (!known) static_cast<void>(evaluate_rows(q, frequency, {}));
  result.clear();
  for (const PointStates& point : all_states_) {
    if (point.share > 0.0) result.push_back(point);
  }
}

LinearState LawPatchForce::linear_state(const Harmonics& centre, double radius) const {
  return sleep_.linear_state(shapes_, centre, radius);
}

Eigen::MatrixXd LawPatchForce::stuck_stiffness() const {
  Eigen::MatrixX3d k(weights_.size(), 3);
  for (Eigen::Index i = 0; i < weights_.size(); ++i) {
    k.row(i) = weights_[i] * laws_[static_cast<std::size_t>(i)]->stuck_stiffness().transpose();
  }
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n_modes(), n_modes());
  for (std::size_t s = 0; s < shape_.size(); ++s) {
    stiffness +=
        shape_[s]->transpose() * k.col(static_cast<Eigen::Index>(s)).asDiagonal() * *shape_[s];
  }
  return stiffness;
}

}  // namespace microslip::contact
