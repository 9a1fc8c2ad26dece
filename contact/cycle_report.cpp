#include "contact/cycle_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace microslip::contact {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

// Stick, slip, separated.
std::size_t group(ContactState state) {
  switch (state) {
    case ContactState::stick:
      return 0;
    case ContactState::separated:
      return 2;
    default:
      return 1;
  }
}

// At `phase`, `weight` of area leaves one group for another.
struct Transition {
  double phase;
  double weight;
  std::size_t from;
  std::size_t to;
};

class PhaseSweep {
 public:
  void add(const FrictionCycle& cycle, double weight) {
    const auto segments = cycle.segments();
    const std::size_t n = segments.size();
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t here = group(segments[i].state);
      const std::size_t before = group(segments[(i + n - 1) % n].state);
      if (here != before) {
        transitions_.push_back({segments[i].start, weight, before, here});
      }
    }
    // At phase 0 the last segment is still running, unless the first begins there.
    area_[group(segments[n - 1].state)] += weight;
  }

  // Largest over the phase of the smallest area. Fractions held only for an interval of rounding
  // length between two transitions that should coincide do not count.
  double coexistence() {
    std::sort(transitions_.begin(), transitions_.end(),
              [](const Transition& a, const Transition& b) { return a.phase < b.phase; });
    double largest = 0.0;
    double phase = 0.0;
    for (const Transition& next : transitions_) {
      largest = std::max(largest, smallest_area(next.phase - phase));
      area_[next.from] -= next.weight;
      area_[next.to] += next.weight;
      phase = next.phase;
    }
    return std::max(largest, smallest_area(two_pi - phase));
  }

 private:
  [[nodiscard]] double smallest_area(double duration) const {
    constexpr double rounding = 1e-14;  // of transition angles of size 2π
    return duration > rounding ? *std::min_element(area_.begin(), area_.end()) : 0.0;
  }

  std::array<double, 3> area_{};
  std::vector<Transition> transitions_;
};

}  // namespace

CycleReport cycle_report(const ContactPatch& patch, const std::vector<PointMotion>& motions) {
  std::array<double, 3> share{};
  CycleReport report;
  PhaseSweep sweep;
  const double area = patch.weights().sum();
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const double weight = patch.weights()[static_cast<Eigen::Index>(i)];
    if (weight == 0.0) {
      continue;
    }
    const FrictionCycle cycle = friction_cycle(patch.points()[i], motions[i]);
    for (const CycleSegment& segment : cycle.segments()) {
      share[group(segment.state)] += weight * segment.length;
    }
    report.slip_work += weight * cycle.dissipated_energy;
    sweep.add(cycle, weight);
  }
  const double whole = share[0] + share[1] + share[2];
  if (whole > 0.0) {
    report.stick_share = share[0] / whole;
    report.slip_share = share[1] / whole;
    report.separated_share = share[2] / whole;
    const double coexistence = sweep.coexistence() / area;
    // Sums of weights that cancel leave rounding, not area.
    report.three_states_share = coexistence > 1e-12 ? coexistence : 0.0;
  }
  return report;
}

}  // namespace microslip::contact
