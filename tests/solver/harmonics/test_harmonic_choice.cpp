#include "solver/harmonics/harmonic_choice.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "solver/continuation.hpp"
#include "solver/branch/start_point.hpp"
#include "tests/support/modal_scenes.hpp"

namespace microslip::solver {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double tolerance = 1e-3;
constexpr int highest = 21;

Scene event_chain(double preload) {
  Scene scene = tests::chain_scene(preload);
  tests::use_event_cycles(scene);
  return scene;
}

Scene event_three_dof(double preload) {
  Scene scene = tests::three_dof_scene(preload);
  tests::use_event_cycles(scene);
  return scene;
}

ContinuationOptions choosing() {
  ContinuationOptions options;
  options.frequency_begin = two_pi * 18.0;
  options.frequency_end = two_pi * 28.0;
  options.n_harmonics = highest;
  options.harmonic_tolerance = tolerance;
  return options;
}

NewtonResult solution_of(const Scene& scene, const HarmonicSet& set, double frequency) {
  const auto start = find_start(HarmonicBalance(scene, set), frequency, 1e-11);
  EXPECT_TRUE(start.solution.has_value());
  return start.solution.value_or(NewtonResult{});
}

HarmonicDecision asked(const Scene& scene, const HarmonicSet& set, double frequency) {
  const HarmonicBalance balance(scene, set);
  const NewtonResult at = solution_of(scene, set, frequency);
  const BranchVector hold{Eigen::VectorXd::Zero(balance.size()), 1.0};
  return HarmonicChoice(scene, tolerance, highest)
      .enlarged(balance, at.point, hold, natural_scaling(balance, at.point.x, frequency));
}

TEST(HarmonicChoice, ConstantLoadAddsOddHarmonicsOnly) {
  // The half-wave symmetry f(θ + π) = −f(θ): even harmonics and the mean vanish.
  for (const double hertz : {20.0, 21.0, 24.0}) {
    const HarmonicDecision decision = asked(event_chain(10.0), 1, two_pi * hertz);
    EXPECT_GT(decision.set.count(), 1) << hertz;
    for (const int k : decision.set.orders()) EXPECT_EQ(k % 2, 1) << hertz;
  }
}

TEST(HarmonicChoice, NothingIsAddedWhereContactIsLinear) {
  EXPECT_EQ(asked(event_chain(600.0), 1, two_pi * 21.0).set, HarmonicSet(1));  // stuck
  EXPECT_EQ(asked(event_three_dof(-1e6), 1, two_pi * 21.0).set, HarmonicSet(1));  // a wide gap
}

TEST(HarmonicChoice, WhatIsLeftOutIsTheErrorToFirstOrder) {
  // Amplitude with and without the harmonics above 3: the estimate is a bound that is not idle.
  const Scene scene = event_three_dof(10.0);
  const double frequency = two_pi * 22.0;
  const HarmonicDecision decision = asked(scene, 3, frequency);
  ContinuationOptions options;
  options.n_harmonics = 3;
  const double few = solve_at_frequency(scene, frequency, options).points.at(0).amplitude;
  options.n_harmonics = highest;
  const double many = solve_at_frequency(scene, frequency, options).points.at(0).amplitude;
  const double error = std::abs(few - many) / many;
  EXPECT_GT(error, tolerance);  // else the test tells nothing
  EXPECT_LT(error, 1.3 * decision.missing);
  EXPECT_GT(error, 0.1 * decision.missing);
}

TEST(HarmonicChoice, InternalResonanceCallsForItsHarmonic) {
  // 3ω = ω₂ (hard case 48): the third harmonic of friction drives the second mode at resonance.
  Scene scene = event_chain(30.0);
  const double frequency = two_pi * 21.0;
  scene.natural_frequency[1] = 3.0 * frequency;
  const HarmonicDecision tuned = asked(scene, 1, frequency);
  EXPECT_TRUE(tuned.set.contains(3));
  EXPECT_EQ(tuned.added.at(0), 3);
  EXPECT_GT(tuned.missing, 10.0 * tolerance);
  ContinuationOptions one;
  one.n_harmonics = 1;
  const double amplitude = solve_at_frequency(scene, frequency, one).points.at(0).amplitude;
  const ResponsePoint chosen = solve_at_frequency(scene, frequency, choosing()).points.at(0);
  EXPECT_GT(std::abs(chosen.amplitude - amplitude), 10.0 * tolerance * amplitude);
  EXPECT_LE(chosen.harmonics_left_out, 0.5 * tolerance);
}

TEST(HarmonicChoice, DropsHarmonicsThatDoNothing) {
  const Scene scene = event_chain(10.0);
  const double frequency = two_pi * 21.0;
  const HarmonicBalance balance(scene, highest);
  const NewtonResult at = solution_of(scene, highest, frequency);
  const BranchVector hold{Eigen::VectorXd::Zero(balance.size()), 1.0};
  const HarmonicChoice choice(scene, tolerance, highest);
  const HarmonicDecision decision =
      choice.reduced(balance, at, hold, natural_scaling(balance, at.point.x, frequency), 0.0);
  EXPECT_LT(decision.set.count(), highest / 2);
  EXPECT_LE(decision.left_out, 0.3 * tolerance);
  for (const int k : decision.set.orders()) EXPECT_EQ(k % 2, 1);
  // What was dropped is not missed: the set does not chatter.
  EXPECT_EQ(asked(scene, decision.set, frequency).set, decision.set);
}

TEST(HarmonicChoice, KeepsHarmonicsOfTheExcitation) {
  Scene scene = event_chain(600.0);
  Harmonics excitation(4, 2);
  excitation.rows().topRows(3) = scene.excitation.rows();
  excitation.rows()(7, 0) = 1e-9;
  scene.excitation = excitation;
  EXPECT_EQ(HarmonicChoice(scene, tolerance, highest).least(), HarmonicSet(std::vector<int>{1, 4}));
}

TEST(HarmonicChoice, RefusesATolerancethatIsNone) {
  const Scene scene = event_chain(10.0);
  EXPECT_THROW(HarmonicChoice(scene, 0.0, highest), std::invalid_argument);
  EXPECT_THROW(HarmonicChoice(scene, tolerance, 0), std::invalid_argument);
}

TEST(HarmonicChoice, CurveUsesOneHarmonicWhereStuckAndMoreWhereItSlips) {
  const auto curve = trace_response(event_three_dof(50.0), choosing());
  ASSERT_TRUE(curve.complete) << curve.diagnosis;
  int n_changes = 0;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const ResponsePoint& point = curve.points[i];
    if (point.report.stick_share == 1.0) {
      EXPECT_EQ(point.orders, std::vector<int>{1});
    }
    if (point.mark == PointMark::peak) {
      EXPECT_GE(point.orders.size(), 5U);
    }
    EXPECT_LE(point.harmonics_left_out, 0.5 * tolerance);
    EXPECT_EQ(point.q.n_harmonics(), curve.points.front().q.n_harmonics());
    if (i > 0 && point.orders != curve.points[i - 1].orders) ++n_changes;
  }
  EXPECT_GE(n_changes, 2);
  EXPECT_LE(n_changes, 30);  // 144 points: the set does not chatter
  EXPECT_TRUE(curve.log.empty());
}

