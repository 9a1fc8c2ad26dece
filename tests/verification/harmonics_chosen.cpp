// Harmonics chosen point by point against a fixed large set (issue: multi-harmonic balance, "auto").
//
//   promised: |a(chosen) − a(all up to 31)| ≤ 1e-3 a, a the amplitude of the output, on the plane across the
//   branch: the tolerance given to the solver, which aims at half of it; next to a fold the same distance
//   at a fixed frequency has no bound, so the large set is solved for from each point on that plane
//
// on the chains of theory sections 20.3 and 20.4 at all preloads and on random modal scenes (seeds 0 … 39),
// the first 150 points of each curve. One harmonic is left where contact is linear. Points that would need
// harmonics above 21, the highest allowed, say so in `harmonics_left_out` and are counted.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "solver/continuation.hpp"
#include "solver/balance/harmonic_balance.hpp"
#include "solver/balance/newton.hpp"
#include "solver/balance/output_amplitude.hpp"
#include "solver/stability/stability.hpp"
#include "solver/branch/start_point.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"

namespace microslip {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double promised = 1e-3;
constexpr int highest = 21;
constexpr int all_up_to = 31;

struct Count {
  long points = 0;
  long compared = 0;
  long unsolved = 0;  // by the large set from the point
  long capped = 0;    // need harmonics above the highest allowed
  long one_harmonic = 0;
  long linear = 0;  // fully stuck or open
  long harmonics = 0;
  std::size_t most = 0;
  int highest_order = 1;
  double largest = 0.0;
};

/// Difference of the amplitude, over it; negative: the large set was not solved for.
double error_of(const solver::Scene& scene, const solver::ResponsePoint& point) {
  const solver::HarmonicBalance few(scene, solver::HarmonicSet(point.orders));
  const solver::HarmonicBalance many(scene, all_up_to);
  const Eigen::VectorXd x = few.unknowns(point.q);
  const auto at = few.evaluate(x, point.frequency);
  solver::Scaling scaling = solver::natural_scaling(few, x, point.frequency);
  const double width =
      solver::slow_flow_stability(few, at.jacobian, point.frequency).nearest;
  scaling.parameter = std::clamp(width, 1e-7 * point.frequency, 0.1 * point.frequency);
  const auto tangent = solver::null_vector(at, scaling, 1.0);
  if (!tangent) return -1.0;
  const auto widened = [&](const Eigen::VectorXd& one) { return many.unknowns(few.harmonics(one)); };
  const auto solution = solver::solve_newton(
      [&](const Eigen::VectorXd& y, double frequency) { return many.evaluate(y, frequency); },
      {widened(x), point.frequency}, {widened(tangent->x), tangent->parameter}, scaling, {});
  if (!solution.converged) return -1.0;
  const double amplitude =
      solver::output_amplitude(many.harmonics(solution.point.x), scene.output).half_peak_to_peak;
  return std::abs(point.amplitude - amplitude) / amplitude;
}

bool is_linear(const solver::ResponsePoint& point) {
  return point.report.stick_share == 1.0 || point.report.separated_share == 1.0;
}

void compare(const solver::Scene& scene, const solver::ResponseCurve& curve, std::size_t n_compared,
             const std::string& name, Count& count) {
  const std::size_t stride = std::max<std::size_t>(1, curve.points.size() / n_compared);
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const solver::ResponsePoint& point = curve.points[i];
    ++count.points;
    count.harmonics += static_cast<long>(point.orders.size());
    count.most = std::max(count.most, point.orders.size());
    count.highest_order = std::max(count.highest_order, point.orders.back());
    if (point.orders.size() == 1) ++count.one_harmonic;
    if (is_linear(point)) {
      ++count.linear;
      // A step whose other end slips has the harmonics of that end all over.
      const bool inside = i > 0 && i + 1 < curve.points.size() && is_linear(curve.points[i - 1]) &&
                          is_linear(curve.points[i + 1]);
      if (inside) {
        EXPECT_EQ(point.orders.size(), 1U) << name;
      }
    }
    if (point.harmonics_left_out > promised) ++count.capped;
    const bool asked = i % stride == 0 && point.amplitude > 0.0;
    if (!asked || point.harmonics_left_out > promised) continue;
    const double error = error_of(scene, point);
    ++count.compared;
    if (error < 0.0) {
      ++count.unsolved;
      continue;
    }
    EXPECT_LE(error, promised) << name << " at " << point.frequency << " rad/s, "
                               << point.orders.size() << " harmonics up to " << point.orders.back();
    count.largest = std::max(count.largest, error);
  }
}

