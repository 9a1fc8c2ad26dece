#include "contact/planar_steady.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/LU>

namespace microslip::contact {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// Newton's method helps after this many periods: most sliders pushed into full stick have come to rest
/// by then, and where they do is history.
constexpr int patience = 2;
/// Beyond this the last orbit stands, with its defect; onset of slip converges like 1/periods.
constexpr int most_periods = 60;
/// The same for a march without help, at the corner of two ellipses.
constexpr int longest_march = 300;

/// The same where it is to tell rest from hardly any slip: a march that rests does so after a few periods, at
/// the corner it finds; one that creeps for longer tells nothing, and Newton's slider stands.
constexpr int deciding_march = 12;

/// Slip of a period that may be what is left of a search that ends at the tolerance, whatever the angle
/// between the edges it is pushed by: their corner loses the root of it at the most.
constexpr double hardly_any = 1e-4;

/// A slider of order one that moves by less in a period cannot be told from one that rests.
constexpr double rounding = 4e-15;

/// (I − M)⁻¹ b; a direction that the period leaves alone is left alone.
Eigen::Matrix2Xd solve_fixed_point(const Matrix2d& M, const Eigen::Matrix2Xd& b) {
  Eigen::FullPivLU<Matrix2d> lu(Matrix2d::Identity() - M);
  lu.setThreshold(1e-13);  // rounding of a period
  return lu.solve(b);
}

Matrix2d period_derivative(const PlanarMotion& motion, const PlanarOrbit& orbit) {
  OrbitVariation variation(motion, OrbitVariation::Columns::slider_only);
  variation.carry(orbit);
  return variation.slider();
}

double force_of(const PlanarMotion& motion, const Vector2d& slider) {
  return motion.stiffness().cwiseProduct(slider).norm();
}

/// What a period does to the slider, summed over its slip: of little slip this has all digits, which the
/// difference of two positions has not.
struct PeriodMove {
  Vector2d change = Vector2d::Zero();
  double path = 0.0;
};

PeriodMove period_move(const PlanarOrbit& orbit) {
  const RadauNodes& rule = radau_nodes();
  PeriodMove move;
  for (const PlanarPiece& piece : orbit.pieces) {
    if (piece.entry == PlanarEntry::returned) {
      move.change += piece.slider - piece.before;
      move.path += (piece.slider - piece.before).norm();
    }
    for (const SlipStep& step : piece.steps) {
      for (int i = 0; i < n_stages; ++i) {
        const double way = step.length * rule.weight[static_cast<std::size_t>(i)] * step.rate(i);
        move.change += way * step.direction.col(i);
        move.path += std::abs(way);
      }
    }
  }
  // Of much slip the steps know the end to their tolerance and no better, and the difference is as
  // good.
  constexpr double little = 1e-3;
  if (move.path > little) move.change = orbit.end - orbit.begin;
  return move;
}

/// Phases at which slip ends, once for every window of the period that pushes the slider.
std::vector<double> ends_of_slip(const PlanarOrbit& orbit) {
  std::vector<double> found;
  const std::vector<PlanarPiece>& pieces = orbit.pieces;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const PlanarPiece& next = pieces[i + 1 < pieces.size() ? i + 1 : 0];
    const bool ends = pieces[i].state == ContactState::slip && next.state != ContactState::slip;
    if (ends) found.push_back(pieces[i].end);
  }
  return found;
}

/// Smallest Newton step and smallest move of a period so far. Far from the cycle the first may grow while
/// the second shrinks; where one direction contracts fast and another slowly it is the other way round.
class Progress {
 public:
  /// Whether one of them has fallen, Newton steps by little at least where they creep; keeps the smaller.
  bool add(double newton, double move) {
    const bool falls = newton < 0.98 * newton_ || move < 0.9 * move_;
    newton_ = std::min(newton_, newton);
    move_ = std::min(move_, move);
    return falls;
  }

 private:
  double newton_ = INFINITY;
  double move_ = INFINITY;
};

/// Newton's method on the period map, with the march as its safeguard.
class FixedPoint {
 public:
  FixedPoint(const PlanarMotion& motion, const std::vector<PlanarInterval>& intervals,
             const OrbitOptions& options)
      : motion_(motion), intervals_(intervals), options_(options) {}

  SteadyOrbit solve() {
    SteadyOrbit steady = iterate();
    bool stuck = !steady.orbit.slips || (rests_ && !helped_);
    if (helped_ && (stuck || hardly_slips(steady.orbit))) {
      // Newton's steps may have come to the edge of the sliders that rest, from outside: what slips
      // still is the little it has not converged by. Where the march rests is told by the march
      // alone.
      SteadyOrbit marched = march(stuck ? longest_march : deciding_march);
      stuck = stuck || !marched.orbit.slips;
      if (stuck) steady = std::move(marched);
    }
    steady.regime = stuck ? CycleRegime::full_stick : CycleRegime::stick_slip;
    return steady;
  }

 private:
  [[nodiscard]] bool hardly_slips(const PlanarOrbit& orbit) const {
    return force_of(motion_, Vector2d::Constant(period_move(orbit).path)) <= hardly_any;
  }

