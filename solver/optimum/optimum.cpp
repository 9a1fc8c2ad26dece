#include "solver/optimum.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "solver/balance/first_harmonics.hpp"
#include "solver/enrichment/curve_harmonics.hpp"
#include "solver/optimum/common_harmonics.hpp"

namespace microslip::solver {
namespace {

/// Largest amplitude by position on the scale of the parameter.
using PeakFunction = std::function<double(double)>;

/// A minimum inside (a, c): f(b) ≤ f(a), f(c).
struct Bracket {
  double a, b, c;
  double value;
};

/// The minimum of a parabola through three points, relative to the first;
/// infinite where they lie on a line.
double parabola_step(const std::array<double, 3>& at, const std::array<double, 3>& value) {
  const double r = (at[0] - at[1]) * (value[0] - value[2]);
  const double q = (at[0] - at[2]) * (value[0] - value[1]);
  if (q == r) return std::numeric_limits<double>::infinity();
  return -0.5 * ((at[0] - at[2]) * q - (at[0] - at[1]) * r) / (q - r);
}

constexpr double bracket_left = 4.0;  // tolerances: what a search leaves of its bracket

/// Golden section with parabolic steps (Brent 1973, chapter 5) until the bracket is below the
/// tolerance.
void minimise(const PeakFunction& f, const Bracket& bracket, double tolerance) {
  constexpr double golden = 0.3819660112501051;
  double a = bracket.a;
  double c = bracket.c;
  std::array<double, 3> x{bracket.b, bracket.b, bracket.b};  // best, second, third
  std::array<double, 3> value{bracket.value, bracket.value, bracket.value};
  double last = c - a;
  double before_last = last;
  while (c - a > bracket_left * tolerance) {
    const double middle = 0.5 * (a + c);
    double step = parabola_step(x, value);
    // A parabola that leaves the bracket or does not halve the step before last is not trusted.
    const bool trusted = x[0] + step > a && x[0] + step < c && std::abs(step) < 0.5 * before_last;
    if (!trusted) step = golden * ((x[0] < middle ? c : a) - x[0]);
    if (std::abs(step) < tolerance) step = std::copysign(tolerance, middle - x[0]);
    before_last = trusted ? last : std::abs(step) / golden;
    last = std::abs(step);
    const double here = x[0] + step;
    const double found = f(here);
    if (found < value[0]) {
      (step > 0.0 ? a : c) = x[0];
      x = {here, x[0], x[1]};
      value = {found, value[0], value[1]};
    } else {
      (step > 0.0 ? c : a) = here;
      const bool second = found < value[1] || x[1] == x[0];
      x = second ? std::array{x[0], here, x[1]} : std::array{x[0], x[1], here};
      value =
          second ? std::array{value[0], found, value[1]} : std::array{value[0], value[1], found};
    }
  }
}

std::string sentence(const char* text, double value) {
  std::ostringstream stream;
  stream.precision(6);
  stream << text << value;
  return stream.str();
}

constexpr double as_good = 1.01;  // times the minimum
// Two solutions of one amplitude differ by less: what is closer does not depend on the parameter.
constexpr double flat_within = 1.0 + 1e-7;
// A smooth minimum is as level as that over some 1e-3 of its parameter; of the scale.
constexpr double flat_width = 0.02;
// Times the lowest amplitude: what lies beyond a value that high, as seen from the one believed to
// be the best, is not searched.
constexpr double rim = 1.1;
constexpr double rough = 1e-2;  // of the scale: tolerance for a valley that may not be the lowest

/// A share of the scale as a distance of positions.
double on_scale(const OptimumOptions& options, double share) {
  return share *
         (options.scale == ParameterScale::logarithmic ? 1.0 : options.upper - options.lower);
}

using Place = std::vector<PeakOfParameter>::const_iterator;

/// The values about the best one whose amplitude is at most `limit`: first and one past the last.
/// `trace` is sorted by parameter.
std::array<Place, 2> below(const std::vector<PeakOfParameter>& trace, const PeakOfParameter& best,
                           double limit) {
  const auto above = [limit](const PeakOfParameter& one) { return one.amplitude > limit; };
  const auto centre = std::find_if(trace.begin(), trace.end(), [&](const PeakOfParameter& one) {
    return one.parameter == best.parameter;
  });
  const auto left = std::find_if(std::make_reverse_iterator(centre), trace.rend(), above).base();
  return {left, std::find_if(centre, trace.end(), above)};
}

/// How well the minimum is determined: the interval about it that is as good to 1 %, and other
/// minima as good to 2 %. `trace` is sorted by parameter.
std::string valley(const std::vector<PeakOfParameter>& trace, const PeakOfParameter& best) {
  const auto [left, right] = below(trace, best, as_good * best.amplitude);
  std::ostringstream text;
  text.precision(4);
  text << "as good to 1 % from " << left->parameter << " to " << std::prev(right)->parameter;
  for (auto one = trace.begin(); one != trace.end(); ++one) {
    const bool elsewhere = one < left || one >= right;
    const bool lowest =
        (one == trace.begin() || std::prev(one)->amplitude > one->amplitude) &&
        (std::next(one) == trace.end() || std::next(one)->amplitude > one->amplitude);
    if (elsewhere && lowest && one->amplitude <= 1.02 * best.amplitude) {
      text << "; another minimum of nearly the same height near " << one->parameter;
    }
  }
  return text.str();
}

std::string lowest_so_far(const PeakOfParameter& best) {
  std::ostringstream text;
  text.precision(4);
  text << "the lowest so far at " << best.parameter;
  return text.str();
}

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

class Search {
 public:
  Search(const SceneFamily& family, const ContinuationOptions& range, const OptimumOptions& options)
      : options_(options),
        one_frequency_(range.frequency_begin == range.frequency_end),
        peaks_(family, range, trace_options(options)) {}

