#include "contact/force/pointwise_force.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact/patch/mode_shape_check.hpp"
#include "contact/phase.hpp"

namespace microslip::contact {
namespace {

void check(const RestingPoints& points, const ModalShapes& shapes) {
  const Eigen::Index n = points.weights.size();
  const bool whole = static_cast<Eigen::Index>(points.ranges.size()) == n &&
                     points.reference_load.size() == n && points.stuck_stiffness.rows() == n;
  if (n < 1 || !whole) {
    throw std::invalid_argument("contact force: " + std::to_string(n) + " weights for " +
                                std::to_string(points.ranges.size()) + " points");
  }
  if (!points.weights.allFinite() || points.weights.minCoeff() < 0.0) {
    throw std::invalid_argument("contact force: a weight is negative or not finite");
  }
  require_mode_shape("contact force", "u", shapes.u, n, shapes.u.cols());
  require_mode_shape("contact force", "v", shapes.v, n, shapes.u.cols());
  if (shapes.w.size() > 0) {
    require_mode_shape("contact force", "w", shapes.w, n, shapes.u.cols());
  }
}

void add_sleeping(ForceAndJacobian& result, const SleepingPart& part, const Harmonics& q,
                  std::size_t n_rows) {
  const Eigen::Index n = part.mean.size();
  result.force.rows().topRows(q.rows().rows()).noalias() += q.rows() * part.stiffness;  // symmetric
  result.force.rows().row(0) += part.mean.transpose();
  for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(n_rows); ++k) {
    result.jacobian.block(k * n, k * n, n, n) += part.stiffness;
  }
}

void keep_sleeping(const SleepingSet& sleep, std::vector<CycleStates>& cycles) {
  for (std::size_t i = 0; i < cycles.size(); ++i) {
    const SleepState state = sleep.state(static_cast<Eigen::Index>(i));
    if (state == SleepState::awake) continue;
    const bool stuck = state == SleepState::stuck;
    cycles[i] = {stuck ? CycleRegime::full_stick : CycleRegime::separated,
                 PeriodStates(stuck ? ContactState::stick : ContactState::separated)};
  }
}

}  // namespace

PointwiseForce::PointwiseWork::PointwiseWork(const PointwiseForce& force)
    : Workspace(force), sleep(force.points_, force.shapes_), cycles(force.points_.ranges.size()) {}

PointwiseForce::PointwiseForce(RestingPoints points, ModalShapes&& shapes)
    : ModalForce(shapes.u.cols()), points_(std::move(points)), shapes_(std::move(shapes)) {
  check(points_, shapes_);
}

std::unique_ptr<ModalForce::Workspace> PointwiseForce::workspace() const {
  return std::make_unique<PointwiseWork>(*this);
}

PointwiseForce::PointwiseWork& PointwiseForce::own(Workspace& work) const {
  if (!work.is_of(*this)) {
    throw std::invalid_argument("contact force: the workspace is that of another force");
  }
  return static_cast<PointwiseWork&>(work);  // workspace() makes no others
}

void PointwiseForce::look_at(const Harmonics& q, double frequency, PointwiseWork& work) const {
  work.motion.set(shapes_, q);
  work.sleep.look_at(work.motion, frequency, points_, shapes_);
}

ForceAndJacobian PointwiseForce::evaluated(const Harmonics& q, double frequency, const Asked& asked,
                                           Workspace& workspace) const {
  PointwiseWork& work = own(workspace);
  look_at(q, frequency, work);
  work.kept_q.reset();
  keep_sleeping(work.sleep, work.cycles);
  ForceAndJacobian result = awake_force(frequency, asked, work);
  if (asked.n_harmonics <= q.n_harmonics()) {
    work.kept_q = q;
    work.kept_frequency = frequency;
  }
  if (const SleepingPart* part = work.sleep.part()) {
    add_sleeping(result, *part, q, asked.rows.size());
  }
  return result;
}

void PointwiseForce::keep(Eigen::Index point, const CycleStates& cycle, PointwiseWork& work) const {
  work.cycles[static_cast<std::size_t>(point)] =
      is_frictionless(point) ? cycle.without_slip() : cycle;
}

/// Of rough surfaces the range tells where they are open alone, nothing of friction.
bool PointwiseForce::is_frictionless(Eigen::Index point) const {
  const std::optional<LinearRange>& range = points_.ranges[static_cast<std::size_t>(point)];
  return range && range->sticks_linearly && !range->rubs();
}

void PointwiseForce::states(const Harmonics& q, double frequency, ContactStates& result,
                            Workspace& workspace) const {
  PointwiseWork& work = own(workspace);
  const bool known = work.kept_q && frequency == work.kept_frequency &&
                     q.rows().rows() == work.kept_q->rows().rows() &&
                     q.vector() == work.kept_q->vector();
  if (!known) {
    look_at(q, frequency, work);
    work.kept_q.reset();
    keep_sleeping(work.sleep, work.cycles);
    find_states(frequency, work);
  }
  const double area = points_.weights.sum();
  result.clear();
  for (std::size_t i = 0; i < work.cycles.size(); ++i) {
    const double weight = points_.weights[static_cast<Eigen::Index>(i)];
    if (weight > 0.0) result.push_back({weight / area, work.cycles[i]});
  }
}

