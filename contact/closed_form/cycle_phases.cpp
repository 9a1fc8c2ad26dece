#include "contact/closed_form/cycle_phases.hpp"

#include <algorithm>
#include <cmath>

#include "contact/phase.hpp"

namespace microslip::contact {
namespace {

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

// Shares before roots: scaling all forces by a power of two, odd or even, changes no bit.
HalfAngle from_versines(double one_minus_cos, double one_plus_cos) {
  const double x = std::max(one_minus_cos, 0.0);
  const double y = std::max(one_plus_cos, 0.0);
  if (x + y <= 0.0) {
    return {0.0, {}};
  }
  const double s = std::sqrt(x / (x + y));
  const double c = std::sqrt(y / (x + y));
  return {2.0 * std::atan2(s, c), {2.0 * s * c, (c - s) * (c + s)}};
}

// What follows a slip phase: stick, then slip the other way until its own extremum.
struct Reversal {
  double stick;          // length of the stick phase
  double slip;           // length of the slip phase after it
  Direction slip_begin;  // where that slip phase begins
};

// `from` is the extremum at which slip ended, `to` the extremum of the other slip function, `ahead`
// the angle between them in [0, 2π]. Slip takes the last part of it; it begins at once where its
// level is behind already by rounding.
Reversal reversal(const Direction& from, const Direction& to, double ahead, double one_minus_cos,
                  double one_plus_cos) {
  const HalfAngle slip = from_versines(one_minus_cos, one_plus_cos);
  if (slip.angle >= ahead) {
    return {0.0, ahead, from};
  }
  return {ahead - slip.angle, slip.angle, to - slip.direction};
}

Reversal after_positive(const SlipFunctions& w, double ahead) {
  return reversal(w.end_of_positive, w.end_of_negative, ahead, w.excess, w.rest_negative);
}

Reversal after_negative(const SlipFunctions& w, double ahead) {
  return reversal(w.end_of_negative, w.end_of_positive, ahead, w.excess, w.rest_positive);
}

// From θ_P forward to θ_N, in (0, 2π], given θ_P − θ_N in [−2π, 2π]. The way back is the rest of
// the period, so that both ways together are one period even where θ_P = θ_N.
double from_positive_to_negative(double positive_minus_negative) {
  const double ahead = -positive_minus_negative;
  return ahead > 0.0 ? ahead : ahead + two_pi;
}

// Walks from the first instant of contact to the last.
class ContactWalk {
 public:
  ContactWalk(const SlipFunctions& w, CyclePhases& phases) : w_(w), phases_(phases) {
    const HalfAngle half = from_versines(w.above_open, w.below_closed);
    contact_ = 2.0 * half.angle;
    touch_down_ = w.largest_load - half.direction;
    lift_off_ = w.largest_load + half.direction;
    to_positive_ = angle(w.end_of_positive - touch_down_);
    to_negative_ = angle(w.end_of_negative - touch_down_);
  }

  void walk() {
    begin();
    for (int i = 0; i < 2 && time_ < contact_; ++i) {  // two reversals take a whole period
      reverse();
    }
    phases_.add({PhaseKind::separated, lift_off_, two_pi - contact_, 0.0});
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
    const double ahead = from_positive_to_negative(to_positive_ - to_negative_);
    if (last_ == PhaseKind::positive_slip) {
      const Reversal next = after_positive(w_, ahead);
      add(PhaseKind::stick_after_positive, w_.end_of_positive, next.stick, 0.0);
      slip(PhaseKind::negative_slip, next.slip_begin, next.slip);
    } else {
      const Reversal next = after_negative(w_, two_pi - ahead);
      add(PhaseKind::stick_after_negative, w_.end_of_negative, next.stick, 0.0);
      slip(PhaseKind::positive_slip, next.slip_begin, next.slip);
    }
  }

  const SlipFunctions& w_;
  CyclePhases& phases_;
  PhaseKind last_ = PhaseKind::separated;
  Direction touch_down_;      // θ_2
  Direction lift_off_;        // θ_1
  double contact_ = 0.0;      // 2γ
  double to_positive_ = 0.0;  // θ_P − θ_2 in [−π, π]
  double to_negative_ = 0.0;  // θ_N − θ_2
  double time_ = 0.0;         // since θ_2
};

void add_stick_slip(CyclePhases& phases, const SlipFunctions& w) {
  const double ahead = from_positive_to_negative(angle(w.end_of_positive - w.end_of_negative));
  const Reversal to_negative = after_positive(w, ahead);
  const Reversal to_positive = after_negative(w, two_pi - ahead);
  phases.add({PhaseKind::stick_after_positive, w.end_of_positive, to_negative.stick, 0.0});
  phases.add(
      {PhaseKind::negative_slip, to_negative.slip_begin, to_negative.slip, to_negative.slip});
  phases.add({PhaseKind::stick_after_negative, w.end_of_negative, to_positive.stick, 0.0});
  phases.add(
      {PhaseKind::positive_slip, to_positive.slip_begin, to_positive.slip, to_positive.slip});
}

}  // namespace

ContactState state_of(PhaseKind kind) {
  switch (kind) {
    case PhaseKind::separated:
      return ContactState::separated;
    case PhaseKind::positive_slip:
      return ContactState::positive_slip;
    case PhaseKind::negative_slip:
      return ContactState::negative_slip;
    default:
      return ContactState::stick;
  }
}

CycleRegime cycle_regime(const SlipFunctions& w) {
  if (w.above_open <= 0.0) {
    return CycleRegime::separated;
  }
  if (w.below_closed > 0.0) {
    return CycleRegime::separation;
  }
  return w.excess <= 0.0 ? CycleRegime::full_stick : CycleRegime::stick_slip;
}

CyclePhases cycle_phases(const SlipFunctions& w, CycleRegime regime) {
  CyclePhases phases;
  if (regime == CycleRegime::stick_slip) {
    add_stick_slip(phases, w);
  } else if (regime == CycleRegime::separation) {
    ContactWalk(w, phases).walk();
  }
  return phases;
}

}  // namespace microslip::contact
