#include "solver/richer_peak.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "solver/balance/condensed.hpp"
#include "solver/balance/first_harmonics.hpp"
#include "solver/balance/output_amplitude.hpp"
#include "solver/balance/period_energy.hpp"
#include "solver/enrichment/carried_peak.hpp"
#include "solver/enrichment/curve_harmonics.hpp"
#include "solver/enrichment/enrichment.hpp"
#include "solver/enrichment/level_point.hpp"
#include "solver/enrichment/resonances_along.hpp"
#include "solver/enrichment/resonances_beyond.hpp"
#include "solver/peak/high_points.hpp"

namespace microslip::solver {
namespace {

constexpr double farthest = 4.0;     // amplitudes or widths along the branch
constexpr double much_lower = 0.95;  // of the amplitude
constexpr double moved_much = 0.02;  // the same
constexpr Eigen::Index most_unknowns = 150;
// Of motion or amplitude, on a harmonic beyond: what it dissipates may change the peak more.
constexpr double counts_beyond = 5e-4;

/// By friction in a period [J].
double energy_of(HarmonicBalance& balance, const LocalPeak& peak) {
  return period_energy(balance, peak.point.x, peak.point.parameter).friction;
}

/// A peak that leaves the range is still one; a single frequency is kept.
ContinuationOptions widened(ContinuationOptions range) {
  constexpr double beyond = 0.1;
  if (range.frequency_begin == range.frequency_end) return range;
  const bool forward = range.frequency_begin < range.frequency_end;
  (forward ? range.frequency_begin : range.frequency_end) *= 1.0 - beyond;
  (forward ? range.frequency_end : range.frequency_begin) *= 1.0 + beyond;
  return range;
}

/// The highest point of a curve, as it was written and with what others start from.
struct Top {
  ResponsePoint point;
  LocalPeak peak;
};

std::optional<Top> solved_top(const Scene& scene, HarmonicBalance& balance,
                              const ContinuationOptions& range, const ResponseCurve& curve) {
  const std::vector<HighPoint> high = high_points(scene, curve, range);
  const HighPoint* top = highest_of_curve(high);
  if (top == nullptr) return std::nullopt;
  std::optional<LocalPeak> peak = top->place == PeakPlace::range_end
                                      ? local_end(balance, top->point, range)
                                      : local_peak(balance, top->point);
  if (!peak) return std::nullopt;
  return Top{top->point, std::move(*peak)};
}

/// All harmonics that a point of the curve has: they may be chosen.
HarmonicSet set_of(const Scene& scene, const ContinuationOptions& range,
                   const ResponseCurve& curve) {
  HarmonicSet set = first_harmonics(scene, range);
  for (const ResponsePoint& point : curve.points) set = set.united(point.orders);
  return set;
}

/// Unknowns of one model in the modes of another.
Eigen::VectorXd in_modes(const HarmonicBalance& from, const HarmonicBalance& to,
                         const Eigen::VectorXd& x, const Eigen::MatrixXd& embedding) {
  const Harmonics q = from.harmonics(x);
  if (embedding.size() == 0) return to.unknowns(q);
  Harmonics other(q.n_harmonics(), embedding.rows());
  other.rows() = q.rows() * embedding.transpose();
  return to.unknowns(other);
}

/// From the peak of one model to that of another.
struct Carrier {
  const HarmonicBalance& from;
  HarmonicBalance& to;
  const OtherModel& other;
  ContinuationOptions range;

  [[nodiscard]] LocalPeak start_from(const LocalPeak& peak) const {
    LocalPeak start = peak;
    start.point.x = in_modes(from, to, peak.point.x, other.embedding);
    // An end of the range stays where it is.
    if (start.place == PeakPlace::peak) start.point.parameter *= other.frequency_factor;
    start.tangent.x = in_modes(from, to, peak.tangent.x, other.embedding);
    return start;
  }

  [[nodiscard]] std::optional<LocalPeak> carried(const LocalPeak& peak) const {
    PeakWork work;
    return level_point(to, start_from(peak), range, work, farthest);
  }

