#include "contact/plane/planar_steady.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/LU>

#include "contact/plane/planar_rest.hpp"

namespace microslip::contact {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// Beyond this the last orbit stands, with its defect.
constexpr int most_periods = 60;
/// The same for a march into full stick, without help but that of a corner.
constexpr int longest_march = 300;
/// A march that takes longer goes along a valley between two windows.
constexpr int slow_march = 20;

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

/// What a period does to the slider, summed over its slip: of little slip this has all digits,
/// which the difference of two positions has not.
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

/// Smallest Newton step and smallest move of a period so far. Far from the cycle the first may grow
/// while the second shrinks; where one direction contracts fast and another slowly it is the other
/// way round.
class Progress {
 public:
  /// Whether one of them has fallen, Newton steps by little at least where they creep;
  /// keeps the smaller.
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
    SteadyOrbit steady;
    steady.orbit = walk_orbit(motion_, intervals_, motion_.virgin_slider(), options_);
    steady.regime = CycleRegime::full_stick;
    if (!steady.orbit.slips) return steady;
    const RestPlace place = best_rest(motion_, intervals_, steady.orbit.end);
    if (place.answer == RestPlace::Answer::rests) {
      if (!march(steady)) rest_towards(place.slider, steady);
    } else {
      const bool near = place.converged && place.answer == RestPlace::Answer::slips;
      steady = iterate(near ? place.slider : steady.orbit.end);
      if (steady.orbit.slips) steady.regime = CycleRegime::stick_slip;
    }
    return steady;
  }

 private:
  /// One period from a slider, and what Newton's method makes of it.
  struct Trial {
    Vector2d slider = Vector2d::Zero();
    Vector2d moved = Vector2d::Zero();
    Vector2d newton = Vector2d::Zero();
    double size = 0.0;  ///< of the move, in f / F₀
  };

  Trial walk_from(const Vector2d& slider, SteadyOrbit& steady) const {
    steady.orbit = walk_orbit(motion_, intervals_, slider, options_);
    const PeriodMove moved = period_move(steady.orbit);
    Trial trial{slider, moved.change, {}, force_of(motion_, moved.change)};
    trial.newton = solve_fixed_point(period_derivative(motion_, steady.orbit), moved.change);
    steady.defect = steady.orbit.slips ? force_of(motion_, trial.newton) : 0.0;
    const double path = force_of(motion_, Vector2d::Constant(moved.path));
    const bool rests =
        path <= 30.0 * rounding;  // slip of a few roundings at its two or more places
    steady.closes = rests || trial.size <= rounding * std::min(1.0, 1e3 * path);
    return trial;
  }

  /// ⟨K (Φ(s) − s), d⟩: falls along d, since Φ brings no two sliders farther apart in the measure
  /// of K.
  [[nodiscard]] double pull(const Trial& trial, const Vector2d& along) const {
    return trial.moved.dot(motion_.stiffness().cwiseProduct(along));
  }

  [[nodiscard]] bool is_done(const SteadyOrbit& steady) const {
    const bool gives_up = steady.orbit.defect > 0.0;
    return gives_up || !steady.orbit.slips || steady.closes ||
           steady.defect <= 0.1 * options_.tolerance;
  }

  [[nodiscard]] SteadyOrbit iterate(const Vector2d& start) const {
    SteadyOrbit steady;
    Trial now = walk_from(start, steady);
    Progress progress;
    int failures = 0;
    for (int period = 0; period < most_periods && !is_done(steady); ++period) {
      const bool improved = progress.add(steady.defect, now.size);
      failures += improved ? 0 : 1;
      // No progress this close: it is the steps of the walk that differ from period to period.
      if (failures >= 3 && steady.defect <= 1e4 * options_.tolerance) break;
      const bool tries =
          improved && now.newton.allFinite() && steady.defect < 4.0;  // none is farther
      if (!improved) progress = {};
      const Trial before = now;
      const Vector2d step = tries ? now.newton : now.moved;
      now = walk_from(before.slider + step, steady);
      if (tries) period += shorten(before, step, now, steady);
    }
    return steady;
  }

