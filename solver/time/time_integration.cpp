#include "solver/time_integration.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/balance/output_amplitude.hpp"
#include "solver/time/periodicity.hpp"

namespace microslip::solver {
namespace {

/// Sizes that changes are held against are those of the period; where nothing keeps up a motion,
/// those of the largest period so far: motion that decays to rest is small only against what it
/// was.
void keep_largest(const TimeSystem& system, PeriodState& state, PeriodState& largest) {
  if (system.is_driven()) return;
  largest.displacement_size = std::max(largest.displacement_size, state.displacement_size);
  largest.force_size = std::max(largest.force_size, state.force_size);
  // Begun at rest there is none but the displacement that the static force holds.
  largest.velocity_size = std::max(
      {largest.velocity_size, state.velocity_size, system.frequency() * largest.displacement_size});
  state.displacement_size = largest.displacement_size;
  state.velocity_size = largest.velocity_size;
  state.force_size = largest.force_size;
}

PeriodState period_state(const TimeSystem& system, const TimeState& state,
                         const TimeStepper& stepper) {
  const TimeLevels& levels = stepper.levels();
  PeriodState result{state.motion.q, state.motion.velocity,
                     Eigen::VectorXd::Zero(system.n_modes())};
  if (system.contact() != nullptr) result.contact_force = stepper.contact_force(state);
  result.displacement_size = levels.last.displacement;
  result.velocity_size = levels.last.velocity;
  result.force_size = std::max(system.excitation_size(), result.contact_force.norm());
  return result;
}

double ratio_of(double part, double whole) { return part == 0.0 ? 0.0 : part / whole; }

/// @param at_rest  energy that comes and goes where nothing drives the motion [J]:
///                 works of a decay vanish with it.
void fill_response(const TimeSystem& system, const TimeRecorder& recorder, double at_rest,
                   TimePoint& point) {
  ResponsePoint& response = point.response;
  response.frequency = system.frequency();
  response.q = recorder.harmonics();
  const OutputAmplitude output = output_amplitude(response.q, system.scene().output);
  response.amplitude = recorder.half_peak_to_peak();
  response.first_amplitude = output.first_harmonic;
  response.mean = output.mean;
  response.phase = output.phase;
  response.report = recorder.report();
  response.stability = point.period_multiple == 1 ? Stability::stable : Stability::not_assessed;
  response.iterations = point.n_periods;
  point.work = recorder.work();
  const PeriodWork& w = point.work;
  response.energy = {.friction = w.slip, .damping = w.damping};
  const double size = std::max({std::abs(w.excitation), w.damping + w.slip, at_rest});
  response.energy_imbalance = ratio_of(std::abs(w.excitation - w.damping - w.slip), size);
  response.dissipation_mismatch = ratio_of(std::abs(w.contact - w.slip), size);
  point.stick_phases = recorder.stick_phases();
}

TimePoint run(const TimeSystem& system, TimeStepper& stepper, const TimeOptions& options,
              TimeState& state) {
  PeriodicityTest test;
  PeriodState largest;
  TimePoint point;
  const auto is_stopped = [&] { return options.stop && options.stop(); };
  while (point.n_periods < options.max_periods) {
    stepper.advance_period(state, nullptr);
    PeriodState now = period_state(system, state, stepper);
    keep_largest(system, now, largest);
    test.add(std::move(now));
    ++point.n_periods;
    point.stopped = is_stopped();
    if (point.stopped) return point;
    if (point.n_periods < options.min_periods) continue;
    point.period_multiple = test.multiple(options.periodicity_tolerance);
    if (point.period_multiple > 0) break;
  }
  point.periodic = point.period_multiple > 0;
  const int n_recorded =
      point.periodic ? point.period_multiple : static_cast<int>(PeriodicityTest::largest_multiple);
  const long events_before = stepper.n_events();
  TimeRecorder recorder(system, options.n_harmonics, state.memory);
  for (int i = 0; i < n_recorded; ++i) {
    stepper.advance_period(state, &recorder);
    point.stopped = i + 1 < n_recorded && is_stopped();
    if (point.stopped) return point;
  }
  point.n_events = stepper.n_events() - events_before;
  point.response.residual =
      test.distance(static_cast<std::size_t>(std::max(1, point.period_multiple)));
  // Kinetic energy, which only velocities that decay give a size here.
  fill_response(system, recorder, largest.velocity_size * largest.velocity_size, point);
  return point;
}

}  // namespace

TimePoint integrate_to_steady_state(const TimeSystem& system, const TimeOptions& options,
                                    TimeState& state) {
  const auto stepper = make_stepper(system, options);
  return run(system, *stepper, options, state);
}

}  // namespace microslip::solver