  Optimum run() {
    try {
      return searched();
    } catch (const SearchStopped&) {
      is_stopped_ = true;
      const std::vector<PeakOfParameter> known = peaks_.result().peaks;
      if (!known.empty()) result_.best = *lowest(known);
      return finished();
    }
  }

  /// Of the curve at a value; nullptr: none was traced.
  [[nodiscard]] const ResponsePoint* highest_at(const PeakOfParameter& value) const {
    return peaks_.highest_point(value.parameter);
  }

 private:
  Optimum searched() {
    peaks_.trace();
    const auto followed = [&](double parameter) { return peaks_.highest(parameter).amplitude; };
    const auto on_whole_curves = [&](double parameter) {
      static_cast<void>(peaks_.confirm(parameter));
      return peaks_.highest(parameter).amplitude;
    };
    // A peak that only the curve at the best value shows is followed from there, a valley that only
    // its edges show is searched, and all repeated; each round finds one more.
    constexpr int rounds = 8;
    for (int i = 0; i < rounds; ++i) {
      refine(followed);
      if (settled() && open_valleys(peaks_.result().peaks).empty()) return finished();
    }
    result_.notes.emplace_back(
        "peaks followed kept missing the highest one, or valleys kept appearing; search on whole "
        "curves");
    refine(on_whole_curves);
    is_settled_ = settled();
    return finished();
  }

  static PeakTraceOptions trace_options(const OptimumOptions& options) {
    return {.lower = options.lower,
            .upper = options.upper,
            .n_values = options.n_scan,
            .n_checks = 3,
            .only_check = options.believed,
            .rim = rim,
            .scale = options.scale,
            .amplitude_tolerance = options.amplitude_tolerance,
            .together = options.together};
  }

  /// Times an amplitude: what does not differ from it.
  [[nodiscard]] double the_same() const { return 1.0 + options_.amplitude_tolerance; }

  [[nodiscard]] double parameter(double position) const {
    return options_.scale == ParameterScale::logarithmic ? std::exp(position) : position;
  }
  [[nodiscard]] double position(double parameter) const {
    return options_.scale == ParameterScale::logarithmic ? std::log(parameter) : parameter;
  }

  static Place lowest(const std::vector<PeakOfParameter>& peaks) {
    return std::min_element(peaks.begin(), peaks.end(),
                            [](const auto& a, const auto& b) { return a.amplitude < b.amplitude; });
  }

  /// A value next to one at the end of those known: where it is lower, there is a minimum between.
  void probe_beside(const std::vector<PeakOfParameter>& peaks, Place place,
                    const PeakFunction& amplitude) {
    if (peaks.size() < 2) return;
    constexpr double close = 0.05;  // of the way to the neighbour
    const auto neighbour = place == peaks.begin() ? std::next(place) : std::prev(place);
    const double here = position(place->parameter);
    static_cast<void>(amplitude(parameter(here + close * (position(neighbour->parameter) - here))));
  }

