#include "solver/time/time_events.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "solver/time/time_guards.hpp"
#include "solver/time/time_quadrature.hpp"

namespace microslip::solver {
namespace {

constexpr int default_longest_step =
    64;                                  // of a period: guards are sampled at 256 instants at least
constexpr double shortest_step = 1e-14;  // of a period

// Dormand & Prince 5(4): the last stage is the first of the next step.
constexpr std::size_t n_stages = 7;
constexpr std::array<double, n_stages> nodes{0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0};
constexpr std::array<std::array<double, 6>, n_stages> stages{{
    {},
    {0.2},
    {3.0 / 40.0, 9.0 / 40.0},
    {44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0},
    {19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0},
    {9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0},
    {35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0},
}};
/// Order 5 minus order 4.
constexpr std::array<double, n_stages> error_weights{
    71.0 / 57600.0,      0.0,          -71.0 / 16695.0, 71.0 / 1920.0,
    -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0};

/// Of the highest coefficient of the dense output (Hairer, Nørsett & Wanner I, section II.6).
constexpr std::array<double, n_stages> dense_weights{
    -12715105075.0 / 11282082432.0,  0.0,
    87487479700.0 / 32700410799.0,   -10690763975.0 / 1880347072.0,
    701980252875.0 / 199316789632.0, -1453857185.0 / 822651844.0,
    69997945.0 / 29380423.0};

/// Dense output of order four; the end is the last stage.
InternalPolynomials internal_polynomials(const Eigen::VectorXd& begin, const Eigen::VectorXd& end,
                                         double length, const Eigen::MatrixXd& rate) {
  const Eigen::Map<const Eigen::VectorXd> d(dense_weights.data(), n_stages);
  const Eigen::VectorXd change = end - begin;
  const Eigen::VectorXd bend = length * rate.col(0) - change;
  InternalPolynomials c(begin.size(), 5);
  c << begin, change, bend, change - length * rate.col(n_stages - 1) - bend, length * (rate * d);
  return c;
}

/// The scale vanishes where nothing moves yet.
double relative_error(double error, double scale) {
  if (error == 0.0) return 0.0;
  return scale > 0.0 ? error / scale : std::numeric_limits<double>::infinity();
}

}  // namespace

EventStepper::EventStepper(const TimeSystem& system, const TimeOptions& options)
    : system_(system), tolerance_(options.step_tolerance) {
  const int n_steps =
      options.steps_per_period > 0 ? options.steps_per_period : default_longest_step;
  // On the imaginary axis the pair is stable up to about 1, half of what is allowed to rk4.
  const long needed = 2L * system.least_steps();
  if (std::isinf(tolerance_) && n_steps < needed) {
    throw std::invalid_argument("time integration: " + std::to_string(n_steps) +
                                " fixed steps per period at " + std::to_string(system.frequency()) +
                                " rad/s are too few: the stuck system goes up to " +
                                std::to_string(system.largest_frequency()) +
                                " rad/s and needs at least " + std::to_string(needed));
  }
  longest_step_ = system.period() / n_steps;
  next_step_ = longest_step_;
  const Eigen::Index n_points = system.contact() != nullptr ? system.contact()->n_points() : 0;
  max_events_ = options.max_events > 0 ? options.max_events : 1000 + 100 * n_points;
  const double fastest = system.largest_frequency();
  if (fastest > 0.0) {  // a first guess, smaller than what the force will make of it
    levels_.last = {system.excitation_size() / (fastest * fastest),
                    system.excitation_size() / fastest};
  }
}

contact::GuardScale EventStepper::scale() const {
  const double displacement = std::max(levels_.last.displacement, levels_.current.displacement);
  return {displacement, std::max({levels_.last.velocity, levels_.current.velocity,
                                  system_.frequency() * displacement})};
}

Eigen::VectorXd EventStepper::acceleration(double time, const ModalMotion& motion,
                                           const TransientMemory& memory) {
  const contact::TransientForce* contact = system_.contact();
  return system_.acceleration(time, motion,
                              contact != nullptr ? contact->held_force(motion, memory)
                                                 : Eigen::VectorXd::Zero(system_.n_modes()).eval());
}

void EventStepper::accelerate(double time, TimeState& state) {
  state.motion.acceleration = acceleration(time, state.motion, state.memory);
}

EventStepper::Step EventStepper::try_step(double time, double length, const TimeState& state) {
  const Eigen::Index n = system_.n_modes();
  const contact::TransientForce* contact = system_.contact();
  const Eigen::Index n_internal = contact != nullptr ? contact->n_internal() : 0;
  const contact::GuardScale size = scale();
  Eigen::MatrixXd velocity(n, n_stages);  // of each stage
  Eigen::MatrixXd acceleration_of(n, n_stages);
  Eigen::MatrixXd internal_rate(n_internal, n_stages);
  TransientMemory moved = n_internal > 0 ? state.memory : TransientMemory{};
  const TransientMemory& memory = n_internal > 0 ? moved : state.memory;
  velocity.col(0) = state.motion.velocity;
  acceleration_of.col(0) = state.motion.acceleration;
  if (n_internal > 0) internal_rate.col(0) = contact->internal_rates(state.motion, memory, size);
  Step step;
  for (std::size_t i = 1; i < n_stages; ++i) {
    const Eigen::Map<const Eigen::VectorXd> a(stages[i].data(), static_cast<Eigen::Index>(i));
    const auto column = static_cast<Eigen::Index>(i);
    step.displacement = length * velocity.leftCols(column).lazyProduct(a);
    step.velocity = length * acceleration_of.leftCols(column).lazyProduct(a);
    ModalMotion motion{state.motion.q + step.displacement, state.motion.velocity + step.velocity};
    if (n_internal > 0) {
      moved.internal = state.memory.internal + length * (internal_rate.leftCols(column) * a);
    }
    motion.acceleration = acceleration(time + nodes[i] * length, motion, memory);
    velocity.col(column) = motion.velocity;
    acceleration_of.col(column) = motion.acceleration;
    if (n_internal > 0) {
      internal_rate.col(column) = contact->internal_rates(motion, memory, size);
    }
  }
  step.acceleration_end = acceleration_of.col(n_stages - 1);
  const Eigen::Map<const Eigen::VectorXd> weights(error_weights.data(), n_stages);
  const double displacement_error = length * velocity.lazyProduct(weights).norm();
  const double velocity_error = length * acceleration_of.lazyProduct(weights).norm();
  step.error = std::max(relative_error(displacement_error, size.displacement),
                        relative_error(velocity_error, size.velocity));
  if (n_internal > 0) {
    step.internal =
        internal_polynomials(state.memory.internal, moved.internal, length, internal_rate);
    const Eigen::VectorXd importance = contact->internal_weights(state.motion, state.memory, size);
    const Eigen::VectorXd error = length * (internal_rate * weights);
    step.error = std::max(step.error, error.cwiseProduct(importance).lpNorm<Eigen::Infinity>());
  }
  return step;
}

EventStepper::Step EventStepper::accepted_step(double time, double& length,
                                               const TimeState& state) {
  const double asked = length;
  while (true) {
    Step step = try_step(time, length, state);
    const double ratio = step.error / tolerance_;
    const double factor = ratio > 0.0 ? std::clamp(0.9 * std::pow(ratio, -0.2), 0.2, 5.0) : 5.0;
    if (ratio <= 1.0) {
      const bool cut_short = length == asked && asked < next_step_;  // by the end of the period
      next_step_ = std::min(longest_step_, std::max(factor * length, cut_short ? next_step_ : 0.0));
      return step;
    }
    if (!(length > shortest_step * system_.period())) {
      throw TimeError(Diagnosis::out_of_range, "the error of a step stays at " +
                                                   std::to_string(step.error) +
                                                   " of the motion however short it is");
    }
    length *= std::isfinite(factor) ? std::min(factor, 0.9) : 0.2;
  }
}

EventStepper::Taken EventStepper::smooth_step(double time, double& length, const TimeState& state) {
  const auto taken = [&] {
    Step step = accepted_step(time, length, state);
    TimeSegment segment(time, length, state.motion, step.displacement, step.velocity,
                        state.motion.acceleration, step.acceleration_end, step.internal);
    return Taken{std::move(step), std::move(segment)};
  };
  Taken whole = taken();
  if (system_.contact() == nullptr) return whole;
  const std::optional<double> kink = first_kink(*system_.contact(), whole.segment);
  if (!kink) return whole;
  // The stages beyond the kink have seen another force: the step is taken anew.
  length *= *kink;
  return taken();
}

void EventStepper::move_to(double x, const TimeSegment& segment, TimeState& state) {
  state.motion = segment.at(x);
  if (segment.has_internal()) state.memory.internal = segment.internal_at(x);
}

void EventStepper::count_events(std::size_t n) {
  n_events_ += static_cast<long>(n);
  period_events_ += static_cast<long>(n);
  if (period_events_ > max_events_) {
    throw TimeError(Diagnosis::event_chatter, "more than " + std::to_string(max_events_) +
                                                  " changes of contact state in one period");
  }
}

void EventStepper::settle(TimeState& state) {
  constexpr int n_passes = 4;  // stick → slip → separated, and once to see that it holds
  if (system_.contact() == nullptr) return;
  for (int pass = 0; pass < n_passes; ++pass) {
    const auto guards = system_.contact()->guards(state.motion, state.memory, scale());
    std::size_t n_changed = 0;
    for (Eigen::Index point = 0; point < guards.rows(); ++point) {
      if (guards.row(point).minCoeff() >= -guard_tolerance) continue;
      system_.contact()->switch_state(point, state.motion, state.memory);
      ++n_changed;
    }
    count_events(n_changed);
    if (n_changed == 0) return;
  }
}

void EventStepper::observe(TimeObserver* observer, const TimeSegment& segment, double end,
                           const TransientMemory& memory) const {
  if (observer == nullptr || end == 0.0) return;
  double work = 0.0;
  if (system_.contact() != nullptr) {
    TransientMemory now = memory;
    for (const auto& [at, weight] : gauss_five) {
      if (segment.has_internal()) now.internal = segment.internal_at(end * at);
      work += end * segment.length() * weight *
              system_.contact()->slip_power(segment.at(end * at), now);
    }
  }
  observer->take(segment, end, memory, work);
}

void EventStepper::advance_period(TimeState& state, TimeObserver* observer) {
  const double period = system_.period();
  period_events_ = 0;
  reach(state.motion);
  accelerate(0.0, state);
  settle(state);
  accelerate(0.0, state);
  double time = 0.0;
  while (period - time > shortest_step * period) {
    const double rest = period - time;
    double length = next_step_;
    if (rest <= 1.0001 * length) {
      length = rest;
    } else if (rest < 2.0 * length) {
      length = 0.5 * rest;
    }
    const auto [step, segment] = smooth_step(time, length, state);
    const auto event = system_.contact() != nullptr
                           ? first_event(*system_.contact(), segment, state.memory, scale())
                           : std::nullopt;
    observe(observer, segment, event ? event->at : 1.0, state.memory);
    if (event) {
      time += event->at * length;
      move_to(event->at, segment, state);
      for (const Eigen::Index point : event->points) {
        system_.contact()->switch_state(point, state.motion, state.memory);
      }
      count_events(event->points.size());
      settle(state);
      accelerate(time, state);
    } else {
      if (segment.has_internal()) state.memory.internal = segment.internal_at(1.0);
      state.motion.q += step.displacement;
      state.motion.velocity += step.velocity;
      state.motion.acceleration = step.acceleration_end;
      time += length;
    }
    reach(state.motion);
  }
  close_period();
}

}  // namespace microslip::solver
