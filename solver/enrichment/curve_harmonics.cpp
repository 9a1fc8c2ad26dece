#include "solver/enrichment/curve_harmonics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "solver/balance/first_harmonics.hpp"
#include "solver/enrichment/resonances_along.hpp"
#include "solver/peak/high_points.hpp"

namespace microslip::solver {
namespace {

constexpr std::size_t most_places = 3;  // of a curve, from the highest down
constexpr double of_interest = 0.3;     // of the highest
constexpr int most_traces = 3;          // of a curve for the choice, and of the one that is given
// With so many first harmonics the peak is looked for, where it cannot be followed from one: curves
// that cost little beside that of all it may need.
constexpr std::array stepping_stones{3, 7};

struct Place {
  LocalPeak peak;
  double frequency = 0.0;
  bool is_told = false;  // the highest peak of the curve, else its highest end
  double height = 1.0;   // over the highest; of what is told, its own
};

/// What the answer of a curve is read from: what is told of it, then what is higher or nearly so.
std::vector<Place> places_of(const Scene& scene, const ContinuationOptions& range,
                             const HarmonicSet& set, const ResponseCurve& curve) {
  const ContinuationOptions given = with_harmonics(range, set);
  HarmonicBalance balance(scene, set);
  std::vector<Place> places;
  const std::vector<HighPoint> high = high_points(scene, curve, given);
  const HighPoint* told = highest_of_curve(high);
  const auto add = [&](const HighPoint& one) {
    auto place = one.place == PeakPlace::peak ? local_peak(balance, one.point)
                                              : local_end(balance, one.point, given);
    if (place) places.push_back({std::move(*place), one.point.frequency, &one == told});
  };
  if (told != nullptr) add(*told);
  for (const HighPoint& one : high) {
    const bool counts = one.point.amplitude > of_interest * high.front().point.amplitude;
    if (!counts || places.size() == most_places) break;
    if (&one != told) add(one);
  }
  const double highest = high.empty() ? 0.0 : high.front().point.amplitude;
  for (Place& place : places) {
    if (!place.is_told && highest > 0.0) place.height = place.peak.amplitude / highest;
  }
  return places;
}

/// What a lower place lacks counts as a share of the highest; of what is told, of itself.
ContinuationOptions range_of(const Place& place, ContinuationOptions range) {
  if (place.height > 0.0) range.harmonic_tolerance /= std::min(place.height, 1.0);
  return range;
}

/// Of its kind, a peak or an end, within a share of the frequency; nullptr: none.
const SettledPeak* nearest_of(const std::vector<SettledPeak>& known, const LocalPeak& peak,
                              double share) {
  const SettledPeak* nearest = nullptr;
  double least = share;
  for (const SettledPeak& one : known) {
    const double shift = std::abs(one.frequency / peak.point.parameter - 1.0);
    if (shift > least || one.is_end != (peak.place == PeakPlace::range_end)) continue;
    least = shift;
    nearest = &one;
  }
  return nearest;
}

/// Relative, of a peak to what it is with more harmonics, and of that to what it should be; of the
/// nearest in frequency. Empty: none is near.
std::optional<double> distance_to(const std::vector<SettledPeak>& known, const LocalPeak& peak,
                                  double tolerance) {
  const SettledPeak* nearest = nearest_of(known, peak, tolerance);
  if (nearest == nullptr) return std::nullopt;
  return std::abs(nearest->amplitude / peak.amplitude - 1.0) + nearest->left_out;
}

/// The next set of which the curve is cheap. @param now  that of the curve at hand.
std::optional<HarmonicSet> stepping_stone(const HarmonicSet& least, const HarmonicSet& now,
                                          const HarmonicSet& wanted) {
  for (const int highest : stepping_stones) {
    HarmonicSet stone = HarmonicSet(highest).united(least.orders());
    if (stone.count() > now.count() && 2 * stone.count() <= wanted.count()) return stone;
  }
  return std::nullopt;
}

/// With few harmonics a curve may lack the peak it has with those chosen, or have one more: of an
/// end nothing follows for a peak.
SettledPeak settled_of(const CurveHarmonics& chosen, const ResponseCurve& curve) {
  const bool has_peak = std::ranges::any_of(
      curve.points, [](const ResponsePoint& point) { return point.mark == PointMark::peak; });
  return has_peak == chosen.is_peak ? chosen.highest : SettledPeak{};
}

bool is_stopped(const ContinuationOptions& range) { return range.stop && range.stop(); }

/// What the highest place of a curve is with more harmonics. @param near  nullptr: not known yet.
SettledPeak settled_at(const SettledPeak* near, PeakHarmonicsChoice& choice, const HarmonicSet& set,
                       const LocalPeak& peak) {
  if (near != nullptr) return *near;
  const PeakHarmonics own = choice.choose(set, peak, set);
  return own.peak ? own.richest : SettledPeak{};
}

/// With more harmonics the peak of a curve may be followed to a branch beside it.
void tell_peak_beside(const SettledPeak& found, double tolerance, ResponseCurve& curve) {
  const SettledPeak& own = curve.settled_peak;
  const double shift = std::abs(found.frequency / own.frequency - 1.0);
  const bool is_own = !(found.amplitude > (1.0 + tolerance) * own.amplitude && shift > tolerance);
  if (!curve.complete || !(own.amplitude > 0.0) || is_own) return;
  std::ostringstream text;
  text.precision(4);
  text << (curve.message.empty() ? "" : "; ") << "a solution beside the curve has a peak of "
       << found.amplitude << " m at " << 0.5 * found.frequency / std::numbers::pi
       << " Hz: harmonics were chosen for it as well, and response.search_starts looks for its "
          "branch";
  curve.message += text.str();
}

/// @param resonates  one that is left out, somewhere along the curve: it may do anything.
void note_unsettled(ResponseCurve& curve, bool resonates) {
  if (curve.points.empty()) return;
  const auto highest = std::ranges::max_element(curve.points, {}, &ResponsePoint::amplitude);
  curve.log.push_back({highest->frequency, Remedy::harmonics_kept});
  if (!resonates) return;
  for (ResponsePoint& point : curve.points) {
    if (point.mark != PointMark::peak && &point != &*highest) continue;
    point.harmonics_left_out = std::max(point.harmonics_left_out, all_left_out);
  }
}

void count(CurveHarmonics& sum, const PeakWork& work) {
  sum.iterations += work.iterations;
  sum.contact_evaluations += work.contact_evaluations;
}

/// The curve at hand and what was done for it.
class ChosenCurve {
 public:
  ChosenCurve(const Scene& scene, const ContinuationOptions& range, const CurveOfSet& first,
              const CurveOfSet& trace)
      : scene_(scene),
        range_(range),
        first_(first),
        trace_(trace),
        set_(least_harmonics(scene)),
        curve_(first(set_)) {
    add({.set = set_,
         .iterations = curve_.iterations,
         .contact_evaluations = curve_.contact_evaluations});
  }