  /// The minimum between the neighbours of a peak, neither of them lower.
  void search_beside(const std::vector<PeakOfParameter>& peaks, Place place,
                     const PeakFunction& amplitude, double relative_tolerance) {
    if (place == peaks.begin() || place == std::prev(peaks.end())) return;
    const Bracket bracket{position(std::prev(place)->parameter), position(place->parameter),
                          position(std::next(place)->parameter), place->amplitude};
    minimise([&](double at) { return amplitude(parameter(at)); }, bracket,
             on_scale(options_, relative_tolerance));
  }

  /// Inner values lower than their neighbours that may hide the minimum: nearly as low as the
  /// lowest known, between neighbours further apart than a rough search leaves them, and not
  /// searched between just these.
  [[nodiscard]] std::vector<Place> open_valleys(const std::vector<PeakOfParameter>& peaks) const {
    constexpr double rival = 1.1;
    std::vector<Place> valleys;
    if (peaks.size() < 3) return valleys;
    const double limit = rival * lowest(peaks)->amplitude;
    for (auto one = std::next(peaks.begin()); std::next(one) != peaks.end(); ++one) {
      const double beside = std::min(std::prev(one)->amplitude, std::next(one)->amplitude);
      const double width =
          position(std::next(one)->parameter) - position(std::prev(one)->parameter);
      // Less deep is the rounding of a flat stretch.
      const bool valley = one->amplitude * flat_within < beside && one->amplitude < limit;
      const bool wide = width > bracket_left * on_scale(options_, rough);
      if (valley && wide && searched_.count(neighbourhood(one)) == 0) valleys.push_back(one);
    }
    return valleys;
  }

  static std::array<double, 3> neighbourhood(Place place) {
    return {std::prev(place)->parameter, place->parameter, std::next(place)->parameter};
  }

  /// Valleys beside the lowest that the values known show only roughly may be deeper than it.
  void search_rivals(const PeakFunction& amplitude) {
    const std::vector<PeakOfParameter> peaks = peaks_.result().peaks;
    const std::vector<Place> valleys = open_valleys(peaks);
    const bool only_the_lowest = valleys.size() == 1 && valleys.front() == lowest(peaks);
    if (only_the_lowest) return;
    for (const auto one : valleys) {
      search_beside(peaks, one, amplitude, rough);
      searched_.insert(neighbourhood(one));
    }
  }

  /// Searches the minimum between the neighbours of the lowest value known.
  void search_lowest(const PeakFunction& amplitude) {
    std::vector<PeakOfParameter> known = peaks_.result().peaks;
    const auto least = lowest(known);
    if (least == known.begin() || least == std::prev(known.end())) {
      probe_beside(known, least, amplitude);
      known = peaks_.result().peaks;
    }
    const auto place = lowest(known);
    search_beside(known, place, amplitude, options_.relative_tolerance);
    if (place != known.begin() && std::next(place) != known.end()) {
      searched_.insert(neighbourhood(place));
    }
  }

  /// Searches the valleys that may hold the minimum until their values show no other.
  void refine(const PeakFunction& amplitude) {
    constexpr int most_searches =
        8;  // each finds what the one before laid open, seldom more than once
    if (peaks_.result().peaks.empty()) return;
    searched_.clear();  // amplitudes may have changed: a peak more is followed
    for (int i = 0; i < most_searches; ++i) {
      search_rivals(amplitude);
      search_lowest(amplitude);
      if (open_valleys(peaks_.result().peaks).empty()) return;
    }
  }

  /// Whether the lowest value is confirmed by its curve, and stays the lowest while the edges of
  /// its valley are solved for.
  bool settled() {
    const std::vector<PeakOfParameter> peaks = peaks_.result().peaks;
    if (peaks.empty()) return true;
    result_.best = *lowest(peaks);
    search_edges();
    // What lies beside curves is searched where the curves themselves have nothing against it.
    return is_proved(0) && (options_.search_starts == 0 || is_proved(options_.search_starts));
  }

  /// @param search_starts  of the curves that it is proved by.
  bool is_proved(int search_starts) {
    if (options_.search_starts > 0) trace_proofs(search_starts);
    if (!peaks_.confirm(result_.best.parameter, search_starts)) return false;
    // Following it once more may have found a peak that was missed before.
    const double confirmed = peaks_.highest(result_.best.parameter).amplitude;
    if (confirmed > the_same() * result_.best.amplitude) return false;
    search_edges();
    const std::vector<PeakOfParameter> all = peaks_.result().peaks;
    return lowest(all)->amplitude * the_same() >= result_.best.amplitude &&
           edges_hold(search_starts);
  }

