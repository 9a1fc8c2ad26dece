#include "solver/branch/special_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "solver/balance/output_amplitude.hpp"

namespace microslip::solver {
namespace {

// A bracket that Newton's method does not make shorter than this tells the place to eight digits.
constexpr double rounding_share = 1e-8;
constexpr int max_cuts =
    90;  // bisection alone needs 44 for a share of 1e-13, and a third are bisections
// Next to a kink where slip in a plane begins Newton's method may take hundreds of evaluations:
// after so many, eight digits of the place are enough, and after more some.
constexpr long dear_search = 200;
constexpr long vain_search = 1000;
constexpr double vain_share = 1e-5;
// Where the branch is smooth three are enough; at a kink more would not shorten the bracket.
constexpr int n_cubics = 4;
// Of the steeper end: a slope that is this small and does not fall any more is rounding.
constexpr double level_share = 1e-8;
// Places of one step where nothing solves the equations: where the branch turns back between its
// ends, or where forces jump, as sampled ones may by 1e-5 of their scale. There each costs as much
// as twenty that are solved.
constexpr int most_failed = 12;            // one after the other
constexpr int most_failed_of_sampled = 4;  // of one search: what is behind them stays unsolved
constexpr double steep = 0.2;  // cosine of a tangent with the chord: a steeper one tells no slope
// A slope that falls to this share of the ends' may change sign where the cubic is not the branch.
constexpr double suspicious_slope = 0.3;
// One that is this large where the cubic has its extremum does not; below, parabolas look closer.
constexpr double hopeless_slope = 0.02;
constexpr int max_parabolas = 8;

// Angles of the tangents with the chord are equal on an arc; a kink, where points begin to slip, to
// stick or to separate, makes them differ by more than this factor, and the cubic is not the
// branch.
constexpr double uneven = 1.5;
constexpr double slight_turn = 0.01;  // rad: what turns less hides nothing that a curve could show
// Of a smooth branch the cubic knows more of the slope than of the branch, which turns in hundreds
// of directions: on five curves of the default blade with 17 and 19 harmonics slopes that passed
// zero unseen were below 0.2 of the turn, but for two folds 6e-8 of their frequency apart.
constexpr double share_of_smooth_turn = 0.25;
// A slope that is this small beside what the tangent turns may pass zero twice where the cubic does
// not. Steep parts of a branch, where folds may hide, are few.
constexpr double level_at_peak = 0.1;
constexpr double level_at_fold = 0.3;
// The motion along the branch jumps at a kink by about this share of itself; the slope no more.
constexpr double kink_reach = 0.3;
// Of more points each is a small part of the force: their kinks together are a smooth curve.
constexpr std::size_t most_kinks = 32;
constexpr int max_splits = 7;             // of a step, at its kinks: to less than a hundredth of it
constexpr int max_splits_of_sampled = 2;  // which are smooth
constexpr double slight_turn_of_sampled = 0.05;  // rad

/// Something that varies along a segment, with its slope by arc length in the scaling of now().
struct Value {
  double value;
  double slope;
  double steepest;  ///< slope in the direction in which it rises most

