// Scenes of paper B by time integration (theory sections 20.2 to 20.4), with the facts printed
// there. Stick phases are counted as segments in stick; the periodicity tolerance 1e-6 is a
// thousandth of the smallest difference any of these facts rests on.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "solver/time_integration.hpp"
#include "tests/support/campaign.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"
#include "tests/support/steady_states.hpp"

namespace microslip::time_scenes {
namespace {

constexpr double hertz = 2.0 * M_PI;

solver::TimePoint oscillator(double ratio, solver::TimeMethod method) {
  tests::SinglePoint single;
  single.damping_ratio = 0.05;
  single.point = {100.0, 0.0, 0.5, 1.0};  // stiffness 100, limit 0.5
  solver::Scene scene = tests::single_point_scene(single);
  tests::add_transient(scene);
  solver::TimeOptions options;
  options.method = method;
  return tests::steady_state(scene, ratio, options);
}

class Oscillator : public testing::TestWithParam<solver::TimeMethod> {};
INSTANTIATE_TEST_SUITE_P(BothMethods, Oscillator,
                         testing::Values(solver::TimeMethod::events, solver::TimeMethod::rk4));

TEST_P(Oscillator, SticksFourTimesPerCycleAtRatio015) {
  const auto point = oscillator(0.15, GetParam());
  ASSERT_TRUE(point.periodic);
  EXPECT_EQ(point.period_multiple, 1);
  EXPECT_EQ(point.stick_phases, std::vector<int>{4});
}

TEST_P(Oscillator, SlipsPracticallyAllTheTimeAtRatio075AndSticksMoreBelow) {
  std::map<double, double> stick;
  for (const double ratio : {0.75, 0.5, 0.25}) {
    const auto point = oscillator(ratio, GetParam());
    ASSERT_TRUE(point.periodic);
    stick[ratio] = point.response.report.stick_share;
    std::printf("ratio %.2f: amplitude %.6f, stick share %.3f in %d phases\n", ratio,
                point.response.amplitude, stick[ratio], point.stick_phases.front());
  }
  EXPECT_LT(stick[0.75], 0.05);  // only the elastic reversals
  EXPECT_GT(stick[0.5], 2.0 * stick[0.75]);
  EXPECT_GT(stick[0.25], 2.0 * stick[0.5]);
}

std::vector<double> frequencies(double begin, double end, double step) {
  std::vector<double> list;
  const auto n = static_cast<int>(std::lround((end - begin) / step));
  for (int i = 0; i <= n; ++i) list.push_back(hertz * (begin + step * i));
  return list;
}

solver::TimeOptions quick() {
  solver::TimeOptions options;
  options.step_tolerance = 1e-8;
  options.periodicity_tolerance = 1e-6;
  options.max_periods = 400;
  return options;
}

TEST(Chain, ThirtyNewtonsGiveTheLowestPeakFreeAndStuckTheHighest) {
  std::map<double, double> peak;
  for (const double preload : tests::campaign_values(
           {0.0, 10.0, 20.0, 30.0, 50.0, 100.0, 200.0, 600.0}, {0.0, 20.0, 30.0, 50.0, 600.0})) {
    solver::Scene scene = tests::chain_scene(preload);
    tests::add_transient(scene);
    for (const auto& point : tests::swept_states(scene, frequencies(19.0, 26.0, 0.25), quick())) {
      EXPECT_TRUE(point.periodic) << preload;
      peak[preload] = std::max(peak[preload], point.response.amplitude);
    }
    std::printf("preload %7.0f N: peak %.6e m\n", preload, peak[preload]);
  }
  for (const auto& [preload, value] : peak) {
    if (preload != 30.0) {
      EXPECT_LT(peak[30.0], value) << preload;
    }
    if (preload != 0.0 && preload != 600.0) {  // at 600 N it never slips
      EXPECT_LT(value, peak[0.0]) << preload;
      EXPECT_LT(value, peak[600.0]) << preload;
    }
  }
}

/// Frequencies [Hz] at which the way up and the way down end in different steady states.
std::vector<double> coexisting(double preload) {
  solver::Scene scene = tests::three_dof_scene(preload);
  tests::add_transient(scene);
  std::vector<double> up = frequencies(23.0, 26.0, 0.25);
  up.insert(up.begin(), hertz * 22.0);
  std::vector<double> both = up;
  both.insert(both.end(), up.rbegin(), up.rend());
  const auto points = tests::swept_states(scene, both, quick());
  std::vector<double> found;
  for (std::size_t i = 0; i < up.size(); ++i) {
    const auto& a = points[i];
    const auto& b = points[both.size() - 1 - i];
    if (!a.periodic || !b.periodic) continue;
    if (b.response.amplitude > 1.5 * a.response.amplitude) found.push_back(up[i] / hertz);
    EXPECT_LT(a.response.amplitude, 1.01 * b.response.amplitude);  // the way down stays high
  }
  std::printf("preload %3.0f N: two steady states at", preload);
  for (const double f : found) std::printf(" %.2f", f);
  std::printf(" Hz\n");
  return found;
}

TEST(ThreeDegreesOfFreedom, JumpBetweenTwoSteadyStatesAt25And30And50Newtons) {
  for (const double preload : {25.0, 30.0, 50.0}) {
    EXPECT_GE(coexisting(preload).size(), 2U) << preload;
  }
}

TEST(ThreeDegreesOfFreedom, DoNotJumpAt0And100And200Newtons) {
  for (const double preload : tests::campaign_values({0.0, 100.0, 200.0}, {100.0})) {
    EXPECT_TRUE(coexisting(preload).empty()) << preload;
  }
}

}  // namespace
}  // namespace microslip::time_scenes