  SteadyOrbit iterate() {
    SteadyOrbit steady;
    Vector2d slider = motion_.virgin_slider();
    Vector2d fallback = slider;
    Progress progress;
    int failures = 0;
    bool tried = false;
    for (int period = 0;; ++period) {
      if (period > 0 && !helped_) steady.history.push_back(std::move(steady.orbit));
      steady.orbit = walk_orbit(motion_, intervals_, slider, options_);
      steady.defect = 0.0;
      steady.closes = true;
      rests_ = false;
      if (!steady.orbit.slips) break;
      if (period + 1 == patience && rest_in_corner(steady)) break;
      const PeriodMove moved = period_move(steady.orbit);
      const Vector2d newton =
          solve_fixed_point(period_derivative(motion_, steady.orbit), moved.change);
      steady.defect = force_of(motion_, newton);
      const double size = force_of(motion_, moved.change);
      const double path = force_of(motion_, Vector2d::Constant(moved.path));
      rests_ = path <= 30.0 * rounding;  // slip of a few roundings at its two or more places
      steady.closes = rests_ || size <= rounding * std::min(1.0, 1e3 * path);
      if (steady.closes || steady.defect <= 0.1 * options_.tolerance) break;
      if (period >= most_periods) break;
      const bool improved = progress.add(steady.defect, size);
      failures += tried && !improved ? 1 : 0;
      // No progress this close: it is the steps of the walk that differ from period to period.
      if (failures >= 3 && steady.defect <= 1e4 * options_.tolerance) break;
      if (tried && !improved) {
        slider = fallback;
        tried = false;
        progress = {};
        continue;
      }
      fallback = steady.orbit.end;
      tried =
          period + 1 >= patience && newton.allFinite() && steady.defect < 4.0;  // none is farther
      slider = tried ? Vector2d(slider + newton) : fallback;
      helped_ = helped_ || tried;
    }
    return steady;
  }

  /// From the virgin slider, period by period, until it no longer moves.
  SteadyOrbit march(int most) {
    SteadyOrbit steady;
    Vector2d slider = motion_.virgin_slider();
    for (int period = 0; period < most; ++period) {
      if (period > 0) steady.history.push_back(std::move(steady.orbit));
      steady.orbit = walk_orbit(motion_, intervals_, slider, options_);
      steady.defect = force_of(motion_, steady.orbit.end - slider);
      steady.closes = steady.defect <= rounding;
      if (!steady.orbit.slips || steady.defect <= 0.01 * options_.tolerance) break;
      if (period + 1 >= patience && rest_in_corner(steady)) break;
      slider = steady.orbit.end;
    }
    return steady;
  }

  /// Whether the two windows that push in the last period leave the slider in their corner. If so the
  /// orbit is that of the slider at rest there.
  bool rest_in_corner(SteadyOrbit& steady) const {
    const std::vector<double> ends = ends_of_slip(steady.orbit);
    if (ends.size() != 2) return false;
    const std::optional<SliderCorner> corner =
        meeting_corner(motion_, {ends[0], ends[1]}, steady.orbit.end);
    if (!corner.has_value()) return false;
    PlanarOrbit rest = walk_orbit(motion_, intervals_, corner->slider, options_);
    if (rest.slips) return false;
    steady.orbit = std::move(rest);
    steady.corner = corner;
    steady.history.clear();
    steady.defect = 0.0;
    steady.closes = true;
    return true;
  }

  const PlanarMotion& motion_;
  const std::vector<PlanarInterval>& intervals_;
  const OrbitOptions& options_;
  bool helped_ = false;
  bool rests_ = false;  // the last period slipped by no more than rounding
};

bool any_contact(const std::vector<PlanarInterval>& intervals) {
  return std::any_of(intervals.begin(), intervals.end(),
                     [](const PlanarInterval& x) { return x.in_contact; });
}

}  // namespace

SteadyOrbit steady_orbit(const PlanarMotion& motion, const std::vector<PlanarInterval>& intervals,
                         const OrbitOptions& options) {
  if (!any_contact(intervals)) return {};
  SteadyOrbit steady;
  if (intervals.front().touches_down) {
    steady.orbit = walk_orbit(motion, intervals, Vector2d::Zero(), options);
    steady.regime = CycleRegime::separation;
    return steady;
  }
  return FixedPoint(motion, intervals, options).solve();
}

SteadyDerivative steady_derivative(const PlanarMotion& motion, const SteadyOrbit& steady) {
  OrbitVariation variation(motion, OrbitVariation::Columns::all);
  const Eigen::Index n = variation.n_parameters();
  if (steady.regime == CycleRegime::full_stick) {
    if (steady.corner.has_value()) {
      variation.set_corner_slider(*steady.corner);
    } else {
      variation.set_virgin_slider();
      for (const PlanarOrbit& before : steady.history) variation.carry(before);
    }
  }
  variation.carry_and_integrate(steady.orbit);
  SteadyDerivative result;
  result.first = variation.force(0).leftCols(n);
  result.second = variation.force(1).leftCols(n);
  if (steady.regime != CycleRegime::stick_slip) return result;
  const Eigen::Matrix2Xd memory =
      solve_fixed_point(variation.slider().rightCols(2), variation.slider().leftCols(n));
  result.first.noalias() += variation.force(0).rightCols(2) * memory;
  result.second.noalias() += variation.force(1).rightCols(2) * memory;
  return result;
}

}  // namespace microslip::contact
