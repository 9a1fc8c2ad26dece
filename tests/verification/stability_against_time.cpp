// Row 50. Hard: a solution that nothing goes to, beside two that are stable.
// Met in: paper B, figure 9, preloads of 25 to 50 N.
// Right: integration in time comes back to stable ones and leaves the other.
//
// Stability of harmonic balance with five harmonics against time integration (theory sections
// 17, 20.4), where three solutions coexist: 25, 30 and 50 N, at three frequencies inside the band
// between the folds.
//
// A solution judged stable is found again by integration from a start 1 % away in every harmonic;
// the one judged unstable is left, for one of the other two. 1 % is above the error of five
// harmonics and far below the distance of the solutions. Found again: within 2 % of the first
// harmonic, ten times the named tolerance of the methods; left: farther than half of the way to the
// nearest other solution.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "solver/continuation.hpp"
#include "solver/time_integration.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"
#include "tests/support/steady_states.hpp"

namespace microslip::stability_against_time {
namespace {

using solver::Harmonics;
using solver::ResponsePoint;
using solver::Stability;

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr int n_harmonics = 5;

double distance(const Harmonics& a, const Harmonics& b) {
  return (a.rows() - b.rows()).middleRows(1, 2).norm() / b.rows().middleRows(1, 2).norm();
}

/// 1 % more in every coefficient of one sign of a pattern, 1 % less in the others.
Harmonics perturbed(const Harmonics& q, double sign) {
  Harmonics other = q;
  for (Eigen::Index i = 0; i < other.rows().size(); ++i) {
    other.vector()[i] *= 1.0 + sign * 0.01 * (i % 3 == 2 ? -1.0 : 1.0);
  }
  return other;
}

Harmonics attractor_from(const solver::Scene& scene, double frequency, const Harmonics& start) {
  solver::TimeOptions options;
  options.step_tolerance = 1e-7;         // far below the 2 % asked for
  options.periodicity_tolerance = 1e-4;  // likewise
  options.max_periods = 2000;
  options.n_harmonics = n_harmonics;
  const auto point = tests::steady_state_from(scene, frequency, start, options);
  EXPECT_EQ(point.period_multiple, 1) << frequency;
  return point.response.q;
}

void judge(const solver::Scene& scene, const std::vector<ResponsePoint>& points, double preload) {
  ASSERT_EQ(points.size(), 3U) << preload;
  const double frequency = points[0].frequency;
  EXPECT_EQ(points[1].stability, Stability::unstable) << preload;
  for (const std::size_t outer : {0U, 2U}) {
    EXPECT_NE(points[outer].stability, Stability::unstable) << preload;
    for (const double sign : {1.0, -1.0}) {
      const Harmonics end = attractor_from(scene, frequency, perturbed(points[outer].q, sign));
      EXPECT_LT(distance(end, points[outer].q), 0.02) << preload << " N, solution " << outer;
    }
  }
  for (const double sign : {1.0, -1.0}) {
    const Harmonics end = attractor_from(scene, frequency, perturbed(points[1].q, sign));
    const double nearest =
        std::min(distance(points[0].q, points[1].q), distance(points[2].q, points[1].q));
    EXPECT_GT(distance(end, points[1].q), 0.5 * nearest) << preload;
    EXPECT_LT(std::min(distance(end, points[0].q), distance(end, points[2].q)), 0.02) << preload;
  }
}

struct Branch {
  solver::Scene scene;
  solver::ContinuationOptions options;
  solver::ResponseCurve curve;
};

/// The curve of a preload, traced once for all tests.
const Branch& branch(double preload) {
  static std::map<double, Branch> known;
  const auto [place, is_new] = known.try_emplace(preload);
  Branch& b = place->second;
  if (!is_new) return b;
  b.scene = tests::three_dof_scene(preload);
  tests::add_transient(b.scene);
  tests::use_event_cycles(b.scene);
  b.options.frequency_begin = two_pi * 18.0;
  b.options.frequency_end = two_pi * 28.0;
  b.options.n_harmonics = n_harmonics;
  b.curve = solver::trace_response(b.scene, b.options);
  return b;
}

TEST(StabilityAgainstTime, StableSolutionsAreFoundAndTheMiddleOneIsLeft) {
  int n_stable = 0;
  int n_open = 0;
  for (const double preload : {25.0, 30.0, 50.0}) {
    const auto& [scene, options, curve] = branch(preload);
    ASSERT_TRUE(curve.complete);
    std::vector<double> folds;
    for (const auto& point : curve.points) {
      if (point.mark == solver::PointMark::fold) folds.push_back(point.frequency);
    }
    ASSERT_EQ(folds.size(), 2U) << preload;
    for (const double share : {0.2, 0.5, 0.8}) {
      const double frequency = folds[0] + share * (folds[1] - folds[0]);
      const auto points = solver::points_at_frequency(scene, curve, frequency, options);
      judge(scene, points, preload);
      for (const std::size_t outer : {0U, 2U}) {
        ++(points.at(outer).stability == Stability::stable ? n_stable : n_open);
      }
    }
  }
  std::printf("of 18 solutions that time integration finds, %d are judged stable, %d left open\n",
              n_stable, n_open);
  EXPECT_EQ(n_stable, 18);  // the multipliers of the period map tell all of them
}

TEST(StabilityAgainstTime, FewPointsOfTheCurvesAreLeftOpen) {
  // Pairs of Hill's problem of a hysteretic force are no proof either way; multipliers in time are,
  // but on the unit circle, and where a change of state falls on θ = 0 so closely that neighbours
  // differ.
  int n_points = 0;
  int n_open = 0;
  for (const double preload : {0.0, 10.0, 25.0, 30.0, 50.0, 100.0, 200.0}) {
    for (const auto& point : branch(preload).curve.points) {
      if (point.mark == solver::PointMark::fold) continue;  // neutral
      ++n_points;
      if (point.stability == Stability::not_assessed) ++n_open;
      if (point.determinant_sign < 0.0) {
        EXPECT_EQ(point.stability, Stability::unstable);
      }
    }
  }
  std::printf("%d of %d points left open\n", n_open, n_points);
  EXPECT_LE(n_open, n_points / 30);
}

TEST(StabilityAgainstTime, EveryFrequencyOfACurveWithoutFoldsIsJudgedAsTimeIntegrationFinds) {
  // 15 N: the only motion of period one loses its stability by a pair of multipliers near 27.6 Hz,
  // and no determinant changes sign there. Time integration from the solution itself stays or
  // leaves.
  solver::Scene scene = tests::three_dof_scene(15.0);
  tests::add_transient(scene);
  tests::use_event_cycles(scene);
  int n_left = 0;
  for (const double hz : {20.0, 23.0, 25.0, 26.0, 27.0, 27.3, 27.7, 27.8, 28.0}) {
    solver::ContinuationOptions options;
    options.n_harmonics = n_harmonics;
    const auto curve = solver::solve_at_frequency(scene, two_pi * hz, options);
    ASSERT_TRUE(curve.complete) << hz;
    const ResponsePoint& point = curve.points[0];
    EXPECT_GT(point.determinant_sign, 0.0) << hz;
    solver::TimeOptions time;
    time.step_tolerance = 1e-7;
    time.periodicity_tolerance = 1e-4;
    time.max_periods = 1000;  // the pair grows by 2.8 % per period: a factor e²⁷
    const auto end = tests::steady_state_from(scene, point.frequency, point.q, time);
    const bool stays = end.period_multiple == 1 && distance(end.response.q, point.q) < 0.02;
    EXPECT_EQ(point.stability, stays ? Stability::stable : Stability::unstable) << hz;
    n_left += stays ? 0 : 1;
  }
  EXPECT_EQ(n_left, 3);
}

}  // namespace
}  // namespace microslip::stability_against_time
