#include "contact/line/band_walk.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "contact/phase.hpp"

namespace microslip::contact {
namespace {

struct Slider {
  double position = 0.0;
  SliderOrigin origin = SliderOrigin::virgin;
  BandPlace memory;
  bool stood = false;
};

Slider left_by(SliderOrigin origin, const BandNode& node) {
  const double at = origin == SliderOrigin::negative_slip ? node.upper : node.lower;
  return {at, origin, node.place, node.turns};
}

/// Offset at which the lower (sign 1) or upper (−1) end of the band reaches a position; there is
/// one crossing in the stretch. Newton's method within a bracket:
/// the force errs by the square of what the phase does.
double crossing(SliderBand& band, double sign, double position, const BandStretch& stretch) {
  double low = stretch.begin;
  double high = stretch.end;
  const double close = 1e-9 * (high - low);  // the next step would be its square
  double x = 0.5 * (low + high);
  for (int i = 0; i < 100 && high - low > close * 1e-5; ++i) {
    const BandInstant now = band.at(BandPlace{stretch.anchor, x});
    const double beyond = now.reach - sign * (now.position - position);  // > 0: not reached
    const double slope = now.reach_rate - sign * now.velocity;
    (beyond > 0.0 ? low : high) = x;
    const double newton = slope != 0.0 ? x - beyond / slope : low;
    const bool inside = newton > low && newton < high;
    const double next = inside ? newton : 0.5 * (low + high);
    if (inside && std::abs(next - x) <= close) return next;
    x = next;
  }
  return x;
}

class Walk {
 public:
  Walk(SliderBand& band, BandCycle& cycle) : band_(band), cycle_(cycle) {}

  void cross(const BandNode& from, const BandNode& to, Slider& slider) {
    const BandStretch stretch = stretch_between(from, to);
    if (!band_.has_spring()) {
      stick(stretch, from.edge, slider);
    } else if (slider.position < to.lower) {
      slip(1.0, slider.position > from.lower, from.edge, stretch, slider);
      slider = left_by(SliderOrigin::positive_slip, to);
    } else if (slider.position > to.upper) {
      slip(-1.0, slider.position < from.upper, from.edge, stretch, slider);
      slider = left_by(SliderOrigin::negative_slip, to);
    } else {
      stick(stretch, from.edge, slider);
    }
  }

 private:
  void slip(double sign, bool sticks_first, bool at_edge, BandStretch stretch,
            const Slider& slider) {
    if (sticks_first) {
      BandStretch first = stretch;
      first.end = stretch.begin = crossing(band_, sign, slider.position, stretch);
      stick(first, at_edge, slider);
    }
    BandPiece piece = piece_over(stretch);
    piece.state = sign > 0.0 ? ContactState::positive_slip : ContactState::negative_slip;
    add(piece, at_edge && !sticks_first);
  }

  void stick(const BandStretch& stretch, bool at_edge, const Slider& slider) {
    BandPiece piece = piece_over(stretch);
    piece.slider = slider.position;
    piece.origin = slider.origin;
    piece.memory = slider.memory;
    piece.stood = slider.stood;
    add(piece, at_edge);
  }

  static BandPiece piece_over(const BandStretch& stretch) {
    BandPiece piece;
    piece.begin = stretch.anchor.phase + stretch.begin;
    piece.end = stretch.anchor.phase + stretch.end;
    piece.stretch = stretch;
    return piece;
  }

  /// Joined to the piece before where that goes on smoothly.
  void add(const BandPiece& piece, bool at_edge) {
    if (!at_edge && !cycle_.pieces.empty()) {
      BandPiece& last = cycle_.pieces.back();
      const bool same = last.state == piece.state && last.slider == piece.slider;
      const bool layered = piece.stretch.anchor.layered && piece.state != ContactState::stick;
      if (same && !layered && last.end == piece.begin) {
        last.end = piece.end;
        last.stretch = {{}, last.begin, last.end};
        return;
      }
    }
    cycle_.pieces.push_back(piece);
  }

  SliderBand& band_;
  BandCycle& cycle_;
};

BandPiece separation(double begin, double end) {
  BandPiece piece;
  piece.state = ContactState::separated;
  piece.begin = begin;
  piece.end = end;
  return piece;
}

/// Nodes of one period from the one with the largest w_P.
std::vector<BandNode> from_highest(const std::vector<BandNode>& nodes) {
  const auto last = nodes.end() - 1;
  const auto highest = std::max_element(
      nodes.begin(), last, [](const BandNode& a, const BandNode& b) { return a.lower < b.lower; });
  std::vector<BandNode> turned(highest, last);
  for (auto node = nodes.begin(); node <= highest; ++node) {
    turned.push_back(*node);
    turned.back().phase += two_pi;
    BandPlace& place = turned.back().place;
    (place.anchor.layered ? place.anchor.phase : place.offset) += two_pi;
  }
  return turned;
}

/// The virgin slider pushed into [highest.lower, lowest.upper].
Slider pushed(double virgin, const BandNode& highest, const BandNode& lowest) {
  if (virgin < highest.lower) return left_by(SliderOrigin::positive_slip, highest);
  if (virgin > lowest.upper) return left_by(SliderOrigin::negative_slip, lowest);
  return {virgin, SliderOrigin::virgin, {}, false};
}

void walk_period(SliderBand& band, const std::vector<BandNode>& run, BandCycle& cycle) {
  const std::vector<BandNode> nodes = from_highest(run);
  const BandNode& lowest =
      *std::min_element(nodes.begin(), nodes.end(),
                        [](const BandNode& a, const BandNode& b) { return a.upper < b.upper; });
  const bool stuck = nodes.front().lower <= lowest.upper || !band.has_spring();
  cycle.regime = stuck ? CycleRegime::full_stick : CycleRegime::stick_slip;
  Slider slider = stuck ? pushed(-band.position_mean(), nodes.front(), lowest)
                        : left_by(SliderOrigin::positive_slip, nodes.front());
  Walk walk(band, cycle);
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) walk.cross(nodes[i], nodes[i + 1], slider);
}

}  // namespace

void walk_band(SliderBand& band, BandCycle& cycle) {
  cycle.pieces.clear();
  cycle.regime = CycleRegime::separated;
  const std::vector<ContactRun>& runs = band.find_runs();
  if (runs.empty()) {
    cycle.pieces.push_back(separation(0.0, two_pi));
    return;
  }
  if (!runs.front().touches_down) {
    walk_period(band, runs.front().nodes, cycle);
    return;
  }
  cycle.regime = CycleRegime::separation;
  Walk walk(band, cycle);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::vector<BandNode>& nodes = runs[i].nodes;
    Slider slider = left_by(SliderOrigin::touch_down, nodes.front());
    for (std::size_t j = 0; j + 1 < nodes.size(); ++j) walk.cross(nodes[j], nodes[j + 1], slider);
    const bool last = i + 1 == runs.size();
    const double next =
        last ? runs.front().nodes.front().phase + two_pi : runs[i + 1].nodes.front().phase;
    cycle.pieces.push_back(separation(nodes.back().phase, next));
  }
}

}  // namespace microslip::contact
