#include "solver/time/time_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/time/time_quadrature.hpp"

namespace microslip::solver {

using contact::ContactState;

TimeRecorder::TimeRecorder(const TimeSystem& system, int n_harmonics, const TransientMemory& before)
    : system_(system),
      integrals_(n_harmonics, system.n_modes()),
      highest_(-std::numeric_limits<double>::infinity()),
      lowest_(std::numeric_limits<double>::infinity()),
      state_(before.state),
      stick_phases_(before.state.size(), 0) {}

void TimeRecorder::take(const TimeSegment& segment, double end, const TransientMemory& memory,
                        double slip_work) {
  const double duration = end * segment.length();
  add_integrals(segment, end);
  add_extremes(segment, end);
  add_states(duration, memory);
  duration_ += duration;
  work_.slip += slip_work;
}

void TimeRecorder::add_integrals(const TimeSegment& segment, double end) {
  for (const auto& [at, rule_weight] : gauss_five) {
    const double x = end * at;
    const double weight = end * segment.length() * rule_weight;
    const double time = segment.begin() + x * segment.length();
    const ModalMotion motion = segment.at(x);
    auto& rows = integrals_.rows();
    rows.row(0) += weight * motion.q.transpose();
    for (int h = 1; h <= integrals_.n_harmonics(); ++h) {
      const double angle = h * system_.frequency() * time;
      rows.row(2 * h - 1) += weight * std::sin(angle) * motion.q.transpose();
      rows.row(2 * h) += weight * std::cos(angle) * motion.q.transpose();
    }
    work_.excitation += weight * system_.excitation(time).dot(motion.velocity);
    work_.damping += weight * system_.damping_force(motion.velocity).dot(motion.velocity);
  }
}

void TimeRecorder::add_extremes(const TimeSegment& segment, double end) {
  const Eigen::Matrix<double, 1, 6> y = system_.scene().output.transpose() * segment.coefficients();
  const auto value = [&](double x) {
    return y[0] + x * (y[1] + x * (y[2] + x * (y[3] + x * (y[4] + x * y[5]))));
  };
  const auto slope = [&](double x) {
    return y[1] + x * (2.0 * y[2] + x * (3.0 * y[3] + x * (4.0 * y[4] + x * 5.0 * y[5])));
  };
  const auto meet = [&](double x) {
    highest_ = std::max(highest_, value(x));
    lowest_ = std::min(lowest_, value(x));
  };
  constexpr int n_cells = 4;
  for (int i = 0; i < n_cells; ++i) {
    double low = end * i / n_cells;
    double high = end * (i + 1) / n_cells;
    meet(low);
    meet(high);
    const bool rises = slope(low) > 0.0;
    if (rises == (slope(high) > 0.0)) continue;
    for (int k = 0; k < 50; ++k) {
      const double middle = 0.5 * (low + high);
      ((slope(middle) > 0.0) == rises ? low : high) = middle;
    }
    meet(low);
  }
}

void TimeRecorder::add_states(double duration, const TransientMemory& memory) {
  if (system_.contact() == nullptr) return;
  const contact::StateShares share = system_.contact()->shares(memory);
  report_.stick_share += duration * share.stick;
  report_.slip_share += duration * share.slip;
  report_.separated_share += duration * share.separated;
  report_.three_states_share =
      std::max(report_.three_states_share, std::min({share.stick, share.slip, share.separated}));
  for (std::size_t i = 0; i < state_.size(); ++i) {
    const bool begins = memory.state[i] == ContactState::stick && state_[i] != ContactState::stick;
    stick_phases_[i] += begins ? 1 : 0;
    state_[i] = memory.state[i];
  }
}

Harmonics TimeRecorder::harmonics() const {
  Harmonics q = integrals_;
  q.rows() *= 2.0 / duration_;
  q.rows().row(0) *= 0.5;
  return q;
}

PeriodWork TimeRecorder::work() const {
  const double n = n_periods();
  PeriodWork work{work_.excitation / n, work_.damping / n, 0.0, work_.slip / n};
  work.contact = work.excitation - work.damping;
  return work;
}

contact::CycleReport TimeRecorder::report() const {
  contact::CycleReport report = report_;
  report.stick_share /= duration_;
  report.slip_share /= duration_;
  report.separated_share /= duration_;
  report.slip_work = work().slip;
  return report;
}

std::vector<int> TimeRecorder::stick_phases() const {
  std::vector<int> phases = stick_phases_;
  for (std::size_t i = 0; i < phases.size(); ++i) {
    if (phases[i] == 0 && state_[i] == ContactState::stick) phases[i] = 1;
  }
  return phases;
}

}  // namespace microslip::solver
