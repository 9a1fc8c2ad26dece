#include "solver/optimum/corrected_search.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "solver/optimum/bracketed_minimum.hpp"
#include "solver/optimum/corrected_peaks.hpp"
#include "solver/optimum/valley.hpp"

namespace microslip::solver {
namespace {

constexpr std::size_t most_values = 40;
constexpr int most_curves = 9;
constexpr int most_refuted = 2;  // values by their curves, then no peak that is carried is believed
constexpr int scan = 16;         // over all values
constexpr int scan_between = 4;  // two that are solved for
constexpr double step_of_scale = 0.06;      // of first neighbours, on the logarithmic scale
constexpr double step_of_span = 0.02;       // on the linear one
constexpr double farthest_neighbour = 1.7;  // steps
constexpr double worth_a_curve = 0.01;      // of the amplitude
constexpr double wide_of_scale = 0.1744;    // between values that show the way to the bounds: 0.84
constexpr double wide_of_span = 0.06;
constexpr double edge_tolerance = 1e-2;  // of the scale: an interval is told, not a number

class CorrectedPeakSearch {
 public:
  CorrectedPeakSearch(PeakFamilies& few, const SceneFamily& family,
                      const ContinuationOptions& range, const OptimumOptions& options)
      : range_(range), options_(options), peaks_(few, family, range, options) {}

  CorrectedSearch run(double believed) {
    CorrectedSearch result;
    try {
      const double best = settled(position_on(options_.scale, believed));
      result.highest = values().at(best).top;
      result.optimum = found(best, believed);
    } catch (const NeedsOtherSearch&) {
    } catch (const SearchStopped&) {
      result.optimum = out_of_time();
    }
    result.work = peaks_.work();
    result.n_curves = peaks_.n_curves();
    return result;
  }

 private:
  [[nodiscard]] const std::map<double, CorrectedPeaks::Value>& values() const {
    return peaks_.values();
  }
  [[nodiscard]] double step() const {
    const bool logarithmic = options_.scale == ParameterScale::logarithmic;
    return on_scale(options_, logarithmic ? step_of_scale : step_of_span);
  }

  /// The best value, when its minimum, its neighbours and the edges of its valley stay and its
  /// whole curve has the same peak.
  double settled(double believed) {
    peaks_.solve({believed - step(), believed, believed + step()});
    int n_refuted = 0;
    bool is_outlined = false;
    while (values().size() < most_values && peaks_.n_curves() < most_curves) {
      const double best = robust_value();
      const std::vector<double> open = open_beside(best);
      if (!open.empty()) {
        peaks_.solve(open);
      } else if (!is_outlined) {
        outline(best);
        is_outlined = true;
      } else if (values().at(best).top) {
        return proved(best);
      } else if (!peaks_.is_raised(best) && !peaks_.agrees_with_curve(best)) {
        if (++n_refuted > most_refuted) peaks_.trust_curves_alone();
        for (const double direction : {-1.0, 1.0}) peaks_.spread(best, direction);
      }
    }
    throw NeedsOtherSearch{};
  }

  /// How the peak rises towards the bounds, and whether it is lower somewhere, as far as peaks can
  /// be carried.
  void outline(double best) {
    const bool logarithmic = options_.scale == ParameterScale::logarithmic;
    const double wide = on_scale(options_, logarithmic ? wide_of_scale : wide_of_span);
    const double lower = position_on(options_.scale, options_.lower);
    const double upper = position_on(options_.scale, options_.upper);
    for (double way = wide; best - way > lower || best + way < upper; way += wide) {
      std::vector<double> ring;
      for (const double at : {best - way, best + way}) {
        if (at > lower && at < upper) ring.push_back(at);
      }
      peaks_.solve_if_carried(ring);
    }
  }

  /// Beside the best value a peak may be higher than is known.
  [[nodiscard]] double proved(double best) const {
    const PeakOfParameter& highest = values().at(best).highest;
    if (!highest.whole_curve || highest.place == PeakPlace::unsolved) throw NeedsOtherSearch{};
    return best;
  }

