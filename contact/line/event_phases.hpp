/// @file
/// The phases of a steady friction cycle under periodic motion with any number of harmonics, event
/// by event (theory section 8).
///
/// Slip P lasts until a maximum of w_P, N until a minimum of w_N; contact begins and ends where the
/// load changes sign; stick ends where w_P rises above q − c or w_N falls below −q − c. All extrema
/// and all signs of the load are known beforehand (find_sign_changes), so between two of them every
/// guard is monotone and has one crossing or none: no pair of events can be missed.
///
/// One walk gives the steady cycle (section 4.6 with a start that belongs to it):
///   with separation   from each touch-down, where s = u;
///   never separated   from the largest maximum of w_P: the slider is never below max w_P − q
///                     there, nor above it after the smallest minimum of w_N, if
///   full stick        does not hold: max w_P − q ≤ min w_N + q.
#pragma once

#include <cstdint>
#include <vector>

#include "contact/contact_state.hpp"
#include "contact/line/event_guards.hpp"
#include "contact/numerics/sign_changes.hpp"

namespace microslip::contact {

/// What set the memory c of a stick phase.
enum class StickOrigin : std::uint8_t { none, virgin, positive_slip, negative_slip, touch_down };

struct EventPhase {
  ContactState state = ContactState::stick;
  StickOrigin origin = StickOrigin::none;  ///< stick only
  double begin = 0.0;                      ///< [rad], in [0, 4π)
  double length = 0.0;                     ///< [rad], ≥ 0
  double offset = 0.0;                     ///< stick: c of f = spring + c
  double memory = 0.0;                     ///< stick: phase at which c was set [rad]
};

struct EventPhases {
  CycleRegime regime = CycleRegime::separated;
  std::vector<EventPhase> phases;  ///< in order of time; lengths sum to 2π; some may be 0
};

/// Finds phases; keeps its storage for the next motion.
class EventSearch {
 public:
  [[nodiscard]] const EventPhases& find(const EventGuards& guards);

 private:
  void find_separation();
  void find_loaded();
  void find_full_stick(double high, double high_phase, double low, double low_phase);

  const EventGuards* guards_ = nullptr;
  EventPhases result_;
  std::vector<SignChange> load_;
  std::vector<SignChange> positive_;  // of dw_P/dθ
  std::vector<SignChange> negative_;  // of dw_N/dθ
};

}  // namespace microslip::contact
