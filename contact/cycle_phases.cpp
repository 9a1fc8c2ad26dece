#include "contact/cycle_phases.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace microslip::contact {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

// Sum and difference of angles, as directions.
Direction operator+(const Direction& a, const Direction& b) {
  return {a.sin * b.cos + a.cos * b.sin, a.cos * b.cos - a.sin * b.sin};
}
Direction operator-(const Direction& a, const Direction& b) {
  return {a.sin * b.cos - a.cos * b.sin, a.cos * b.cos + a.sin * b.sin};
}

// In [−π, π].
double angle(const Direction& d) { return std::atan2(d.sin, d.cos); }

// An angle in [0, π] given by 1 − cos : 1 + cos, with its direction.
struct HalfAngle {
  double angle;
  Direction direction;
};

HalfAngle from_versines(double one_minus_cos, double one_plus_cos) {
  const double s = std::sqrt(std::max(one_minus_cos, 0.0));
  const double c = std::sqrt(std::max(one_plus_cos, 0.0));
  const double square = s * s + c * c;
  if (square <= 0.0) {
    return {0.0, {}};
  }
  return {2.0 * std::atan2(s, c), {2.0 * s * c / square, (c - s) * (c + s) / square}};
}

// What follows a slip phase: stick, then slip the other way until its own extremum.
struct Reversal {
  double stick;          // length of the stick phase
  double slip;           // length of the slip phase after it
  Direction slip_begin;  // where that slip phase begins
};

// `from` is the extremum at which slip ended, `to` the extremum of the other slip function,
// y = from − to in [−π, π].
Reversal reversal(const Direction& from, const Direction& to, double y, double one_minus_cos,
                  double one_plus_cos) {
  const HalfAngle slip = from_versines(one_minus_cos, one_plus_cos);
  if (y >= 0.0) {
    return {two_pi - slip.angle - y, slip.angle, to - slip.direction};
  }
  if (slip.angle + y >= 0.0) {
    return {0.0, -y, from};
  }
  return {-slip.angle - y, slip.angle, to - slip.direction};
}

Reversal after_positive(const SlipFunctions& w, double positive_minus_negative) {
  return reversal(w.end_of_positive, w.end_of_negative, positive_minus_negative, w.excess,
                  2.0 * w.limit + w.difference);
}

Reversal after_negative(const SlipFunctions& w, double positive_minus_negative) {
  return reversal(w.end_of_negative, w.end_of_positive, -positive_minus_negative, w.excess,
                  2.0 * w.limit - w.difference);
}

double wrapped(double x) {
  return x > std::numbers::pi ? x - two_pi : (x < -std::numbers::pi ? x + two_pi : x);
}

// Walks from the first instant of contact to the last.
class ContactWalk {
 public:
  explicit ContactWalk(const SlipFunctions& w) : w_(w) {
    const HalfAngle half = from_versines(w.above_open, w.below_closed);
    contact_ = 2.0 * half.angle;
    touch_down_ = w.largest_load - half.direction;
    lift_off_ = w.largest_load + half.direction;
    to_positive_ = angle(w.end_of_positive - touch_down_);
    to_negative_ = angle(w.end_of_negative - touch_down_);
  }

  CyclePhases walk() {
    begin();
    for (int i = 0; i < 2 && time_ < contact_; ++i) {  // two reversals take a whole period
      reverse();
    }
    phases_.add({PhaseKind::separated, lift_off_, two_pi - contact_, 0.0});
    return phases_;
  }

 private:
  // Adds one phase of the given length, cut off at the end of contact.
  void add(PhaseKind kind, const Direction& from, double length, double to_extremum) {
    if (time_ < contact_) {
      phases_.add({kind, from, std::min(length, contact_ - time_), to_extremum});
      time_ += length;
    }
  }

  void slip(PhaseKind kind, const Direction& from, double length) {
    add(kind, from, length, length);
    last_ = kind;
  }

