#include "solver/optimum/corrected_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "solver/balance/first_harmonics.hpp"
#include "solver/continuation.hpp"
#include "solver/enrichment/carried_peak.hpp"
#include "solver/enrichment/curve_harmonics.hpp"
#include "solver/enrichment/enrichment.hpp"
#include "solver/enrichment/level_point.hpp"
#include "solver/optimum/bracketed_minimum.hpp"
#include "solver/optimum/valley.hpp"
#include "solver/peak/high_points.hpp"

namespace microslip::solver {
namespace {

constexpr std::size_t most_peaks = 3;  // carried at a value
// Times the highest with few harmonics: what is lower cannot be the highest.
constexpr double may_be_highest = 0.7;
constexpr std::size_t most_values = 24;
constexpr int most_curves = 9;
constexpr int most_refuted =
    2;                    // values, by their curves, before no peak that is carried is believed
constexpr int scan = 16;  // over all values
constexpr int scan_between = 4;             // two that are solved for
constexpr double step_of_scale = 0.06;      // of first neighbours, on the logarithmic scale
constexpr double step_of_span = 0.02;       // on the linear one
constexpr double farthest_neighbour = 1.7;  // steps
constexpr double worth_a_curve = 0.01;      // of the amplitude
constexpr double edge_tolerance = 1e-2;     // of the scale: an interval is told, not a number

using FamilyPeaks = std::map<std::size_t, LocalPeak>;

/// A value of the parameter where the peaks have all harmonics.
struct Value {
  FamilyPeaks few;
  FamilyPeaks all;                           // where they could be carried
  std::map<std::size_t, double> correction;  // log (A / a)
  PeakOfParameter highest;
  std::optional<ResponsePoint> top;  // of the whole curve, where it was traced
  int n_curves = 0;
  PeakWork work;
};

/// Curves say what peaks with few harmonics do not know of, or the minimum lies at a bound.
struct NeedsOtherSearch {};

class Correction {
 public:
  Correction(PeakFamilies& few, const SceneFamily& family, const ContinuationOptions& range,
             const OptimumOptions& options)
      : few_(few), family_(family), range_(range), options_(options) {}

  CorrectedSearch run(double believed) {
    CorrectedSearch result;
    try {
      const double best = settled(position(believed));
      result.highest = values_.at(best).top;
      result.optimum = found(best, believed);
    } catch (const NeedsOtherSearch&) {
    } catch (const SearchStopped&) {
      result.optimum = out_of_time();
    }
    result.work = work_;
    result.n_curves = n_curves_;
    return result;
  }

 private:
  [[nodiscard]] bool is_logarithmic() const {
    return options_.scale == ParameterScale::logarithmic;
  }
  [[nodiscard]] double position(double parameter) const {
    return is_logarithmic() ? std::log(parameter) : parameter;
  }
  [[nodiscard]] double parameter(double position) const {
    return is_logarithmic() ? std::exp(position) : position;
  }
  [[nodiscard]] double step() const {
    return on_scale(options_, is_logarithmic() ? step_of_scale : step_of_span);
  }

  /// The best value, when its minimum, its neighbours and the edges of its valley stay and its
  /// whole curve has the same peak.
  double settled(double believed) {
    solve({believed - step(), believed, believed + step()});
    while (values_.size() < most_values && n_curves_ < most_curves) {
      const double best = robust_value();
      const std::vector<double> open = open_beside(best);
      if (!open.empty()) {
        solve(open);
      } else if (values_.at(best).top) {
        return proved(best);
      } else if (!is_raised(best) && !agrees_with_curve(best)) {
        if (++n_refuted_ > most_refuted) trust_curves_alone();
        for (const double direction : {-1.0, 1.0}) spread(best, direction);
      }
    }
    throw NeedsOtherSearch{};
  }

  /// A value is solved again from what its neighbours are by now. @return  whether it has become
  /// higher.
  bool is_raised(double position) {
    Value before = values_.at(position);
    const double lower = before.highest.amplitude;
    solve({position});
    if (amplitude(position) < lower) values_.insert_or_assign(position, std::move(before));
    return amplitude(position) > (1.0 + options_.amplitude_tolerance) * lower;
  }