TEST(HarmonicChoice, ChoosingCostsFewEvaluationsBesidesThoseOfTheEquations) {
  // Against the same curve with all harmonics that were chosen anywhere on it. A point costs one probe, some
  // seven evaluations in Newton's method with the tangent, and a new set both ends of a step once more.
  const Scene scene = event_three_dof(50.0);
  const auto chosen = trace_response(scene, choosing());
  HarmonicSet used(1);
  for (const ResponsePoint& point : chosen.points) used = used.united(point.orders);
  ContinuationOptions fixed = choosing();
  fixed.harmonic_tolerance = 0.0;
  fixed.orders = used.orders();
  const auto all = trace_response(scene, fixed);
  ASSERT_TRUE(all.complete) << all.diagnosis;
  const auto per_point = [](const ResponseCurve& curve) {
    return static_cast<double>(curve.contact_evaluations) /
           static_cast<double>(curve.points.size());
  };
  std::printf("evaluations per point: %.1f chosen, %.1f with the %d harmonics used\n",
              per_point(chosen), per_point(all), used.count());
  EXPECT_LT(per_point(chosen), 2.0 * per_point(all));
}

TEST(HarmonicChoice, PointsBetweenHaveTheHarmonicsOfTheirNeighbours) {
  const Scene scene = event_three_dof(50.0);
  const auto curve = trace_response(scene, choosing());
  for (const auto& point : points_at_frequency(scene, curve, two_pi * 25.0, choosing())) {
    EXPECT_LT(point.residual, 1e-11);
    EXPECT_FALSE(point.orders.empty());
  }
}

}  // namespace
}  // namespace microslip::solver