  // The rates at touch-down decide: ẇ_P > 0 slips positively, ẇ_N < 0 negatively, else stick until
  // the slip function is back at its value of touch-down, mirrored about its extremum.
  void begin() {
    bool positive = to_positive_ > 0.0 && w_.positive > 0.0;
    bool negative = to_negative_ > 0.0 && w_.negative > 0.0;
    if (positive && negative) {  // only by rounding; the faster one
      positive = w_.positive * std::sin(to_positive_) >= w_.negative * std::sin(to_negative_);
      negative = !positive;
    }
    if (positive) {
      slip(PhaseKind::positive_slip, touch_down_, to_positive_);
    } else if (negative) {
      slip(PhaseKind::negative_slip, touch_down_, to_negative_);
    } else {
      stick_first();
    }
  }

  void stick_first() {
    const double until_positive = time_of_mirror(to_positive_, w_.positive);
    const double until_negative = time_of_mirror(to_negative_, w_.negative);
    const bool positive = until_positive <= until_negative;
    const double until = positive ? until_positive : until_negative;
    const Direction& extremum = positive ? w_.end_of_positive : w_.end_of_negative;
    add(PhaseKind::stick_after_separation, touch_down_, until, 0.0);
    const double to_extremum = positive ? to_positive_ : to_negative_;
    slip(positive ? PhaseKind::positive_slip : PhaseKind::negative_slip,
         extremum + extremum - touch_down_, to_extremum + two_pi - until);
  }

  // A slip function that does not vary is never reached again.
  static double time_of_mirror(double to_extremum, double size) {
    return size > 0.0 && to_extremum <= 0.0 ? 2.0 * to_extremum + two_pi : two_pi;
  }

  void reverse() {
    const double y = wrapped(to_positive_ - to_negative_);
    if (last_ == PhaseKind::positive_slip) {
      const Reversal next = after_positive(w_, y);
      add(PhaseKind::stick_after_positive, w_.end_of_positive, next.stick, 0.0);
      slip(PhaseKind::negative_slip, next.slip_begin, next.slip);
    } else {
      const Reversal next = after_negative(w_, y);
      add(PhaseKind::stick_after_negative, w_.end_of_negative, next.stick, 0.0);
      slip(PhaseKind::positive_slip, next.slip_begin, next.slip);
    }
  }

  const SlipFunctions& w_;
  CyclePhases phases_;
  PhaseKind last_ = PhaseKind::separated;
  Direction touch_down_;      // θ_2
  Direction lift_off_;        // θ_1
  double contact_ = 0.0;      // 2γ
  double to_positive_ = 0.0;  // θ_P − θ_2 in [−π, π]
  double to_negative_ = 0.0;  // θ_N − θ_2
  double time_ = 0.0;         // since θ_2
};

}  // namespace

CycleRegime cycle_regime(const SlipFunctions& w) {
  if (w.above_open <= 0.0) {
    return CycleRegime::separated;
  }
  if (w.below_closed > 0.0) {
    return CycleRegime::separation;
  }
  return w.excess <= 0.0 ? CycleRegime::full_stick : CycleRegime::stick_slip;
}

CyclePhases stick_slip_phases(const SlipFunctions& w) {
  const double y = angle(w.end_of_positive - w.end_of_negative);
  const Reversal to_negative = after_positive(w, y);
  const Reversal to_positive = after_negative(w, y);
  CyclePhases phases;
  phases.add({PhaseKind::stick_after_positive, w.end_of_positive, to_negative.stick, 0.0});
  phases.add(
      {PhaseKind::negative_slip, to_negative.slip_begin, to_negative.slip, to_negative.slip});
  phases.add({PhaseKind::stick_after_negative, w.end_of_negative, to_positive.stick, 0.0});
  phases.add(
      {PhaseKind::positive_slip, to_positive.slip_begin, to_positive.slip, to_positive.slip});
  return phases;
}

CyclePhases separation_phases(const SlipFunctions& w) { return ContactWalk(w).walk(); }

}  // namespace microslip::contact