namespace {

/// Of a motion as it is summed over the modes, without what cancels: |x| and |x'| of a point and
/// direction are no larger.
struct MotionSizes {
  Eigen::VectorXd of_place;  ///< |q_0| + Σ_k |q_k|
  Eigen::VectorXd of_path;   ///< Σ_k k |q_k|

  explicit MotionSizes(const Harmonics& q) {
    of_place = q.rows().row(0).cwiseAbs().transpose();
    of_path.setZero(of_place.size());
    for (int k = 1; k <= q.n_harmonics(); ++k) {
      const Eigen::VectorXd size =
          (q.sine(k).array().square() + q.cosine(k).array().square()).sqrt().matrix();
      of_place += size;
      of_path += k * size;
    }
  }
};

/// μ(σ) is monotone.
double largest_coefficient(const FrictionLaw& law, double fastest) {
  return std::max(law.at_rest(), law.at(fastest).value);
}

Eigen::ArrayXd at_points(const Eigen::MatrixXd& shape, const Eigen::VectorXd& size,
                         Eigen::Index n) {
  if (shape.size() == 0) return Eigen::ArrayXd::Zero(n);
  return (shape.cwiseAbs() * size).array();
}

}  // namespace

double PointwiseForce::work_error(const Harmonics& q, double frequency,
                                  Workspace& workspace) const {
  constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon();
  PointwiseWork& work = own(workspace);
  look_at(q, frequency, work);
  const MotionSizes sizes(q);
  const Eigen::Index n = points_.weights.size();
  const auto place = [&](const Eigen::MatrixXd& shape) {
    return at_points(shape, sizes.of_place, n);
  };
  const auto path = [&](const Eigen::MatrixXd& shape) {
    return at_points(shape, sizes.of_path, n);
  };
  const auto& k = points_.stuck_stiffness;
  const Eigen::ArrayXd along_p = path(shapes_.u);
  const Eigen::ArrayXd along_r = path(shapes_.w);
  const Eigen::ArrayXd stored =
      k.col(0).array() * place(shapes_.u) * along_p + k.col(2).array() * place(shapes_.w) * along_r;
  const Eigen::ArrayXd change = k.col(1).array() * place(shapes_.v);
  const Eigen::ArrayXd load = points_.reference_load.array() + change;
  const Eigen::ArrayXd pressed = load * path(shapes_.v);
  double error = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::optional<LinearRange>& range = points_.ranges[static_cast<std::size_t>(i)];
    const bool awake = work.sleep.state(i) == SleepState::awake;
    if (points_.weights[i] == 0.0) continue;
    if (awake && !(range && range->sticks_linearly)) return std::numeric_limits<double>::infinity();
    const double way = along_p[i] + along_r[i];
    const double rubbed =
        range ? largest_coefficient(range->friction, frequency * way) * load[i] * way : 0.0;
    double of_point = rounding * (stored[i] + rubbed + pressed[i]);
    if (awake) {
      const bool parts = range->rest_load < change[i];
      const WorkPrecision precision = work_precision(i, q.n_harmonics());
      of_point += precision.friction * std::min(stored[i], rubbed);
      if (parts) of_point += precision.load * pressed[i];
    }
    error += points_.weights[i] * of_point;
  }
  return std::numbers::pi * error;
}

CycleReport PointwiseForce::report(const Harmonics& q, double frequency,
                                   Workspace& workspace) const {
  PointwiseWork& work = own(workspace);
  look_at(q, frequency, work);
  const std::size_t n = points_.ranges.size();
  ReportSum sum;
  std::vector<Eigen::Index> others;
  for (std::size_t i = 0; i < n; ++i) {
    const auto point = static_cast<Eigen::Index>(i);
    const SleepState state = work.sleep.state(point);
    const double weight = points_.weights[point];
    if (weight == 0.0) continue;
    const bool open = state == SleepState::open;
    // In contact without friction: whether that is slip, the cycle tells.
    if (state == SleepState::awake || (!open && is_frictionless(point))) {
      others.push_back(point);
      continue;
    }
    const CycleSegment whole{open ? ContactState::separated : ContactState::stick, 0.0, two_pi,
                             0.0};
    sum.add({&whole, 1}, 0.0, weight);
  }
  add_cycles(others, frequency, work, sum);
  CycleReport report = sum.result();
  report.awake_share = static_cast<double>(work.sleep.awake().size()) / static_cast<double>(n);
  return report;
}

LinearState PointwiseForce::linear_state_of(const MotionSet& motions) const {
  return contact::linear_state(points_, shapes_, motions);
}

Eigen::MatrixXd PointwiseForce::stuck_stiffness() const {
  const Eigen::MatrixX3d k = points_.stuck_stiffness.array().colwise() * points_.weights.array();
  Eigen::MatrixXd stiffness = shapes_.u.transpose() * k.col(0).asDiagonal() * shapes_.u;
  stiffness += shapes_.v.transpose() * k.col(1).asDiagonal() * shapes_.v;
  if (shapes_.w.size() > 0) {
    stiffness += shapes_.w.transpose() * k.col(2).asDiagonal() * shapes_.w;
  }
  return stiffness;
}

}  // namespace microslip::contact
