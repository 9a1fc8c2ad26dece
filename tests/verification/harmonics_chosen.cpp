// Harmonics chosen for a curve against a fixed large set ("auto").
//
//   promised: |A(chosen) − A(all up to 31)| ≤ 1e-3 A at the highest peak, A the amplitude of the
//   output: the tolerance given to the solver, which aims at half of it. The peak with the large
//   set is climbed to from the chosen one; at an end of the range its frequency stays
//
// on the chains of theory sections 20.3 and 20.4 at all preloads, on a patch whose modes lie at
// multiples of the resonance, and on random modal scenes (seeds 0 … 39, the first 150 points of
// each curve). One harmonic is left where contact is linear. A peak whose harmonics the solver
// could not settle says so ("harmonics-kept"), and is counted.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "solver/continuation.hpp"
#include "solver/enrichment/enrichment.hpp"
#include "solver/enrichment/level_point.hpp"
#include "solver/peak/high_points.hpp"
#include "tests/support/campaign.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"

namespace microslip::harmonics_chosen {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double promised = 1e-3;
constexpr int all_up_to = 31;

struct Count {
  int curves = 0;
  int compared = 0;
  int unsolved = 0;  // by the large set from the peak
  int kept = 0;      // said not to be settled
  int linear = 0;    // fully stuck or open all over
  long harmonics = 0;
  std::size_t most = 0;
  double largest = 0.0;
};

/// Difference of the amplitude, over it; negative: the large set was not solved for.
double error_of(const solver::Scene& scene, const solver::HighPoint& high,
                const solver::ContinuationOptions& range) {
  solver::HarmonicBalance few(scene, solver::HarmonicSet(high.point.orders));
  solver::HarmonicBalance many(scene, all_up_to);
  const auto peak = high.place == solver::PeakPlace::peak
                        ? solver::local_peak(few, high.point)
                        : solver::local_end(few, high.point, range);
  if (!peak) return -1.0;
  solver::PeakWork work;
  const auto solved =
      solver::level_point(many, solver::embedded(*peak, few, many), range, work, 2.0);
  return solved ? std::abs(peak->amplitude / solved->amplitude - 1.0) : -1.0;
}

bool is_linear(const solver::ResponsePoint& point) {
  return point.report.stick_share == 1.0 || point.report.separated_share == 1.0;
}

void compare(const solver::Scene& scene, const solver::ContinuationOptions& range,
             const std::string& name, Count& count) {
  const solver::ResponseCurve curve = solver::trace_response(scene, range);
  EXPECT_TRUE(curve.complete || curve.diagnosis == solver::Diagnosis::budget)
      << name << ": " << curve.diagnosis;
  const auto high = solver::high_points(scene, curve, range);
  if (high.empty()) return;
  const solver::HighPoint& highest = high.front();
  ++count.curves;
  count.harmonics += static_cast<long>(highest.point.orders.size());
  count.most = std::max(count.most, highest.point.orders.size());
  if (std::ranges::all_of(curve.points, is_linear)) {
    ++count.linear;
    EXPECT_EQ(highest.point.orders.size(), 1U) << name;
    return;
  }
  if (std::ranges::any_of(curve.log, [](const auto& event) {
        return event.remedy == solver::Remedy::harmonics_kept;
      })) {
    ++count.kept;
    return;
  }
  if (highest.place == solver::PeakPlace::unsolved) return;
  const double error = error_of(scene, highest, range);
  ++count.compared;
  if (error < 0.0) {
    ++count.unsolved;
    return;
  }
  EXPECT_LE(error, promised) << name << " at " << highest.point.frequency << " rad/s, "
                             << highest.point.orders.size() << " harmonics up to "
                             << highest.point.orders.back();
  count.largest = std::max(count.largest, error);
}

void print(const char* name, const Count& count) {
  std::printf(
      "%s: %d curves, %.1f harmonics in the mean, %zu at most; %d linear; largest error of the "
      "peak %.1e "
      "of %d (promised %.0e), %d not solved with all, %d said not to be settled\n",
      name, count.curves, static_cast<double>(count.harmonics) / count.curves, count.most,
      count.linear, count.largest, count.compared, promised, count.unsolved, count.kept);
}

solver::ContinuationOptions choosing(solver::ContinuationOptions options) {
  options.n_harmonics = all_up_to;
  options.harmonic_tolerance = promised;
  return options;
}

solver::ContinuationOptions chain_range() {
  solver::ContinuationOptions options;
  options.frequency_begin = two_pi * 18.0;
  options.frequency_end = two_pi * 28.0;
  return options;
}

TEST(HarmonicsChosen, ConstantLoadKeepsThePromise) {
  Count count;
  for (const double preload : {0.0, 10.0, 20.0, 30.0, 50.0, 100.0, 200.0, 600.0}) {
    solver::Scene scene = tests::chain_scene(preload);
    tests::use_event_cycles(scene);
    compare(scene, choosing(chain_range()), std::to_string(preload) + " N", count);
  }
  print("chain, constant load", count);
  EXPECT_EQ(count.unsolved + count.kept, 0);
  EXPECT_LE(count.most, 5U);
  EXPECT_GT(count.linear, 0);
}

TEST(HarmonicsChosen, NormalMotionKeepsThePromise) {
  Count count;
  for (const double preload : {0.0, 10.0, 25.0, 30.0, 50.0, 100.0, 200.0, 600.0}) {
    solver::Scene scene = tests::three_dof_scene(preload);
    tests::use_event_cycles(scene);
    compare(scene, choosing(chain_range()), std::to_string(preload) + " N", count);
  }
  print("three degrees of freedom", count);
  EXPECT_EQ(count.unsolved + count.kept, 0);
  EXPECT_LE(count.most, 12U);
}

TEST(HarmonicsChosen, ModesAtMultiplesOfTheResonanceKeepThePromise) {
  // In the manner of the default blade, whose modes lie at three and eight times its resonance:
  // there 1, 3, 5, 7, 9, 13 harmonics give 538, 548, 440, 498, 475, 481 µm, and the next one alone
  // tells nothing.
  Count count;
  for (const double preload : tests::campaign_values({0.3, 1.0, 3.0}, {1.0})) {
    solver::Scene scene = tests::patch_scene({4, 8}, preload);
    scene.natural_frequency << 1.0, 3.05, 8.1, 11.0;
    scene.natural_frequency *= two_pi * 300.0;
    tests::use_event_cycles(scene);
    solver::ContinuationOptions range;
    range.frequency_begin = two_pi * 285.0;
    range.frequency_end = two_pi * 345.0;
    compare(scene, choosing(range), std::to_string(preload) + " N", count);
  }
  print("modes at multiples", count);
  EXPECT_EQ(count.unsolved, 0);
}

TEST(HarmonicsChosen, RandomScenesKeepThePromise) {
  Count count;
  const int n_seeds = tests::campaign_size(40, 6);
  for (int seed = 0; seed < n_seeds; ++seed) {
    tests::RandomScene random = tests::random_scene(static_cast<std::uint64_t>(seed));
    tests::use_event_cycles(random.scene);
    solver::ContinuationOptions options = choosing(random.options);
    options.max_points = 150;
    compare(random.scene, options, "seed " + std::to_string(seed), count);
  }
  print("random scenes", count);
  EXPECT_EQ(count.unsolved + count.kept, 0);
}

}  // namespace
}  // namespace microslip::harmonics_chosen
