#include "solver/optimum/followed_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "solver/optimum/bracketed_minimum.hpp"
#include "solver/optimum/valley.hpp"

namespace microslip::solver {
namespace {

/// Largest amplitude by position on the scale of the parameter.
using PeakFunction = std::function<double(double)>;

// Two solutions of one amplitude differ by less: what is closer does not depend on the parameter.
constexpr double flat_within = 1.0 + 1e-7;
// A smooth minimum is as level as that over some 1e-3 of its parameter; of the scale.
constexpr double flat_width = 0.02;

class Search {
 public:
  Search(PeakFamilies& peaks, const OptimumOptions& options, bool one_frequency)
      : options_(options), one_frequency_(one_frequency), peaks_(peaks) {}

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

  /// Times an amplitude: what does not differ from it.
  [[nodiscard]] double the_same() const { return 1.0 + options_.amplitude_tolerance; }

  [[nodiscard]] double parameter(double position) const {
    return parameter_at(options_.scale, position);
  }
  [[nodiscard]] double position(double parameter) const {
    return position_on(options_.scale, parameter);
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
  /// lowest known, or lower by a part of what the higher neighbour has more, between neighbours
  /// further apart than a rough search leaves them, and not searched between just these.
  [[nodiscard]] std::vector<Place> open_valleys(const std::vector<PeakOfParameter>& peaks) const {
    constexpr double rival = 1.1;
    // Two branches that cross make the bottom of a valley, which its values need not be near.
    constexpr double deeper = 0.25;
    std::vector<Place> valleys;
    if (peaks.size() < 3) return valleys;
    const double least = lowest(peaks)->amplitude;
    for (auto one = std::next(peaks.begin()); std::next(one) != peaks.end(); ++one) {
      const auto [beside, above] =
          std::minmax(std::prev(one)->amplitude, std::next(one)->amplitude);
      const bool may_be_lowest = one->amplitude < rival * least ||
                                 one->amplitude - deeper * (above - one->amplitude) < least;
      const double width =
          position(std::next(one)->parameter) - position(std::prev(one)->parameter);
      // Less deep is the rounding of a flat stretch.
      const bool valley = one->amplitude * flat_within < beside && may_be_lowest;
      const bool wide = width > bracket_left * on_scale(options_, rough_search);
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
      search_beside(peaks, one, amplitude, rough_search);
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

  /// Of those that were traced whole: peaks that were followed there may not be the highest.
  [[nodiscard]] PeakOfParameter lowest_curve() const {
    PeakOfParameter least = result_.best;
    for (const PeakOfParameter& one : result_.trace) {
      const bool is_known = one.whole_curve && one.place != PeakPlace::unsolved;
      if (is_known && (!least.whole_curve || one.amplitude < least.amplitude)) least = one;
    }
    return least;
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
    if (result_.reason == NotFound::unsettled) result_.best = lowest_curve();
    // What lies beside it was not solved, or is another peak.
    const bool is_cut =
        result_.reason == NotFound::out_of_time || result_.reason == NotFound::unsettled;
    result_.message = is_cut ? lowest_so_far(result_.best) : valley(result_.trace, result_.best);
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
  PeakFamilies& peaks_;
  std::set<std::array<double, 3>>
      searched_;  // valleys of the present search, with their neighbours
  Optimum result_;
};

}  // namespace

PeakFamilies peaks_to_search(const SceneFamily& family, const ContinuationOptions& range,
                             const OptimumOptions& options) {
  return {family,
          range,
          {.lower = options.lower,
           .upper = options.upper,
           .n_values = options.n_scan,
           .n_checks = 3,
           .only_check = options.believed,
           .scale = options.scale,
           .amplitude_tolerance = options.amplitude_tolerance,
           .together = options.together}};
}

Optimum search_followed(PeakFamilies& peaks, const OptimumOptions& options, bool one_frequency) {
  return Search(peaks, options, one_frequency).run();
}

}  // namespace microslip::solver