  /// Slope as a share of the steepest; infinite where nothing rises, as level is not what that is.
  [[nodiscard]] double steepness() const {
    return steepest > 0.0 ? std::abs(slope) / steepest : std::numeric_limits<double>::infinity();
  }
};

/// A place on a segment.
struct Node {
  StepPoint at;
  Value value;
  BranchVector position;  ///< scaled
  BranchVector tangent;   ///< scaled, of length one
};

BranchVector minus(const BranchVector& a, const BranchVector& b) {
  return {a.x - b.x, a.parameter - b.parameter};
}

double angle(const BranchVector& a, const BranchVector& b) {
  return std::acos(std::clamp(dot(a, b) / std::sqrt(dot(a, a) * dot(b, b)), -1.0, 1.0));
}

/// Places halfway in a step and its halves that have been solved for, by their shares of the way.
/// Others no second search comes to, and each holds its Jacobian and factors.
using Places = std::map<double, StepPoint>;

class Segment {
 public:
  /// @param until   share of the step that is searched.
  /// @param places  borrowed: of the same step, looked up first and added to.
  Segment(BranchWalker& walker, HarmonicBalance& balance, PointMark kind, double until,
          Places& places)
      : walker_(walker),
        balance_(balance),
        kind_(kind),
        until_(until),
        places_(places),
        most_splits_(walker.is_sampled() ? max_splits_of_sampled : max_splits),
        hiding_share_(walker.is_sampled() ? share_of_smooth_turn : 1.0),
        most_failed_(walker.is_sampled() ? most_failed_of_sampled : most_failed),
        slight_turn_(walker.is_sampled() ? slight_turn_of_sampled : slight_turn) {}

  [[nodiscard]] std::vector<SpecialPoint> search() {
    Node begin = node({0.0, walker_.before()});
    if (walker_.kink()) {
      Node ahead = node({0.0, *walker_.kink()});
      const bool turns = (begin.value.slope > 0.0) != (ahead.value.slope > 0.0);
      if (turns && wanted(begin)) found_.push_back({0.0, begin.at.point.solution, kind_, true});
      begin = std::move(ahead);
    }
    Node end = node({1.0, walker_.now()});
    if (walker_.is_at_tip()) {
      take_tip(begin, end);
      return std::move(found_);
    }
    if (until_ < 1.0) {
      if (auto last = between(begin, end, until_)) end = std::move(*last);
    }
    search(begin, end, 0);
    return std::move(found_);
  }

  /// After search(): the valleys beside the peaks of the segment, as unmarked points.
  [[nodiscard]] std::vector<SpecialPoint> valleys() {
    std::vector<SpecialPoint> found;
    for (auto& [a, b] : falling_then_rising_) {
      SpecialPoint valley = locate(std::move(a), std::move(b));
      valley.mark = PointMark::none;
      if (valley.solved) found.push_back(std::move(valley));
    }
    return found;
  }

 private:
  [[nodiscard]] bool wanted(const Node& before) const {
    return kind_ == PointMark::fold || before.value.slope > 0.0;
  }

  void search(const Node& a, const Node& b, int n_splits) {
    if (n_splits < most_splits_ && may_hide(a, b)) {
      if (const auto middle = between(a, b, 0.5 * (a.at.share + b.at.share))) {
        places_.try_emplace(middle->at.share, middle->at);
        search(a, *middle, n_splits + 1);
        search(*middle, b, n_splits + 1);
        return;
      }
    }
    if ((a.value.slope > 0.0) != (b.value.slope > 0.0)) {
      take(a, b);
      return;
    }
    const double share = turning_share(a, b);
    if (share <= 0.0) return;
    const std::optional<Node> middle = beyond_zero(a, b, share);
    if (!middle) return;
    take(a, *middle);
    take(*middle, b);
  }

  /// A peak or fold at the tip itself: of the ends of the step, both within 1e-5 of it, the one
  /// that lies farther out.
  void take_tip(const Node& a, const Node& b) {
    const bool rises = a.value.slope > 0.0;
    if (rises == (b.value.slope > 0.0) || !wanted(a)) return;
    const Node& farther = rises == (b.value.value > a.value.value) ? b : a;
    found_.push_back({0.0, farther.at.point.solution, kind_, true});
  }

  /// Between two places whose slopes differ in sign.
  void take(const Node& a, const Node& b) {
    if (wanted(a)) {
      found_.push_back(locate(a, b));
    } else {
      falling_then_rising_.emplace_back(a, b);
    }
  }