  /// Ends of the interval called as good.
  [[nodiscard]] std::vector<double> edges() const {
    const std::vector<PeakOfParameter> peaks = peaks_.result().peaks;
    const auto [left, right] = below(peaks, result_.best, as_good * result_.best.amplitude);
    return {left->parameter, std::prev(right)->parameter};
  }

  /// The curves of the best value and of the edges, which are confirmed one after the other,
  /// side by side.
  void trace_proofs(int search_starts) {
    std::vector<double> values = edges();
    values.push_back(result_.best.parameter);
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    peaks_.prepare(values, search_starts);
  }

  /// No higher peak, of the curves or beside them, at the edges.
  bool edges_hold(int search_starts) {
    if (options_.search_starts == 0) return true;
    return std::ranges::all_of(edges(),
                               [&](double end) { return peaks_.confirm(end, search_starts); });
  }

  /// What stands against the ends of the interval called as good. @return  whether nothing does.
  bool tell_open_ends() {
    bool settled = true;
    if (options_.search_starts == 0) return settled;
    for (const double end : edges()) {
      if (end == result_.best.parameter || !peaks_.is_cut_short(end)) continue;
      const std::string open =
          sentence("not settled at ", end) +
          ", an end of the interval as good to 1 %: its curve is incomplete and "
          "may have a higher peak";
      result_.message += "; " + open;
      result_.warnings.push_back(open);
      settled = false;
    }
    return settled;
  }

  void search_edges() {
    const bool flat = flat_interval(peaks_.result().peaks).has_value();
    for (const double direction : {-1.0, 1.0}) {
      if (flat) search_edge(direction, flat_within * result_.best.amplitude);
      search_edge(direction, as_good * result_.best.amplitude);
    }
  }

  /// Solves for where the amplitude passes a limit, from the last value known to be lower towards
  /// the first known to be higher; nothing to do where no value on that side is higher.
  void search_edge(double direction, double limit) {
    constexpr double enough = 2e-3;  // of the scale: an interval is told, not a number
    const std::vector<PeakOfParameter> peaks = peaks_.result().peaks;
    const double best = position(result_.best.parameter);
    double inside = best;
    double outside = direction * std::numeric_limits<double>::infinity();
    for (const PeakOfParameter& peak : peaks) {
      const double at = position(peak.parameter);
      if ((at - best) * direction <= 0.0 || peak.amplitude <= limit) continue;
      if ((outside - at) * direction > 0.0) outside = at;
    }
    if (!std::isfinite(outside)) return;
    for (const PeakOfParameter& peak : peaks) {
      const double at = position(peak.parameter);
      if ((at - inside) * direction > 0.0 && (outside - at) * direction > 0.0) inside = at;
    }
    const double tolerance =
        on_scale(options_, std::max(enough, 2.0 * options_.relative_tolerance));
    while (std::abs(outside - inside) > tolerance) {
      const double middle = 0.5 * (inside + outside);
      (peaks_.highest(parameter(middle)).amplitude <= limit ? inside : outside) = middle;
    }
  }

  [[nodiscard]] std::optional<std::array<double, 2>> flat_interval(
      const std::vector<PeakOfParameter>& trace) const {
    const double limit = flat_within * lowest(trace)->amplitude;
    if (result_.best.amplitude > limit) return std::nullopt;
    const auto [first, end] = below(trace, result_.best, limit);
    const std::array<double, 2> flat{first->parameter, std::prev(end)->parameter};
    const bool wide = position(flat[1]) - position(flat[0]) > on_scale(options_, flat_width);
    return wide ? std::optional(flat) : std::nullopt;
  }

  [[nodiscard]] bool at_bound() const {
    // Values of the scan are made from positions and rounded.
    const double rounding = on_scale(options_, 1e-9);
    const double here = position(result_.best.parameter);
    return std::abs(here - position(options_.lower)) <= rounding ||
           std::abs(here - position(options_.upper)) <= rounding;
  }

  /// Why the lowest peak is not at the best value.
  [[nodiscard]] NotFound reason() const {
    if (is_stopped_) return NotFound::out_of_time;
    if (!is_settled_) return NotFound::unsettled;
    if (result_.flat) return NotFound::flat;
    if (at_bound()) return NotFound::at_bound;
    const double here = result_.best.parameter;
    if (here == result_.trace.front().parameter || here == result_.trace.back().parameter)
      return NotFound::no_solution_beside;
    if (!result_.best.whole_curve) return NotFound::incomplete_curve;
    return result_.best.place == PeakPlace::unsolved ? NotFound::unsolved_peak : NotFound::none;
  }

