#include "contact/line/event_phases.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "contact/phase.hpp"

namespace microslip::contact {
namespace {

// Phase of a change, counted on and on around the period.
double unwrapped(const std::vector<SignChange>& changes, std::size_t i) {
  const std::size_t turns = i / changes.size();
  return changes[i % changes.size()].phase + two_pi * static_cast<double>(turns);
}

// Sign changes of a rate.
class Extrema {
 public:
  explicit Extrema(const std::vector<SignChange>& changes) : changes_(&changes) {}

  [[nodiscard]] bool empty() const { return changes_->empty(); }
  [[nodiscard]] double phase(std::size_t i) const { return unwrapped(*changes_, i); }
  [[nodiscard]] bool is_maximum(std::size_t i) const {
    return !(*changes_)[i % changes_->size()].rising;
  }
  // First one after `phase`, not before number i.
  [[nodiscard]] std::size_t after(double phase_now, std::size_t i) const {
    while (!empty() && phase(i) <= phase_now) {
      ++i;
    }
    return i;
  }

 private:
  const std::vector<SignChange>* changes_;
};

constexpr double never = std::numeric_limits<double>::infinity();

// One slip direction: where stick gives way to it, where it ends.
struct Side {
  const TrigonometricPolynomial* guard;  // w_P or w_N
  const TrigonometricPolynomial* rate;
  Extrema extrema;
  double sign;           // +1 slips up to maxima, −1 down to minima
  std::size_t next = 0;  // first extremum after now
  double level = 0.0;    // of the guard at which stick gives way

  [[nodiscard]] bool ends_slip(std::size_t i) const {
    return extrema.is_maximum(i) == (sign > 0.0);
  }
  // How far beyond the level, in the direction of slip.
  [[nodiscard]] double beyond(double phase) const { return sign * (guard->value(phase) - level); }
};

// Where stick ends, and the extremum at which the slip after it will end.
struct Onset {
  double phase = never;
  std::size_t extremum = 0;
};

Onset onset(const Side& side, double from, double end) {
  if (side.extrema.empty()) {
    return {};
  }
  for (std::size_t i = side.next;; ++i) {
    const double to = std::min(side.extrema.phase(i), end);
    const double at_to = side.ends_slip(i) ? side.beyond(to) : 0.0;
    if (at_to > 0.0) {
      const double at_from = side.beyond(from);
      if (at_from >= 0.0) {
        return {from, i};
      }
      const double sign = side.sign;
      return {crossing(*side.guard, side.level, from, to, sign * at_from, sign * at_to), i};
    }
    if (to >= end) {
      return {};
    }
    from = to;
  }
}

// Walks through one stretch of contact.
class Walk {
 public:
  Walk(const EventGuards& guards, const std::vector<SignChange>& positive,
       const std::vector<SignChange>& negative, std::vector<EventPhase>& phases)
      : limit_(guards.limit),
        positive_{&guards.positive, &guards.positive_rate, Extrema(positive), 1.0},
        negative_{&guards.negative, &guards.negative_rate, Extrema(negative), -1.0},
        phases_(phases) {}

  // From touch-down at `begin` to lift-off at `end`; the slider starts where u is.
  void contact(const EventGuards& guards, double begin, double end) {
    end_ = end;
    positive_.level = guards.positive.value(begin);
    negative_.level = guards.negative.value(begin);
    positive_.next = positive_.extrema.after(begin, 0);
    negative_.next = negative_.extrema.after(begin, 0);
    run({ContactState::stick, StickOrigin::touch_down, begin, 0.0, -guards.spring.value(begin),
         begin});
  }

  // A whole period from extremum number i of w_P, where positive slip ends.
  void period(std::size_t i) {
    const double begin = positive_.extrema.phase(i);
    end_ = begin + two_pi;
    run(after_slip(positive_, i));
  }

 private:
  void run(EventPhase stick) {
    while (true) {
      const Onset up = onset(positive_, stick.begin, end_);
      const Onset down = onset(negative_, stick.begin, end_);
      const double until = std::min({up.phase, down.phase, end_});
      stick.length = until - stick.begin;
      phases_.push_back(stick);
      if (until >= end_) {
        return;
      }
      const bool upward = up.phase < down.phase || (up.phase == down.phase && faster_up(until));
      Side& side = upward ? positive_ : negative_;
      const std::size_t extremum = upward ? up.extremum : down.extremum;
      const double slip_end = std::min(side.extrema.phase(extremum), end_);
      phases_.push_back({upward ? ContactState::positive_slip : ContactState::negative_slip,
                         StickOrigin::none, until, slip_end - until});
      if (slip_end >= end_) {
        return;
      }
      stick = after_slip(side, extremum);
    }
  }