  [[nodiscard]] Node node(StepPoint at) const {
    const Scaling& scaling = walker_.now().scaling;
    const WalkerPoint& point = at.point;
    const BranchVector& solution = point.solution.point;
    BranchVector tangent{point.tangent.x * (point.scaling.x / scaling.x),
                         point.tangent.parameter * (point.scaling.parameter / scaling.parameter)};
    const double length = std::sqrt(dot(tangent, tangent));
    tangent.x /= length;
    tangent.parameter /= length;
    BranchVector position{solution.x / scaling.x, solution.parameter / scaling.parameter};
    const Value value = value_at(solution, tangent);
    return {std::move(at), value, std::move(position), std::move(tangent)};
  }

  [[nodiscard]] Value value_at(const BranchVector& point, const BranchVector& tangent) const {
    const Scaling& scaling = walker_.now().scaling;
    if (kind_ == PointMark::fold) {
      return {point.parameter, tangent.parameter * scaling.parameter, scaling.parameter};
    }
    const auto amplitude = output_amplitude(balance_.harmonics(point.x), balance_.scene().output);
    const Eigen::VectorXd gradient = scaling.x * balance_.unknowns(amplitude.gradient);
    return {amplitude.half_peak_to_peak, gradient.dot(tangent.x), gradient.norm()};
  }

  [[nodiscard]] std::optional<Node> between(const Node& a, const Node& b, double share) {
    if (const auto known = places_.find(share); known != places_.end()) return node(known->second);
    if (n_failed_ >= most_failed_) return std::nullopt;
    auto point = walker_.between(a.at, b.at, share);
    if (!point) {
      ++n_failed_;
      return std::nullopt;
    }
    if (!walker_.is_sampled()) n_failed_ = 0;
    return node(std::move(*point));
  }

  [[nodiscard]] double nearly_level() const {
    return kind_ == PointMark::fold ? level_at_fold : level_at_peak;
  }

  /// Between two places there is a kink at which the slope may change its sign unseen.
  [[nodiscard]] bool may_hide(const Node& a, const Node& b) const {
    const BranchVector chord = minus(b.position, a.position);
    const double first = angle(a.tangent, chord);
    const double second = angle(chord, b.tangent);
    const auto [less, more] = std::minmax(first, second);
    const double nearest = std::min(a.value.steepness(), b.value.steepness());
    const double turn = first + second;
    if (turn > slight_turn_ && more > uneven * less && nearest < hiding_share_ * turn) return true;
    const bool same_sign = (a.value.slope > 0.0) == (b.value.slope > 0.0);
    if (turn > slight_turn_ && same_sign && nearest < nearly_level() * turn) return true;
    const double motion = std::max(a.tangent.x.norm(), b.tangent.x.norm());
    return kind_ == PointMark::peak && nearest < kink_reach * motion && crosses_kink(a, b);
  }

  /// A few points, and one of them begins or ceases to slip or to separate on the way.
  [[nodiscard]] bool crosses_kink(const Node& a, const Node& b) const {
    if (!balance_.scene().contact) return false;
    const auto read = [&](const Node& at, contact::ContactStates& states) {
      const BranchVector& point = at.at.point.solution.point;
      balance_.states(point.x, point.parameter, states);
    };
    contact::ContactStates before;
    contact::ContactStates after;
    read(a, before);
    if (before.size() > most_kinks) return false;
    read(b, after);
    return contact::state_change(before, after).n_regimes > 0;
  }

  /// Slope of the cubic through both ends, c₀ + c₁ u + c₂ u² over the share 0 ≤ u ≤ 1 of the way
  /// between.
  struct CubicSlope {
    CubicSlope(const Node& a, const Node& b) {
      const BranchVector chord = minus(b.position, a.position);
      const double square = dot(chord, chord);
      const auto by_share = [&](const Node& at) {
        return at.value.slope * square /
               std::max(dot(at.tangent, chord), steep * std::sqrt(square));
      };
      c[0] = by_share(a);
      last = by_share(b);
      const double rise = b.value.value - a.value.value;
      c[1] = 6.0 * rise - 4.0 * c[0] - 2.0 * last;
      c[2] = 3.0 * (c[0] + last) - 6.0 * rise;
    }

