// What is hard: curves with vanishing damping, forces or contact, jumps either way, and parameters
// many decades apart (rows 33, 35, 38–42, 45, 47, 51 and 52 of the project's list of hard cases).
// Met in: paper A (jumps of low preloads and of gaps), paper B figure 9, random modal scenes.
// Right: every curve complete, every point with its energy balance, limits met.

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tests/support/curves.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/readable_patch.hpp"

namespace microslip::response_curve {
namespace {

using solver::PointMark;
using solver::ResponseCurve;
using solver::ResponsePoint;
using tests::frequency_range;
using tests::marked;

constexpr double certificate = 1e-10;  // energy balance and dissipation of every written point

void expect_proven(const ResponseCurve& curve, const std::string& what) {
  ASSERT_TRUE(curve.complete) << what << ": " << curve.diagnosis << ", " << curve.message;
  for (const ResponsePoint& point : curve.points) {
    ASSERT_TRUE(point.q.vector().allFinite()) << what;
    ASSERT_LE(point.energy_imbalance, certificate) << what << " at " << point.frequency;
    ASSERT_LE(point.dissipation_mismatch, certificate) << what << " at " << point.frequency;
  }
}

/// One mode of 1 rad/s, one point; the normal motion follows from phi_v.
tests::SinglePoint oscillator(const contact::PointParameters& point, double phi_v = 0.0) {
  tests::SinglePoint single;
  single.point = point;
  single.phi_v = phi_v;
  return single;
}

TEST(ResponseCurveHard, FindsTheNarrowPeakOfADampingRatioOfAMillionth) {
  // Row 33. Full stick: the peak of a linear oscillator, F / (2ζ ω₀ √(1 + k) √(1 − ζ²/(1 + k))).
  tests::SinglePoint single = oscillator({2.0, 0.0, 0.5, 1e9});
  single.damping_ratio = 1e-6;
  const ResponseCurve curve =
      solver::trace_response(tests::single_point_scene(single), frequency_range(0.5, 3.0));
  expect_proven(curve, "stuck");
  const auto peaks = marked(curve, PointMark::peak);
  ASSERT_EQ(peaks.size(), 1U);
  EXPECT_NEAR(peaks[0].frequency, std::sqrt(3.0), 1e-10);
  // The damping force itself is a difference of terms 1e6 times larger.
  EXPECT_NEAR(peaks[0].amplitude, 1.0 / (2e-6 * std::sqrt(3.0)), 1e-9 * peaks[0].amplitude);
}

TEST(ResponseCurveHard, FrictionAloneBoundsTheResonanceWithoutDamping) {
  // Row 33. The limit μn₀ is above πF/4: friction eats what the force brings, at any amplitude.
  tests::SinglePoint single = oscillator({5.0, 0.0, 0.5, 4.0});
  single.damping_ratio = 0.0;
  const ResponseCurve curve =
      solver::trace_response(tests::single_point_scene(single), frequency_range(0.5, 2.2));
  expect_proven(curve, "friction alone");
  EXPECT_EQ(marked(curve, PointMark::peak).size(), 1U);
}

TEST(ResponseCurveHard, OffResonanceNeedsNoDamping) {
  // Row 33.
  tests::SinglePoint single = oscillator({2.0, 0.0, 0.5, 1e9});
  single.damping_ratio = 0.0;
  const auto curve = solver::solve_at_frequency(tests::single_point_scene(single), 1.2, {});
  ASSERT_TRUE(curve.complete);
  EXPECT_NEAR(curve.points[0].amplitude, 1.0 / (3.0 - 1.44), 1e-13);
  EXPECT_EQ(curve.points[0].energy_imbalance, 0.0);
}

TEST(ResponseCurveHard, AModeThatNothingMovesChangesNothing) {
  // Row 35. The same scene with a third mode that has neither force nor patch motion nor output.
  const solver::Scene two = tests::chain_scene(30.0);
  solver::Scene three = tests::chain_scene(30.0);
  const auto& patch = dynamic_cast<const tests::ReadablePatch&>(*two.contact);
  three.natural_frequency =
      Eigen::Vector3d(two.natural_frequency[0], two.natural_frequency[1], 200.0);
  three.damping_ratio = Eigen::Vector3d::Constant(0.02);
  three.output = Eigen::Vector3d(two.output[0], two.output[1], 0.0);
  three.excitation = contact::Harmonics(1, 3);
  three.excitation.rows().leftCols(2) = two.excitation.rows();
  contact::ModalShapes shapes{Eigen::MatrixXd::Zero(1, 3), Eigen::MatrixXd::Zero(1, 3), {}};
  shapes.u.leftCols(2) = patch.shapes().u;
  three.contact = std::make_unique<tests::ReadablePatch>(patch.patch(), shapes);
  for (const double hertz : {18.0, 22.0, 24.0, 28.0}) {
    const double omega = 2.0 * M_PI * hertz;
    const auto without = solver::solve_at_frequency(two, omega, {});
    const auto with = solver::solve_at_frequency(three, omega, {});
    ASSERT_TRUE(without.complete && with.complete);
    EXPECT_NEAR(with.points[0].amplitude, without.points[0].amplitude,
                1e-12 * without.points[0].amplitude);
    EXPECT_EQ(with.points[0].q.rows().col(2).norm(), 0.0);
  }
}

/// A body that nothing but one point may hold: a rigid-body mode and a bending mode at 50 Hz.
solver::Scene loose_body(double preload) {
  solver::Scene scene;
  scene.natural_frequency = Eigen::Vector2d(0.0, 100.0 * M_PI);
  scene.damping_ratio = Eigen::Vector2d(0.0, 0.01);
  scene.output = Eigen::Vector2d::Ones();
  scene.excitation = contact::Harmonics(1, 2);
  scene.excitation.rows().row(1) = Eigen::RowVector2d::Ones();
  scene.contact = std::make_unique<tests::ReadablePatch>(
      contact::ContactPatch(Eigen::VectorXd::Ones(1), {{2e4, 0.0, 0.3, preload}}),
      contact::ModalShapes{Eigen::RowVector2d(1.0, -1.0), Eigen::MatrixXd::Zero(1, 2), {}});
  return scene;
}

TEST(ResponseCurveHard, ABodyThatSlipsLooseStaysWhereItIs) {
  // Row 27. The mean of the rigid-body mode is held while the point sticks, and any while it slips
  // throughout.
  for (const auto& [begin, end] : {std::pair{10.0, 70.0}, std::pair{70.0, 10.0}}) {
    for (const double preload : {1.0, 10.0}) {
      const auto curve = solver::trace_response(
          loose_body(preload), frequency_range(2.0 * M_PI * begin, 2.0 * M_PI * end));
      expect_proven(curve, "loose body");
      EXPECT_GT(marked(curve, PointMark::peak).size(), 0U);
      for (const ResponsePoint& point : curve.points) EXPECT_LT(std::abs(point.mean), 1e-12);
    }
  }
}

TEST(ResponseCurveHard, AFreeBodyThatNothingHoldsAnswersByItsInertia) {
  // Row 27. Nothing holds its mean: the linear response of both modes.
  solver::Scene scene = loose_body(1.0);
  scene.contact.reset();
  const auto curve = solver::trace_response(scene, frequency_range(20.0 * M_PI, 140.0 * M_PI));
  expect_proven(curve, "free body");
  for (const ResponsePoint& point : curve.points) {
    const double w = point.frequency;
    const double elastic = std::pow(scene.natural_frequency[1], 2);
    const std::complex<double> exact =
        -1.0 / (w * w) +
        1.0 / std::complex<double>(elastic - w * w, 2.0 * 0.01 * std::sqrt(elastic) * w);
    EXPECT_NEAR(point.amplitude, std::abs(exact), 1e-11 * std::abs(exact));
  }
}

TEST(ResponseCurveHard, SweepsExactlyThroughNaturalFrequencies) {
  // Row 38: begin, end and one point exactly at the mode.
  const solver::Scene scene = tests::single_point_scene(oscillator({2.0, 0.0, 0.5, 1.0}));
  expect_proven(solver::trace_response(scene, frequency_range(1.0, 2.0)), "from the mode");
  expect_proven(solver::trace_response(scene, frequency_range(0.5, 1.0)), "to the mode");
  expect_proven(solver::solve_at_frequency(scene, 1.0, {}), "at the mode");
}

TEST(ResponseCurveHard, ASweepOfOneRoundingErrorHasItsTwoEnds) {
  // Row 38: steps that are shares of such a range round to none.
  tests::SinglePoint single;
  single.point = {2.0, 0.0, 0.5, 1.0};
  for (const double begin : {0.8, 1.0, 1.7}) {
    const double end = std::nextafter(begin, 2.0);
    for (const bool up : {true, false}) {
      const auto curve =
          solver::trace_response(tests::single_point_scene(single),
                                 up ? frequency_range(begin, end) : frequency_range(end, begin));
      ASSERT_TRUE(curve.complete) << curve.message;
      EXPECT_LE(curve.points.size(), 4U);
      EXPECT_EQ(curve.points.front().frequency, up ? begin : end);
      EXPECT_EQ(curve.points.back().frequency, up ? end : begin);
    }
  }
}

TEST(ResponseCurveHard, AlmostStuckAndAlmostFreeTendToTheLimits) {
  // Row 39. At 1.5 rad/s the stuck amplitude is 1/|3 − 2.25| = 1.33: slip begins at μn₀ = 2.67.
  const double omega = 1.5;
  const auto amplitude = [&](double preload) {
    const auto curve = solver::solve_at_frequency(
        tests::single_point_scene(oscillator({2.0, 0.0, 0.5, preload})), omega, {});
    EXPECT_TRUE(curve.complete) << preload;
    return curve.points.at(0).amplitude;
  };
  const double stuck = 1.0 / std::hypot(3.0 - omega * omega, 0.02 * omega);
  const double free = 1.0 / std::hypot(1.0 - omega * omega, 0.02 * omega);
  const double limit = 2.0 * stuck / 0.5;  // preload at which slip begins
  EXPECT_NEAR(amplitude(1.000001 * limit), stuck, 1e-13);
  for (const double below : {1e-2, 1e-4, 1e-6}) {
    // The force turns linearly in the excess (f_c) and leaves the amplitude by its square or 3/2
    // power.
    const double change = std::abs(amplitude((1.0 - below) * limit) - stuck);
    EXPECT_GT(change, 0.0);
    EXPECT_LT(change, 20.0 * below);
  }
  for (const double preload : {1e-2, 1e-4, 1e-6}) {
    EXPECT_NEAR(amplitude(preload), free, 2.0 * preload);
  }
}

TEST(ResponseCurveHard, LowPreloadSoftensAndJumps) {
  // Row 40: the load opens while the point moves; both folds are solved for, unstable between them.
  const auto curve = solver::trace_response(tests::three_dof_scene(30.0),
                                            frequency_range(2.0 * M_PI * 18.0, 2.0 * M_PI * 28.0));
  expect_proven(curve, "30 N");
  const auto folds = marked(curve, PointMark::fold);
  ASSERT_EQ(folds.size(), 2U);
  const bool between = std::any_of(curve.points.begin(), curve.points.end(), [](const auto& point) {
    return point.stability == solver::Stability::unstable;
  });
  EXPECT_TRUE(between);
}

TEST(ResponseCurveHard, AGapHardensAndJumps) {
  // Row 40: impact on a spring behind a gap of 2; the free peak is at 1, the bonded one at √3.
  tests::SinglePoint single = oscillator({0.0, 2.0, 0.0, -4.0}, 1.0);
  single.force = 0.2;
  const auto curve =
      solver::trace_response(tests::single_point_scene(single), frequency_range(0.7, 1.6));
  expect_proven(curve, "gap");
  const auto folds = marked(curve, PointMark::fold);
  const auto peaks = marked(curve, PointMark::peak);
  ASSERT_EQ(folds.size(), 2U);
  ASSERT_EQ(peaks.size(), 1U);
  EXPECT_GT(peaks[0].frequency, 1.02);
  EXPECT_GT(std::max(folds[0].frequency, folds[1].frequency), peaks[0].frequency * (1.0 - 1e-9));
}

TEST(ResponseCurveHard, BothOfTwoEqualPeaksAreReported) {
  // Row 45: two uncoupled modes with F/(2ζω²) alike; no point of contact moves.
  solver::Scene scene = tests::chain_scene(1e9);
  scene.natural_frequency = Eigen::Vector2d(1.0, 2.0);
  scene.output = Eigen::Vector2d(1.0, 1.0);
  scene.excitation.rows().row(1) << 1.0, 4.0;
  scene.contact = nullptr;
  const auto peaks =
      marked(solver::trace_response(scene, frequency_range(0.5, 3.0)), PointMark::peak);
  ASSERT_EQ(peaks.size(), 2U);
  EXPECT_NEAR(peaks[0].frequency, 1.0, 0.02);
  EXPECT_NEAR(peaks[1].frequency, 2.0, 0.02);
}

TEST(ResponseCurveHard, NoForceIsNoMotion) {
  // Row 51, with and without damping.
  for (const double damping : {0.01, 0.0}) {
    tests::SinglePoint single = oscillator({2.0, 2.0, 0.5, 1.0}, 0.5);
    single.force = 0.0;
    single.damping_ratio = damping;
    const auto curve =
        solver::trace_response(tests::single_point_scene(single), frequency_range(0.5, 2.0));
    expect_proven(curve, "no force");
    for (const ResponsePoint& point : curve.points) {
      EXPECT_EQ(point.amplitude, 0.0);
      EXPECT_EQ(point.energy_imbalance, 0.0);
    }
  }
}

TEST(ResponseCurveHard, AForceTimesABillionTendsToTheFreeResponse) {
  // Row 52. Friction is 1e-9 of the force then.
  tests::SinglePoint single = oscillator({2.0, 0.0, 0.5, 1.0});
  single.force = 1e9;
  const auto curve =
      solver::trace_response(tests::single_point_scene(single), frequency_range(0.5, 2.0));
  expect_proven(curve, "1e9 N");
  const auto peaks = marked(curve, PointMark::peak);
  ASSERT_EQ(peaks.size(), 1U);
  const double free = 1e9 / (0.02 * std::sqrt(1.0 - 1e-4));
  EXPECT_NEAR(peaks[0].amplitude, free, 1e-8 * free);
}

TEST(ResponseCurveHard, AStuckPeakMayBeTheHigherOne) {
  // Row 47: y of the chain with the force on it; nothing assumes an order of the limits.
  solver::Scene scene = tests::chain_scene(30.0);
  scene.excitation.rows().row(1) << 0.2, 8.0;
  const auto options = frequency_range(2.0 * M_PI * 15.0, 2.0 * M_PI * 80.0);
  const auto highest = [&](const ResponseCurve& curve) {
    double value = 0.0;
    for (const ResponsePoint& point : marked(curve, PointMark::peak)) {
      value = std::max(value, point.amplitude);
    }
    return value;
  };
  const double free = highest(solver::trace_linear(scene, solver::LinearLimit::free, options));
  const double stuck = highest(solver::trace_linear(scene, solver::LinearLimit::stuck, options));
  EXPECT_GT(stuck, free);
  expect_proven(solver::trace_response(scene, options), "stuck above free");
}

TEST(ResponseCurveHard, NearlyRigidContactTakesNoMoreStepsThanStiffContact) {
  // Row 13. Three modes meet in one point that a contact of 1e4 … 1e7 times their stiffness holds:
  // its motion is the small difference of theirs, known to their rounding only.
  const auto trace = [](double ratio) {
    solver::Scene scene;
    scene.natural_frequency = Eigen::Vector3d(1.0, 1.4, 1.7);
    scene.damping_ratio = Eigen::Vector3d(0.02, 0.004, 0.001);
    scene.excitation = contact::Harmonics(1, 3);
    scene.excitation.rows().row(1) << -1.2, 0.9, 0.5;
    scene.excitation.rows().row(2) << 0.3, -0.4, 0.6;
    scene.output = Eigen::Vector3d(1.0, -0.5, 0.3);
    const contact::ContactPatch patch(Eigen::VectorXd::Ones(1), {{ratio, 0.6 * ratio, 0.5, 6.0}});
    const contact::ModalShapes shapes{
        Eigen::RowVector3d(0.31, 0.40, -0.05), Eigen::RowVector3d(-0.59, -1.16, 0.48), {}};
    scene.contact = std::make_unique<tests::ReadablePatch>(patch, shapes);
    return solver::trace_response(scene, frequency_range(0.4, 3.0));
  };
  const ResponseCurve stiff = trace(1e4);
  ASSERT_TRUE(stiff.complete) << stiff.diagnosis;
  const double peak = marked(stiff, PointMark::peak).at(0).frequency;
  for (const double ratio : {1e5, 1e6, 1e7}) {
    const ResponseCurve curve = trace(ratio);
    ASSERT_TRUE(curve.complete) << ratio << ": " << curve.diagnosis;
    // Rows double where rounding shortens the steps; peaks and folds, the same in all, take few of
    // the rest.
    EXPECT_LT(4 * curve.iterations, 9 * stiff.iterations) << ratio;
    // An iteration takes as many evaluations: rounding is not polished.
    EXPECT_LT(5 * curve.contact_evaluations * stiff.iterations,
              6 * stiff.contact_evaluations * curve.iterations)
        << ratio;
    // What the contact gives way is of order 1e-4.
    EXPECT_NEAR(marked(curve, PointMark::peak).at(0).frequency, peak, 1e-3) << ratio;
  }
}

}  // namespace
}  // namespace microslip::response_curve