  [[nodiscard]] std::string objection() const {
    const double here = result_.best.parameter;
    switch (result_.reason) {
      case NotFound::none:
      case NotFound::count:
        break;
      case NotFound::out_of_time:
        return "out of time: the search was stopped before its end";
      case NotFound::no_solution:
        return "no solution was found for any value";
      case NotFound::unsettled:
        return sentence("not settled: peaks beside those followed kept appearing, the last near ",
                        here);
      case NotFound::flat:
        return sentence("flat: the smallest amplitude is the same from ", (*result_.flat)[0]) +
               sentence(" to ", (*result_.flat)[1]);
      case NotFound::at_bound:
        return sentence("the smallest amplitude lies at the bound ", here);
      case NotFound::no_solution_beside:
        return sentence("beside the smallest amplitude, at ", here) +
               ", the values searched have no solution";
      case NotFound::incomplete_curve:
        return sentence("the curve at the smallest amplitude, at ", here) +
               ", is incomplete: a higher peak may be missing";
      case NotFound::unsolved_peak:
        return sentence("the peak of the curve at the smallest amplitude, at ", here) +
               ", was not solved for";
    }
    return "";
  }

  Optimum finished() {
    const PeakTrace trace = peaks_.result();
    result_.trace = trace.peaks;
    result_.notes.insert(result_.notes.begin(), trace.notes.begin(), trace.notes.end());
    result_.warnings = trace.warnings;
    result_.orders = peaks_.orders();
    result_.n_curves = trace.n_curves;
    result_.iterations = trace.iterations;
    result_.contact_evaluations = trace.contact_evaluations;
    if (result_.trace.empty()) {
      result_.reason = is_stopped_ ? NotFound::out_of_time : NotFound::no_solution;
      result_.message = result_.objection = objection();
      return std::move(result_);
    }
    // The one confirmed: others of the valley are lower by rounding at most.
    result_.best = *std::find_if(
        result_.trace.begin(), result_.trace.end(),
        [&](const PeakOfParameter& one) { return one.parameter == result_.best.parameter; });
    result_.flat = flat_interval(result_.trace);
    result_.reason = reason();
    result_.objection = objection();
    result_.found = result_.reason == NotFound::none;
    result_.message = result_.reason == NotFound::out_of_time
                          ? lowest_so_far(result_.best)  // what lies beside it was not solved
                          : valley(result_.trace, result_.best);
    if (!result_.found) result_.message = result_.objection + "; " + result_.message;
    if (result_.best.place == PeakPlace::range_end && !one_frequency_) {
      result_.message += "; the largest amplitude lies at an end of the frequency range";
    }
    const bool settled = tell_open_ends();
    if (result_.found) {
      result_.message.insert(0, settled ? "settled: " : "settled but for an end of its interval: ");
    }
    return std::move(result_);
  }