    /// Between ends of different signs.
    [[nodiscard]] double zero() const {
      const double root = std::sqrt(std::max(c[1] * c[1] - 4.0 * c[0] * c[2], 0.0));
      const double q = -0.5 * (c[1] + std::copysign(root, c[1]));
      const double near = c[0] / q;
      return near > 0.0 && near < 1.0 ? near : q / c[2];
    }

    std::array<double, 3> c{};
    double last = 0.0;
  };

  /// Where the slope of the cubic through both ends comes nearest to changing sign, as a share of
  /// the whole segment; 0: it does not.
  [[nodiscard]] static double turning_share(const Node& a, const Node& b) {
    const CubicSlope slope(a, b);
    if (slope.c[2] == 0.0) return 0.0;
    const double share = -0.5 * slope.c[1] / slope.c[2];
    if (!(share > 0.02) || !(share < 0.98)) return 0.0;
    const double sign = slope.c[0] > 0.0 ? 1.0 : -1.0;
    const double least = sign * (slope.c[0] + 0.5 * slope.c[1] * share);
    const double least_end = std::min(std::abs(slope.c[0]), std::abs(slope.last));
    if (!(least < suspicious_slope * least_end)) return 0.0;
    return a.at.share + share * (b.at.share - a.at.share);
  }

  struct End {
    double share;
    double slope;
  };

  /// A place where the slope has the other sign, near a share where it may: its extremum by
  /// parabolas through three places, as long as it may still pass zero.
  [[nodiscard]] std::optional<Node> beyond_zero(const Node& a, const Node& b, double share) {
    const double sign = a.value.slope > 0.0 ? 1.0 : -1.0;
    const double hopeless =
        hopeless_slope * std::min(std::abs(a.value.slope), std::abs(b.value.slope));
    End left{a.at.share, sign * a.value.slope};
    End right{b.at.share, sign * b.value.slope};
    std::optional<End> least;
    for (int i = 0; i < max_parabolas; ++i) {
      std::optional<Node> point = between(a, b, share);
      if (!point) return std::nullopt;
      const End here{share, sign * point->value.slope};
      if (here.slope <= 0.0) return point;
      if (here.slope > hopeless) return std::nullopt;
      if (!least) {
        least = here;
      } else {
        const bool below = here.slope < least->slope;
        const bool before = here.share < least->share;
        (before == below ? right : left) = below ? *least : here;
        if (below) least = here;
      }
      share = vertex(left, *least, right);
      const bool settled = std::abs(share - least->share) < 1e-5;
      if (settled || !(share > left.share) || !(share < right.share)) return std::nullopt;
    }
    return std::nullopt;
  }

  /// Extremum of the parabola through three ends.
  [[nodiscard]] static double vertex(End a, End b, End c) {
    const double r = (b.share - a.share) * (b.slope - c.slope);
    const double q = (b.share - c.share) * (b.slope - a.slope);
    return b.share - 0.5 * ((b.share - c.share) * q - (b.share - a.share) * r) / (q - r);
  }

  /// At a share of the bracket, or where Newton's method fails there, elsewhere in it.
  [[nodiscard]] std::optional<Node> inside(const Node& low, const Node& high, double share) {
    for (const double other : {share, 0.5, 0.25, 0.75, 0.05, 0.95}) {
      const double at = low.at.share + other * (high.at.share - low.at.share);
      if (auto point = between(low, high, at)) return point;
    }
    return std::nullopt;
  }

  /// Of what a bracket was searched with, at its width.
  [[nodiscard]] static bool is_enough(long evaluations, double width) {
    return (evaluations > dear_search && width < rounding_share) ||
           (evaluations > vain_search && width < vain_share);
  }

