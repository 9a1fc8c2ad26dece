// What is hard: modes that come near each other and part again while a parameter changes, so that a
// peak followed from value to value may end on the other mode's (row 44); a range in which no
// solution with the period of the force is stable, so that the only curve shows a motion that no
// machine does (row 50). Met in: blades of a disk near a veering, Campbell diagrams; the chain of
// paper B, figure 9, at 15 N near 27.7 Hz. Right: peaks followed are the peaks of the curves at
// every value, whichever mode they belong to, and a sweep up finds what a sweep down finds; the
// range without a stable solution is told, integration in time leaves the solution there and finds
// no period.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "pipelines/record/run_messages.hpp"
#include "solver/optimum.hpp"
#include "solver/time_integration.hpp"
#include "tests/support/curves.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/readable_patch.hpp"
#include "tests/support/steady_states.hpp"
#include "tests/support/traced_peaks.hpp"

namespace microslip::branch_identity {
namespace {

using solver::PointMark;
using solver::ResponseCurve;
using solver::ResponsePoint;
using tests::frequency_range;
using tests::marked;

constexpr double two_pi = 2.0 * std::numbers::pi;

/// Two modes, the first tuned from below the second to above; one point of contact that both move
/// couples them. Stuck, the two frequencies come no nearer than some 1 %; slip brings them closer
/// and lets the peaks grow together.
solver::Scene veering_scene(double tuned) {
  solver::Scene scene;
  scene.natural_frequency = Eigen::Vector2d(std::min(tuned, 1.0), std::max(tuned, 1.0));
  const bool swapped = tuned > 1.0;
  const auto ordered = [&](double first, double second) {
    return swapped ? Eigen::Vector2d(second, first) : Eigen::Vector2d(first, second);
  };
  scene.damping_ratio = ordered(1e-3, 1.5e-3);
  scene.output = ordered(1.0, 0.6);
  scene.excitation = contact::Harmonics(1, 2);
  scene.excitation.rows().row(1) = ordered(0.01, 0.008).transpose();
  const contact::ContactPatch patch(Eigen::VectorXd::Ones(1), {{0.02, 0.0, 0.5, 0.06}});
  const contact::ModalShapes shapes{ordered(0.8, -0.6).transpose(), Eigen::RowVector2d::Zero(), {}};
  scene.contact = std::make_unique<tests::ReadablePatch>(patch, shapes);
  return scene;
}

ResponsePoint highest_of(const ResponseCurve& curve) {
  return *std::max_element(
      curve.points.begin(), curve.points.end(),
      [](const ResponsePoint& a, const ResponsePoint& b) { return a.amplitude < b.amplitude; });
}

TEST(Veering, PeaksFollowedThroughItAreThoseOfTheCurves) {
  // Row 44.
  solver::PeakTraceOptions options;
  options.lower = 0.96;
  options.upper = 1.04;
  options.n_values = 33;
  options.n_checks = 3;
  options.scale = solver::ParameterScale::linear;
  const auto range = frequency_range(0.9, 1.15);
  const solver::PeakTrace trace = tests::traced_peaks(veering_scene, range, options);
  ASSERT_EQ(trace.peaks.size(), 33U);
  int n_two = 0;
  int n_tuned = 0;  // the highest peak is one of the tuned mode
  for (const solver::PeakOfParameter& peak : trace.peaks) {
    const ResponseCurve curve = solver::trace_response(veering_scene(peak.parameter), range);
    ASSERT_TRUE(curve.complete) << peak.parameter << ": " << curve.diagnosis;
    n_two += marked(curve, PointMark::peak).size() == 2U ? 1 : 0;
    const ResponsePoint highest = highest_of(curve);
    // Both are solved for as unknowns, to rounding of a slope.
    EXPECT_NEAR(peak.amplitude, highest.amplitude, 1e-8 * highest.amplitude) << peak.parameter;
    EXPECT_NEAR(peak.frequency, highest.frequency, 1e-6) << peak.parameter;
    const Eigen::RowVectorXd sizes = highest.q.rows().middleRows(1, 2).colwise().norm();
    n_tuned += (sizes[0] > sizes[1]) == (peak.parameter < 1.0) ? 1 : 0;
  }
  EXPECT_GT(n_two, 16);
  // The highest changes hands on the way: following one mode alone would be wrong.
  EXPECT_GT(n_tuned, 2);
  EXPECT_LT(n_tuned, 31);
  std::printf("%d of 33 curves have two peaks, of %d the tuned mode's is the highest\n", n_two,
              n_tuned);
}

TEST(Veering, SweepsUpAndDownFindTheSameBranch) {
  // Row 44. A jump to the neighbouring mode's branch would cost a sweep a peak, or a fold.
  for (const double tuned : {0.97, 0.99, 0.995, 1.0 - 1e-6, 1.005, 1.01, 1.03}) {
    const ResponseCurve up =
        solver::trace_response(veering_scene(tuned), frequency_range(0.9, 1.15));
    const ResponseCurve down =
        solver::trace_response(veering_scene(tuned), frequency_range(1.15, 0.9));
    ASSERT_TRUE(up.complete && down.complete) << tuned;
    for (const PointMark mark : {PointMark::peak, PointMark::fold}) {
      const auto a = marked(up, mark);
      auto b = marked(down, mark);
      std::reverse(b.begin(), b.end());
      ASSERT_EQ(a.size(), b.size()) << tuned;
      for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_NEAR(a[i].amplitude, b[i].amplitude, 1e-8 * a[i].amplitude) << tuned;
        EXPECT_NEAR(a[i].frequency, b[i].frequency, 1e-8) << tuned;
      }
    }
  }
}

constexpr int n_harmonics = 7;

solver::Scene restless_scene() {
  solver::Scene scene = tests::three_dof_scene(15.0);
  tests::add_transient(scene);
  tests::use_event_cycles(scene);
  return scene;
}

pipelines::CurveResult restless_curve(double from_hz, double to_hz) {
  auto options = frequency_range(two_pi * from_hz, two_pi * to_hz);
  options.n_harmonics = n_harmonics;
  options.search_starts = 6;
  pipelines::CurveResult result;
  result.name = "preload_15";
  result.curve = solver::trace_response(restless_scene(), options);
  return result;
}

TEST(NoStableMotion, IsToldWithItsRangeAndTheWayToSeeIt) {
  // Row 50. From 27.59 Hz on a pair of multipliers lies outside the unit circle and the search
  // finds no other solution.
  const pipelines::CurveResult result = restless_curve(27.0, 28.0);
  ASSERT_TRUE(result.curve.complete) << result.curve.diagnosis;
  EXPECT_TRUE(result.curve.detached.empty());
  EXPECT_EQ(result.curve.points.front().stability, solver::Stability::stable);
  EXPECT_EQ(result.curve.points.back().stability, solver::Stability::unstable);
  const std::string text = pipelines::restless_text(result);
  double from = 0.0;
  double to = 0.0;
  ASSERT_EQ(
      std::sscanf(text.c_str(), "curve preload_15: from %lf to %lf Hz no solution found is stable",
                  &from, &to),
      2)
      << text;
  EXPECT_GT(from, 27.3);
  EXPECT_LT(from, 27.8);
  EXPECT_EQ(to, 28.0);
  EXPECT_NE(text.find("response.method = \"time\""), std::string::npos) << text;
}

TEST(NoStableMotion, IsNotToldWhereAStableOneExistsBesideTheUnstable) {
  // Between folds two stable solutions surround the unstable one.
  pipelines::CurveResult result;
  result.name = "preload_30";
  auto options = frequency_range(two_pi * 18.0, two_pi * 28.0);
  result.curve = solver::trace_response(tests::three_dof_scene(30.0), options);
  const auto unstable = [](const ResponsePoint& point) {
    return point.stability == solver::Stability::unstable;
  };
  ASSERT_TRUE(std::any_of(result.curve.points.begin(), result.curve.points.end(), unstable));
  EXPECT_EQ(pipelines::restless_text(result), "");
}

ResponsePoint point_at(double hz, solver::Stability stability, solver::StabilityBasis basis) {
  ResponsePoint point;
  point.frequency = two_pi * hz;
  point.stability = stability;
  point.stability_basis = basis;
  return point;
}

TEST(NoStableMotion, IsToldOfAPeakWhoseNeighboursOnlyHillsExponentsCallStable) {
  // Row 50: the period map is looked at where it costs little, at peaks and folds.
  using enum solver::Stability;
  using enum solver::StabilityBasis;
  pipelines::CurveResult result;
  result.name = "scale_1";
  result.curve.points = {point_at(10.0, stable, hill), point_at(10.1, unstable, period_map),
                         point_at(10.2, stable, hill), point_at(10.3, stable, period_map)};
  EXPECT_NE(pipelines::restless_text(result).find("from 10 to 10.2 Hz no solution"),
            std::string::npos)
      << pipelines::restless_text(result);
  result.curve.points[0].stability_basis = period_map;
  result.curve.points[2].stability_basis = period_map;
  EXPECT_EQ(pipelines::restless_text(result), "");
}

// Row 50: a low stable branch lies below, so that there is a stable solution at every frequency.
TEST(NoStableMotion, AtThePeakThatIsToldIsNamedThoughALowOneIsStable) {
  using enum solver::Stability;
  using enum solver::StabilityBasis;
  pipelines::CurveResult result;
  result.name = "scale_1";
  const auto add = [&](double hz, solver::Stability stability, double amplitude) {
    result.curve.points.push_back(point_at(hz, stability, hill));
    result.curve.points.back().amplitude = amplitude;
  };
  add(10.0, stable, 1.0);
  add(10.3, stable, 2.0);
  add(10.2, unstable, 5.0);
  result.curve.points.back().mark = PointMark::peak;
  add(10.4, stable, 4.0);
  const std::string text = pipelines::unstable_peak_text(result);
  EXPECT_NE(text.find("curve scale_1: its peak, 5 m at 10.2 Hz, is unstable"), std::string::npos)
      << text;
  EXPECT_NE(text.find("stable reaches 4 m, at 10.4 Hz"), std::string::npos) << text;
  result.curve.points[3].amplitude = 4.99;  // beside the fold that is met
  EXPECT_EQ(pipelines::unstable_peak_text(result), "");
  result.curve.points[3].amplitude = 4.0;
  result.curve.points[2].stability = stable;
  EXPECT_EQ(pipelines::unstable_peak_text(result), "");
}

TEST(NoStableMotion, IsToldAtASingleFrequency) {
  pipelines::CurveResult result;
  result.name = "scale_1";
  result.curve.points = {
      point_at(10.0, solver::Stability::unstable, solver::StabilityBasis::period_map)};
  EXPECT_NE(pipelines::restless_text(result).find("curve scale_1: at 10 Hz no solution"),
            std::string::npos)
      << pipelines::restless_text(result);
}

TEST(NoStableMotion, IntegrationInTimeLeavesTheSolutionAndFindsNoPeriod) {
  // Row 50.
  const solver::Scene scene = restless_scene();
  solver::ContinuationOptions options;
  options.n_harmonics = n_harmonics;
  const double frequency = two_pi * 27.8;
  const auto curve = solver::solve_at_frequency(scene, frequency, options);
  ASSERT_TRUE(curve.complete);
  EXPECT_EQ(curve.points[0].stability, solver::Stability::unstable);
  solver::TimeOptions time;
  time.step_tolerance = 1e-7;
  time.max_periods = 800;
  const auto end = tests::steady_state_from(scene, frequency, curve.points[0].q, time);
  EXPECT_FALSE(end.periodic);
}

}  // namespace
}  // namespace microslip::branch_identity