  /// What a curve has told of a value is followed to its neighbours, as far as it raises them.
  void spread(double position, double direction) {
    for (auto next = neighbour(position, direction); next; next = neighbour(*next, direction)) {
      if (values_.at(*next).top || !is_raised(*next)) return;
    }
  }

  /// Beside the best value a peak may be higher than is known.
  [[nodiscard]] double proved(double best) const {
    const PeakOfParameter& highest = values_.at(best).highest;
    if (!highest.whole_curve || highest.place == PeakPlace::unsolved) throw NeedsOtherSearch{};
    return best;
  }

  /// Where to solve for a value next: at the minimum, beside it, at the edges of its valley.
  std::vector<double> open_beside(double best) {
    const double here = lowest();
    const bool level = amplitude(here) >= (1.0 - options_.amplitude_tolerance) * amplitude(best);
    const bool near = std::abs(here - best) <= on_scale(options_, options_.relative_tolerance);
    if (!near && !level) return {here};
    std::vector<double> open;
    for (const double direction : {-1.0, 1.0}) {
      const std::optional<double> edge = edge_beside(best, direction);
      const bool asks = edge && !curves_alone_;  // a curve is too dear for an interval
      if (asks && !is_solved(*edge, edge_tolerance)) open.push_back(*edge);
      if (const auto beside = open_neighbour(best, direction)) open.push_back(*beside);
    }
    return open;
  }

  /// The top of a peak may be several, of which the one carried need not be the highest.
  void trust_curves_alone() {
    curves_alone_ = true;
    std::erase_if(values_, [](const auto& value) { return !value.second.top; });
    for (auto& [at, value] : values_) {
      const auto few = highest(value.few);
      value.correction = {{few->first, std::log(value.highest.amplitude / few->second.amplitude)}};
    }
  }

  [[nodiscard]] static FamilyPeaks::const_iterator highest(const FamilyPeaks& peaks) {
    return std::ranges::max_element(peaks, {},
                                    [](const auto& one) { return one.second.amplitude; });
  }

  [[nodiscard]] double nearest(double position) const {
    return std::ranges::min_element(
               values_, {}, [&](const auto& value) { return std::abs(value.first - position); })
        ->first;
  }

  [[nodiscard]] bool is_solved(double position, double tolerance) const {
    return std::abs(nearest(position) - position) <= on_scale(options_, tolerance);
  }

  /// Of a kink, or a jump, of their own the peaks with few harmonics know nothing: as the amplitude
  /// falls from the other side to the best value it may go on falling nearly to the neighbour. The
  /// middle of that way, where so much is to be gained.
  [[nodiscard]] std::optional<double> open_neighbour(double best, double direction) const {
    const double gain = curves_alone_ ? worth_a_curve : 2.0 * options_.amplitude_tolerance;
    const std::optional<double> there = neighbour(best, direction);
    const std::optional<double> opposite = neighbour(best, -direction);
    if (!there || std::abs(*there - best) > farthest_neighbour * step()) {
      return best + direction * step();
    }
    if (!opposite) return std::nullopt;
    const auto log_amplitude = [&](double at) {
      return std::log(values_.at(at).highest.amplitude);
    };
    const double fall =
        (log_amplitude(*opposite) - log_amplitude(best)) / std::abs(*opposite - best);
    const double way = std::abs(*there - best);
    const bool is_open =
        fall * way > gain && way > 2.0 * on_scale(options_, options_.relative_tolerance);
    return is_open ? std::optional(std::midpoint(best, *there)) : std::nullopt;
  }

  /// The next value that is solved for.
  [[nodiscard]] std::optional<double> neighbour(double best, double direction) const {
    const auto here = values_.find(best);
    if (direction > 0.0) {
      const auto after = std::next(here);
      return after != values_.end() ? std::optional(after->first) : std::nullopt;
    }
    return here != values_.begin() ? std::optional(std::prev(here)->first) : std::nullopt;
  }

  /// Of values that are as low as the lowest, within the tolerance, the one whose neighbours are
  /// lowest: at the foot of a steep flank a little changes much.
  [[nodiscard]] double robust_value() const {
    const double limit =
        (1.0 + options_.amplitude_tolerance) * values_.at(lowest_value()).highest.amplitude;
    double best = lowest_value();
    for (const auto& [at, value] : values_) {
      const bool is_low = value.highest.amplitude <= limit;
      if (is_low && higher_neighbour(at) < higher_neighbour(best)) best = at;
    }
    return best;
  }