  /// By cubics where the branch is smooth, which leave little to do; then regula falsi (Illinois)
  /// with a bisection after every two steps, so that a jump is found as well. Ends where the slope
  /// is rounding, or the bracket.
  [[nodiscard]] SpecialPoint locate(Node low, Node high) {
    const bool rises = low.value.slope > 0.0;
    double low_weight = low.value.slope;
    double high_weight = high.value.slope;
    const double steeper = std::max(std::abs(low_weight), std::abs(high_weight));
    const double enough = 0.1 * walker_.resolution() * steeper;
    const double level = level_share * steeper;
    const long evaluations = walker_.evaluations();
    double least = std::numeric_limits<double>::infinity();
    std::optional<SpecialPoint> best;
    for (int i = 0; i < max_cuts && high.at.share - low.at.share > walker_.resolution(); ++i) {
      if (is_enough(walker_.evaluations() - evaluations, high.at.share - low.at.share)) {
        return unsolved(low, high);
      }
      const double cut = low_weight / (low_weight - high_weight);
      const double cubic = i < n_cubics ? CubicSlope(low, high).zero() : 0.0;
      const bool by_cubic = cubic > 0.0 && cubic < 1.0;
      const double line = i % 3 == 2 ? 0.5 : cut;
      std::optional<Node> point = inside(low, high, by_cubic ? cubic : line);
      if (!point) return unsolved(low, high);
      const double slope = point->value.slope;
      if (std::abs(slope) <= level && std::abs(slope) > 0.25 * least) break;  // rounding
      best = SpecialPoint{point->at.share, point->at.point.solution, kind_, true};
      least = std::abs(slope);
      if (least <= enough || cut <= 0.0 || cut >= 1.0) break;
      const bool is_low = (slope > 0.0) == rises;
      (is_low ? low : high) = std::move(*point);
      (is_low ? low_weight : high_weight) = slope;
      if (!by_cubic) (is_low ? high_weight : low_weight) *= 0.5;
    }
    return best ? std::move(*best) : unsolved(low, high);
  }

  /// The end of a bracket that comes nearest.
  [[nodiscard]] SpecialPoint unsolved(const Node& low, const Node& high) const {
    const bool low_is_nearer = kind_ == PointMark::peak
                                   ? low.value.value > high.value.value
                                   : std::abs(low.value.slope) < std::abs(high.value.slope);
    const Node& nearer = low_is_nearer ? low : high;
    // Within rounding of the zero nothing is missing.
    const bool solved =
        high.at.share - low.at.share < std::max(rounding_share, walker_.resolution());
    return {nearer.at.share, nearer.at.point.solution, kind_, solved};
  }

  BranchWalker& walker_;  ///< counts what the search costs
  HarmonicBalance& balance_;
  PointMark kind_;
  double until_;
  Places& places_;
  int most_splits_;
  double hiding_share_;  ///< of a turn: slopes as small may change their sign
  int most_failed_;
  double slight_turn_;
  int n_failed_ = 0;
  std::vector<SpecialPoint> found_;
  std::vector<std::pair<Node, Node>> falling_then_rising_;  ///< of peaks alone
};

}  // namespace

std::vector<SpecialPoint> peaks_between(BranchWalker& walker, HarmonicBalance& balance) {
  Places places;
  return Segment(walker, balance, PointMark::peak, 1.0, places).search();
}

std::vector<SpecialPoint> special_points(BranchWalker& walker, HarmonicBalance& balance,
                                         double until) {
  Places places;
  Segment peaks(walker, balance, PointMark::peak, until, places);
  std::vector<SpecialPoint> found = peaks.search();
  if (!found.empty()) {
    for (SpecialPoint& valley : peaks.valleys()) found.push_back(std::move(valley));
  }
  for (SpecialPoint& fold : Segment(walker, balance, PointMark::fold, until, places).search()) {
    found.push_back(std::move(fold));
  }
  std::sort(found.begin(), found.end(),
            [](const SpecialPoint& a, const SpecialPoint& b) { return a.share < b.share; });
  return found;
}

}  // namespace microslip::solver