void print(const char* name, const Count& count) {
  std::printf(
      "%s: %ld points, %.1f harmonics in the mean, %zu at most, highest order %d; %ld with one, %ld "
      "linear; largest error %.1e of the amplitude over %ld points (promised %.0e), %ld unsolved; %ld "
      "points need more than %d\n",
      name, count.points, static_cast<double>(count.harmonics) / static_cast<double>(count.points),
      count.most, count.highest_order, count.one_harmonic, count.linear, count.largest,
      count.compared, promised, count.unsolved, count.capped, highest);
}

solver::ContinuationOptions choosing(solver::ContinuationOptions options) {
  options.n_harmonics = highest;
  options.harmonic_tolerance = promised;
  return options;
}

solver::ContinuationOptions chain_range() {
  solver::ContinuationOptions options;
  options.frequency_begin = two_pi * 18.0;
  options.frequency_end = two_pi * 28.0;
  return options;
}

TEST(HarmonicsChosen, ConstantLoadKeepsThePromiseWithOddHarmonicsOnly) {
  Count count;
  for (const double preload : {0.0, 10.0, 20.0, 30.0, 50.0, 100.0, 200.0, 600.0}) {
    solver::Scene scene = tests::chain_scene(preload);
    tests::use_event_cycles(scene);
    const auto curve = solver::trace_response(scene, choosing(chain_range()));
    ASSERT_TRUE(curve.complete) << preload << ": " << curve.diagnosis;
    for (const auto& point : curve.points) {
      for (const int k : point.orders) EXPECT_EQ(k % 2, 1) << preload;
    }
    compare(scene, curve, 8, std::to_string(preload) + " N", count);
  }
  print("chain, constant load", count);
  EXPECT_EQ(count.unsolved, 0);
  EXPECT_LE(count.most, 5U);
  EXPECT_GT(count.linear, 0);
}

TEST(HarmonicsChosen, NormalMotionKeepsThePromiseOnEveryPartOfTheBranch) {
  Count count;
  for (const double preload : {0.0, 10.0, 25.0, 30.0, 50.0, 100.0, 200.0, 600.0}) {
    solver::Scene scene = tests::three_dof_scene(preload);
    tests::use_event_cycles(scene);
    const auto curve = solver::trace_response(scene, choosing(chain_range()));
    ASSERT_TRUE(curve.complete) << preload << ": " << curve.diagnosis;
    compare(scene, curve, 10, std::to_string(preload) + " N", count);
  }
  print("three degrees of freedom", count);
  EXPECT_EQ(count.unsolved, 0);
  EXPECT_LE(count.most, 12U);
  EXPECT_GT(count.one_harmonic, 100);
}

TEST(HarmonicsChosen, RandomScenesKeepThePromise) {
  Count count;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    tests::RandomScene random = tests::random_scene(seed);
    tests::use_event_cycles(random.scene);
    solver::ContinuationOptions options = choosing(random.options);
    options.max_points = 150;
    const auto curve = solver::trace_response(random.scene, options);
    EXPECT_TRUE(curve.complete || curve.diagnosis == "budget") << seed << ": " << curve.diagnosis;
    compare(random.scene, curve, 5, "seed " + std::to_string(seed), count);
  }
  print("random scenes", count);
  EXPECT_LE(count.unsolved, count.compared / 50);
  EXPECT_LE(count.capped, count.points / 50);
  // A complete set would have the highest order at every point.
  EXPECT_LT(count.harmonics, 4 * count.points);
}

}  // namespace
}  // namespace microslip
