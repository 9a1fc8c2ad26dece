#include "solver/optimum.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include "solver/balance/first_harmonics.hpp"
#include "solver/enrichment/curve_harmonics.hpp"
#include "solver/optimum/common_harmonics.hpp"
#include "solver/optimum/corrected_search.hpp"
#include "solver/optimum/followed_search.hpp"
#include "solver/optimum/valley.hpp"

namespace microslip::solver {
namespace {

void check(const OptimumOptions& options) {
  const bool positive = options.scale == ParameterScale::linear || options.lower > 0.0;
  if (!positive || !(options.upper > options.lower) || options.n_scan < 3) {
    throw std::invalid_argument("optimum: bounds " + std::to_string(options.lower) + " to " +
                                std::to_string(options.upper) + " with " +
                                std::to_string(options.n_scan) +
                                " scan points; needs lower < upper, 0 < lower on the logarithmic "
                                "scale, and at least 3 points");
  }
}

/// Where a trace, read from one of its ends, falls to a limit that its lowest value is below.
template <class Iterator>
double first_below(Iterator begin, Iterator end, double limit) {
  const auto inside = std::find_if(
      begin, end, [limit](const PeakOfParameter& one) { return one.amplitude <= limit; });
  if (inside == begin) return inside->parameter;
  const auto outside = std::prev(inside);
  const double share = (limit - inside->amplitude) / (outside->amplitude - inside->amplitude);
  return inside->parameter + share * (outside->parameter - inside->parameter);
}

/// Bounds that a search with few harmonics has narrowed about one of its minima: to what is nearly
/// as low, within a factor of three.
OptimumOptions about(const OptimumOptions& options, const std::vector<PeakOfParameter>& trace,
                     const PeakOfParameter& minimum) {
  constexpr double clearly_higher = 1.6;  // few harmonics err by up to a third
  constexpr double factor = 3.0;
  constexpr double least_factor = 1.5;
  constexpr double share = 0.25;  // of a linear scale
  constexpr double least_share = 0.1;
  constexpr int n_scan = 5;
  const double best = minimum.parameter;
  const bool logarithmic = options.scale == ParameterScale::logarithmic;
  const double span = options.upper - options.lower;
  const auto beside = [&](double of_best, double of_span) {
    return logarithmic ? std::array{best / of_best, best * of_best}
                       : std::array{best - of_span * span, best + of_span * span};
  };
  const std::array farthest = beside(factor, share);
  const std::array nearest = beside(least_factor, least_share);
  const double limit = clearly_higher * minimum.amplitude;
  const double low = first_below(trace.begin(), trace.end(), limit);
  const double high = first_below(trace.rbegin(), trace.rend(), limit);
  OptimumOptions near = options;
  near.lower = std::max(options.lower, std::clamp(low, farthest[0], nearest[0]));
  near.upper = std::min(options.upper, std::clamp(high, nearest[1], farthest[1]));
  near.n_scan = std::min(options.n_scan, n_scan);
  near.believed = best;
  return near;
}

/// Whether amplitudes rise between a value and a minimum: else it is of the same valley, or of a
/// flat stretch beside it.
bool is_apart(const std::vector<PeakOfParameter>& trace, const PeakOfParameter& one,
              const PeakOfParameter& minimum) {
  const auto [low, high] = std::minmax(one.parameter, minimum.parameter);
  return std::ranges::any_of(trace, [&, low = low, high = high](const PeakOfParameter& between) {
    return between.parameter > low && between.parameter < high &&
           between.amplitude > as_good * one.amplitude;
  });
}

/// Other minima with few harmonics, nearly as low as the lowest: with those that are needed one of
/// them may be the lowest. Two at most, the lowest first.
std::vector<PeakOfParameter> rivals_of(const Optimum& first, const OptimumOptions& searched) {
  constexpr double rival = 1.1;
  constexpr std::size_t most = 2;
  std::vector<PeakOfParameter> by_amplitude = first.trace;
  std::ranges::stable_sort(by_amplitude, {}, &PeakOfParameter::amplitude);
  std::vector<PeakOfParameter> minima{first.best};
  for (const PeakOfParameter& one : by_amplitude) {
    if (one.amplitude >= rival * first.best.amplitude || minima.size() > most) break;
    if (one.parameter >= searched.lower && one.parameter <= searched.upper) continue;
    const bool apart = std::ranges::all_of(
        minima, [&](const auto& other) { return is_apart(first.trace, one, other); });
    if (apart) minima.push_back(one);
  }
  minima.erase(minima.begin());
  return minima;
}

bool is_minimum(const Optimum& one) { return one.found || one.reason == NotFound::at_bound; }

/// What a search before has cost.
void add_work(Optimum& sum, const Optimum& before) {
  sum.iterations += before.iterations;
  sum.contact_evaluations += before.contact_evaluations;
  sum.n_curves += before.n_curves;
}

/// Of two minima searched apart the lower one, which names the other where that is nearly as low,
/// with the work of both.
Optimum lower_of(const Optimum& one, const Optimum& other) {
  const bool is_other =
      is_minimum(other) && (!is_minimum(one) || other.best.amplitude < one.best.amplitude);
  Optimum lower = is_other ? other : one;
  const Optimum& higher = is_other ? one : other;
  if (is_minimum(higher) && higher.best.amplitude <= nearly_as_low * lower.best.amplitude) {
    lower.message +=
        sentence("; another minimum of nearly the same height near ", higher.best.parameter);
  }
  add_work(lower, higher);
  return lower;
}

constexpr int few = 3;  // harmonics

void add_work(Optimum& sum, const PeakWork& work) {
  sum.iterations += work.iterations;
  sum.contact_evaluations += work.contact_evaluations;
}

/// As many values to a decade of a wide range as the usual number to each of three.
OptimumOptions with_scan_of_range(OptimumOptions options) {
  constexpr double usual_decades = 3.0;
  constexpr int most = 100;
  if (options.scale == ParameterScale::linear) return options;
  const double decades = std::log10(options.upper / options.lower);
  const double usual = options.n_scan - 1;
  const double steps = std::max(usual, std::ceil(usual / usual_decades * decades - 1e-9));
  options.n_scan = 1 + static_cast<int>(std::min(steps, most - 1.0));
  return options;
}

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

bool is_one_frequency(const ContinuationOptions& range) {
  return range.frequency_begin == range.frequency_end;
}

void add_work(PeakWork& sum, const PeakTrace& trace, int sign) {
  sum.iterations += sign * trace.iterations;
  sum.contact_evaluations += sign * trace.contact_evaluations;
}

bool is_stopped(const Optimum& one) { return one.reason == NotFound::out_of_time; }

/// What one search with harmonics given has found.
struct Searched {
  Optimum optimum;
  std::optional<ResponsePoint> highest;  ///< of the curve at the best value
};
using SearchWith = std::function<Searched(const ContinuationOptions& given)>;

Searched by_following(const SceneFamily& family, const ContinuationOptions& given,
                      const OptimumOptions& options) {
  PeakFamilies peaks = peaks_to_search(family, given, options);
  Searched result{search_followed(peaks, options, is_one_frequency(given)), std::nullopt};
  if (!result.optimum.found) return result;
  const ResponsePoint* highest = peaks.highest_point(result.optimum.best.parameter);
  if (highest != nullptr) result.highest = *highest;
  return result;
}

/// Searches again as long as the peak at the best value asks for harmonics that those of other
/// values have not. Stopped in the middle it is what the search before has found.
/// @param chosen  by other peaks; takes those in.
Optimum search_with_own_harmonics(const SceneFamily& family, const ContinuationOptions& range,
                                  const SearchWith& search, ContinuationOptions& chosen,
                                  PeakWork& work) {
  constexpr int most_searches = 3;
  Optimum before;
  double amplitude = 0.0;  // what was lacked there
  for (int searches = 1;; ++searches) {
    auto [result, highest] = search(chosen);
    if (is_stopped(result) && before.found) {
      add_work(before, result);
      before.warnings.push_back(
          sentence("out of time: with harmonics of its own the peak at the best value is ",
                   amplitude) +
          " m, and the search was not repeated with them");
      return before;
    }
    add_work(result, before);
    if (!result.found) return result;
    std::optional<LackedHarmonics> lacked =
        lacked_harmonics(family, result.best, highest ? &*highest : nullptr, chosen, range, work);
    if (!lacked) return result;
    if (searches == most_searches) {
      result.warnings.push_back(
          sentence("with harmonics of its own the peak at the best value is ", lacked->amplitude) +
          " m: those of the search do not tell it");
      return result;
    }
    chosen = std::move(lacked->range);
    amplitude = lacked->amplitude;
    before = std::move(result);
  }
}

/// A search with few harmonics, and what goes on from it.
class SearchByFewFirst {
 public:
  SearchByFewFirst(const SceneFamily& family, const ContinuationOptions& range,
                   const OptimumOptions& options)
      : family_(family),
        range_(range),
        options_(options),
        is_coarse_(options.amplitude_tolerance > OptimumOptions{}.amplitude_tolerance),
        few_(peaks_to_search(family, few_harmonics(), few_options())) {}

