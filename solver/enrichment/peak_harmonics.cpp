#include "solver/enrichment/peak_harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "solver/balance/first_harmonics.hpp"
#include "solver/balance/period_energy.hpp"
#include "solver/enrichment/dropped_harmonics.hpp"
#include "solver/enrichment/level_point.hpp"
#include "solver/enrichment/resonant_orders.hpp"

namespace microslip::solver {
namespace {

// Of the force scale: what symmetry leaves of a harmonic is some 1e-15 of it.
constexpr double silent = 1e-12;
// Shares of the tolerance.
constexpr double may_be_left_out = 0.5;
constexpr double added_down_to = 0.25;
constexpr double may_be_pruned = 0.5;
constexpr int fewest_first_ones = 3;
constexpr double worth_trying = 8.0;  // times that, by the sum of estimates: signs may cancel
constexpr double worth_trying_first = 40.0;  // the same, next to an internal resonance
constexpr double of_frequency = 0.1;  // a resonance is narrow: its frequency is asked for closer
constexpr double idle = 1e-6;         // of the amplitude: less is not worth a confirmation
constexpr std::size_t largest_block = 10;  // added at a time: estimates far away rank, no more
constexpr std::size_t confirming_block = 4;
constexpr int most_rounds = 15;
// Amplitudes or widths: a set with a resonance moves a peak far; one that keeps it hardly does.
constexpr double too_far = 4.0;
constexpr double stays_within = 0.5;

/// Up to `highest`, as far as the force is known.
std::vector<int> beyond(const HarmonicSet& set, const Harmonics& force, double scale, int highest) {
  std::vector<int> orders;
  for (int k = 1; k <= std::min(highest, force.n_harmonics()); ++k) {
    const double size = std::hypot(force.sine(k).norm(), force.cosine(k).norm());
    if (size > silent * scale && !set.contains(k)) orders.push_back(k);
  }
  return orders;
}

/// @param peak  solved with `fewer`.
PeakHarmonics pruned_to(const PeakHarmonics& rich, const HarmonicSet& fewer,
                        const LocalPeak& peak) {
  PeakHarmonics result = rich;
  result.left_out += std::abs(peak.amplitude / rich.peak->amplitude - 1.0);
  result.set = fewer;
  result.peak = peak;
  return result;
}

}  // namespace

PeakHarmonicsChoice::PeakHarmonicsChoice(const Scene& scene, const ContinuationOptions& range)
    : scene_(scene), range_(range), least_(least_harmonics(scene)) {
  if (!(range.harmonic_tolerance > 0.0) || range.n_harmonics < 1) {
    throw std::invalid_argument("harmonics: tolerance " + std::to_string(range.harmonic_tolerance) +
                                " and highest " + std::to_string(range.n_harmonics) +
                                "; needs a tolerance above 0 and at least one harmonic");
  }
}

PeakHarmonicsChoice::Estimate PeakHarmonicsChoice::estimate(const HarmonicSet& set,
                                                            const LocalPeak& peak) {
  Estimate result;
  if (!scene_.contact) return result;
  HarmonicBalance coarse(scene_, set);
  const int highest = std::max(set.highest(), range_.n_harmonics);
  const int reach = std::max(highest, range_.highest_resonance);
  const Harmonics force = coarse.contact_force(peak.point.x, peak.point.parameter, reach);
  const std::vector<int> all = beyond(set, force, peak.scaling.residual, reach);
  if (all.empty()) return result;
  const BalanceEvaluation at = coarse.evaluate(peak.point.x, peak.point.parameter);
  ++work_.contact_evaluations;
  for (const int k :
       resonant_orders(coarse, peak.point, at.jacobian.dense(), force, range_.harmonic_tolerance)) {
    if (std::ranges::count(all, k) > 0) result.resonant.push_back(k);
  }
  const std::vector<int> orders = beyond(set, force, peak.scaling.residual, highest);
  if (orders.empty()) return result;
  HarmonicBalance richer(scene_, set.united(orders));
  const std::vector<RicherShare> shares = richer_shares(richer, embedded(peak, coarse, richer));
  work_.contact_evaluations += 2;
  for (const RicherShare& share : shares) {
    if (share.order == 0 || set.contains(share.order)) continue;
    result.shares.push_back(share);
    result.sum += std::abs(share.amplitude);
  }
  std::ranges::stable_sort(result.shares, std::ranges::greater{},
                           [](const RicherShare& share) { return std::abs(share.amplitude); });
  return result;
}

double PeakHarmonicsChoice::Estimate::beyond(const std::vector<int>& orders) const {
  double rest = 0.0;
  for (const RicherShare& share : shares) {
    if (std::ranges::count(orders, share.order) == 0) rest += std::abs(share.amplitude);
  }
  return rest;
}

std::vector<int> PeakHarmonicsChoice::wanted(const Estimate& estimate) const {
  std::vector<int> orders = estimate.resonant;
  double rest = estimate.sum;
  for (const RicherShare& share : estimate.shares) {
    if (rest <= added_down_to * range_.harmonic_tolerance || orders.size() >= largest_block) break;
    orders.push_back(share.order);
    rest -= std::abs(share.amplitude);
  }
  return orders;
}

std::vector<int> PeakHarmonicsChoice::block(const Estimate& estimate) const {
  std::vector<int> orders;
  for (const RicherShare& share : estimate.shares) {
    const bool counts = std::abs(share.amplitude) > idle;
    if (counts && orders.size() < confirming_block) orders.push_back(share.order);
  }
  return orders;
}

bool PeakHarmonicsChoice::same(const LocalPeak& a, const LocalPeak& b, double tolerance) const {
  return std::abs(a.amplitude - b.amplitude) <= tolerance * b.amplitude &&
         std::abs(a.point.parameter - b.point.parameter) <=
             of_frequency * tolerance * b.point.parameter;
}

std::optional<LocalPeak> PeakHarmonicsChoice::solved(const HarmonicSet& from, const LocalPeak& peak,
                                                     const HarmonicSet& to, double farthest) {
  const HarmonicBalance coarse(scene_, from);
  HarmonicBalance richer(scene_, to);
  const LocalPeak start = embedded(peak, coarse, richer);
  return level_point(richer, start, range_, work_, farthest);
}

/// A peak that is far is nearer by steps: the lowest harmonic first.
std::optional<LocalPeak> PeakHarmonicsChoice::solved_one_by_one(HarmonicSet set, LocalPeak peak,
                                                                std::vector<int> orders) {
  if (orders.size() < 2) return std::nullopt;
  std::ranges::sort(orders);
  for (const int order : orders) {
    const HarmonicSet next = set.united({order});
    std::optional<LocalPeak> there = solved(set, peak, next, too_far);
    if (!there) return std::nullopt;
    set = next;
    peak = std::move(*there);
  }
  return peak;
}

PeakHarmonics PeakHarmonicsChoice::choose(const HarmonicSet& set, const LocalPeak& peak,
                                          const HarmonicSet& more) {
  PeakHarmonics result{set.united(more.orders()), peak};
  if (result.set != set) result.peak = solved(set, peak, result.set, too_far);
  const PeakHarmonics fewest = result;
  settle(result);
  if (result.peak && !(result.richest.amplitude > 0.0)) {
    result.richest = told(result.set, *result.peak, result.left_out);
  }
  if (!result.settled) return result;
  const PeakHarmonics rich = result;
  const bool is_least = fewest.set == more.united(least_.orders());
  const double allowed = may_be_pruned * range_.harmonic_tolerance;
  if (is_least && same(*rich.peak, *fewest.peak, allowed)) {
    return pruned_to(rich, fewest.set, *fewest.peak);
  }
  HarmonicBalance balance(scene_, rich.set);
  const std::vector<DroppedHarmonic> dropped = dropped_harmonics(balance, *rich.peak);
  ++work_.contact_evaluations;
  try_first_ones(result, dropped, more);
  prune(result, rich, dropped, more);
  return result;
}

SettledPeak PeakHarmonicsChoice::told(const HarmonicSet& set, const LocalPeak& peak,
                                      double left_out) {
  HarmonicBalance balance(scene_, set);
  ++work_.contact_evaluations;
  const PeriodEnergy energy = period_energy(balance, peak.point.x, peak.point.parameter);
  return {peak.point.parameter, peak.amplitude, left_out, energy.friction,
          peak.place == PeakPlace::range_end};
}

/// Adds harmonics until what is left out does little and a block of it, solved for, confirms this.
void PeakHarmonicsChoice::settle(PeakHarmonics& result) {
  const double tolerance = range_.harmonic_tolerance;
  for (int round = 0; result.peak && round < most_rounds; ++round) {
    if (range_.stop && range_.stop()) {
      if (round == 0) result.peak.reset();  // nothing is known of what it lacks
      return;
    }
    const Estimate now = estimate(result.set, *result.peak);
    result.left_out = now.sum;
    const bool small = now.sum <= may_be_left_out * tolerance && now.resonant.empty();
    const std::vector<int> orders = small ? block(now) : wanted(now);
    if (orders.empty()) {
      result.settled = true;
      return;
    }
    HarmonicSet larger = result.set.united(orders);
    std::optional<LocalPeak> next = solved(result.set, *result.peak, larger, too_far);
    if (!next) next = solved_one_by_one(result.set, *result.peak, orders);
    if (next && small) {
      result.confirmed = std::abs(next->amplitude - result.peak->amplitude) / next->amplitude;
      result.settled = same(*result.peak, *next, tolerance);
      if (result.settled) {
        result.richest = told(larger, *next, now.beyond(orders));
        return;
      }
    }
    result.set = std::move(larger);
    result.peak = std::move(next);
  }
}

/// The peak without some of its harmonics, where it stays.
std::optional<PeakHarmonics> PeakHarmonicsChoice::without(const PeakHarmonics& rich,
                                                          const HarmonicSet& fewer) {
  std::optional<LocalPeak> peak = solved(rich.set, *rich.peak, fewer, stays_within);
  if (!peak || !same(*rich.peak, *peak, may_be_pruned * range_.harmonic_tolerance)) return {};
  return pruned_to(rich, fewer, *peak);
}

/// The first harmonics alone, as few as do: next to an internal resonance what one harmonic does is
/// not told by its size. More may do less well than fewer there, so that they are tried upward, by
/// a quarter more at a time, until some do; then by bisection.
void PeakHarmonicsChoice::try_first_ones(PeakHarmonics& result,
                                         const std::vector<DroppedHarmonic>& dropped,
                                         const HarmonicSet& least) {
  const PeakHarmonics rich = result;
  const auto first = [&](int highest) {
    return HarmonicSet(highest).united(least.orders()).united(least_.orders());
  };
  std::optional<HarmonicSet> failed;  // by what it has to have a set may be that of fewer orders
  const auto do_first = [&](int highest) {
    const HarmonicSet fewer = first(highest);
    if (fewer == result.set) return true;
    if (fewer == failed) return false;
    std::optional<PeakHarmonics> there = without(rich, fewer);
    if (!there) failed = fewer;
    if (there) result = std::move(*there);
    return there.has_value();
  };
  const auto is_stopped = [&] { return range_.stop && range_.stop(); };
  const auto is_hopeless = [&](int highest) {
    double sum = 0.0;
    const HarmonicSet kept = first(highest);
    for (const DroppedHarmonic& one : dropped) {
      if (!kept.contains(one.order)) sum += std::abs(one.amplitude);
    }
    return sum > worth_trying_first * may_be_pruned * range_.harmonic_tolerance;
  };
  int enough = fewest_first_ones;
  while (enough < rich.set.highest() && is_hopeless(enough)) ++enough;
  int too_few = enough - 1;
  while (!is_stopped() && first(enough).count() < rich.set.count() && !do_first(enough)) {
    too_few = std::exchange(enough, enough + std::max(1, enough / 4));
  }
  if (result.set == rich.set) return;
  while (!is_stopped() && enough - too_few > 1) {
    const int highest = (too_few + enough) / 2;
    (do_first(highest) ? enough : too_few) = highest;
  }
}

/// Takes out of the richest set as many as can be found by bisection, more than are out already.
void PeakHarmonicsChoice::prune(PeakHarmonics& result, const PeakHarmonics& rich,
                                const std::vector<DroppedHarmonic>& dropped,
                                const HarmonicSet& least) {
  const double allowed = may_be_pruned * range_.harmonic_tolerance;
  std::vector<int> order;  // the least first
  std::size_t sure = 0;    // to be taken out
  double sum = 0.0;
  for (const DroppedHarmonic& one : dropped) {
    sum += std::abs(one.amplitude);
    if (!(sum <= worth_trying * allowed)) break;
    if (least.contains(one.order) || least_.contains(one.order)) continue;
    order.push_back(one.order);
    if (sum <= allowed) sure = order.size();
  }
  auto out = static_cast<std::size_t>(rich.set.count() - result.set.count());  // or more can go
  std::size_t too_many = order.size() + 1;                                     // cannot
  for (std::size_t n = std::max(sure, out + 1); n > out && n < too_many; n = (out + too_many) / 2) {
    if (range_.stop && range_.stop()) return;
    std::vector<int> kept = rich.set.orders();
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(n);
    std::erase_if(kept, [&](int k) { return std::find(order.begin(), end, k) != end; });
    std::optional<PeakHarmonics> fewer = without(rich, HarmonicSet(std::move(kept)));
    if (fewer) result = std::move(*fewer);
    (fewer ? out : too_many) = n;
  }
}

double PeakHarmonicsChoice::left_out(const HarmonicSet& set, const LocalPeak& peak) {
  return estimate(set, peak).sum;
}

}  // namespace microslip::solver
