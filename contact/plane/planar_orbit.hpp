/// @file
/// One period of a planar slider from event to event (theory section 9).
///
///   stick      s constant until |K (x − s)| = r
///   slip       by collocation (planar_slip.hpp) until the slip rate ρ falls to 0
///   separated  no force; s = x where contact begins, slipping at once if |K x'| > r'
///
/// The end of stick is found to rounding (planar_stick.hpp). The end of slip is solved for as the
/// length of a last step. Steps are chosen so that the error of forces and slider is about the
/// tolerance; measured factors are in the tests.
#pragma once

#include <cstdint>
#include <vector>

#include "contact/contact_state.hpp"
#include "contact/plane/planar_intervals.hpp"
#include "contact/plane/planar_slip.hpp"

namespace microslip::contact {

/// What happens to the slider where a piece begins.
enum class PlanarEntry : std::uint8_t {
  continued,   ///< stick: nothing; slip: it begins to move, or goes on moving
  touch_down,  ///< s = x
  returned     ///< taken back to the edge of its ellipse: only where a period begins
};

struct PlanarPiece {
  ContactState state = ContactState::stick;  ///< stick, slip, separated
  PlanarEntry entry = PlanarEntry::continued;
  double begin = 0.0;
  double end = 0.0;
  PlanarInstant at_begin;  ///< derivatives of the inner side; in contact only
  Eigen::Vector2d before = Eigen::Vector2d::Zero();  ///< returned: slider before the return
  Eigen::Vector2d slider = Eigen::Vector2d::Zero();  ///< at begin, after the entry
  std::vector<SlipStep> steps;                       ///< slip only
};

struct PlanarOrbit {
  std::vector<PlanarPiece> pieces;
  Eigen::Vector2d begin = Eigen::Vector2d::Zero();  ///< slider the period began with
  Eigen::Vector2d end = Eigen::Vector2d::Zero();    ///< and ended with
  bool slips = false;
  bool separates = false;
  /// Bound of what the coefficients of the forces may miss, / F₀:
  /// 0 unless the walk ran out of steps.
  double defect = 0.0;
};

struct OrbitOptions {
  double tolerance = 1e-10;       ///< of forces, relative to F₀; 1e-13 to 1e-2
  double highest_harmonic = 1.0;  ///< that forces are integrated against, ≥ 1
  /// Pieces and steps of a period, and 200 per harmonic on top: hundreds are usual. Beyond, the
  /// rest of the period is walked in steps of a fixed length, and the defect of the orbit says so.
  int most_steps = 20000;
};

/// Walks one period.
/// @param slider  at the begin of the first interval, / L₀; without effect if that touches down.
[[nodiscard]] PlanarOrbit walk_orbit(const PlanarMotion& motion,
                                     const std::vector<PlanarInterval>& intervals,
                                     const Eigen::Vector2d& slider, const OrbitOptions& options);

}  // namespace microslip::contact
