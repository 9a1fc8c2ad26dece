#include "solver/curve/unmarked_points.hpp"

#include <algorithm>
#include <cmath>

namespace microslip::solver {
namespace {

// Relative. Where a branch turns back at a kink it is known to the walker's shortest step, 1e-7 of
// the amplitude; of the frequency, where that is a tenth of the width of a resonance at the most,
// to less.
constexpr double amplitude_resolution = 1e-6;
constexpr double frequency_resolution = 1e-8;
constexpr std::size_t close_by = 2;  // rows: peak and fold of one kink follow each other

/// Share of its amplitude that a row is known to.
double uncertainty(const ResponsePoint& point) {
  return 0.5 * amplitude_resolution + point.harmonics_left_out;
}

bool is_higher(const ResponsePoint& point, const ResponsePoint& neighbour) {
  const double unsure = uncertainty(point) + uncertainty(neighbour);
  return point.amplitude > (1.0 + unsure) * neighbour.amplitude;
}

bool turns(const ResponsePoint& a, const ResponsePoint& b, const ResponsePoint& c) {
  const double before = b.frequency - a.frequency;
  const double after = c.frequency - b.frequency;
  const double least = frequency_resolution * b.frequency;
  return before * after < 0.0 && std::abs(before) > least && std::abs(after) > least;
}

bool was_entered_anew(const ResponseCurve& curve) {
  return std::any_of(curve.log.begin(), curve.log.end(), [](const SolverEvent& event) {
    return event.remedy == Remedy::fixed_frequency || event.remedy == Remedy::homotopy ||
           event.remedy == Remedy::other_branch;
  });
}

bool is_marked_near(const ResponseCurve& curve, std::size_t row, PointMark mark) {
  const std::size_t last = std::min(row + close_by, curve.points.size() - 1);
  for (std::size_t i = row > close_by ? row - close_by : 0; i <= last; ++i) {
    if (curve.points[i].mark == mark) return true;
  }
  return false;
}

}  // namespace

void mark_unsolved(ResponseCurve& curve) {
  if (!curve.complete || was_entered_anew(curve)) return;
  for (std::size_t i = 1; i + 1 < curve.points.size(); ++i) {
    const ResponsePoint& a = curve.points[i - 1];
    ResponsePoint& b = curve.points[i];
    const ResponsePoint& c = curve.points[i + 1];
    if (b.mark != PointMark::none) continue;
    if (!is_marked_near(curve, i, PointMark::fold) && turns(a, b, c)) {
      b.mark = PointMark::fold;
      curve.log.push_back({b.frequency, Remedy::fold_unsolved});
    } else if (!is_marked_near(curve, i, PointMark::peak) && is_higher(b, a) && is_higher(b, c)) {
      b.mark = PointMark::peak;
      curve.log.push_back({b.frequency, Remedy::peak_unsolved});
    }
  }
}

}  // namespace microslip::solver