  Optimum run() {
    const Clock::time_point begin = Clock::now();
    first_ = search_followed(few_, few_options(), is_one_frequency(range_));
    first_.seconds = seconds_since(begin);
    if (is_stopped(first_)) return first_;
    Optimum result = first_.found ? about_first() : everywhere();
    add_work(result, first_);
    add_work(result, work_);
    result.n_curves += n_curves_in_vain_;
    result.by_few = std::make_shared<const Optimum>(std::move(first_));
    return result;
  }

 private:
  [[nodiscard]] ContinuationOptions few_harmonics() const {
    const HarmonicSet least = least_harmonics(family_(options_.upper));
    ContinuationOptions lean = with_harmonics(range_, least.united(HarmonicSet(few).orders()));
    lean.search_starts = 0;
    return lean;
  }

  /// Solutions beside the curves are looked for with few harmonics where peaks need not be exact.
  [[nodiscard]] OptimumOptions few_options() const {
    OptimumOptions options = options_;
    if (!is_coarse_) options.search_starts = 0;
    if (!is_coarse_)
      options.relative_tolerance = std::max(options.relative_tolerance, rough_search);
    return options;
  }

  /// What few harmonics do not find is searched everywhere.
  Optimum everywhere() {
    const double middle = options_.scale == ParameterScale::logarithmic
                              ? std::sqrt(options_.lower * options_.upper)
                              : 0.5 * (options_.lower + options_.upper);
    ContinuationOptions chosen =
        with_common_harmonics(family_, {options_.lower, middle, options_.upper}, range_, work_);
    return search_with_own_harmonics(
        family_, range_,
        [&](const ContinuationOptions& given) { return by_following(family_, given, options_); },
        chosen, work_);
  }

