#include "solver/optimum/peak_trace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "solver/balance/first_harmonics.hpp"
#include "solver/continuation.hpp"
#include "solver/curve/branch_search.hpp"
#include "solver/enrichment/curve_harmonics.hpp"
#include "solver/optimum/common_harmonics.hpp"

namespace microslip::solver {
namespace {

// The same peak, solved for twice: amplitudes agree to rounding, frequencies of a flat top to its
// root.
constexpr double rounded_amplitude = 1e-7;  // relative
constexpr double same_frequency = 1e-4;     // of the resonance width
// Between two values the step is halved down to this share of their distance.
constexpr double finest = 1.0 / 64.0;
// Following may cost this part of a curve, which tells more, before it is given up.
constexpr long worth_of_a_curve = 4;
constexpr double rounding = 1e-6;  // of a step: what is left of the way is none of its own
// A pair of peaks closer than this share of the step ahead tells rounding errors, not a direction.
constexpr double shortest_base = 0.05;
constexpr std::size_t most_seeds =
    4;  // peaks and ends of one curve that are followed, from the highest down
constexpr std::size_t most_followed = 4;  // to one value; those that are highest beside it
// A peak lost below this share of the highest cannot become the highest within one step.
constexpr double of_interest = 0.5;
// Peaks of a curve lower than that are not followed: should one become the highest, the curve at
// the best value has it.
constexpr double worth_following = 0.5;

bool same(const LocalPeak& a, const ResponsePoint& b) {
  return std::abs(a.amplitude - b.amplitude) <= rounded_amplitude * b.amplitude &&
         std::abs(a.point.parameter - b.frequency) <= same_frequency * a.scaling.parameter;
}

bool same(const LocalPeak& a, const LocalPeak& b) {
  return std::abs(a.amplitude - b.amplitude) <= rounded_amplitude * b.amplitude &&
         std::abs(a.point.parameter - b.point.parameter) <= same_frequency * a.scaling.parameter;
}

void check(const PeakTraceOptions& options) {
  const bool positive = options.scale == ParameterScale::linear || options.lower > 0.0;
  const bool finite = std::isfinite(options.lower) && std::isfinite(options.upper);
  if (!positive || !finite || !(options.upper > options.lower) || options.n_values < 2 ||
      options.n_checks < 2) {
    throw std::invalid_argument("peak trace: bounds " + std::to_string(options.lower) + " to " +
                                std::to_string(options.upper) + " with " +
                                std::to_string(options.n_values) + " values and " +
                                std::to_string(options.n_checks) +
                                " checks; needs lower < upper, 0 < lower on the logarithmic scale, "
                                "at least 2 values and 1 check");
  }
}

}  // namespace

void one_by_one(std::size_t n, const std::function<void(std::size_t)>& task) {
  for (std::size_t i = 0; i < n; ++i) task(i);
}

PeakFamilies::PeakFamilies(const SceneFamily& family, const ContinuationOptions& range,
                           const PeakTraceOptions& options)
    : family_(family), choosing_(range), range_(range), options_(options) {
  check(options);
  options_.n_checks = std::min(options.n_checks, options.n_values);
  spacing_ = (position(options.upper) - position(options.lower)) / (options.n_values - 1);
  std::vector<double> checks;
  for (const double check : check_positions()) checks.push_back(parameter(check));
  PeakWork work;
  range_ = with_common_harmonics(family_, checks, choosing_, work);
  result_.iterations += work.iterations;
  result_.contact_evaluations += work.contact_evaluations;
}

double PeakFamilies::position(double parameter) const {
  return position_on(options_.scale, parameter);
}

/// The position asked for before, where exp and log have only rounded it.
double PeakFamilies::known_position(double parameter) const {
  const double here = position(parameter);
  const double rounding = 1e-9 * spacing_;
  const auto nearest = asked_.lower_bound(here - rounding);
  return nearest != asked_.end() && *nearest <= here + rounding ? *nearest : here;
}

double PeakFamilies::parameter(double position) const {
  return parameter_at(options_.scale, position);
}

double PeakFamilies::value_position(int index) const {
  return position(options_.lower) + spacing_ * index;
}

std::vector<double> PeakFamilies::check_positions() const {
  const double last = options_.n_values - 1;
  if (options_.only_check) {
    const double index = (position(*options_.only_check) - value_position(0)) / spacing_;
    return {value_position(static_cast<int>(std::lround(std::clamp(index, 0.0, last))))};
  }
  std::vector<double> positions;
  positions.reserve(static_cast<std::size_t>(options_.n_checks));
  for (int i = 0; i < options_.n_checks; ++i) {
    const double index = std::round(i * last / (options_.n_checks - 1));
    positions.push_back(value_position(static_cast<int>(index)));
  }
  return positions;
}

void PeakFamilies::note(const std::string& text, double position) {
  std::ostringstream stream;
  stream.precision(6);
  stream << text << " at " << parameter(position);
  result_.notes.push_back(stream.str());
}

void PeakFamilies::warn(const std::string& text, double position) {
  note(text, position);
  result_.warnings.push_back(result_.notes.back());
}

const LocalPeak* PeakFamilies::highest_followed(double position) const {
  const LocalPeak* best = nullptr;
  for (const Followed& family : families_) {
    const auto peak = family.peaks.find(position);
    if (peak == family.peaks.end()) continue;
    if (best == nullptr || peak->second.amplitude > best->amplitude) best = &peak->second;
  }
  return best;
}

PeakOfParameter PeakFamilies::highest_at(double position) const {
  PeakOfParameter best{parameter(position), 0.0, std::numeric_limits<double>::infinity()};
  const LocalPeak* followed = highest_followed(position);
  if (followed != nullptr) {
    best.amplitude = followed->amplitude;
    best.frequency = followed->point.parameter;
    best.place = followed->place;
  }
  const auto curve = curves_.find(position);
  if (curve == curves_.end()) return best;
  best.whole_curve = curve->second.traced.complete;
  if (curve->second.high.empty()) return best;
  const HighPoint& solved = curve->second.high.front();
  if (followed == nullptr || solved.point.amplitude > (1.0 + rounded_amplitude) * best.amplitude) {
    best.amplitude = solved.point.amplitude;
    best.frequency = solved.point.frequency;
    best.place = solved.place;
  }
  best.detached = is_detached(curve->second, best.amplitude);
  return best;
}

/// The amplitude is that of the highest point, beside the curve, or of none that the curve has.
bool PeakFamilies::is_detached(const Curve& curve, double amplitude) const {
  const HighPoint& highest = curve.high.front();
  const double above = amplitude / highest.point.amplitude - 1.0;
  return highest.detached ? above >= -rounded_amplitude
                          : curve.traced.complete && above > options_.amplitude_tolerance;
}

/// Nothing is known at a value, or an end of the range from which the amplitude grows into it.
bool PeakFamilies::needs_curve(double position) const {
  if (curves_.contains(position)) return false;
  const LocalPeak* followed = highest_followed(position);
  return followed == nullptr || followed->rises;
}

ContinuationOptions PeakFamilies::range_with(int search_starts) const {
  ContinuationOptions range = range_;
  range.search_starts = std::max(range.search_starts, search_starts);
  return range;
}

/// The curve, or the one that is known there with what a search finds beside it.
ResponseCurve PeakFamilies::traced(double position, const ContinuationOptions& range) const {
  const auto known = curves_.find(position);
  const Scene scene = family_(parameter(position));
  if (known == curves_.end()) return trace_response(scene, range, until_stopped(range));
  if (range.stop && range.stop()) throw SearchStopped{};
  ResponseCurve curve = known->second.traced;
  search_branches(scene, range, curve);
  return curve;
}

void PeakFamilies::count(const ResponseCurve& curve, double position) {
  const auto known = curves_.find(position);
  if (known == curves_.end()) {
    ++result_.n_curves;
  } else {
    result_.iterations -= known->second.traced.iterations;
    result_.contact_evaluations -= known->second.traced.contact_evaluations;
  }
  result_.iterations += curve.iterations;
  result_.contact_evaluations += curve.contact_evaluations;
}

void PeakFamilies::trace_ahead(const std::vector<double>& positions, int search_starts) {
  const ContinuationOptions range = range_with(search_starts);
  std::vector<std::pair<double, int>> keys;
  for (const double position : positions) {
    const auto known = curves_.find(position);
    const std::pair key{position, range.search_starts};
    const bool traced =
        known != curves_.end() && known->second.search_starts >= range.search_starts;
    if (!traced && !ahead_.contains(key)) keys.push_back(key);
  }
  std::vector<ResponseCurve> curves(keys.size());
  options_.together(keys.size(), [&](std::size_t i) { curves[i] = traced(keys[i].first, range); });
  for (std::size_t i = 0; i < keys.size(); ++i) {
    count(curves[i], keys[i].first);
    ahead_.insert_or_assign(keys[i], std::move(curves[i]));
  }
}

const PeakFamilies::Curve& PeakFamilies::curve_at(double position, int search_starts) {
  const auto known = curves_.find(position);
  if (known != curves_.end() && known->second.search_starts >= search_starts) return known->second;
  const ContinuationOptions range = range_with(search_starts);
  auto ahead = ahead_.extract({position, range.search_starts});
  if (ahead.empty() && range_.stop && range_.stop()) throw SearchStopped{};
  ResponseCurve curve = ahead.empty() ? traced(position, range) : std::move(ahead.mapped());
  if (ahead.empty()) count(curve, position);
  if (curve.diagnosis == Diagnosis::interrupted) throw SearchStopped{};
  const bool is_new = !curves_.contains(position);  // else it has been told
  if (is_new && !curve.complete)
    note(std::string("curve incomplete (") + to_string(curve.diagnosis) + ")", position);
  const Scene scene = family_(parameter(position));
  std::vector<HighPoint> high = high_points(scene, curve, range_);
  Curve kept{std::move(curve), std::move(high), range.search_starts};
  if (is_new && std::any_of(kept.high.begin(), kept.high.end(),
                            [](const auto& one) { return one.climbed; })) {
    note("a peak that the curve passes was solved for from the points beside it", position);
  }
  if (!kept.high.empty() && kept.high.front().place == PeakPlace::unsolved &&
      (is_new || kept.high.front().detached)) {
    note("the highest point of the curve is not a solved peak: the peak may be higher", position);
  }
  if (!kept.high.empty() && kept.high.front().detached) {
    warn("the highest peak stands on a branch detached from the curve: no sweep meets it",
         position);
    search_everywhere(range.search_starts);
  }
  if (is_new && choosing_.harmonic_tolerance > 0.0 && !kept.high.empty() &&
      left_out_at(scene, kept.high.front().point, choosing_) > choosing_.harmonic_tolerance) {
    note("the highest peak lacks harmonics that the checks did not need", position);
  }
  return curves_.insert_or_assign(position, std::move(kept)).first->second;
}

/// Curves whose surroundings were not searched cannot tell that a detached peak is not there.
void PeakFamilies::search_everywhere(int search_starts) {
  range_.search_starts = std::max(range_.search_starts, search_starts);
  std::erase_if(curves_, [&](const auto& curve) {
    return curve.second.search_starts < range_.search_starts;
  });
}

bool PeakFamilies::agrees(const Peaks& peaks, double position) const {
  const LocalPeak& here = peaks.at(position);
  const std::vector<HighPoint>& solved = curves_.at(position).high;
  return std::any_of(solved.begin(), solved.end(),
                     [&](const HighPoint& peak) { return same(here, peak.point); });
}

bool PeakFamilies::known_elsewhere(std::size_t family, double position) const {
  const LocalPeak& here = families_[family].peaks.at(position);
  for (std::size_t i = 0; i < families_.size(); ++i) {
    const Peaks& peaks = families_[i].peaks;
    const auto other = peaks.find(position);
    if (i != family && other != peaks.end() && same(here, other->second)) return true;
  }
  return false;
}

/// Gives a peak up where another family has it.
bool PeakFamilies::left_to_another(std::size_t family, double position) {
  if (!known_elsewhere(family, position)) return false;
  families_[family].peaks.erase(position);
  families_[family].met.insert(position);
  return true;
}

/// A peak that the curve does not have: its branch has come off the curve somewhere since the last
/// curve that had it. What is higher than all of the curve is a solution that counts, and stays;
/// what is no higher, within a tolerance above rounding, goes from here alone.
/// @return  whether it goes, back to the last curve that had it.
bool PeakFamilies::cut(Followed& family, double position) {
  Peaks& peaks = family.peaks;
  const std::vector<HighPoint>& solved = curves_.at(position).high;
  const double amplitude = peaks.at(position).amplitude;
  const bool coarse = options_.amplitude_tolerance > rounded_amplitude;
  const double least = coarse ? 1.0 + options_.amplitude_tolerance : 1.0;
  if (solved.empty() || amplitude > least * solved.front().point.amplitude) {
    constexpr const char* text =
        "a followed peak, higher than all of the curve, stands on a branch detached from it";
    told_detached_ ? note(text, position) : warn(text, position);
    told_detached_ = true;
    return false;
  }
  if (coarse) {
    peaks.erase(position);
    family.refuted.insert(position);
    return true;
  }
  for (Followed& other : families_) other.met.clear();  // what they met may be what goes
  note(
      "a followed peak is not on the curve (its branch is detached, or another peak), curves "
      "traced whole",
      position);
  const auto agreed = [&](const auto& curve) {
    return curve.second.traced.complete && peaks.contains(curve.first) &&
           agrees(peaks, curve.first);
  };
  const auto here = curves_.find(position);
  const auto above = std::find_if(here, curves_.end(), agreed);
  const auto below = std::find_if(std::make_reverse_iterator(here), curves_.rend(), agreed);
  const double high =
      above == curves_.end() ? std::numeric_limits<double>::infinity() : above->first;
  const double low = below == curves_.rend() ? -high : below->first;
  for (auto peak = peaks.upper_bound(low); peak != peaks.end() && peak->first < high;) {
    if (asked_.contains(peak->first)) pending_.insert(peak->first);
    peak = peaks.erase(peak);
  }
  return true;
}

std::optional<LocalPeak> PeakFamilies::followed(const Peaks& peaks, Peaks::const_iterator nearest,
                                                double target, PeakWork& work) const {
  if (range_.stop && range_.stop()) throw SearchStopped{};
  const LocalPeak& a = nearest->second;
  BranchVector guess = a.point;
  const auto after = std::next(nearest);
  auto other = after != peaks.end() ? after : nearest;
  if (nearest != peaks.begin() && (other == nearest || target > nearest->first)) {
    other = std::prev(nearest);
  }
  // Toward a value between two known ones, interpolate; beyond the last one, extrapolate.
  if (target > nearest->first && after != peaks.end()) other = after;
  const double base = other->first - nearest->first;
  const double ahead = target - nearest->first;
  const bool predicted = std::abs(base) > shortest_base * std::abs(ahead);
  if (predicted) {
    guess.x += ahead / base * (other->second.point.x - a.point.x);
    guess.parameter += ahead / base * (other->second.point.parameter - a.point.parameter);
  }
  const Scene scene = family_(parameter(target));
  HarmonicBalance balance(scene, first_harmonics(scene, range_));
  std::optional<LocalPeak> peak = follow_peak(balance, a, guess, range_, work);
  if (!peak && predicted) peak = follow_peak(balance, a, a.point, range_, work);
  return peak;
}

/// Mean evaluations of a curve traced whole.
long PeakFamilies::curve_cost() const {
  long sum = 0;
  for (const auto& [position, curve] : curves_) sum += curve.traced.contact_evaluations;
  return sum / std::max<long>(1, static_cast<long>(curves_.size()));
}

/// From the nearest known position; where that fails, from the nearest on the other side.
bool PeakFamilies::follow_to(Followed& family, double target) const {
  Peaks& peaks = family.peaks;
  const auto above = peaks.lower_bound(target);
  if (above == peaks.end()) return follow_from(family, std::prev(above), target);
  if (above == peaks.begin()) return follow_from(family, above, target);
  const auto below = std::prev(above);
  const bool down = target - below->first < above->first - target;
  return follow_from(family, down ? below : above, target) ||
         follow_from(family, down ? above : below, target);
}

bool PeakFamilies::follow_from(Followed& family, Peaks::const_iterator nearest,
                               double target) const {
  Peaks& peaks = family.peaks;
  const long most_evaluations = family.work.contact_evaluations + curve_cost() / worth_of_a_curve;
  double step = target - nearest->first;
  bool failed = false;
  while (nearest->first != target) {
    const double rest = target - nearest->first;
    const double next =
        std::abs(rest) <= (1.0 + rounding) * std::abs(step) ? target : nearest->first + step;
    Reach& reach = family.reach[nearest->first];
    std::optional<LocalPeak> peak;
    if (next > reach.below && next < reach.above)
      peak = followed(peaks, nearest, next, family.work);
    if (peak) {
      nearest = peaks.emplace(next, std::move(*peak)).first;
      // What failed a step ago would fail again.
      if (!failed) step *= 2.0;
    } else {
      reach = next > nearest->first ? Reach{reach.below, std::min(reach.above, next)}
                                    : Reach{std::max(reach.below, next), reach.above};
      step = 0.5 * (next - nearest->first);
      if (std::abs(step) < finest * spacing_) return false;
      // Tracing the curve whole tells more for as much.
      if (family.work.contact_evaluations > most_evaluations) return false;
    }
    failed = !peak;
  }
  return true;
}

/// As follow_to(); what has failed is not tried again while no other peak is known.
bool PeakFamilies::is_reached(Followed& family, double target) const {
  const auto before = family.unreached.find(target);
  if (before != family.unreached.end() && before->second == family.peaks.size()) return false;
  const bool reached = follow_to(family, target);
  if (!reached) family.unreached[target] = family.peaks.size();
  return reached;
}

/// From a known peak over all values up or down, until it is lost or met by another family.
void PeakFamilies::follow_values(std::size_t family, double from, double direction) {
  for (int i = 0; i < options_.n_values; ++i) {
    const double target = value_position(direction > 0.0 ? i : options_.n_values - 1 - i);
    if ((target - from) * direction <= 0.0) continue;
    Peaks& peaks = families_[family].peaks;
    if (!follow_to(families_[family], target)) {
      const auto last = direction > 0.0 ? std::prev(peaks.end()) : peaks.begin();
      const double before = target - direction * spacing_;
      if (last->second.amplitude < of_interest * highest_at(before).amplitude) return;
      if (!curves_.contains(target)) {
        note("a peak was lost (vanished, jumped or left the range), curve traced whole", target);
        pending_.insert(target);
      }
      return;
    }
    if (left_to_another(family, target)) return;
    const auto curve = curves_.find(target);
    const bool contradicted =
        curve != curves_.end() && curve->second.traced.complete && !agrees(peaks, target);
    if (contradicted && cut(families_[family], target)) return;
  }
}

void PeakFamilies::seed(double position, int search_starts) {
  asked_.insert(position);
  const Curve& curve = curve_at(position, search_starts);
  if (curve.traced.complete) {
    for (Followed& family : families_) {
      Peaks& peaks = family.peaks;
      const bool contradicted = peaks.contains(position) && !agrees(peaks, position);
      if (contradicted) static_cast<void>(cut(family, position));
    }
  }
  const Scene scene = family_(parameter(position));
  HarmonicBalance balance(scene, first_harmonics(scene, range_));
  for (std::size_t i = 0; i < std::min(most_seeds, curve.high.size()); ++i) {
    const HighPoint& high = curve.high[i];
    const bool known = std::any_of(families_.begin(), families_.end(), [&](const Followed& family) {
      const auto here = family.peaks.find(position);
      return here != family.peaks.end() && same(here->second, high.point);
    });
    if (known || high.place == PeakPlace::unsolved) continue;
    const bool low = high.point.amplitude < worth_following * curve.high.front().point.amplitude;
    if (low && high.place == PeakPlace::peak) continue;
    std::optional<LocalPeak> peak = high.place == PeakPlace::peak
                                        ? local_peak(balance, high.point)
                                        : local_end(balance, high.point, range_);
    if (!peak) continue;
    Followed family;
    family.peaks.emplace(position, std::move(*peak));
    families_.push_back(std::move(family));
    follow_values(families_.size() - 1, position, 1.0);
    // What was cut or met by another family need not reach back.
    if (families_.back().peaks.contains(position))
      follow_values(families_.size() - 1, position, -1.0);
  }
}

void PeakFamilies::settle() {
  while (!pending_.empty()) {
    if (pending_.size() > 1) trace_ahead({pending_.begin(), pending_.end()}, 0);
    const double next = *pending_.begin();
    pending_.erase(pending_.begin());
    seed(next);
  }
}

void PeakFamilies::trace() {
  const int last = options_.n_values - 1;
  for (int i = 0; i <= last; ++i) asked_.insert(value_position(i));
  const std::vector<double> checks = check_positions();
  trace_ahead(checks, 0);
  for (const double check : checks) seed(check);
  settle();
  for (int i = 0; i <= last; ++i) {
    const double here = value_position(i);
    if (!needs_curve(here)) continue;
    seed(here);
    settle();
  }
}

/// Whether another family's peak lies on the way there from the nearest of its own.
bool PeakFamilies::is_anothers(const Followed& family, Peaks::const_iterator nearest,
                               double position) {
  const auto [low, high] = std::minmax(nearest->first, position);
  const auto met = family.met.lower_bound(low);
  return met != family.met.end() && *met <= high;
}

/// Those with a peak within a spacing, by the amplitude of the nearest.
std::vector<std::size_t> PeakFamilies::highest_near(double position) const {
  std::vector<std::pair<double, std::size_t>> by_amplitude;
  for (std::size_t i = 0; i < families_.size(); ++i) {
    const Peaks& peaks = families_[i].peaks;
    auto nearest = peaks.lower_bound(position);
    const bool below = nearest != peaks.begin() &&
                       (nearest == peaks.end() ||
                        position - std::prev(nearest)->first < nearest->first - position);
    if (below) --nearest;
    if (nearest == peaks.end() || std::abs(nearest->first - position) > spacing_) continue;
    if (families_[i].refuted.contains(position)) continue;
    if (is_anothers(families_[i], nearest, position)) continue;
    by_amplitude.emplace_back(-nearest->second.amplitude, i);
  }
  std::ranges::sort(by_amplitude);
  by_amplitude.resize(std::min(by_amplitude.size(), most_followed));
  std::vector<std::size_t> families;
  families.reserve(by_amplitude.size());
  for (const auto& [amplitude, family] : by_amplitude) families.push_back(family);
  return families;
}

/// The highest near by are followed there.
void PeakFamilies::follow_near(double position) {
  const std::vector<std::size_t> near = highest_near(position);
  std::vector<char> is_there(near.size());  // not of bits: written side by side
  options_.together(near.size(), [&](std::size_t i) {
    is_there[i] = is_reached(families_[near[i]], position) ? 1 : 0;
  });
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (is_there[i] != 0) static_cast<void>(left_to_another(near[i], position));
  }
}