  // Both at once only where the band is empty, or by rounding.
  [[nodiscard]] bool faster_up(double phase) const {
    return positive_.rate->value(phase) >= -negative_.rate->value(phase);
  }

  EventPhase after_slip(const Side& side, std::size_t extremum) {
    const double phase = side.extrema.phase(extremum);
    const double value = side.guard->value(phase);
    const double offset = side.sign * limit_ - value;
    const bool up = side.sign > 0.0;
    positive_.level = up ? value : value + 2.0 * limit_;
    negative_.level = up ? value - 2.0 * limit_ : value;
    positive_.next = positive_.extrema.after(phase, up ? extremum + 1 : positive_.next);
    negative_.next = negative_.extrema.after(phase, up ? negative_.next : extremum + 1);
    return {ContactState::stick,
            up ? StickOrigin::positive_slip : StickOrigin::negative_slip,
            phase,
            0.0,
            offset,
            phase};
  }

  double limit_;
  Side positive_;
  Side negative_;
  std::vector<EventPhase>& phases_;
  double end_ = 0.0;
};

// The largest of sign · w over its extrema; w has no mean, so the value is ≥ 0 but for rounding.
struct Largest {
  double value = 0.0;
  std::size_t number = 0;
  bool found = false;
};

Largest largest(const TrigonometricPolynomial& guard, double sign,
                const std::vector<SignChange>& changes) {
  Largest best;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    if (changes[i].rising != (sign < 0.0)) {
      continue;
    }
    const double value = sign * guard.value(changes[i].phase);
    if (!best.found || value > best.value) {
      best = {value, i, true};
    }
  }
  return best;
}

}  // namespace

const EventPhases& EventSearch::find(const EventGuards& guards) {
  guards_ = &guards;
  result_.phases.clear();
  find_sign_changes(guards.load, load_);
  if (load_.empty() && !(guards.load.mean() > 0.0)) {
    result_.regime = CycleRegime::separated;
    result_.phases.push_back({ContactState::separated, StickOrigin::none, 0.0, two_pi});
    return result_;
  }
  find_sign_changes(guards.positive_rate, positive_);
  find_sign_changes(guards.negative_rate, negative_);
  if (load_.empty()) {
    find_loaded();
  } else {
    find_separation();
  }
  return result_;
}

void EventSearch::find_separation() {
  result_.regime = CycleRegime::separation;
  const std::size_t n = load_.size();
  const std::size_t first = load_[0].rising ? 0 : 1;
  for (std::size_t k = 0; k < n; k += 2) {
    const auto at = [&](std::size_t i) { return unwrapped(load_, i); };
    const std::size_t i = first + k;
    Walk(*guards_, positive_, negative_, result_.phases).contact(*guards_, at(i), at(i + 1));
    result_.phases.push_back(
        {ContactState::separated, StickOrigin::none, at(i + 1), at(i + 2) - at(i + 1)});
  }
}

void EventSearch::find_loaded() {
  const Largest top = largest(guards_->positive, 1.0, positive_);
  const Largest bottom = largest(guards_->negative, -1.0, negative_);
  const double high = guards_->limit - top.value;
  const double low = bottom.value - guards_->limit;
  if (low <= high || !top.found) {
    find_full_stick(high, top.found ? positive_[top.number].phase : 0.0, low,
                    bottom.found ? negative_[bottom.number].phase : 0.0);
    return;
  }
  result_.regime = CycleRegime::stick_slip;
  Walk(*guards_, positive_, negative_, result_.phases).period(top.number);
}

void EventSearch::find_full_stick(double high, double high_phase, double low, double low_phase) {
  result_.regime = CycleRegime::full_stick;
  EventPhase stick{ContactState::stick, StickOrigin::virgin, 0.0, two_pi, guards_->spring_mean};
  if (stick.offset < low) {
    stick.origin = StickOrigin::negative_slip;
    stick.offset = low;
    stick.memory = low_phase;
  } else if (stick.offset > high) {
    stick.origin = StickOrigin::positive_slip;
    stick.offset = high;
    stick.memory = high_phase;
  }
  result_.phases.push_back(stick);
}

}  // namespace microslip::contact