  /// One step across the branch, along which the amplitude is stationary. Empty: the change is
  /// more than a step may tell, or it leaves too much of the residual.
  [[nodiscard]] std::optional<LocalPeak> stepped(const LocalPeak& peak) const {
    constexpr double most_left = 0.2;
    LocalPeak at = start_from(peak);
    const BalanceEvaluation here = to.evaluate(at.point.x, at.point.parameter);
    const BranchVector step = newton_step(here, border_of(at), at.scaling);
    if (!step.x.allFinite() || !std::isfinite(step.parameter)) return std::nullopt;
    at.point.x += step.x;
    at.point.parameter += step.parameter;
    const Eigen::VectorXd left = to.residual(at.point.x, at.point.parameter).residual;
    if (!(left.norm() <= most_left * here.residual.norm())) return std::nullopt;
    at.amplitude = output_amplitude(to.harmonics(at.point.x), to.scene().output).half_peak_to_peak;
    if (std::abs(at.amplitude / peak.amplitude - 1.0) > other.told_by_step) return std::nullopt;
    return at;
  }
};

/// Points of the curve on either side of its highest, as long as they are nearly as high.
std::vector<LocalPeak> places_beside(HarmonicBalance& balance, const ResponseCurve& curve,
                                     const ResponsePoint& top) {
  constexpr double nearly = 0.8;
  constexpr std::ptrdiff_t most = 4;
  const auto highest = std::ranges::find(curve.points, top.frequency, &ResponsePoint::frequency);
  std::vector<LocalPeak> places;
  if (highest == curve.points.end()) return places;
  for (const std::ptrdiff_t side : {-1, 1}) {
    for (std::ptrdiff_t i = 1; i <= most; ++i) {
      const std::ptrdiff_t at = highest - curve.points.begin() + side * i;
      if (at < 0 || at >= std::ssize(curve.points)) break;
      const ResponsePoint& point = curve.points[static_cast<std::size_t>(at)];
      if (point.amplitude < nearly * top.amplitude) break;
      if (auto place = local_peak(balance, point)) places.push_back(std::move(*place));
    }
  }
  return places;
}

/// Of the curve whose peak is to be found with more harmonics.
struct Origin {
  const Scene& scene;
  const ContinuationOptions& range;
  const ResponseCurve& curve;
  HarmonicBalance& coarse;
  const Top& top;
};

/// Next to an internal resonance a peak becomes two: the other one is reached from beside it.
void look_beside(const Origin& origin, const HarmonicSet& all, std::optional<LocalPeak>& found,
                 PeakWork& work) {
  for (const LocalPeak& beside : places_beside(origin.coarse, origin.curve, origin.top.point)) {
    auto next = carried_peak(origin.scene, origin.range, beside, origin.coarse.set(), all, work);
    if (next && next->amplitude > found->amplitude) found = std::move(next);
  }
}

/// With many unknowns looking beside takes longer than the curve: nine harmonics of the default
/// blade 2 s beside 0.2 of the curve with one.
bool is_cheap(const Scene& scene, const HarmonicSet& all) {
  return (2 * all.count() + 1) * scene.n_modes() <= most_unknowns;
}

std::optional<LocalPeak> carried_top(const Origin& origin, const HarmonicSet& all, PeakWork& work) {
  const auto& [scene, range, curve, coarse, top] = origin;
  std::optional<LocalPeak> found = carried_peak(scene, range, top.peak, coarse.set(), all, work);
  const double least = (1.0 - moved_much) * top.point.amplitude;
  if (found && found->amplitude < least && is_cheap(scene, all))
    look_beside(origin, all, found, work);
  return found;
}

/// The peak with those that resonate as well; few scenes have any.
/// @param peak  solved with all that `fewer` has.
std::optional<LocalPeak> carried_beyond(const Origin& origin, const LocalPeak& peak,
                                        const HarmonicSet& fewer, const HarmonicSet& all,
                                        PeakWork& work) {
  auto found = carried_peak(origin.scene, origin.range, peak, fewer, all, work);
  const double least = (1.0 - counts_beyond) * peak.amplitude;
  if (found && found->amplitude < least && is_cheap(origin.scene, all)) {
    look_beside(origin, all, found, work);
  }
  return found;
}

/// Those that the set lacks.
HarmonicSet with_next(const HarmonicSet& all, int next) {
  return next < 1 ? all : all.united(HarmonicSet(next).orders());
}

/// |δA| / A of harmonics that a peak lacks, by one step. Their sizes added up are three times what
/// solving for them tells, their sum may hide them: the root of their squares does not.
double left_out_of(const Scene& scene, const LocalPeak& peak, const HarmonicSet& all,
                   const HarmonicSet& more) {
  const HarmonicBalance coarse(scene, all);
  HarmonicBalance richer(scene, more);
  double sum = 0.0;
  double squares = 0.0;
  for (const RicherShare& share : richer_shares(richer, embedded(peak, coarse, richer))) {
    if (share.order == 0 || all.contains(share.order)) continue;
    sum += share.amplitude;
    squares += share.amplitude * share.amplitude;
  }
  return std::min(std::max(std::abs(sum), std::sqrt(squares)), all_left_out);
}

/// The peak with the next harmonics, where those are seen.
void go_on(const Origin& origin, int next, HarmonicSet& all, LocalPeak& found, RicherPeak& result,
           PeakWork& work) {
  constexpr double worth_solving = 0.01;  // of the amplitude
  HarmonicSet more = with_next(all, next);
  if (more == all) return;
  result.left_out = left_out_of(origin.scene, found, all, more);
  if (!(result.left_out > worth_solving)) return;
  auto there = carried_peak(origin.scene, origin.range, found, all, more, work);
  if (!there || there->amplitude < another_peak * found.amplitude) return;
  result.left_out = 0.0;
  result.highest = next;
  found = std::move(*there);
  all = std::move(more);
}

}  // namespace

std::optional<RicherPeak> richer_peak(const Scene& scene, const ContinuationOptions& range,
                                      const ResponseCurve& curve, int highest, int next) {
  if (curve.points.empty() || !scene.contact) return std::nullopt;
  HarmonicBalance coarse(scene, first_harmonics(scene, range));
  const std::optional<Top> top = solved_top(scene, coarse, range, curve);
  if (!top) return std::nullopt;
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  RicherPeak result{top->point.frequency, top->point.amplitude, std::nullopt, highest};
  HarmonicSet all = coarse.set().united(HarmonicSet(highest).orders());
  const ContinuationOptions wide = widened(range);
  PeakWork work;
  const Origin origin{scene, wide, curve, coarse, *top};
  std::optional<LocalPeak> found = carried_top(origin, all, work);
  if (found) {
    HarmonicBalance balance(scene, all);
    result.beyond = resonances_beyond(balance, *found, range.highest_resonance, counts_beyond);
  }
  if (!result.beyond.empty()) {
    const HarmonicSet fewer = std::exchange(all, all.united(result.beyond));
    found = carried_beyond(origin, *found, fewer, all, work);
  }
  if (found) go_on(origin, next, all, *found, result, work);
  result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  if (!found || found->amplitude < another_peak * top->point.amplitude) return result;
  result.frequency = found->point.parameter;
  result.amplitude = found->amplitude;
  HarmonicBalance richer(scene, all);
  result.dissipated_energy = energy_of(richer, *found);
  result.change = (found->amplitude - top->point.amplitude) / found->amplitude;
  return result;
}

std::vector<int> resonant_harmonics(const Scene& scene, const ContinuationOptions& range,
                                    const ResponseCurve& curve, int highest, double share) {
  ContinuationOptions asked = range;
  asked.n_harmonics = highest;
  asked.highest_resonance = 0;
  asked.harmonic_tolerance = share;
  return resonances_along(scene, asked, set_of(scene, range, curve), curve);
}

ContinuationOptions with_harmonics_of(const Scene& scene, const ContinuationOptions& range,
                                      const ResponseCurve& curve) {
  return with_harmonics(range, set_of(scene, range, curve));
}

std::optional<PeakOfBoth> peak_elsewhere(const Scene& scene, const ContinuationOptions& range,
                                         const ResponseCurve& curve, const OtherModel& other) {
  if (curve.points.empty()) return std::nullopt;
  HarmonicBalance balance(scene, set_of(scene, range, curve));
  const std::optional<Top> top = solved_top(scene, balance, range, curve);
  if (!top) return std::nullopt;
  HarmonicBalance elsewhere(other.scene, balance.set());
  const Carrier carrier{balance, elsewhere, other, widened(range)};
  std::optional<LocalPeak> found;
  if (other.told_by_step > 0.0) found = carrier.stepped(top->peak);
  const bool is_solved = !found;
  if (is_solved) found = carrier.carried(top->peak);
  // Much lower is another peak: the highest may be reached from points beside that of the curve.
  if (!found || found->amplitude < much_lower * top->point.amplitude) {
    for (const LocalPeak& beside : places_beside(balance, curve, top->point)) {
      std::optional<LocalPeak> next = carrier.carried(beside);
      if (next && (!found || next->amplitude > found->amplitude)) found = std::move(next);
    }
  }
  if (!found) return std::nullopt;
  return PeakOfBoth{top->point.frequency,
                    top->point.amplitude,
                    found->point.parameter,
                    found->amplitude,
                    energy_of(balance, top->peak),
                    energy_of(elsewhere, *found),
                    is_solved};
}

}  // namespace microslip::solver
