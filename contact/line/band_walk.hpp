/// @file
/// The steady cycle of a slider in its band (slider_band.hpp):
/// pieces of stick and slip in order of time.
///
/// On a stretch both ends of the band are monotone. The slider is taken along by w_P if that ends
/// above it, by w_N if that ends below it, and rests otherwise, so that a stretch has one
/// transition at most, the root of a monotone function.
///
/// One walk gives the steady cycle (theory section 4.6 with a start that belongs to it):
///   with separation   from each touch-down, where s = u;
///   never separated   from the largest w_P, where s = w_P, unless the point sticks throughout:
///                     max w_P ≤ min w_N, with the virgin slider pushed into [max w_P,
///                     min w_N] (section 4.2).
#pragma once

#include <cstdint>
#include <vector>

#include "contact/contact_state.hpp"
#include "contact/line/slider_band.hpp"

namespace microslip::contact {

/// What left the slider where a stick piece finds it.
enum class SliderOrigin : std::uint8_t { none, virgin, positive_slip, negative_slip, touch_down };

/// The law is smooth inside, and in slip so is the coefficient: one layer of it is several pieces.
struct BandPiece {
  ContactState state = ContactState::stick;
  double begin = 0.0;  ///< [rad], in [0, 4π)
  double end = 0.0;
  BandStretch stretch;                       ///< the same counted from an anchor
  double slider = 0.0;                       ///< stick: s, with u counted without its mean [m]
  SliderOrigin origin = SliderOrigin::none;  ///< stick
  BandPlace memory;                          ///< stick: where the slider was left
  bool stood = false;                        ///< and whether this was the kink of |u'|

  /// Of the friction in slip.
  [[nodiscard]] double slip_sign() const {
    return state == ContactState::positive_slip ? 1.0 : -1.0;
  }
};

struct BandCycle {
  CycleRegime regime = CycleRegime::separated;
  std::vector<BandPiece> pieces;  ///< in order of time; lengths sum to 2π
};

/// @param cycle  written whole; storage is used again.
void walk_band(SliderBand& band, BandCycle& cycle);

}  // namespace microslip::contact
