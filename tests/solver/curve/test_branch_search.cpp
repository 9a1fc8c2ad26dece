// Branches that no sweep meets (rows 43 and 50b of the project's list of hard cases).

#include "solver/curve/branch_search.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "contact/force/point_method_force.hpp"
#include "contact/line/line_events.hpp"
#include "tests/solver/duffing.hpp"
#include "tests/solver/humped_damping.hpp"
#include "tests/support/random_scene.hpp"

namespace microslip::solver::test_branch_search {
namespace {

Scene with_isola() { return tests::isola_scene(0.5); }

constexpr double two_pi = 2.0 * std::numbers::pi;

ContinuationOptions range(double begin, double end, int starts) {
  ContinuationOptions options;
  options.frequency_begin = begin;
  options.frequency_end = end;
  options.search_starts = starts;
  return options;
}

// Row 43. Hard: a loop that no sweep meets.
// Met in: gaps under a force that barely closes them.
// Right: the search finds it, and tells its number of starts.
TEST(BranchSearch, FindsAnIsola) {
  const ResponseCurve curve = trace_response(with_isola(), range(0.6, 1.4, 12));
  ASSERT_TRUE(curve.complete) << curve.diagnosis;
  EXPECT_EQ(curve.n_starts, 9 * 12);  // both ends, seven inside; the peak and ω₀ are the middle one
  ASSERT_EQ(curve.detached.size(), 1U);
  const DetachedBranch& isola = curve.detached[0];
  EXPECT_TRUE(isola.closed);
  double largest = 0.0;
  for (const ResponsePoint& point : isola.points) {
    const double square = point.amplitude * point.amplitude;
    const double stiffness = 1.0 - point.frequency * point.frequency;
    const double d = tests::HumpedDamping::damping(square);
    EXPECT_NEAR((stiffness * stiffness + d * d) * square, 0.25, 1e-10);
    largest = std::max(largest, point.amplitude);
  }
  EXPECT_NEAR(largest, 5.0, 1e-6);  // F/d far from the hump, at a solved peak
  for (const ResponsePoint& point : curve.points) EXPECT_LT(point.amplitude, 2.0);
}

// Hard: starts are tried in a scene that errs by a thousandth.
// Met in: forces of points in a plane, which are ten times as dear as those that are sampled.
// Right: what is found solves the equations of the scene itself, once.
TEST(BranchSearch, StartsTriedInACheaperSceneFindTheSame) {
  ContinuationOptions options = range(0.6, 1.4, 12);
  options.search_scene = std::make_shared<const Scene>(tests::isola_scene(0.5005));
  const ResponseCurve curve = trace_response(with_isola(), options);
  ASSERT_TRUE(curve.complete) << curve.diagnosis;
  ASSERT_EQ(curve.detached.size(), 1U);
  EXPECT_TRUE(curve.detached[0].closed);
  for (const ResponsePoint& point : curve.detached[0].points) {
    const double square = point.amplitude * point.amplitude;
    const double stiffness = 1.0 - point.frequency * point.frequency;
    const double d = tests::HumpedDamping::damping(square);
    EXPECT_NEAR((stiffness * stiffness + d * d) * square, 0.25, 1e-10);
  }
}

// Row 50b. Hard: the free response is proved, and another solution has contact.
// Met in: gaps.
// Right: the proof says "a solution", the search finds the other.
TEST(BranchSearch, FindsTheContactingBranchBesideAProvedFreeOne) {
  // Row 50b. Gap 2, k_v twice the stiffness: above 1.15 rad/s the free amplitude stays below 0.62.
  tests::SinglePoint single;
  single.point = {0.0, 2.0, 0.0, -4.0};
  single.phi_v = 1.0;
  single.force = 0.2;
  const Scene scene = tests::single_point_scene(single);
  const ResponseCurve curve = trace_response(scene, range(1.15, 1.5, 12));
  ASSERT_TRUE(curve.complete);
  EXPECT_NE(curve.certificate.find("free"), std::string::npos) << curve.certificate;
  ASSERT_FALSE(curve.detached.empty());
  for (const ResponsePoint& point : curve.detached[0].points) {
    EXPECT_LT(point.report.separated_share, 1.0);
    EXPECT_GT(point.amplitude, 2.0);
    EXPECT_LT(point.energy_imbalance, 1e-10);
  }
  EXPECT_FALSE(curve.detached[0].closed);
}

/// A gap oscillator: 20 Hz, one-sided stop of 20 kN/m at 1 mm.
Scene with_stop() {
  tests::SinglePoint single;
  single.frequency = two_pi * 20.0;
  single.point = {0.0, 2e4, 0.0, -20.0};
  single.phi_u = 0.0;
  single.phi_v = 1.0;
  return tests::single_point_scene(single);
}

/// The three solutions at a frequency, all of them on the curve from 15 to 30 Hz, by amplitude.
std::vector<double> amplitudes_on_the_whole_curve(double frequency) {
  const Scene scene = with_stop();
  const ContinuationOptions whole = range(two_pi * 15.0, two_pi * 30.0, 0);
  std::vector<double> amplitudes;
  for (const ResponsePoint& point :
       points_at_frequency(scene, trace_response(scene, whole), frequency, whole)) {
    amplitudes.push_back(point.amplitude);
  }
  std::sort(amplitudes.begin(), amplitudes.end());
  return amplitudes;
}

TEST(BranchSearch, FindsABranchThatCoversAnEndOfTheRangeOnly) {
  const std::vector<double> known = amplitudes_on_the_whole_curve(two_pi * 22.0);
  ASSERT_EQ(known.size(), 3U);
  for (const bool reversed : {false, true}) {
    const double begin = two_pi * (reversed ? 30.0 : 22.0);
    const double end = two_pi * (reversed ? 22.0 : 30.0);
    const ResponseCurve curve = trace_response(with_stop(), range(begin, end, 20));
    ASSERT_EQ(curve.detached.size(), 1U);
    const DetachedBranch& branch = curve.detached[0];
    EXPECT_FALSE(branch.closed);
    // It comes in at 22 Hz, turns at 22.39 Hz and leaves at 22 Hz.
    EXPECT_EQ(branch.points.front().frequency, two_pi * 22.0);
    EXPECT_EQ(branch.points.back().frequency, two_pi * 22.0);
    const auto [low, high] =
        std::minmax(branch.points.front().amplitude, branch.points.back().amplitude);
    EXPECT_NEAR(low, known[1], 1e-9 * known[1]);
    EXPECT_NEAR(high, known[2], 1e-9 * known[2]);
  }
}

// From 20 Hz, beside the range, the branch of the stop leans into it: one start alone meets it in
// no frequency of the search.
TEST(BranchSearch, FollowsTheCurveOfAResonanceBesideTheRangeIntoIt) {
  const std::vector<double> known = amplitudes_on_the_whole_curve(two_pi * 22.0);
  ASSERT_EQ(known.size(), 3U);
  const ResponseCurve curve = trace_response(with_stop(), range(two_pi * 22.0, two_pi * 30.0, 1));
  ASSERT_EQ(curve.detached.size(), 1U);
  const DetachedBranch& branch = curve.detached[0];
  EXPECT_NEAR(branch.points.front().amplitude + branch.points.back().amplitude, known[1] + known[2],
              1e-8 * known[2]);
}

// Row 68. Hard: at one frequency nothing is walked that could lead to another solution.
// Met in: an open gap beside a solution 18 times larger.
// Right: the search at that frequency finds it.
TEST(BranchSearch, FindsTheOtherSolutionsAtASingleFrequency) {
  const std::vector<double> known = amplitudes_on_the_whole_curve(two_pi * 22.0);
  ASSERT_EQ(known.size(), 3U);
  const ContinuationOptions options = range(two_pi * 22.0, two_pi * 22.0, 20);
  const ResponseCurve curve = trace_response(with_stop(), options);
  ASSERT_EQ(curve.points.size(), 1U);
  EXPECT_EQ(curve.n_starts, 20);
  std::vector<double> found{curve.points[0].amplitude};
  for (const DetachedBranch& branch : curve.detached) {
    ASSERT_EQ(branch.points.size(), 1U);
    EXPECT_LT(branch.points[0].energy_imbalance, 1e-10);
    found.push_back(branch.points[0].amplitude);
  }
  std::sort(found.begin(), found.end());
  ASSERT_EQ(found.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], known[i], 1e-9 * known[i]);
}

/// Two modes; the contact opens at a resonance.
Scene that_opens() {
  Scene scene;
  scene.natural_frequency = two_pi * Eigen::Vector2d(40.0, 95.0);
  scene.damping_ratio = Eigen::Vector2d(0.003, 0.003);
  scene.excitation = Harmonics(1, 2);
  scene.excitation.rows().row(1) << 9.0, 2.0;
  scene.output = Eigen::Vector2d(0.6, 0.8);
  contact::ModalShapes shapes{Eigen::MatrixXd(1, 2), Eigen::MatrixXd(1, 2), {}};
  shapes.u << 0.3, 0.5;
  shapes.v << 0.7, 0.4;
  std::vector<std::shared_ptr<const contact::PointMethod>> point{
      std::make_shared<contact::LineEvents>(contact::PointParameters{1e4, 9e4, 0.2, 60.0})};
  scene.contact = std::make_unique<contact::PointMethodForce>(Eigen::VectorXd::Ones(1),
                                                              std::move(point), std::move(shapes));
  return scene;
}

TEST(BranchSearch, AtOneFrequencyFindsWhatASweepMeetsThere) {
  // Where twelve starts alone find none.
  const Scene scene = that_opens();
  const double frequency = two_pi * 48.7;
  ContinuationOptions sweep = range(two_pi * 38.0, two_pi * 60.0, 0);
  sweep.n_harmonics = 3;
  const ResponseCurve whole = trace_response(scene, sweep);
  ASSERT_TRUE(whole.complete) << whole.message;
  std::vector<double> known;
  for (const auto& point : points_at_frequency(scene, whole, frequency, sweep)) {
    known.push_back(point.amplitude);
  }
  ContinuationOptions there = range(frequency, frequency, 12);
  there.n_harmonics = 3;
  const ResponseCurve one = trace_response(scene, there);
  std::vector<double> found{one.points.at(0).amplitude};
  for (const DetachedBranch& branch : one.detached) {
    found.push_back(branch.points.at(0).amplitude);
  }
  std::sort(known.begin(), known.end());
  std::sort(found.begin(), found.end());
  ASSERT_EQ(known.size(), 3U);
  ASSERT_EQ(found.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], known[i], 1e-9 * known[i]);
  EXPECT_TRUE(one.message.empty()) << one.message;
}