  /// Where to solve for a value next: at the minimum, beside it, at the edges of its valley.
  std::vector<double> open_beside(double best) {
    const double here = lowest();
    const bool level =
        peaks_.amplitude(here) >= (1.0 - options_.amplitude_tolerance) * peaks_.amplitude(best);
    const bool near = std::abs(here - best) <= on_scale(options_, options_.relative_tolerance);
    if (!near && !level) return {here};
    std::vector<double> open;
    for (const double direction : {-1.0, 1.0}) {
      const std::optional<double> edge = edge_beside(best, direction);
      const bool asks =
          edge && !peaks_.trusts_curves_alone();  // a curve is too dear for an interval
      if (asks && !is_solved(*edge, edge_tolerance)) open.push_back(*edge);
      if (const auto beside = open_neighbour(best, direction)) open.push_back(*beside);
    }
    return open;
  }

  [[nodiscard]] bool is_solved(double position, double tolerance) const {
    return std::abs(peaks_.nearest(position) - position) <= on_scale(options_, tolerance);
  }

  /// Of a kink, or a jump, of their own the peaks with few harmonics know nothing: as the amplitude
  /// falls from the other side to the best value it may go on falling nearly to the neighbour. The
  /// middle of that way, where so much is to be gained.
  [[nodiscard]] std::optional<double> open_neighbour(double best, double direction) const {
    const double gain =
        peaks_.trusts_curves_alone() ? worth_a_curve : 2.0 * options_.amplitude_tolerance;
    const std::optional<double> there = peaks_.neighbour(best, direction);
    const std::optional<double> opposite = peaks_.neighbour(best, -direction);
    if (!there || std::abs(*there - best) > farthest_neighbour * step()) {
      return best + direction * step();
    }
    if (!opposite) return std::nullopt;
    const auto log_amplitude = [&](double at) {
      return std::log(values().at(at).highest.amplitude);
    };
    const double fall =
        (log_amplitude(*opposite) - log_amplitude(best)) / std::abs(*opposite - best);
    const double way = std::abs(*there - best);
    const bool is_open =
        fall * way > gain && way > 2.0 * on_scale(options_, options_.relative_tolerance);
    return is_open ? std::optional(std::midpoint(best, *there)) : std::nullopt;
  }

  /// Of values that are as low as the lowest, within the tolerance, the one whose neighbours are
  /// lowest: at the foot of a steep flank a little changes much. One whose whole curve is known
  /// already, where that is as good as well.
  [[nodiscard]] double robust_value() const {
    const double same = 1.0 + options_.amplitude_tolerance;
    const double limit = same * values().at(lowest_value()).highest.amplitude;
    double best = lowest_value();
    std::optional<double> traced;
    for (const auto& [at, value] : values()) {
      if (value.highest.amplitude > limit) continue;
      if (higher_neighbour(at) < higher_neighbour(best)) best = at;
      const bool is_whole = value.top && value.highest.whole_curve;
      const bool lower = !traced || higher_neighbour(at) < higher_neighbour(*traced);
      if (is_whole && lower) traced = at;
    }
    const bool is_enough = traced && higher_neighbour(*traced) <= same * higher_neighbour(best);
    return is_enough ? *traced : best;
  }

  /// Its amplitude; infinite where one is missing.
  [[nodiscard]] double higher_neighbour(double position) const {
    double amplitude = 0.0;
    for (const double direction : {-1.0, 1.0}) {
      const std::optional<double> beside = peaks_.neighbour(position, direction);
      if (!beside) return std::numeric_limits<double>::infinity();
      amplitude = std::max(amplitude, values().at(*beside).highest.amplitude);
    }
    return amplitude;
  }

  [[nodiscard]] double lowest_value() const {
    return std::ranges::min_element(
               values(), {}, [](const auto& value) { return value.second.highest.amplitude; })
        ->first;
  }