  OptimumOptions options_;
  bool one_frequency_;
  bool is_settled_ = true;
  bool is_stopped_ = false;
  PeakFamilies peaks_;
  std::set<std::array<double, 3>>
      searched_;  // valleys of the present search, with their neighbours
  Optimum result_;
};

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

/// Bounds that a search with few harmonics has narrowed: to what is nearly as low,
/// within a factor of three.
OptimumOptions about(const OptimumOptions& options, const Optimum& first) {
  constexpr double clearly_higher = 1.6;  // few harmonics err by up to a third
  constexpr double factor = 3.0;
  constexpr double least_factor = 1.5;
  constexpr double share = 0.25;  // of a linear scale
  constexpr double least_share = 0.1;
  constexpr int n_scan = 9;
  const double best = first.best.parameter;
  const bool logarithmic = options.scale == ParameterScale::logarithmic;
  const double span = options.upper - options.lower;
  const auto beside = [&](double of_best, double of_span) {
    return logarithmic ? std::array{best / of_best, best * of_best}
                       : std::array{best - of_span * span, best + of_span * span};
  };
  const std::array farthest = beside(factor, share);
  const std::array nearest = beside(least_factor, least_share);
  const double limit = clearly_higher * first.best.amplitude;
  const double low = first_below(first.trace.begin(), first.trace.end(), limit);
  const double high = first_below(first.trace.rbegin(), first.trace.rend(), limit);
  OptimumOptions near = options;
  near.lower = std::max(options.lower, std::clamp(low, farthest[0], nearest[0]));
  near.upper = std::min(options.upper, std::clamp(high, nearest[1], farthest[1]));
  near.n_scan = std::min(options.n_scan, n_scan);
  near.believed = best;
  return near;
}

constexpr int few = 3;  // harmonics

/// What a search before has cost.
void add_work(Optimum& sum, const Optimum& before) {
  sum.iterations += before.iterations;
  sum.contact_evaluations += before.contact_evaluations;
  sum.n_curves += before.n_curves;
}

void add_work(Optimum& sum, const PeakWork& work) {
  sum.iterations += work.iterations;
  sum.contact_evaluations += work.contact_evaluations;
}

bool is_stopped(const Optimum& one) { return one.reason == NotFound::out_of_time; }

/// Searches again as long as the peak at the best value asks for harmonics that those of other
/// values have not. Stopped in the middle it is what the search before has found.
/// @param chosen  by other peaks; takes those in.
Optimum search_with_own_harmonics(const SceneFamily& family, const ContinuationOptions& range,
                                  const OptimumOptions& options, ContinuationOptions& chosen,
                                  PeakWork& work) {
  constexpr int most_searches = 3;
  Optimum before;
  double amplitude = 0.0;  // what was lacked there
  for (int searches = 1;; ++searches) {
    Search search(family, chosen, options);
    Optimum result = search.run();
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
        lacked_harmonics(family, result.best, search.highest_at(result.best), chosen, range, work);
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

/// Few harmonics tell where the best value lies; there it is searched with those given, or with
/// those that its own peak needs where they are chosen.
/// What few do not find is searched everywhere.
Optimum search_by_few_first(const SceneFamily& family, const ContinuationOptions& range,
                            const OptimumOptions& options) {
  OptimumOptions first_options = options;
  // Solutions beside the curves are looked for with few harmonics where peaks need not be exact.
  const bool coarse = options.amplitude_tolerance > OptimumOptions{}.amplitude_tolerance;
  if (!coarse) first_options.search_starts = 0;
  first_options.relative_tolerance = std::max(options.relative_tolerance, rough);
  const HarmonicSet least = least_harmonics(family(options.upper));
  ContinuationOptions lean = with_harmonics(range, least.united(HarmonicSet(few).orders()));
  lean.search_starts = 0;
  Optimum first = Search(family, lean, first_options).run();
  if (is_stopped(first)) return first;
  PeakWork work;
  if (!first.found) {
    const double middle = options.scale == ParameterScale::logarithmic
                              ? std::sqrt(options.lower * options.upper)
                              : 0.5 * (options.lower + options.upper);
    ContinuationOptions everywhere =
        with_common_harmonics(family, {options.lower, middle, options.upper}, range, work);
    Optimum result = search_with_own_harmonics(family, range, options, everywhere, work);
    add_work(result, first);
    add_work(result, work);
    return result;
  }
  ContinuationOptions chosen = with_common_harmonics(family, {first.best.parameter}, range, work);
  OptimumOptions near = about(options, first);
  if (coarse && !first.best.detached) near.search_starts = 0;
  Optimum result = search_with_own_harmonics(family, range, near, chosen, work);
  const double rounding = 1e-9 * (near.upper - near.lower);
  const double best = result.best.parameter;
  const bool left = (best <= near.lower + rounding && near.lower > options.lower) ||
                    (best >= near.upper - rounding && near.upper < options.upper);
  const bool again = left && !is_stopped(result);
  if (again) {
    const Optimum nearby = std::move(result);
    result = search_with_own_harmonics(family, range, options, chosen, work);
    add_work(result, nearby);
  }
  add_work(result, first);
  add_work(result, work);
  if (!again) {
    result.notes.push_back(sentence("with few harmonics the best value is ", first.best.parameter) +
                           sentence("; searched with those that it needs from ", near.lower) +
                           sentence(" to ", near.upper));
  }
  return result;
}

}  // namespace

Optimum minimise_peak(const SceneFamily& family, const ContinuationOptions& given,
                      const OptimumOptions& options) {
  check(options);
  ContinuationOptions range = given;
  range.judge_stability = false;
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const bool many = range.harmonic_tolerance > 0.0 || range.n_harmonics > few;
  Optimum optimum =
      many ? search_by_few_first(family, range, options) : Search(family, range, options).run();
  optimum.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return optimum;
}

}  // namespace microslip::solver