/// Peaks that were not known yet are followed to the values that were asked for before.
void PeakFamilies::follow_to_asked() {
  for (const double position : asked_) {
    if (!curves_.contains(position)) follow_near(position);
  }
}

PeakOfParameter PeakFamilies::highest(double parameter) {
  const double here = known_position(parameter);
  follow_near(here);
  const bool is_hole = hides_lost(here);
  if (is_hole) static_cast<void>(curve_at(here, 0));
  asked_.insert(here);  // not before: stopped in the middle, the highest is not known
  if (is_hole) {
    seed(here);
    settle();
  }
  PeakOfParameter best = highest_at(here);
  best.parameter = parameter;
  return best;
}

/// What is followed there would be the lowest of all, and a peak that is higher near by is not
/// known there: only the curve tells whether it has vanished.
bool PeakFamilies::hides_lost(double position) const {
  if (curves_.contains(position)) return false;
  const LocalPeak* here = highest_followed(position);
  const double amplitude = here == nullptr ? 0.0 : here->amplitude;
  const auto is_lower = [&](double other) { return highest_at(other).amplitude <= amplitude; };
  if (std::ranges::any_of(asked_, is_lower)) return false;
  return std::ranges::any_of(families_, [&](const Followed& family) {
    const Peaks& peaks = family.peaks;
    if (peaks.contains(position)) return false;
    const auto above = peaks.lower_bound(position);
    const auto is_higher = [&](const auto& peak) {
      return std::abs(peak.first - position) <= spacing_ && peak.second.amplitude > amplitude;
    };
    return (above != peaks.end() && is_higher(*above)) ||
           (above != peaks.begin() && is_higher(*std::prev(above)));
  });
}

