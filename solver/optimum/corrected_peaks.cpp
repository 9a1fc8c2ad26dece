#include "solver/optimum/corrected_peaks.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "solver/balance/first_harmonics.hpp"
#include "solver/continuation.hpp"
#include "solver/enrichment/carried_peak.hpp"
#include "solver/enrichment/curve_harmonics.hpp"
#include "solver/enrichment/enrichment.hpp"
#include "solver/enrichment/level_point.hpp"
#include "solver/peak/high_points.hpp"

namespace microslip::solver {
namespace {

constexpr std::size_t most_peaks = 3;  // carried at a value
// Times the highest with few harmonics: what is lower cannot be the highest.
constexpr double may_be_highest = 0.7;

CorrectedPeaks::FamilyPeaks::const_iterator highest_of(const CorrectedPeaks::FamilyPeaks& peaks) {
  return std::ranges::max_element(peaks, {}, [](const auto& one) { return one.second.amplitude; });
}

/// A value stands for its highest peak with few harmonics alone.
void correct_highest(CorrectedPeaks::Value& value) {
  const auto few = highest_of(value.few);
  value.correction[few->first] = std::log(value.highest.amplitude / few->second.amplitude);
}

}  // namespace

void CorrectedPeaks::solve(const std::vector<double>& positions) {
  std::vector<Value> fresh(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    auto few = high_peaks(positions[i]);
    if (!few) throw NeedsOtherSearch{};
    fresh[i].few = std::move(*few);
  }
  options_.together(positions.size(), [&](std::size_t i) {
    if (curves_alone_ || !carry(positions[i], fresh[i])) trace(positions[i], fresh[i]);
  });
  for (std::size_t i = 0; i < positions.size(); ++i) keep(positions[i], std::move(fresh[i]));
}

void CorrectedPeaks::solve_if_carried(const std::vector<double>& positions) {
  std::vector<std::pair<double, Value>> fresh;
  for (const double position : positions) {
    auto few = high_peaks(position);
    if (!few) continue;
    fresh.emplace_back(position, Value{});
    fresh.back().second.few = std::move(*few);
  }
  std::vector<char> is_carried(fresh.size());  // not of bits: written side by side
  options_.together(fresh.size(), [&](std::size_t i) {
    is_carried[i] = carry(fresh[i].first, fresh[i].second) ? 1 : 0;
  });
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    auto& [position, value] = fresh[i];
    is_carried[i] != 0 ? keep(position, std::move(value)) : count(value);
  }
}

void CorrectedPeaks::count(Value& value) {
  work_.iterations += std::exchange(value.work.iterations, 0);
  work_.contact_evaluations += std::exchange(value.work.contact_evaluations, 0);
  n_curves_ += std::exchange(value.n_curves, 0);
  if (range_.stop && range_.stop()) throw SearchStopped{};
}

void CorrectedPeaks::keep(double position, Value value) {
  count(value);
  if (!(value.highest.amplitude > 0.0)) throw NeedsOtherSearch{};
  values_.insert_or_assign(position, std::move(value));
}

/// With few harmonics. @return  empty: out of bounds, or the highest is none that is followed.
std::optional<CorrectedPeaks::FamilyPeaks> CorrectedPeaks::high_peaks(double position) {
  if (const auto known = values_.find(position); known != values_.end()) return known->second.few;
  const double value = parameter(position);
  const bool inside = value >= options_.lower && value <= options_.upper;
  if (!inside) return std::nullopt;
  const PeakOfParameter highest = few_.highest(value);
  FamilyPeaks peaks;
  for (auto& [family, peak] : few_.followed_to(value)) {
    if (peaks.size() == most_peaks || peak.amplitude < may_be_highest * highest.amplitude) break;
    peaks.emplace(family, std::move(peak));
  }
  const bool is_followed = std::ranges::any_of(peaks, [&](const auto& one) {
    return one.second.amplitude >= (1.0 - options_.amplitude_tolerance) * highest.amplitude;
  });
  return is_followed ? std::optional(std::move(peaks)) : std::nullopt;
}

/// @return  false: one is lost.
bool CorrectedPeaks::carry(double position, Value& value) const {
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
void CorrectedPeaks::trace(double position, Value& value) const {
  const Scene scene = family_(parameter(position));
  ResponseCurve curve = trace_response(scene, range_with_starts(), until_stopped(range_));
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
  if (!top.detached) value.curve = std::make_shared<const ResponseCurve>(std::move(curve));
  correct_highest(value);
  if (top.place != PeakPlace::peak) return;
  HarmonicBalance balance(scene, first_harmonics(scene, range_));
  if (auto peak = local_peak(balance, top.point)) {
    value.all.insert_or_assign(highest_of(value.few)->first, std::move(*peak));
  }
}

/// Solutions beside the curve are looked for as well where few harmonics have found some.
ContinuationOptions CorrectedPeaks::range_with_starts() const {
  ContinuationOptions range = range_;
  range.search_starts = std::max(range.search_starts, options_.search_starts);
  return range;
}

bool CorrectedPeaks::agrees_with_curve(double position) {
  Value value = values_.at(position);
  const double carried = value.highest.amplitude;
  trace(position, value);
  const double traced = value.highest.amplitude;
  keep(position, std::move(value));
  return traced <= (1.0 + options_.amplitude_tolerance) * carried;
}

bool CorrectedPeaks::is_raised(double position) {
  Value before = values_.at(position);
  const double lower = before.highest.amplitude;
  solve({position});
  if (amplitude(position) < lower) values_.insert_or_assign(position, std::move(before));
  return amplitude(position) > (1.0 + options_.amplitude_tolerance) * lower;
}

void CorrectedPeaks::spread(double position, double direction) {
  for (auto next = neighbour(position, direction); next; next = neighbour(*next, direction)) {
    if (values_.at(*next).top || !is_raised(*next)) return;
  }
}

void CorrectedPeaks::trust_curves_alone() {
  curves_alone_ = true;
  std::erase_if(values_, [](const auto& value) { return !value.second.top; });
  for (auto& [at, value] : values_) {
    value.correction.clear();
    correct_highest(value);
  }
}

/// From what it is at the next values on both sides, moved as it moves with few harmonics, the
/// higher one: the top of a peak may be several. Else from few.
std::optional<LocalPeak> CorrectedPeaks::carried(const Scene& scene, double position,
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
std::vector<const CorrectedPeaks::Value*> CorrectedPeaks::beside_with(std::size_t family,
                                                                      double position) const {
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
double CorrectedPeaks::correction(std::size_t family, double position) const {
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
  return std::log(value.highest.amplitude / highest_of(value.few)->second.amplitude);
}

double CorrectedPeaks::amplitude(double position) {
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

double CorrectedPeaks::nearest(double position) const {
  return std::ranges::min_element(
             values_, {}, [&](const auto& value) { return std::abs(value.first - position); })
      ->first;
}

std::optional<double> CorrectedPeaks::neighbour(double position, double direction) const {
  const auto here = values_.find(position);
  if (direction > 0.0) {
    const auto after = std::next(here);
    return after != values_.end() ? std::optional(after->first) : std::nullopt;
  }
  return here != values_.begin() ? std::optional(std::prev(here)->first) : std::nullopt;
}

}  // namespace microslip::solver
