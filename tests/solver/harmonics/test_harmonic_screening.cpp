#include "solver/harmonics/harmonic_screening.hpp"

#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "solver/branch/start_point.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"

namespace microslip::solver {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double tolerance = 1e-2;
constexpr int highest = 21;

/// A scene at neighbouring frequencies with one set.
struct Bench {
  explicit Bench(Scene from, HarmonicSet set)
      : scene(std::move(from)), balance(scene, std::move(set)), choice(scene, tolerance, highest),
        screening(scene, choice) {}

  [[nodiscard]] NewtonResult solution(double frequency) const {
    const auto start = find_start(balance, frequency, 1e-11);
    EXPECT_TRUE(start.solution.has_value());
    return start.solution.value_or(NewtonResult{});
  }
  [[nodiscard]] Scaling scaling(const NewtonResult& at) const {
    return natural_scaling(balance, at.point.x, at.point.parameter);
  }
  [[nodiscard]] HarmonicDecision probe(const NewtonResult& at) const {
    const BranchVector hold{Eigen::VectorXd::Zero(balance.size()), 1.0};
    return choice.enlarged(balance, at.point, hold, scaling(at));
  }
  [[nodiscard]] std::optional<double> missing(const NewtonResult& at) {
    return screening.missing(balance, at, scaling(at).residual);
  }

  Scene scene;
  HarmonicBalance balance;
  HarmonicChoice choice;
  HarmonicScreening screening;
};

Scene event_three_dof(double preload) {
  Scene scene = tests::three_dof_scene(preload);
  tests::use_event_cycles(scene);
  return scene;
}

TEST(HarmonicScreening, KnowsNothingBeforeAProbe) {
  Bench bench(event_three_dof(10.0), 5);
  EXPECT_FALSE(bench.missing(bench.solution(two_pi * 22.0)).has_value());
}

TEST(HarmonicScreening, FollowsTheProbeFromPointToPoint) {
  // One part in a hundred of frequency farther on: the estimate is no less than the probe by more than its margin.
  for (const double hertz : {20.0, 22.0, 24.0, 26.0}) {
    Bench bench(event_three_dof(10.0), 7);
    const NewtonResult first = bench.solution(two_pi * hertz);
    bench.screening.remember(bench.balance, first, bench.probe(first));
    const NewtonResult next = bench.solution(two_pi * hertz * 1.01);
    const std::optional<double> missing = bench.missing(next);
    ASSERT_TRUE(missing.has_value()) << hertz;
    const double probed = bench.probe(next).missing;
    EXPECT_GT(probed, 0.0) << hertz;
    EXPECT_LT(probed, 1.5 * *missing) << hertz;
    EXPECT_GT(probed, 0.1 * *missing) << hertz;
  }
}

TEST(HarmonicScreening, AsksForAProbeWhereForcesHaveGrown) {
  // From a stuck point to one that slips: harmonics are heard that were silent.
  Bench bench(event_three_dof(30.0), 1);
  const NewtonResult stuck = bench.solution(two_pi * 18.0);
  const HarmonicDecision probe = bench.probe(stuck);
  ASSERT_TRUE(probe.shares.empty());
  bench.screening.remember(bench.balance, stuck, probe);
  EXPECT_EQ(bench.missing(stuck).value_or(1.0), 0.0);
  const NewtonResult slipping = bench.solution(two_pi * 26.0);
  ASSERT_FALSE(bench.probe(slipping).shares.empty());
  EXPECT_FALSE(bench.missing(slipping).has_value());
}

TEST(HarmonicScreening, TrustsAProbeForFewPoints) {
  Bench bench(event_three_dof(10.0), 7);
  const NewtonResult at = bench.solution(two_pi * 22.0);
  bench.screening.remember(bench.balance, at, bench.probe(at));
  int n_points = 0;
  while (n_points < 100 && bench.missing(at).has_value()) ++n_points;
  EXPECT_GE(n_points, 1);
  EXPECT_LE(n_points, 8);
}

TEST(HarmonicScreening, IsOfOneSet) {
  Bench bench(event_three_dof(10.0), 7);
  const NewtonResult at = bench.solution(two_pi * 22.0);
  bench.screening.remember(bench.balance, at, bench.probe(at));
  const HarmonicBalance other(bench.scene, 5);
  NewtonResult few = at;
  few.point.x = other.unknowns(bench.balance.harmonics(at.point.x));
  EXPECT_FALSE(bench.screening.missing(other, few, 1.0).has_value());
}

}  // namespace
}  // namespace microslip::solver