  /// A step across a kink of the period map, where a window of slip appears or goes, may turn the
  /// pull round: the zero of it is looked for on the way. Returns the number of periods this takes.
  int shorten(const Trial& before, const Vector2d& step, Trial& now, SteadyOrbit& steady) const {
    constexpr double enough = 0.3;  // of the pull before the step
    constexpr int most = 8;
    const double whole = pull(before, step);
    double low = 0.0;
    double high = 1.0;
    double pull_low = whole;
    double pull_high = pull(now, step);
    if (!(pull_high < -enough * whole)) return 0;
    for (int i = 1; i <= most; ++i) {
      const double share =
          low + (high - low) * std::clamp(pull_low / (pull_low - pull_high), 0.1, 0.9);
      now = walk_from(before.slider + share * step, steady);
      const double here = pull(now, step);
      if (is_done(steady) || std::abs(here) <= enough * whole) return i;
      (here > 0.0 ? low : high) = share;
      (here > 0.0 ? pull_low : pull_high) = here;
    }
    return most;
  }

  /// From a first period on, period by period, until the slider no longer moves;
  /// whether it has come so far.
  bool march(SteadyOrbit& steady) const {
    for (int period = 1; period < longest_march; ++period) {
      const Vector2d slider = steady.orbit.end;
      steady.history.push_back(std::move(steady.orbit));
      steady.orbit = walk_orbit(motion_, intervals_, slider, options_);
      steady.defect = force_of(motion_, steady.orbit.end - slider);
      steady.closes = steady.defect <= rounding;
      const bool gives_up = steady.orbit.defect > 0.0;
      if (gives_up || !steady.orbit.slips || steady.defect <= 0.01 * options_.tolerance)
        return true;
      if (rest_in_corner(steady, period >= slow_march)) return true;
    }
    return false;
  }

  /// The first slider that rests on the way from the end of a march to a place where rest is known:
  /// such as around a circle, where the sliders that rest are few and the march comes close like
  /// 1/periods. The way on to that place estimates how far apart such sliders are.
  void rest_towards(const Vector2d& place, SteadyOrbit& steady) const {
    const Vector2d begin = steady.orbit.end;
    double slips = 0.0;
    double rests = 1.0;
    constexpr int halvings = 40;  // to 1e-12 of the way
    for (int i = 0; i < halvings; ++i) {
      const double share = 0.5 * (slips + rests);
      const Vector2d slider = begin + share * (place - begin);
      (walk_orbit(motion_, intervals_, slider, options_).slips ? slips : rests) = share;
    }
    const Vector2d slider = begin + rests * (place - begin);
    steady.orbit = walk_orbit(motion_, intervals_, slider, options_);
    steady.defect = 2.0 * force_of(motion_, place - slider);
    steady.closes = false;
  }

  /// Whether the two windows that push in the last period leave the slider in their corner. If so
  /// the orbit is that of the slider at rest there. A slow march along the valley between two
  /// windows may be taken over by a third before their corner:
  /// it is followed to the corner of the two that push then.
  bool rest_in_corner(SteadyOrbit& steady, bool is_slow) const {
    constexpr int most_windows = 4;
    std::vector<double> ends = ends_of_slip(steady.orbit);
    Vector2d slider = steady.orbit.end;
    for (int i = 0; i < most_windows && ends.size() == 2; ++i) {
      const std::optional<SliderCorner> corner =
          meeting_corner(motion_, {ends[0], ends[1]}, slider);
      if (!corner.has_value()) return false;
      PlanarOrbit rest = walk_orbit(motion_, intervals_, corner->slider, options_);
      if (!rest.slips) {
        steady.orbit = std::move(rest);
        steady.corner = corner;
        steady.history.clear();
        steady.defect = 0.0;
        steady.closes = true;
        return true;
      }
      if (!is_slow) return false;
      const PlanarOrbit next = walk_orbit(motion_, intervals_, rest.end, options_);
      ends = ends_of_slip(next);
      slider = next.end;
    }
    return false;
  }

  const PlanarMotion& motion_;
  const std::vector<PlanarInterval>& intervals_;
  const OrbitOptions& options_;
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
  } else {
    steady = FixedPoint(motion, intervals, options).solve();
  }
  if (steady.orbit.defect > 0.0) {
    steady.closes = false;
    steady.defect = std::max(steady.defect, steady.orbit.defect);
  }
  return steady;
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
