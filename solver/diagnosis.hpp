/// @file
/// What ended a curve early, and what was done where a step failed: values in code,
/// names in files and messages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <ostream>

namespace microslip::solver {

/// What ended a curve, or broke it.
enum class Diagnosis : std::uint8_t {
  none,           ///< complete
  no_start,       ///< no solution at the begin of the range
  newton_stall,   ///< Newton's method fails and no remedy helps
  fold_lost,      ///< the same next to a fold: the branch turns, no way on was found
  event_chatter,  ///< the same where the Jacobian jumps within the smallest step
  /// Beyond such a point only another branch was found; points before and after are valid.
  branch_jump,
  /// A branch entered by a jump is closed and does not reach the end, or the walk comes back to a
  /// fold that it has passed.
  loop,
  budget,  ///< max_points were not enough, or the time that whoever asked for the curve gives it
  /// The branch turned back out of the range at its begin; in time: beyond all numbers.
  out_of_range,
  unbounded,     ///< at an undamped resonance that nothing limits
  not_periodic,  ///< in time: motions that do not repeat themselves
  interrupted,   ///< the observer asked to stop
  uncertified    ///< solutions whose proof fails (curve/certificate.hpp)
};

/// What helped where a step had failed, or was done in its place.
enum class Remedy : std::uint8_t {
  shorter_step,
  kink_turn,
  long_step,
  states_at_once,   ///< a step that changes more of the contact's states than one should
  fixed_frequency,  ///< the branch entered anew by the plain corrector
  homotopy,         ///< the same from a linear limit
  other_branch,     ///< the same, on another one
  other_end,        ///< the curve is that from the end of the range
  located_events,   ///< the whole curve traced again, events located in place of sampled forces
  harmonics_kept,   ///< the choice of harmonics did not settle
  /// There is one, of which the nearest point found is marked, within the step in which it lies.
  peak_unsolved,
  fold_unsolved,  ///< likewise
  more_instants,  ///< the whole curve traced again, twice as many of a period sampled
  row_left_out,   ///< a solution whose proof fails is no row of the curve
  past_loop       ///< the whole curve traced again, over steps that led the walk back
};

namespace names {

template <typename Value>
struct Name {
  Value value;
  const char* text;
};

inline constexpr std::array diagnoses{
    Name<Diagnosis>{Diagnosis::none, ""},
    Name<Diagnosis>{Diagnosis::no_start, "no-start"},
    Name<Diagnosis>{Diagnosis::newton_stall, "newton-stall"},
    Name<Diagnosis>{Diagnosis::fold_lost, "fold-lost"},
    Name<Diagnosis>{Diagnosis::event_chatter, "event-chatter"},
    Name<Diagnosis>{Diagnosis::branch_jump, "branch-jump"},
    Name<Diagnosis>{Diagnosis::loop, "loop"},
    Name<Diagnosis>{Diagnosis::budget, "budget"},
    Name<Diagnosis>{Diagnosis::out_of_range, "out-of-range"},
    Name<Diagnosis>{Diagnosis::unbounded, "unbounded"},
    Name<Diagnosis>{Diagnosis::not_periodic, "not-periodic"},
    Name<Diagnosis>{Diagnosis::interrupted, "interrupted"},
    Name<Diagnosis>{Diagnosis::uncertified, "uncertified"},
};

inline constexpr std::array remedies{
    Name<Remedy>{Remedy::shorter_step, "shorter-step"},
    Name<Remedy>{Remedy::kink_turn, "kink-turn"},
    Name<Remedy>{Remedy::long_step, "long-step"},
    Name<Remedy>{Remedy::states_at_once, "states-at-once"},
    Name<Remedy>{Remedy::fixed_frequency, "fixed-frequency"},
    Name<Remedy>{Remedy::homotopy, "homotopy"},
    Name<Remedy>{Remedy::other_branch, "other-branch"},
    Name<Remedy>{Remedy::other_end, "other-end"},
    Name<Remedy>{Remedy::located_events, "located-events"},
    Name<Remedy>{Remedy::harmonics_kept, "harmonics-kept"},
    Name<Remedy>{Remedy::peak_unsolved, "peak-unsolved"},
    Name<Remedy>{Remedy::fold_unsolved, "fold-unsolved"},
    Name<Remedy>{Remedy::more_instants, "more-instants"},
    Name<Remedy>{Remedy::row_left_out, "row-left-out"},
    Name<Remedy>{Remedy::past_loop, "past-loop"},
};

/// Whether a row is at the place of its value.
constexpr bool is_in_order(const auto& table) {
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (static_cast<std::size_t>(table[i].value) != i) return false;
  }
  return true;
}
static_assert(is_in_order(diagnoses) && is_in_order(remedies));

}  // namespace names

[[nodiscard]] constexpr const char* to_string(Diagnosis diagnosis) {
  return names::diagnoses.at(static_cast<std::size_t>(diagnosis)).text;
}
[[nodiscard]] constexpr const char* to_string(Remedy remedy) {
  return names::remedies.at(static_cast<std::size_t>(remedy)).text;
}

inline std::ostream& operator<<(std::ostream& out, Diagnosis diagnosis) {
  return out << to_string(diagnosis);
}
inline std::ostream& operator<<(std::ostream& out, Remedy remedy) {
  return out << to_string(remedy);
}

}  // namespace microslip::solver