// Where the branch of a solution ends on its way, another one behind is not seen.
TEST(BranchSearch, AtOneFrequencyTellsABranchThatWasNotFollowedToItsEnd) {
  const Scene scene = that_opens();
  ContinuationOptions there = range(two_pi * 48.7, two_pi * 48.7, 1);
  there.n_harmonics = 3;
  there.max_points = 5;
  const ResponseCurve one = trace_response(scene, there);
  EXPECT_TRUE(one.complete);
  EXPECT_NE(one.message.find("followed no further than"), std::string::npos) << one.message;
  EXPECT_NE(one.message.find("budget"), std::string::npos) << one.message;
}

// The middle part of a hardening spring leaves the range where it began: its end, too.
TEST(BranchSearch, ABranchThatLeavesByEitherEdgeIsFollowedToItsEnd) {
  const tests::Duffing duffing;
  const ResponseCurve one = trace_response(duffing.scene(), range(1.36, 1.36, 12));
  EXPECT_EQ(one.points.size() + one.detached.size(), 3U);
  EXPECT_TRUE(one.message.empty()) << one.message;
}

TEST(BranchSearch, FindsNothingWhereThereIsNothing) {
  // Hardening spring below its fold: one solution everywhere.
  tests::Duffing duffing;
  duffing.force = 0.01;
  const ResponseCurve curve = trace_response(duffing.scene(), range(0.7, 1.5, 6));
  ASSERT_TRUE(curve.complete);
  EXPECT_TRUE(curve.detached.empty());
  EXPECT_EQ(curve.n_starts, (9 + 2) * 6);  // both ends, seven inside, the peak and ω₀
}

TEST(BranchSearch, KnowsTheFoldsOfTheCurveItself) {
  // Three solutions at one frequency, all on the curve: none of them is detached.
  tests::Duffing duffing;
  const ResponseCurve curve = trace_response(duffing.scene(), range(0.7, 4.0, 6));
  ASSERT_TRUE(curve.complete);
  EXPECT_TRUE(curve.detached.empty());
}

TEST(BranchSearch, IsNotMadeUnlessAskedFor) {
  const ResponseCurve curve = trace_response(with_isola(), range(0.6, 1.4, 0));
  EXPECT_EQ(curve.n_starts, 0);
  EXPECT_TRUE(curve.detached.empty());
}

}  // namespace
}  // namespace microslip::solver::test_branch_search