  /// Its amplitude; infinite where one is missing.
  [[nodiscard]] double higher_neighbour(double position) const {
    double amplitude = 0.0;
    for (const double direction : {-1.0, 1.0}) {
      const std::optional<double> beside = neighbour(position, direction);
      if (!beside) return std::numeric_limits<double>::infinity();
      amplitude = std::max(amplitude, values_.at(*beside).highest.amplitude);
    }
    return amplitude;
  }

  [[nodiscard]] double lowest_value() const {
    return std::ranges::min_element(
               values_, {}, [](const auto& value) { return value.second.highest.amplitude; })
        ->first;
  }

  /// Peaks at values are carried to all harmonics, several values side by side.
  void solve(const std::vector<double>& positions) {
    std::vector<Value> fresh(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const auto known = values_.find(positions[i]);
      fresh[i].few = known != values_.end() ? known->second.few : high_peaks(positions[i]);
    }
    options_.together(positions.size(), [&](std::size_t i) {
      if (curves_alone_ || !carry(positions[i], fresh[i])) trace(positions[i], fresh[i]);
    });
    for (std::size_t i = 0; i < positions.size(); ++i) keep(positions[i], std::move(fresh[i]));
  }

  void keep(double position, Value value) {
    work_.iterations += std::exchange(value.work.iterations, 0);
    work_.contact_evaluations += std::exchange(value.work.contact_evaluations, 0);
    n_curves_ += std::exchange(value.n_curves, 0);
    if (range_.stop && range_.stop()) throw SearchStopped{};
    if (!(value.highest.amplitude > 0.0)) throw NeedsOtherSearch{};
    values_.insert_or_assign(position, std::move(value));
  }

  /// With few harmonics.
  FamilyPeaks high_peaks(double position) {
    const double value = parameter(position);
    const bool inside = value >= options_.lower && value <= options_.upper;
    if (!inside) throw NeedsOtherSearch{};
    const PeakOfParameter highest = few_.highest(value);
    FamilyPeaks peaks;
    for (auto& [family, peak] : few_.followed_to(value)) {
      if (peaks.size() == most_peaks || peak.amplitude < may_be_highest * highest.amplitude) break;
      peaks.emplace(family, std::move(peak));
    }
    const bool is_followed = std::ranges::any_of(peaks, [&](const auto& one) {
      return one.second.amplitude >= (1.0 - options_.amplitude_tolerance) * highest.amplitude;
    });
    if (!is_followed) throw NeedsOtherSearch{};
    return peaks;
  }

  /// @return  false: one is lost.
  [[nodiscard]] bool carry(double position, Value& value) const {
    const Scene scene = family_(parameter(position));
    value.highest = {parameter(position)};
    for (const auto& [family, peak] : value.few) {
      std::optional<LocalPeak> all = carried(scene, position, family, peak, value.work);
      if (!all) return false;
      value.correction[family] = std::log(all->amplitude / peak.amplitude);
      if (all->amplitude > value.highest.amplitude) {
        value.highest.amplitude = all->amplitude;
        value.highest.frequency = all->point.parameter;
        value.highest.place = all->place;
      }
      value.all.emplace(family, std::move(*all));
    }
    return true;
  }

