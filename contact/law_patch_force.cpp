#include "contact/law_patch_force.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact/cycle_report.hpp"
#include "contact/mode_shape_check.hpp"

namespace microslip::contact {
namespace {

// Points whose Jacobians wait for one dense product: large enough for it to be fast, small enough for
// the rows to stay in cache.
constexpr Eigen::Index block_size = 32;

void require(bool condition, const std::string& message) {
  if (!condition) {
    throw std::invalid_argument("LawPatchForce: " + message);
  }
}

// J_i Φ_i of a block of points, harmonic row by harmonic row of those asked for: n_rows matrices of
// (n_signals · block) × (n_rows · n_modes), then Φᵀ times these.
class JacobianSum {
 public:
  JacobianSum(const std::vector<const Eigen::MatrixXd*>& shapes,
              const std::vector<Eigen::Index>& rows)
      : shapes_(shapes),
        rows_(rows),
        n_rows_(static_cast<Eigen::Index>(rows.size())),
        n_modes_(shapes.front()->cols()),
        phi_(block_rows(), n_modes_),
        moved_(rows.size(), Eigen::MatrixXd(block_rows(), n_rows_ * n_modes_)),
        sum_(Eigen::MatrixXd::Zero(n_rows_ * n_modes_, n_rows_ * n_modes_)) {}

  void add(Eigen::Index point, double weight, const Eigen::MatrixXd& jacobian) {
    const Eigen::Index n_signals = signals();
    const Eigen::Index first = n_signals * n_waiting_;
    for (Eigen::Index s = 0; s < n_signals; ++s) {
      phi_.row(first + s) = shapes_[static_cast<std::size_t>(s)]->row(point);
    }
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      Eigen::MatrixXd& moved = moved_[k];
      for (Eigen::Index l = 0; l < n_rows_; ++l) {
        const Eigen::Index column = rows_[static_cast<std::size_t>(l)];
        moved.block(first, l * n_modes_, n_signals, n_modes_).noalias() =
            weight *
            jacobian.block(n_point_signals * rows_[k], n_point_signals * column, n_signals,
                           n_signals) *
            phi_.middleRows(first, n_signals);
      }
    }
    if (++n_waiting_ == block_size) {
      flush();
    }
  }

  [[nodiscard]] Eigen::MatrixXd take() {
    flush();
    return std::move(sum_);
  }

 private:
  [[nodiscard]] Eigen::Index signals() const { return static_cast<Eigen::Index>(shapes_.size()); }
  [[nodiscard]] Eigen::Index block_rows() const { return signals() * block_size; }

  void flush() {
    const Eigen::Index n = signals() * n_waiting_;
    for (Eigen::Index k = 0; k < n_rows_ && n > 0; ++k) {
      sum_.middleRows(k * n_modes_, n_modes_).noalias() +=
          phi_.topRows(n).transpose() * moved_[static_cast<std::size_t>(k)].topRows(n);
    }
    n_waiting_ = 0;
  }

  const std::vector<const Eigen::MatrixXd*>& shapes_;
  const std::vector<Eigen::Index>& rows_;
  Eigen::Index n_rows_;
  Eigen::Index n_modes_;
  Eigen::Index n_waiting_ = 0;
  Eigen::MatrixXd phi_;
  std::vector<Eigen::MatrixXd> moved_;
  Eigen::MatrixXd sum_;
};

// Forces and their derivatives by ω of the points, in blocks like the Jacobian.
class TractionSum {
 public:
  TractionSum(const std::vector<const Eigen::MatrixXd*>& shapes, int n_harmonics)
      : shapes_(shapes),
        force_(n_harmonics, shapes.front()->cols()),
        derivative_(n_harmonics, shapes.front()->cols()),
        phi_(signals() * block_size, shapes.front()->cols()),
        tractions_(signals() * block_size, force_.rows().rows()),
        by_frequency_(tractions_.rows(), tractions_.cols()) {}

  void add(Eigen::Index point, double weight, double load_at_rest, const PointTraction& traction) {
    double shape = 0.0;
    const bool depends = !traction.frequency_derivative.isZero(0.0);
    if (depends && !depends_) by_frequency_.setZero();
    depends_ = depends_ || depends;
    for (Eigen::Index s = 0; s < signals(); ++s) {
      const Eigen::Index row = signals() * n_waiting_ + s;
      phi_.row(row) = shapes_[static_cast<std::size_t>(s)]->row(point);
      tractions_.row(row) = weight * traction.force.rows().col(s).transpose();
      if (s == 1) tractions_(row, 0) -= weight * load_at_rest;
      if (depends_) {
        for (Eigen::Index k = 0; k < tractions_.cols(); ++k) {
          by_frequency_(row, k) = weight * traction.frequency_derivative[n_point_signals * k + s];
        }
      }
      shape += phi_.row(row).squaredNorm();
    }
    if (traction.defect > 0.0) defect_ += weight * traction.defect * std::sqrt(shape);
    if (++n_waiting_ == block_size) flush();
  }

  /// All but the Jacobian. @param rows  of the derivative by ω.
  [[nodiscard]] ForceAndJacobian take(const std::vector<Eigen::Index>& rows) {
    flush();
    const Eigen::Index n = force_.n_signals();
    ForceAndJacobian result{std::move(force_), {}, {}, defect_};
    result.frequency_derivative.resize(static_cast<Eigen::Index>(rows.size()) * n);
    Eigen::Index at = 0;
    for (const Eigen::Index row : rows) {
      result.frequency_derivative.segment(at, n) = derivative_.rows().row(row).transpose();
      at += n;
    }
    return result;
  }

 private:
  [[nodiscard]] Eigen::Index signals() const { return static_cast<Eigen::Index>(shapes_.size()); }

  void flush() {
    const Eigen::Index n = signals() * n_waiting_;
    n_waiting_ = 0;
    if (n == 0) return;
    force_.rows().noalias() += tractions_.topRows(n).transpose() * phi_.topRows(n);
    if (!depends_) return;
    derivative_.rows().noalias() += by_frequency_.topRows(n).transpose() * phi_.topRows(n);
  }

  const std::vector<const Eigen::MatrixXd*>& shapes_;
  Harmonics force_;
  Harmonics derivative_;
  Eigen::Index n_waiting_ = 0;
  bool depends_ = false;
  double defect_ = 0.0;
  Eigen::MatrixXd phi_;
  Eigen::MatrixXd tractions_;     // (signals · block) × (2H+1)
  Eigen::MatrixXd by_frequency_;  // the same
};

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
  TractionSum sum(shape_, q.n_harmonics());
  JacobianSum jacobian(shape_, rows);
  for (const Eigen::Index i : sleep_.awake()) {
    const PointLaw& law = *laws_[static_cast<std::size_t>(i)];
    motion_.copy(i, point_motion_);
    traction_.defect = 0.0;  // a law that is exact does not mention it
    law.traction(point_motion_, frequency, traction_);
    sum.add(i, weights_[i], law.load_at_rest(), traction_);
    if (traction_.regime != CycleRegime::separated && !rows.empty()) {
      jacobian.add(i, weights_[i], traction_.jacobian);
    }
  }
  ForceAndJacobian result = sum.take(rows);
  result.jacobian = jacobian.take();
  if (const SleepingPart* part = sleep_.part()) add_sleeping(result, *part, q, rows);
  return result;
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
    stiffness += shape_[s]->transpose() * k.col(static_cast<Eigen::Index>(s)).asDiagonal() * *shape_[s];
  }
  return stiffness;
}

}  // namespace microslip::contact
