#include "contact/force/cycle_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/phase.hpp"

namespace microslip::contact {
namespace {

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

// Of segments that follow one another once round the period no more than rounding.
double event_gap(std::span<const CycleSegment> segments) {
  double gap = 0.0;
  double whole = 0.0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const CycleSegment& here = segments[i];
    const double next = segments[(i + 1) % segments.size()].start;
    gap += std::abs(std::remainder(here.start + here.length - next, two_pi));
    gap += std::max(-here.length, 0.0);
    whole += here.length;
  }
  return gap + std::abs(whole - two_pi);
}

// At `phase`, `weight` of area leaves one group for another.
struct Transition {
  double phase;
  double weight;
  std::size_t from;
  std::size_t to;
};

}  // namespace

class ReportSum::PhaseSweep {
 public:
  void add(std::span<const CycleSegment> segments, double weight) {
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
  [[nodiscard]] double coexistence() const {
    std::vector<Transition> transitions = transitions_;
    std::array<double, 3> area = area_;
    std::sort(transitions.begin(), transitions.end(),
              [](const Transition& a, const Transition& b) { return a.phase < b.phase; });
    double largest = 0.0;
    double phase = 0.0;
    for (const Transition& next : transitions) {
      largest = std::max(largest, smallest_area(area, next.phase - phase));
      area[next.from] -= next.weight;
      area[next.to] += next.weight;
      phase = next.phase;
    }
    return std::max(largest, smallest_area(area, two_pi - phase));
  }

 private:
  [[nodiscard]] static double smallest_area(const std::array<double, 3>& area, double duration) {
    constexpr double rounding = 1e-14;  // of transition angles of size 2π
    return duration > rounding ? *std::min_element(area.begin(), area.end()) : 0.0;
  }

  std::array<double, 3> area_{};
  std::vector<Transition> transitions_;
};

ReportSum::ReportSum() : sweep_(std::make_unique<PhaseSweep>()) {}
ReportSum::~ReportSum() = default;

void ReportSum::add(std::span<const CycleSegment> segments, double dissipated_energy,
                    double weight) {
  if (weight == 0.0) {
    return;
  }
  for (const CycleSegment& segment : segments) {
    share_[group(segment.state)] += weight * segment.length;
  }
  area_ += weight;
  slip_work_ += weight * dissipated_energy;
  const double gap = event_gap(segments);
  if (!(gap <= event_gap_) && !std::isnan(event_gap_)) event_gap_ = gap;
  sweep_->add(segments, weight);
}

CycleReport ReportSum::result() const {
  CycleReport report;
  report.slip_work = slip_work_;
  report.event_gap = event_gap_;
  const double whole = share_[0] + share_[1] + share_[2];
  if (whole > 0.0) {
    report.stick_share = share_[0] / whole;
    report.slip_share = share_[1] / whole;
    report.separated_share = share_[2] / whole;
    const double coexistence = sweep_->coexistence() / area_;
    // Sums of weights that cancel leave rounding, not area.
    report.three_states_share = coexistence > 1e-12 ? coexistence : 0.0;
  }
  return report;
}

}  // namespace microslip::contact