std::vector<PeakFamilies::FamilyPeak> PeakFamilies::followed_to(double parameter) const {
  const double here = known_position(parameter);
  std::vector<FamilyPeak> found;
  for (std::size_t i = 0; i < families_.size(); ++i) {
    const auto peak = families_[i].peaks.find(here);
    if (peak != families_[i].peaks.end()) found.push_back({i, peak->second});
  }
  std::ranges::stable_sort(found, std::ranges::greater{},
                           [](const FamilyPeak& one) { return one.peak.amplitude; });
  return found;
}

bool PeakFamilies::confirm(double parameter, int search_starts) {
  const double followed = highest(parameter).amplitude;
  const double here = known_position(parameter);
  const std::size_t n_families = families_.size();
  seed(here, search_starts);
  settle();
  if (families_.size() > n_families) follow_to_asked();
  const Curve& curve = curve_at(here, search_starts);
  if (!curve.traced.complete || curve.high.empty())
    return true;  // named in the notes; nothing better is known
  const double solved = curve.high.front().point.amplitude;
  const bool confirmed = followed >= (1.0 - options_.amplitude_tolerance) * solved;
  if (!confirmed) note("the curve has another highest peak than those followed", here);
  return confirmed;
}

bool PeakFamilies::is_cut_short(double parameter) const {
  const auto curve = curves_.find(known_position(parameter));
  return curve != curves_.end() && !curve->second.traced.complete;
}

const ResponsePoint* PeakFamilies::highest_point(double parameter) const {
  const auto curve = curves_.find(known_position(parameter));
  if (curve == curves_.end() || curve->second.high.empty()) return nullptr;
  return &curve->second.high.front().point;
}

void PeakFamilies::prepare(const std::vector<double>& parameters, int search_starts) {
  std::vector<double> positions;
  positions.reserve(parameters.size());
  for (const double parameter : parameters) positions.push_back(known_position(parameter));
  trace_ahead(positions, search_starts);
}

PeakTrace PeakFamilies::result() const {
  PeakTrace result = result_;
  for (const Followed& family : families_) {
    result.iterations += family.work.iterations;
    result.contact_evaluations += family.work.contact_evaluations;
  }
  for (const double position : asked_) {
    const PeakOfParameter peak = highest_at(position);
    if (std::isfinite(peak.amplitude)) result.peaks.push_back(peak);
  }
  return result;
}

}  // namespace microslip::solver
