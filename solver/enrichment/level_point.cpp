#include "solver/enrichment/level_point.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/balance/few_jacobians.hpp"
#include "solver/balance/output_amplitude.hpp"
#include "solver/branch/branch_geometry.hpp"
#include "solver/enrichment/enrichment.hpp"

namespace microslip::solver {
namespace {

constexpr double level = 1e-4;          // of the amplitude per scaled length
constexpr double narrowest = 1e-5;      // of a bracket: the peak is a kink
constexpr double longest_trial = 0.3;   // scaled
constexpr double shortest_step = 1e-3;  // where Newton's method fails
constexpr int most_steps = 60;
constexpr double tolerance = 1e-8;  // of the residual

/// A solved place of the branch.
struct Step {
  BranchVector point;
  BranchVector tangent;  // scaled, of length one
  double way = 0.0;      // along the branch from the first
  double slope = 0.0;    // da/ds / a
  double amplitude = 0.0;
};

class Climb {
 public:
  Climb(HarmonicBalance& balance, const LocalPeak& start, const ContinuationOptions& range,
        PeakWork& work, double farthest)
      : balance_(balance), start_(start), range_(range), work_(work), farthest_(farthest) {}

  std::optional<LocalPeak> run() {
    std::optional<Step> first = solved(start_.point, border_of(start_), start_.tangent);
    if (!first) return std::nullopt;
    now_ = *first;
    if (start_.place != PeakPlace::range_end) return climbed();
    const LocalPeak end = result();
    if (!rises_inward()) return end;
    std::optional<LocalPeak> peak = climbed();
    if (!peak || !(peak->amplitude > end.amplitude)) return end;
    peak->place = PeakPlace::peak;
    return peak;
  }

 private:
  std::optional<LocalPeak> climbed() {
    for (int i = 0; i < most_steps; ++i) {
      if (is_stopped()) return std::nullopt;
      if (std::abs(now_.slope) <= level) return result();
      (now_.slope > 0.0 ? rising_ : falling_) = now_;
      if (is_bracketed() && std::abs(falling_->way - rising_->way) < narrowest) return result();
      if (!go_on()) return std::nullopt;
    }
    return std::nullopt;
  }

  [[nodiscard]] bool is_stopped() const { return range_.stop && range_.stop(); }

  /// The end of a range is the highest place no longer: its peak lies within.
  [[nodiscard]] bool rises_inward() const {
    const auto [low, high] = std::minmax(range_.frequency_begin, range_.frequency_end);
    if (low == high) return false;
    const bool is_lower_end = now_.point.parameter - low < high - now_.point.parameter;
    const double by_frequency = now_.slope * now_.tangent.parameter;
    return std::abs(now_.slope) > level && (is_lower_end ? by_frequency : -by_frequency) > 0.0;
  }

  [[nodiscard]] bool is_bracketed() const { return rising_ && falling_; }

  [[nodiscard]] std::optional<Step> solved(const BranchVector& guess, const BranchVector& row,
                                           const BranchVector& tangent) {
    const NewtonResult at =
        solve_balance(balance_, range_.corrector, guess, row, start_.scaling,
                      {.tolerance = tolerance, .stop = &range_.stop}, nearby_.get());
    work_.iterations += at.iterations;
    work_.contact_evaluations += at.evaluations;
    if (!at.converged) return std::nullopt;
    if (at.factors) nearby_ = at.factors;
    Step step;
    step.point = at.point;
    step.tangent = tangent_at(at, tangent, start_.scaling).direction;
    const OutputAmplitude output =
        output_amplitude(balance_.harmonics(at.point.x), balance_.scene().output);
    step.amplitude = output.half_peak_to_peak;
    step.slope = balance_.unknowns(output.gradient).dot(step.tangent.x) * start_.scaling.x /
                 output.half_peak_to_peak;
    return step;
  }

  /// To the zero of the slope by the secant of the last two places;
  /// in a bracket never next to its ends.
  [[nodiscard]] double length() const {
    double ahead = now_.slope > 0.0 ? longest_trial : -longest_trial;
    if (before_ && before_->slope != now_.slope) {
      const double secant = now_.slope * (before_->way - now_.way) / (now_.slope - before_->slope);
      if (secant * ahead > 0.0) ahead = std::clamp(secant, -longest_trial, longest_trial);
    } else {
      ahead = std::clamp(now_.slope, -longest_trial, longest_trial);  // a curvature of one
    }
    if (!is_bracketed()) return ahead;
    const double low = std::min(rising_->way, falling_->way);
    const double high = std::max(rising_->way, falling_->way);
    const double margin = 0.05 * (high - low);
    return std::clamp(now_.way + ahead, low + margin, high - margin) - now_.way;
  }

  [[nodiscard]] bool go_on() {
    const double whole = length();
    for (double ahead = whole; std::abs(ahead) >= std::min(shortest_step, std::abs(whole));
         ahead *= 0.5) {
      if (is_stopped()) return false;
      const BranchVector guess = moved(now_.point, now_.tangent, ahead, start_.scaling);
      std::optional<Step> next = solved(guess, now_.tangent, now_.tangent);
      if (!next || dot(next->tangent, now_.tangent) <= 0.0) continue;
      next->way = now_.way + ahead;
      before_ = std::exchange(now_, std::move(*next));
      return std::abs(now_.way) <= farthest_ && is_inside();
    }
    return false;
  }

  [[nodiscard]] bool is_inside() const {
    const auto [low, high] = std::minmax(range_.frequency_begin, range_.frequency_end);
    return now_.point.parameter >= low && now_.point.parameter <= high;
  }

  [[nodiscard]] LocalPeak result() const {
    LocalPeak peak = start_;
    peak.point = now_.point;
    peak.tangent = now_.tangent;
    peak.amplitude = now_.amplitude;
    return peak;
  }

  HarmonicBalance& balance_;
  const LocalPeak& start_;
  const ContinuationOptions& range_;
  PeakWork& work_;
  double farthest_;
  std::shared_ptr<const BranchFactors> nearby_;  // of the last place solved for
  Step now_;
  std::optional<Step> before_;
  std::optional<Step> rising_;
  std::optional<Step> falling_;
};

}  // namespace

std::optional<LocalPeak> level_point(HarmonicBalance& balance, const LocalPeak& start,
                                     const ContinuationOptions& range, PeakWork& work,
                                     double farthest) {
  return Climb(balance, start, range, work, farthest).run();
}

}  // namespace microslip::solver