  /// About each of the minima of the first search that may be the lowest.
  Optimum about_first() {
    Optimum result = searched_about(first_.best);
    for (const PeakOfParameter& rival : rivals_of(first_, about_best(first_.best))) {
      if (is_stopped(result)) break;
      Optimum other = searched_about(rival);
      if (is_stopped(other)) {
        add_work(result, other);
        result.warnings.push_back(
            sentence("out of time: another minimum, nearly as low with few harmonics, was not "
                     "searched near ",
                     rival.parameter));
        break;
      }
      result = lower_of(result, other);
    }
    return result;
  }

  [[nodiscard]] OptimumOptions about_best(const PeakOfParameter& minimum) const {
    return about(options_, first_.trace, minimum);
  }

  Optimum searched_about(const PeakOfParameter& minimum) {
    ContinuationOptions chosen = with_common_harmonics(family_, {minimum.parameter}, range_, work_);
    OptimumOptions near = about_best(minimum);
    const bool beside = std::ranges::any_of(first_.trace, &PeakOfParameter::detached);
    if (is_coarse_ && !beside) near.search_starts = 0;
    const SearchWith search = [&](const ContinuationOptions& given) {
      if (is_coarse_) {
        if (std::optional<Searched> corrected = by_correcting(given, near, minimum.parameter))
          return std::move(*corrected);
      }
      Searched followed = by_following(family_, given, near);
      followed.optimum.notes.push_back(
          sentence("with few harmonics a best value is ", minimum.parameter) +
          sentence("; searched with those that it needs from ", near.lower) +
          sentence(" to ", near.upper));
      return followed;
    };
    Optimum result = search_with_own_harmonics(family_, range_, search, chosen, work_);
    const double rounding = 1e-9 * (near.upper - near.lower);
    const double best = result.best.parameter;
    const bool left = (best <= near.lower + rounding && near.lower > options_.lower) ||
                      (best >= near.upper - rounding && near.upper < options_.upper);
    if (!left || result.found || is_stopped(result)) return result;
    OptimumOptions all = options_;
    if (is_coarse_ && !beside) all.search_starts = 0;
    Optimum again = search_with_own_harmonics(
        family_, range_,
        [&](const ContinuationOptions& given) { return by_following(family_, given, all); }, chosen,
        work_);
    add_work(again, result);
    return again;
  }

  /// Empty: that does not go.
  std::optional<Searched> by_correcting(const ContinuationOptions& given,
                                        const OptimumOptions& near, double first_best) {
    add_work(work_, few_.result(), -1);  // more of its peaks are followed
    CorrectedSearch corrected = search_corrected(few_, family_, given, near, first_best);
    add_work(work_, few_.result(), 1);
    if (!corrected.optimum) {
      n_curves_in_vain_ += corrected.n_curves;
      work_.iterations += corrected.work.iterations;
      work_.contact_evaluations += corrected.work.contact_evaluations;
      return std::nullopt;
    }
    return Searched{std::move(*corrected.optimum), std::move(corrected.highest)};
  }

  const SceneFamily& family_;
  const ContinuationOptions& range_;
  const OptimumOptions& options_;
  bool is_coarse_;
  PeakFamilies few_;
  Optimum first_;
  PeakWork work_;
  int n_curves_in_vain_ = 0;
};

}  // namespace

Optimum minimise_peak(const SceneFamily& family, const ContinuationOptions& given,
                      const OptimumOptions& asked) {
  check(asked);
  const OptimumOptions options = with_scan_of_range(asked);
  ContinuationOptions range = given;
  range.judge_stability = false;
  range.require_proof = false;
  const Clock::time_point begin = Clock::now();
  const bool many = range.harmonic_tolerance > 0.0 || range.n_harmonics > few;
  Optimum optimum = many ? SearchByFewFirst(family, range, options).run()
                         : by_following(family, range, options).optimum;
  optimum.seconds = seconds_since(begin);
  return optimum;
}

}  // namespace microslip::solver
