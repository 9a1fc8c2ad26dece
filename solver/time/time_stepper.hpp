/// @file
/// One period of a scene in time, by either method. The state goes in and out; an observer sees
/// every step.
#pragma once

#include <memory>
#include <stdexcept>

#include "solver/diagnosis.hpp"
#include "solver/time/time_segment.hpp"
#include "solver/time/time_system.hpp"
#include "solver/time_options.hpp"

namespace microslip::solver {

/// Everything the future depends on, at θ = 0 between two periods.
struct TimeState {
  ModalMotion motion;
  TransientMemory memory;  ///< empty without contact
};

/// Why a period could not be integrated.
class TimeError : public std::runtime_error {
 public:
  TimeError(Diagnosis diagnosis, const std::string& message)
      : std::runtime_error(message), diagnosis_(diagnosis) {}
  [[nodiscard]] Diagnosis diagnosis() const { return diagnosis_; }

 private:
  Diagnosis diagnosis_;
};

class TimeObserver {
 public:
  TimeObserver() = default;
  TimeObserver(const TimeObserver&) = delete;
  TimeObserver& operator=(const TimeObserver&) = delete;
  TimeObserver(TimeObserver&&) = delete;
  TimeObserver& operator=(TimeObserver&&) = delete;
  virtual ~TimeObserver() = default;
  /// @param end        the segment counts from x = 0 to this.
  /// @param memory     states within it.
  /// @param slip_work  of the sliders within it [J].
  virtual void take(const TimeSegment& segment, double end, const TransientMemory& memory,
                    double slip_work) = 0;
};

/// Largest motion of the last period: what errors and guards are measured by.
struct TimeLevels {
  contact::GuardScale last;     ///< of the period before; a first guess in the first
  contact::GuardScale current;  ///< of the period so far
};

class TimeStepper {
 public:
  TimeStepper() = default;
  TimeStepper(const TimeStepper&) = delete;
  TimeStepper& operator=(const TimeStepper&) = delete;
  TimeStepper(TimeStepper&&) = delete;
  TimeStepper& operator=(TimeStepper&&) = delete;
  virtual ~TimeStepper() = default;

  /// Integrates from θ = 0 to 2π.
  /// @param observer  nullptr: nobody looks.
  /// @throws TimeError  `event-chatter`: too many changes of state; `out-of-range`: not finite.
  virtual void advance_period(TimeState& state, TimeObserver* observer) = 0;
  [[nodiscard]] virtual long n_events() const = 0;  ///< changes of state so far
  [[nodiscard]] const TimeLevels& levels() const { return levels_; }
  /// G between two periods, as the method sees it [N/√kg]. The scene must have contact.
  [[nodiscard]] virtual Eigen::VectorXd contact_force(const TimeState& state) const = 0;

 protected:
  void reach(const ModalMotion& motion);
  void close_period();
  TimeLevels levels_;
};

/// @param system  borrowed; must outlive the result.
/// @throws std::invalid_argument  an option is out of range, or fixed steps are beyond the bound of
///         the stuck system; the message says how many steps per period it needs.
[[nodiscard]] std::unique_ptr<TimeStepper> make_stepper(const TimeSystem& system,
                                                        const TimeOptions& options);

/// At rest with virgin sliders.
[[nodiscard]] TimeState state_at_rest(const TimeSystem& system);
/// On a periodic motion at θ = 0, sliders where two periods of it leave them.
[[nodiscard]] TimeState state_on(const TimeSystem& system, const Harmonics& q);

}  // namespace microslip::solver