  ResponseCurve run() {
    bool has_along = false;  // orders along the curve were added to those chosen
    for (int traces = 0; traces < most_traces; ++traces) {
      const Choice choice = has_along ? Choice::with_others : choose();
      if (choice == Choice::stopped) break;
      check();
      if (is_stopped(range_) || curve_.diagnosis == Diagnosis::interrupted) {
        is_settled_ = is_settled_ && set_.united(chosen_.set.orders()) == set_ && !resonates();
        break;
      }
      if (choice == Choice::with_others && !is_settled_) {
        has_along = false;
        continue;
      }
      const std::vector<int> along = resonances_along(scene_, range_, set_, curve_);
      if (along.empty()) break;
      is_settled_ = false;  // until they are asked
      if (traces + 1 == most_traces || !traced_with(set_.united(along))) break;
      has_along = true;
    }
    return finished();
  }

 private:
  enum class Choice { as_before, with_others, stopped };

  Choice choose() {
    chosen_ = choose_harmonics(scene_, range_, set_, curve_, first_);
    add(chosen_);
    if (chosen_.set == set_ || is_stopped(range_)) return Choice::as_before;
    if (chosen_.traced && chosen_.traced->complete && !is_given_) {
      set_ = chosen_.set;
      curve_ = std::move(*chosen_.traced);
      return Choice::with_others;
    }
    // With few harmonics already the curve tells most of what may resonate along it.
    const HarmonicSet all = chosen_.set.united(resonances_along(scene_, range_, set_, curve_));
    ResponseCurve richer = traced(all);
    if (!richer.complete && is_stopped(range_)) {  // a whole curve is worth more than half a better
      is_settled_ = false;
      curve_.settled_peak = settled_of(chosen_, curve_);
      return Choice::stopped;
    }
    set_ = all;
    curve_ = std::move(richer);
    return Choice::with_others;
  }

  [[nodiscard]] bool resonates() const {
    return !resonances_along(scene_, range_, set_, curve_).empty();
  }

  void check() {
    const CurveHarmonics checked = check_harmonics(scene_, range_, set_, chosen_.known, curve_);
    const bool is_told = checked.highest.amplitude > 0.0;
    curve_.settled_peak = is_told ? checked.highest : settled_of(chosen_, curve_);
    add(checked);
  }

  /// @return  false: the one at hand is complete, and that is not.
  bool traced_with(const HarmonicSet& all) {
    ResponseCurve richer = traced(all);
    if (!richer.complete && curve_.complete) return false;
    set_ = all;
    curve_ = std::move(richer);
    return true;
  }

  ResponseCurve traced(const HarmonicSet& all) {
    is_given_ = true;
    ResponseCurve richer = trace_(all);
    iterations_ += richer.iterations;
    contact_evaluations_ += richer.contact_evaluations;
    return richer;
  }

  void add(const CurveHarmonics& done) {
    iterations_ += done.iterations;
    contact_evaluations_ += done.contact_evaluations;
    is_settled_ = done.settled;
  }