  /// The highest point of the whole curve stands for the highest peak with few harmonics, unless
  /// one that was carried is higher: it stands on a branch beside the curve, and counts. An
  /// amplitude of zero: nothing was solved.
  void trace(double position, Value& value) const {
    const Scene scene = family_(parameter(position));
    const ResponseCurve curve = trace_response(scene, range_with_starts(), until_stopped(range_));
    value.work.iterations += curve.iterations;
    value.work.contact_evaluations += curve.contact_evaluations;
    ++value.n_curves;
    const PeakOfParameter carried = std::exchange(value.highest, {parameter(position)});
    const std::vector<HighPoint> high = high_points(scene, curve, range_);
    if (high.empty()) return;
    const HighPoint& top = high.front();
    value.top = top.point;
    value.highest.whole_curve = curve.complete;
    if (carried.amplitude > (1.0 + options_.amplitude_tolerance) * top.point.amplitude) {
      value.highest = carried;
      value.highest.whole_curve = curve.complete;
      value.highest.detached = curve.complete && top.place != PeakPlace::unsolved;
      return;
    }
    value.highest.amplitude = top.point.amplitude;
    value.highest.frequency = top.point.frequency;
    value.highest.place = top.place;
    value.highest.detached = top.detached;
    const auto highest_of_few = highest(value.few);
    value.correction[highest_of_few->first] =
        std::log(value.highest.amplitude / highest_of_few->second.amplitude);
    if (top.place != PeakPlace::peak) return;
    HarmonicBalance balance(scene, first_harmonics(scene, range_));
    if (auto peak = local_peak(balance, top.point)) {
      value.all.insert_or_assign(highest_of_few->first, std::move(*peak));
    }
  }

  /// Solutions beside the curve are looked for as well where few harmonics have found some.
  [[nodiscard]] ContinuationOptions range_with_starts() const {
    ContinuationOptions range = range_;
    range.search_starts = std::max(range.search_starts, options_.search_starts);
    return range;
  }

  /// @return  whether its whole curve has no higher peak than the one carried to a value.
  bool agrees_with_curve(double position) {
    Value value = values_.at(position);
    const double carried = value.highest.amplitude;
    trace(position, value);
    const double traced = value.highest.amplitude;
    keep(position, std::move(value));
    return traced <= (1.0 + options_.amplitude_tolerance) * carried;
  }

  /// From what it is at the next values on both sides, moved as it moves with few harmonics, the
  /// higher one: the top of a peak may be several. Else from few.
  [[nodiscard]] std::optional<LocalPeak> carried(const Scene& scene, double position,
                                                 std::size_t family, const LocalPeak& peak,
                                                 PeakWork& work) const {
    constexpr double farthest = 1.0;  // amplitudes or widths along the branch
    const HarmonicSet from = first_harmonics(scene, few_.range());
    const HarmonicSet to = first_harmonics(scene, range_);
    const HarmonicBalance coarse(scene, from);
    HarmonicBalance richer(scene, to);
    std::optional<LocalPeak> highest;
    for (const Value* known : beside_with(family, position)) {
      const LocalPeak there = embedded(known->few.at(family), coarse, richer);
      const LocalPeak& all = known->all.at(family);
      LocalPeak start = embedded(peak, coarse, richer);
      start.point.x += all.point.x - there.point.x;
      if (start.place == PeakPlace::peak) {
        start.point.parameter += all.point.parameter - there.point.parameter;
      }
      start.tangent = all.tangent;
      auto found = level_point(richer, start, range_, work, farthest);
      if (found && (!highest || found->amplitude > highest->amplitude)) highest = std::move(found);
    }
    return highest ? highest : carried_peak(scene, range_, peak, from, to, work);
  }

  /// The next values below and above that have a peak of the family.
  [[nodiscard]] std::vector<const Value*> beside_with(std::size_t family, double position) const {
    const Value* below = nullptr;
    const Value* above = nullptr;
    for (const auto& [at, value] : values_) {
      if (at == position || !value.all.contains(family)) continue;
      if (at < position) below = &value;
      if (at > position && above == nullptr) above = &value;
    }
    std::vector<const Value*> beside;
    for (const Value* one : {below, above}) {
      if (one != nullptr) beside.push_back(one);
    }
    return beside;
  }

  /// log (A / a) of a family; of one that no value has, that of the highest at the nearest value.
  [[nodiscard]] double correction(std::size_t family, double position) const {
    std::optional<std::pair<double, double>> below;
    for (const auto& [at, value] : values_) {
      const auto known = value.correction.find(family);
      if (known == value.correction.end()) continue;
      const std::pair here{at, known->second};
      if (at <= position) {
        below = here;
        continue;
      }
      if (!below) return here.second;
      const double share = (position - below->first) / (here.first - below->first);
      return std::lerp(below->second, here.second, share);
    }
    if (below) return below->second;
    const Value& value = values_.at(nearest(position));
    return std::log(value.highest.amplitude / highest(value.few)->second.amplitude);
  }

