#include "solver/special_points.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "solver/output_amplitude.hpp"

namespace microslip::solver {
namespace {

// Of a segment, which is at most a fifth of a resonance wide: below it are rounding errors only.
constexpr double finest_share = 1e-13;
constexpr int max_cuts =
    90;  // bisection alone needs 44 for the finest share, and a third are bisections
// A slope that falls to this share of the ends' may change sign where the cubic is not the branch.
constexpr double suspicious_slope = 0.3;
// One that is this large where the cubic has its extremum does not; below, parabolas look closer.
constexpr double hopeless_slope = 0.02;
constexpr int max_parabolas = 8;

/// Something that varies along a segment, with its slope by arc length in the scaling of now().
struct Value {
  double value;
  double slope;
};

class Segment {
 public:
  Segment(const BranchWalker& walker, const HarmonicBalance& balance, PointMark kind)
      : walker_(walker), balance_(balance), kind_(kind) {
    begin_ = at(walker.before());
    end_ = at(walker.now());
    const BranchVector& a = walker.before().solution.point;
    const BranchVector& b = walker.now().solution.point;
    length_ = scaled_length({b.x - a.x, b.parameter - a.parameter});
  }

  [[nodiscard]] std::vector<SpecialPoint> search() const {
    std::vector<SpecialPoint> found;
    const auto keep = [&](std::optional<SpecialPoint> point) {
      if (point) found.push_back(std::move(*point));
    };
    if ((begin_.slope > 0.0) != (end_.slope > 0.0)) {
      if (wanted(begin_.slope)) keep(locate({0.0, begin_.slope}, {1.0, end_.slope}));
      return found;
    }
    const double share = turning_share();
    if (share <= 0.0) return found;
    const std::optional<End> middle = beyond_zero(share);
    if (!middle) return found;
    if (wanted(begin_.slope)) keep(locate({0.0, begin_.slope}, *middle));
    if (wanted(middle->slope)) keep(locate(*middle, {1.0, end_.slope}));
    return found;
  }

 private:
  struct End {
    double share;
    double slope;
  };

  [[nodiscard]] bool wanted(double slope_before) const {
    return kind_ == PointMark::fold || slope_before > 0.0;
  }

  [[nodiscard]] double scaled_length(const BranchVector& step) const {
    const Scaling& scaling = walker_.now().scaling;
    return std::hypot(step.x.norm() / scaling.x, step.parameter / scaling.parameter);
  }

  [[nodiscard]] Value at(const WalkerPoint& point) const {
    const BranchVector step{point.tangent.x * point.scaling.x,
                            point.tangent.parameter * point.scaling.parameter};
    const double length = scaled_length(step);
    if (kind_ == PointMark::fold) return {point.solution.point.parameter, step.parameter / length};
    const auto amplitude =
        output_amplitude(balance_.harmonics(point.solution.point.x), balance_.scene().output);
    return {amplitude.half_peak_to_peak, balance_.unknowns(amplitude.gradient).dot(step.x) / length};
  }

  /// Where the slope of the cubic through both ends comes nearest to changing sign; 0: it does not.
  [[nodiscard]] double turning_share() const {
    const double rise = end_.value - begin_.value;
    const double linear = 6.0 * rise - (4.0 * begin_.slope + 2.0 * end_.slope) * length_;
    const double square = 3.0 * (begin_.slope + end_.slope) * length_ - 6.0 * rise;
    const double share = -0.5 * linear / square;
    if (!(share > 0.02) || !(share < 0.98)) return 0.0;
    const double sign = begin_.slope > 0.0 ? 1.0 : -1.0;
    const double least = sign * (begin_.slope * length_ + 0.5 * linear * share);
    const double least_end = std::min(std::abs(begin_.slope), std::abs(end_.slope)) * length_;
    return least < suspicious_slope * least_end ? share : 0.0;
  }

  /// A place where the slope has the other sign, near a share where it may: its extremum by parabolas
  /// through three places, as long as it may still pass zero.
  [[nodiscard]] std::optional<End> beyond_zero(double share) const {
    const double sign = begin_.slope > 0.0 ? 1.0 : -1.0;
    const double hopeless = hopeless_slope * std::min(std::abs(begin_.slope), std::abs(end_.slope));
    End left{0.0, sign * begin_.slope};
    End right{1.0, sign * end_.slope};
    std::optional<End> least;
    for (int i = 0; i < max_parabolas; ++i) {
      const auto point = walker_.between(share);
      if (!point) return std::nullopt;
      const End here{share, sign * at(*point).slope};
      if (here.slope <= 0.0) return End{share, sign * here.slope};
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

  /// Regula falsi (Illinois) with a bisection after every two steps, so that a jump is found as well.
  [[nodiscard]] std::optional<SpecialPoint> locate(End low, End high) const {
    const double enough = 1e-14 * std::max(std::abs(low.slope), std::abs(high.slope));
    const bool rises = low.slope > 0.0;
    std::optional<SpecialPoint> best;
    for (int i = 0; i < max_cuts && high.share - low.share > finest_share; ++i) {
      const double cut = low.slope / (low.slope - high.slope);
      const double share = low.share + (high.share - low.share) * (i % 3 == 2 ? 0.5 : cut);
      auto point = walker_.between(share);
      if (!point) return best;
      const double slope = at(*point).slope;
      best = SpecialPoint{share, std::move(point->solution), kind_};
      if (std::abs(slope) <= enough || cut <= 0.0 || cut >= 1.0) break;
      if ((slope > 0.0) == rises) {
        low = {share, slope};
        high.slope *= 0.5;
      } else {
        high = {share, slope};
        low.slope *= 0.5;
      }
    }
    return best;
  }

  const BranchWalker& walker_;
  const HarmonicBalance& balance_;
  PointMark kind_;
  Value begin_{};
  Value end_{};
  double length_ = 0.0;
};

}  // namespace

std::vector<SpecialPoint> peaks_between(const BranchWalker& walker,
                                        const HarmonicBalance& balance) {
  return Segment(walker, balance, PointMark::peak).search();
}

std::vector<SpecialPoint> special_points(const BranchWalker& walker,
                                         const HarmonicBalance& balance) {
  std::vector<SpecialPoint> found = peaks_between(walker, balance);
  for (SpecialPoint& fold : Segment(walker, balance, PointMark::fold).search()) {
    found.push_back(std::move(fold));
  }
  std::sort(found.begin(), found.end(),
            [](const SpecialPoint& a, const SpecialPoint& b) { return a.share < b.share; });
  return found;
}

}  // namespace microslip::solver
