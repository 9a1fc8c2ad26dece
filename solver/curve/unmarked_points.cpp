#include "solver/curve/unmarked_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace microslip::solver {
namespace {

// Relative. Where a branch turns back at a kink it is known to the walker's shortest step, 1e-7 of
// the amplitude; a fold that is solved for there stands within as much of the frequency, in front
// of rows or behind some.
constexpr double amplitude_resolution = 1e-6;
constexpr double frequency_resolution = 1e-7;
constexpr std::size_t close_by = 2;  // rows: peak and fold of one kink follow each other

/// Share of its amplitude that a row is known to.
double uncertainty(const ResponsePoint& point) {
  return 0.5 * amplitude_resolution + point.harmonics_left_out;
}

bool is_higher(const ResponsePoint& point, const ResponsePoint& neighbour) {
  const double unsure = uncertainty(point) + uncertainty(neighbour);
  return point.amplitude > (1.0 + unsure) * neighbour.amplitude;
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

/// 1: the frequency of the branch is highest there; −1: lowest; 0: neither, or it is not told.
int turn_at(const std::vector<ResponsePoint>& points, std::size_t row) {
  const double here = points[row].frequency;
  const auto way_to = [&](auto begin, auto end) {
    const auto apart = std::find_if(begin, end, [&](const ResponsePoint& other) {
      return std::abs(other.frequency - here) > frequency_resolution * here;
    });
    return apart == end ? 0 : (apart->frequency < here ? 1 : -1);
  };
  const auto at = points.begin() + static_cast<std::ptrdiff_t>(row);
  const int before = way_to(std::make_reverse_iterator(at), points.rend());
  return before == way_to(at + 1, points.end()) ? before : 0;
}

bool turns(const std::vector<ResponsePoint>& points, std::size_t row) {
  const double before = points[row].frequency - points[row - 1].frequency;
  const double after = points[row + 1].frequency - points[row].frequency;
  return before * after < 0.0 && turn_at(points, row) != 0;
}

/// A fold that turns the same way, or one of which that is not told.
bool has_fold_near(const ResponseCurve& curve, std::size_t row) {
  const auto& points = curve.points;
  const double here = points[row].frequency;
  const int way = turn_at(points, row);
  const auto is_near = [&](std::size_t i) {
    const std::size_t apart = i > row ? i - row : row - i;
    return apart <= close_by || std::abs(points[i].frequency - here) <= frequency_resolution * here;
  };
  const auto is_it = [&](std::size_t i) {
    return points[i].mark == PointMark::fold && turn_at(points, i) * way >= 0;
  };
  for (std::size_t i = row + 1; i-- > 0 && is_near(i);) {
    if (is_it(i)) return true;
  }
  for (std::size_t i = row + 1; i < points.size() && is_near(i); ++i) {
    if (is_it(i)) return true;
  }
  return false;
}

/// A row has one mark: a peak at which the branch turns as well stands twice.
void mark_fold(ResponseCurve& curve, std::size_t row) {
  if (curve.points[row].mark == PointMark::peak) {
    ResponsePoint again = curve.points[row];
    again.iterations = 0;
    again.contact_evaluations = 0;
    again.seconds = 0.0;
    curve.points.insert(curve.points.begin() + static_cast<std::ptrdiff_t>(row), std::move(again));
  }
  curve.points[row].mark = PointMark::fold;
  curve.log.push_back({curve.points[row].frequency, Remedy::fold_unsolved});
}

}  // namespace

void mark_unsolved(ResponseCurve& curve) {
  if (!curve.complete || was_entered_anew(curve)) return;
  for (std::size_t i = 1; i + 1 < curve.points.size(); ++i) {
    const ResponsePoint& a = curve.points[i - 1];
    ResponsePoint& b = curve.points[i];
    const ResponsePoint& c = curve.points[i + 1];
    if (b.mark == PointMark::fold) continue;
    if (turns(curve.points, i) && !has_fold_near(curve, i)) {
      mark_fold(curve, i);
    } else if (b.mark == PointMark::none && !is_marked_near(curve, i, PointMark::peak) &&
               is_higher(b, a) && is_higher(b, c)) {
      b.mark = PointMark::peak;
      curve.log.push_back({b.frequency, Remedy::peak_unsolved});
    }
  }
}

}  // namespace microslip::solver