  /// The highest peak with all harmonics, as far as the values solved for tell it.
  double amplitude(double position) {
    if (const auto value = values_.find(position); value != values_.end()) {
      return value->second.highest.amplitude;
    }
    auto known = few_at_.find(position);
    if (known == few_at_.end()) {
      static_cast<void>(few_.highest(parameter(position)));
      std::vector<std::pair<std::size_t, double>> peaks;
      for (const auto& [family, peak] : few_.followed_to(parameter(position))) {
        peaks.emplace_back(family, peak.amplitude);
      }
      known = few_at_.emplace(position, std::move(peaks)).first;
    }
    double highest = 0.0;
    for (const auto& [family, few] : known->second) {
      highest = std::max(highest, few * std::exp(correction(family, position)));
    }
    return highest > 0.0 ? highest : std::numeric_limits<double>::infinity();
  }

  /// Amplitudes over all values, and between those that are solved for.
  std::map<double, double> scanned() {
    std::map<double, double> known;
    const auto add_between = [&](double first, double last, int n) {
      for (int i = 1; i < n; ++i) {
        const double at = std::lerp(first, last, static_cast<double>(i) / n);
        known.emplace(at, amplitude(at));
      }
    };
    add_between(position(options_.lower), position(options_.upper), scan);
    for (auto value = values_.begin(); value != values_.end(); ++value) {
      known.emplace(value->first, value->second.highest.amplitude);
      const auto after = std::next(value);
      if (after != values_.end()) add_between(value->first, after->first, scan_between);
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
          const double here = amplitude(there);
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
    const double limit = as_good * amplitude(best);
    double inside = best;
    double outside = direction * std::numeric_limits<double>::infinity();
    for (const auto& [at, value] : scanned()) {
      if ((at - best) * direction <= 0.0 || value <= limit) continue;
      if ((outside - at) * direction > 0.0) outside = at;
    }
    if (!std::isfinite(outside)) return std::nullopt;
    while (std::abs(outside - inside) > 0.25 * on_scale(options_, edge_tolerance)) {
      const double middle = 0.5 * (inside + outside);
      (amplitude(middle) <= limit ? inside : outside) = middle;
    }
    return inside;
  }

  [[nodiscard]] Optimum with_values() const {
    Optimum optimum;
    for (const auto& [at, value] : values_) optimum.trace.push_back(value.highest);
    optimum.orders = range_.orders;
    optimum.iterations = work_.iterations;
    optimum.contact_evaluations = work_.contact_evaluations;
    return optimum;
  }

  [[nodiscard]] Optimum found(double best, double believed) const {
    Optimum optimum = with_values();
    optimum.best = values_.at(best).highest;
    optimum.found = true;
    optimum.n_curves = n_curves_;
    optimum.message = "settled: " + valley(optimum.trace, optimum.best);
    const bool one_frequency = range_.frequency_begin == range_.frequency_end;
    if (optimum.best.place == PeakPlace::range_end && !one_frequency) {
      optimum.message += "; the largest amplitude lies at an end of the frequency range";
    }
    std::ostringstream text;
    text << "with few harmonics the best value is " << believed
         << "; their peaks were corrected by " << values_.size()
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
    if (values_.empty()) return std::nullopt;
    Optimum optimum = with_values();
    optimum.best = values_.at(lowest_value()).highest;
    optimum.reason = NotFound::out_of_time;
    optimum.objection = "out of time: the search was stopped before its end";
    optimum.message = optimum.objection + "; " + lowest_so_far(optimum.best);
    return optimum;
  }

  PeakFamilies& few_;
  const SceneFamily& family_;
  const ContinuationOptions& range_;
  const OptimumOptions& options_;
  std::map<double, Value> values_;  // by position
  std::map<double, std::vector<std::pair<std::size_t, double>>> few_at_;
  bool curves_alone_ = false;  // peaks that were carried have been refuted
  int n_refuted_ = 0;
  int n_curves_ = 0;
  PeakWork work_;
};

}  // namespace

CorrectedSearch search_corrected(PeakFamilies& few, const SceneFamily& family,
                                 const ContinuationOptions& range, const OptimumOptions& options,
                                 double believed) {
  return Correction(few, family, range, options).run(believed);
}

}  // namespace microslip::solver
