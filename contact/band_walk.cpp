#include "contact/band_walk.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace microslip::contact {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

struct Slider {
  double position = 0.0;
  SliderOrigin origin = SliderOrigin::virgin;
  double memory = 0.0;
  bool stood = false;
};

Slider left_by(SliderOrigin origin, const BandNode& node) {
  const double at = origin == SliderOrigin::negative_slip ? node.upper : node.lower;
  return {at, origin, node.phase, node.turns};
}

/// Where the lower (sign 1) or upper (−1) end of the band reaches a position; there is one crossing between
/// low, where it has not, and high. Newton's method within a bracket: the force errs by the square of what
/// the phase does.
double crossing(SliderBand& band, double sign, double position, double low, double high) {
  constexpr double close = 1e-9;  // the next step would be its square
  double x = 0.5 * (low + high);
  for (int i = 0; i < 100 && high - low > close * 1e-5; ++i) {
    const BandInstant now = band.at(x);
    const double beyond = now.reach - sign * (now.position - position);  // > 0: not reached
    const double slope = now.reach_rate - sign * now.velocity;
    (beyond > 0.0 ? low : high) = x;
    const double newton = x - beyond / slope;
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
    const std::size_t first = cycle_.pieces.size();
    move(from, to, slider);
    if (from.turns && first < cycle_.pieces.size()) cycle_.pieces[first].begins_at_turn = true;
    if (to.turns) cycle_.pieces.back().ends_at_turn = true;
  }

 private:
  void move(const BandNode& from, const BandNode& to, Slider& slider) {
    if (!band_.has_spring()) {
      stick(from.phase, to.phase, from.edge, slider);
    } else if (slider.position < to.lower) {
      slip(1.0, slider.position > from.lower, from, to, slider);
      slider = left_by(SliderOrigin::positive_slip, to);
    } else if (slider.position > to.upper) {
      slip(-1.0, slider.position < from.upper, from, to, slider);
      slider = left_by(SliderOrigin::negative_slip, to);
    } else {
      stick(from.phase, to.phase, from.edge, slider);
    }
  }

  void slip(double sign, bool sticks_first, const BandNode& from, const BandNode& to,
            const Slider& slider) {
    double begin = from.phase;
    if (sticks_first) {
      begin = crossing(band_, sign, slider.position, from.phase, to.phase);
      stick(from.phase, begin, from.edge, slider);
    }
    const ContactState state =
        sign > 0.0 ? ContactState::positive_slip : ContactState::negative_slip;
    add({.state = state, .begin = begin, .end = to.phase}, from.edge && !sticks_first);
  }

  void stick(double begin, double end, bool at_edge, const Slider& slider) {
    add({.state = ContactState::stick,
         .begin = begin,
         .end = end,
         .slider = slider.position,
         .origin = slider.origin,
         .memory = slider.memory,
         .stood = slider.stood},
        at_edge);
  }

  /// Joined to the piece before where that goes on smoothly.
  void add(const BandPiece& piece, bool at_edge) {
    if (!at_edge && !cycle_.pieces.empty()) {
      BandPiece& last = cycle_.pieces.back();
      const bool same = last.state == piece.state && last.slider == piece.slider;
      if (same && last.end == piece.begin) {
        last.end = piece.end;
        return;
      }
    }
    cycle_.pieces.push_back(piece);
  }

  SliderBand& band_;
  BandCycle& cycle_;
};

/// Nodes of one period from the one with the largest w_P.
std::vector<BandNode> from_highest(const std::vector<BandNode>& nodes) {
  const auto last = nodes.end() - 1;
  const auto highest = std::max_element(
      nodes.begin(), last, [](const BandNode& a, const BandNode& b) { return a.lower < b.lower; });
  std::vector<BandNode> turned(highest, last);
  for (auto node = nodes.begin(); node <= highest; ++node) {
    turned.push_back(*node);
    turned.back().phase += two_pi;
  }
  return turned;
}

/// The virgin slider pushed into [highest.lower, lowest.upper].
Slider pushed(double virgin, const BandNode& highest, const BandNode& lowest) {
  if (virgin < highest.lower) return left_by(SliderOrigin::positive_slip, highest);
  if (virgin > lowest.upper) return left_by(SliderOrigin::negative_slip, lowest);
  return {virgin, SliderOrigin::virgin, 0.0, false};
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
    cycle.pieces.push_back({.state = ContactState::separated, .begin = 0.0, .end = two_pi});
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
    cycle.pieces.push_back(
        {.state = ContactState::separated, .begin = nodes.back().phase, .end = next});
  }
}

}  // namespace microslip::contact