  /// Amplitudes over all values, and between those that are solved for.
  std::map<double, double> scanned() {
    std::map<double, double> known;
    const auto add_between = [&](double first, double last, int n) {
      for (int i = 1; i < n; ++i) {
        const double at = std::lerp(first, last, static_cast<double>(i) / n);
        known.emplace(at, peaks_.amplitude(at));
      }
    };
    add_between(position_on(options_.scale, options_.lower),
                position_on(options_.scale, options_.upper), scan);
    for (auto value = values().begin(); value != values().end(); ++value) {
      known.emplace(value->first, value->second.highest.amplitude);
      const auto after = std::next(value);
      if (after != values().end()) add_between(value->first, after->first, scan_between);
    }
    return known;
  }

  double lowest() {
    const std::map<double, double> known = scanned();
    const auto least =
        std::ranges::min_element(known, {}, [](const auto& one) { return one.second; });
    if (least == known.begin() || std::next(least) == known.end()) return least->first;
    double at = least->first;
    double value = least->second;
    minimise(
        [&](double there) {
          const double here = peaks_.amplitude(there);
          if (here < value) {
            value = here;
            at = there;
          }
          return here;
        },
        {std::prev(least)->first, at, std::next(least)->first, value},
        on_scale(options_, 0.5 * options_.relative_tolerance));
    return at;
  }

  /// Where the amplitude passes what is as good; empty: nowhere on that side.
  std::optional<double> edge_beside(double best, double direction) {
    const double limit = as_good * peaks_.amplitude(best);
    double inside = best;
    double outside = direction * std::numeric_limits<double>::infinity();
    for (const auto& [at, value] : scanned()) {
      if ((at - best) * direction <= 0.0 || value <= limit) continue;
      if ((outside - at) * direction > 0.0) outside = at;
    }
    if (!std::isfinite(outside)) return std::nullopt;
    while (std::abs(outside - inside) > 0.25 * on_scale(options_, edge_tolerance)) {
      const double middle = 0.5 * (inside + outside);
      (peaks_.amplitude(middle) <= limit ? inside : outside) = middle;
    }
    return inside;
  }

  [[nodiscard]] Optimum with_values() const {
    Optimum optimum;
    for (const auto& [at, value] : values()) optimum.trace.push_back(value.highest);
    optimum.orders = range_.orders;
    optimum.iterations = peaks_.work().iterations;
    optimum.contact_evaluations = peaks_.work().contact_evaluations;
    return optimum;
  }

  [[nodiscard]] Optimum found(double best, double believed) const {
    Optimum optimum = with_values();
    optimum.best = values().at(best).highest;
    optimum.best_curve = values().at(best).curve;
    optimum.found = true;
    optimum.n_curves = peaks_.n_curves();
    optimum.message = "settled: " + valley(optimum.trace, optimum.best);
    const bool one_frequency = range_.frequency_begin == range_.frequency_end;
    if (optimum.best.place == PeakPlace::range_end && !one_frequency) {
      optimum.message += "; the largest amplitude lies at an end of the frequency range";
    }
    std::ostringstream text;
    text << "with few harmonics the best value is " << believed
         << "; their peaks were corrected by " << values().size()
         << " values solved with those that it needs";
    optimum.notes.push_back(text.str());
    for (const PeakOfParameter& one : optimum.trace) {
      if (!one.detached) continue;
      optimum.notes.push_back(
          sentence("the highest peak stands on a branch detached from the curve: no sweep meets "
                   "it at ",
                   one.parameter));
      optimum.warnings.push_back(optimum.notes.back());
    }
    return optimum;
  }

  [[nodiscard]] std::optional<Optimum> out_of_time() const {
    if (values().empty()) return std::nullopt;
    Optimum optimum = with_values();
    optimum.best = values().at(lowest_value()).highest;
    optimum.reason = NotFound::out_of_time;
    optimum.objection = "out of time: the search was stopped before its end";
    optimum.message = optimum.objection + "; " + lowest_so_far(optimum.best);
    return optimum;
  }

  const ContinuationOptions& range_;
  const OptimumOptions& options_;
  CorrectedPeaks peaks_;
};

}  // namespace

CorrectedSearch search_corrected(PeakFamilies& few, const SceneFamily& family,
                                 const ContinuationOptions& range, const OptimumOptions& options,
                                 double believed) {
  return CorrectedPeakSearch(few, family, range, options).run(believed);
}

}  // namespace microslip::solver