  ResponseCurve finished() {
    tell_peak_beside(chosen_.is_peak ? chosen_.highest : SettledPeak{}, range_.harmonic_tolerance,
                     curve_);
    curve_.iterations = iterations_;
    curve_.contact_evaluations = contact_evaluations_;
    if (!is_settled_) note_unsettled(curve_, resonates());
    return std::move(curve_);
  }

  const Scene& scene_;
  const ContinuationOptions& range_;
  const CurveOfSet& first_;
  const CurveOfSet& trace_;
  HarmonicSet set_;
  ResponseCurve curve_;
  CurveHarmonics chosen_;  ///< the last choice
  bool is_given_ = false;  ///< the curve at hand was traced by `trace`
  bool is_settled_ = true;
  long iterations_ = 0;
  long contact_evaluations_ = 0;
};

}  // namespace

ContinuationOptions with_harmonics(const ContinuationOptions& range, const HarmonicSet& set) {
  ContinuationOptions given = range;
  given.harmonic_tolerance = 0.0;
  given.n_harmonics = set.highest();
  given.orders = set.orders();
  given.without_mean = !set.has_mean();
  return given;
}

CurveHarmonics choose_harmonics(const Scene& scene, const ContinuationOptions& range,
                                const HarmonicSet& set, const ResponseCurve& curve,
                                const CurveOfSet& trace) {
  CurveHarmonics chosen{set};
  const ResponseCurve* now = &curve;
  ResponseCurve traced;
  HarmonicSet of_now = set;
  for (int traces = 0; traces <= most_traces; ++traces) {
    chosen.settled = true;
    chosen.left_out = 0.0;
    chosen.known.clear();
    chosen.highest = {};
    bool is_lost = false;
    for (const Place& place : places_of(scene, range, of_now, *now)) {
      // Next to an internal resonance a peak is several, close together.
      const auto distance = of_now == chosen.set
                                ? distance_to(chosen.known, place.peak, range.harmonic_tolerance)
                                : std::nullopt;
      const ContinuationOptions of_place = range_of(place, range);
      if (distance && *distance <= of_place.harmonic_tolerance) {
        chosen.left_out = std::max(chosen.left_out, *distance * place.height);
        continue;
      }
      PeakHarmonicsChoice choice(scene, of_place);
      const PeakHarmonics found = choice.choose(of_now, place.peak, chosen.set);
      chosen.set = chosen.set.united(found.set.orders());
      chosen.left_out = std::max(chosen.left_out, found.left_out * place.height);
      chosen.settled = chosen.settled && found.settled;
      if (found.peak) chosen.known.push_back(found.richest);
      if (found.peak && place.is_told) {
        chosen.highest = found.richest;
        chosen.is_peak = found.peak->place == PeakPlace::peak;
      }
      count(chosen, choice.work());
      if (found.peak) continue;
      is_lost = true;
      const bool goes_on = traces < most_traces && stepping_stone(set, of_now, chosen.set);
      if (goes_on) break;  // the other places are asked there
    }
    if (!is_lost || traces == most_traces || is_stopped(range)) {
      if (now == &traced && of_now == chosen.set) chosen.traced = std::move(traced);
      return chosen;
    }
    const std::optional<HarmonicSet> stone = stepping_stone(set, of_now, chosen.set);
    if (stone) chosen.set = set;
    const HarmonicSet next = stone.value_or(chosen.set);
    traced = trace(next);
    chosen.iterations += traced.iterations;
    chosen.contact_evaluations += traced.contact_evaluations;
    now = &traced;
    of_now = next;
  }
  return chosen;
}

CurveHarmonics check_harmonics(const Scene& scene, const ContinuationOptions& range,
                               const HarmonicSet& set, const std::vector<SettledPeak>& known,
                               ResponseCurve& curve) {
  CurveHarmonics checked{set};
  PeakHarmonicsChoice choice(scene, range);
  for (const Place& place : places_of(scene, range, set, curve)) {
    const std::optional<double> distance = distance_to(known, place.peak, range.harmonic_tolerance);
    if (place.is_told && !known.empty()) {
      checked.highest = settled_at(nearest_of(known, place.peak, range.harmonic_tolerance), choice,
                                   set, place.peak);
    }
    const double left_out = distance ? *distance : choice.left_out(set, place.peak);
    checked.left_out = std::max(checked.left_out, left_out * place.height);
    for (ResponsePoint& point : curve.points) {
      if (point.frequency == place.frequency) point.harmonics_left_out = left_out;
    }
  }
  checked.settled = checked.left_out <= range.harmonic_tolerance;
  count(checked, choice.work());
  return checked;
}

ResponseCurve trace_with_chosen(const Scene& scene, const ContinuationOptions& range,
                                const CurveOfSet& first, const CurveOfSet& trace) {
  return ChosenCurve(scene, range, first, trace).run();
}

}  // namespace microslip::solver
