#include "contact/point/cycle_segments.hpp"

#include <algorithm>
#include <cmath>

#include "contact/phase.hpp"

namespace microslip::contact {

double wrapped_phase(double phase) {
  const double turned = phase - two_pi * std::floor(phase / two_pi);
  return turned >= 0.0 && turned < two_pi ? turned : 0.0;
}

std::vector<CycleSegment> joined_segments(const std::vector<CycleSegment>& phases,
                                          double shortest) {
  std::vector<CycleSegment> segments;
  for (const CycleSegment& next : phases) {
    const bool joins =
        segments.size() > 0 && (segments.back().state == next.state || next.length < shortest);
    if (joins) {
      segments.back().length += next.length;
    } else if (next.length >= shortest) {
      segments.push_back(next);
      segments.back().start = wrapped_phase(next.start);
    }
  }
  // Neighbours across the end of the list become one.
  if (segments.size() > 1 && segments.front().state == segments.back().state) {
    segments.back().length += segments.front().length;
    segments.erase(segments.begin());
  }
  const auto earliest = std::min_element(
      segments.begin(), segments.end(),
      [](const CycleSegment& a, const CycleSegment& b) { return a.start < b.start; });
  std::rotate(segments.begin(), earliest, segments.end());
  return segments;
}

}  // namespace microslip::contact
