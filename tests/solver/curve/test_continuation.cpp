#include "solver/continuation.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "contact/force/point_method_force.hpp"
#include "contact/plane/planar_cycle.hpp"
#include "solver/balance/linear_force.hpp"
#include "solver/curve/curve_tracer.hpp"
#include "tests/solver/duffing.hpp"
#include "tests/support/curves.hpp"
#include "tests/support/floating_point_traps.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"

namespace microslip::solver::test_continuation {
namespace {

using tests::Duffing;
using tests::frequency_range;
using tests::marked;

TEST(Continuation, EveryPointLiesOnTheClosedFormOfDuffing) {
  const Duffing duffing;
  const auto curve = trace_response(duffing.scene(), frequency_range(0.5, 2.5));
  ASSERT_TRUE(curve.complete) << curve.message;
  EXPECT_EQ(curve.points.front().frequency, 0.5);
  EXPECT_EQ(curve.points.back().frequency, 2.5);
  for (const ResponsePoint& point : curve.points) {
    EXPECT_LT(std::abs(duffing.defect(point.amplitude, point.frequency)), 1e-9);
  }
}

TEST(Continuation, SolvesForFoldsWhereTheTangentIsVertical) {
  const Duffing duffing;
  const auto curve = trace_response(duffing.scene(), frequency_range(0.5, 2.5));
  const auto folds = marked(curve, PointMark::fold);
  ASSERT_EQ(folds.size(), 2U);
  for (const ResponsePoint& fold : folds) {
    // Relative to the slope a linear response of this amplitude would have.
    EXPECT_LT(std::abs(duffing.slope(fold.amplitude, fold.frequency)), 1e-6 * 2.0 * fold.amplitude);
  }
  EXPECT_GT(folds[0].frequency, folds[1].frequency);
}

TEST(Continuation, ThePeakIsWhereTheForceMeetsTheDampingAlone) {
  const Duffing duffing;
  const auto peaks =
      marked(trace_response(duffing.scene(), frequency_range(0.5, 2.5)), PointMark::peak);
  ASSERT_EQ(peaks.size(), 1U);
  const double A = peaks[0].amplitude;
  const double omega = peaks[0].frequency;
  // ∂F²/∂ω = 0: (1 − ω² + ¾αA²) = 2ζ²
  EXPECT_NEAR(1.0 - omega * omega + 0.75 * duffing.alpha * A * A, 2.0 * duffing.zeta * duffing.zeta,
              1e-8);
}

TEST(Continuation, BetweenFoldsAndNowhereElseThePointsAreUnstable) {
  const auto curve = trace_response(Duffing{}.scene(), frequency_range(0.5, 2.5));
  int folds = 0;
  for (const ResponsePoint& point : curve.points) {
    if (point.mark == PointMark::fold) {
      ++folds;
      continue;
    }
    EXPECT_EQ(point.stability, folds == 1 ? Stability::unstable : Stability::stable)
        << point.frequency;
    EXPECT_EQ(point.determinant_sign, folds == 1 ? -1.0 : 1.0);
  }
}

TEST(Continuation, FindsPeaksAMillionTimesNarrowerThanTheRange) {
  Duffing duffing;
  duffing.alpha = 0.0;
  duffing.zeta = 1e-6;
  const auto curve = trace_response(duffing.scene(), frequency_range(0.5, 1.5));
  const auto peaks = marked(curve, PointMark::peak);
  ASSERT_EQ(peaks.size(), 1U);
  EXPECT_NEAR(peaks[0].amplitude, duffing.force / (2.0 * duffing.zeta), 1e-6 * peaks[0].amplitude);
}

TEST(Continuation, ReversedAndForwardSweepsMeetTheSameMarks) {
  const auto up = trace_response(Duffing{}.scene(), frequency_range(0.5, 2.5));
  const auto down = trace_response(Duffing{}.scene(), frequency_range(2.5, 0.5));
  const auto a = marked(up, PointMark::fold);
  auto b = marked(down, PointMark::fold);
  std::reverse(b.begin(), b.end());
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i].frequency, b[i].frequency, 1e-9);
}

TEST(Continuation, WithoutForceNothingMoves) {
  tests::SinglePoint single;
  single.force = 0.0;
  single.point = {2.0, 1.0, 0.3, 1.0};
  single.phi_v = 0.5;
  const auto curve = trace_response(tests::single_point_scene(single), frequency_range(0.5, 2.0));
  ASSERT_TRUE(curve.complete);
  for (const ResponsePoint& point : curve.points) {
    EXPECT_EQ(point.amplitude, 0.0);
    EXPECT_EQ(point.residual, 0.0);
    EXPECT_EQ(point.energy_imbalance, 0.0);
  }
}

TEST(Continuation, WithoutForceAPreloadIsInBalanceToRoundingAndNothingMoves) {
  // Loads of rough cells, summed by quadrature, leave 1e-15 of themselves at rest: no motion to be
  // walked along.
  constexpr Eigen::Index n = 7;
  std::vector<std::shared_ptr<const contact::PointMethod>> cells;
  contact::ModalShapes shapes{Eigen::MatrixXd(n, 3), Eigen::MatrixXd(n, 3), Eigen::MatrixXd(n, 3)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const double x = static_cast<double>(i) / n;
    const contact::PointParameters point{3e4, 4e4, 0.5, 17.3 + 5.1 * x};
    cells.push_back(std::make_shared<contact::PlaneEvents>(contact::SurfaceLaw(
        point, 3e4, contact::FrictionLaw::constant(0.5), contact::RoughSurface::cubic(5e-4))));
    shapes.u.row(i) << 1.0, 0.3 - x, 0.7 * x;
    shapes.v.row(i) << 0.2 * x, 1.0, x - 0.6;
    shapes.w.row(i) << 0.5, x * x, 1.1 - x;
  }
  Scene scene;
  scene.natural_frequency = Eigen::Vector3d(120.0, 140.0, 170.0);
  scene.damping_ratio = Eigen::Vector3d::Constant(0.02);
  scene.output = Eigen::Vector3d(1.0, 0.4, 0.2);
  scene.excitation = Harmonics(1, 3);
  scene.contact = std::make_unique<contact::PointMethodForce>(Eigen::VectorXd::Constant(n, 0.13),
                                                              std::move(cells), std::move(shapes));
  const ResponseCurve curve = trace_response(scene, frequency_range(100.0, 400.0));
  EXPECT_TRUE(curve.complete) << curve.diagnosis << ' ' << curve.message;
  EXPECT_GE(curve.points.size(), 10U);
  for (const ResponsePoint& point : curve.points) {
    EXPECT_EQ(point.amplitude, 0.0);
    EXPECT_EQ(point.mark, PointMark::none);
    EXPECT_DOUBLE_EQ(point.report.stick_share, 1.0);
  }
}

TEST(Continuation, ALargeForceTendsToTheFreeResponse) {
  tests::SinglePoint single;
  single.point = {2.0, 0.0, 0.3, 1.0};
  single.force = 1e9;
  const tests::SinglePoint free = single;
  const auto rubbed = solve_at_frequency(tests::single_point_scene(single), 0.7, {});
  const double linear = free.force / std::hypot(1.0 - 0.49, 2.0 * 0.01 * 0.7);
  ASSERT_TRUE(rubbed.complete);
  EXPECT_NEAR(rubbed.points.front().amplitude, linear, 1e-8 * linear);
}

TEST(Continuation, APeakAtTheEndOfTheRangeIsSaid) {
  Duffing duffing;
  duffing.alpha = 0.0;
  const auto curve = trace_response(duffing.scene(), frequency_range(0.5, 0.95));
  EXPECT_TRUE(curve.complete);
  EXPECT_NE(curve.message.find("peak at boundary"), std::string::npos);
  EXPECT_TRUE(marked(curve, PointMark::peak).empty());
}

TEST(Continuation, StopsWhenTheObserverSaysSo) {
  int n = 0;
  const auto curve = trace_response(Duffing{}.scene(), frequency_range(0.5, 2.5),
                                    [&](const ResponsePoint&) { return ++n < 5; });
  EXPECT_FALSE(curve.complete);
  EXPECT_EQ(curve.diagnosis, Diagnosis::interrupted);
  EXPECT_EQ(curve.points.size(), 5U);
}

TEST(Continuation, AFrequencyInsideAFoldHasThreeSolutions) {
  const auto scene = Duffing{}.scene();
  const auto options = frequency_range(0.5, 2.5);
  const auto curve = trace_response(scene, options);
  const auto folds = marked(curve, PointMark::fold);
  ASSERT_EQ(folds.size(), 2U);
  const double inside = 0.5 * (folds[0].frequency + folds[1].frequency);
  const auto points = points_at_frequency(scene, curve, inside, options);
  ASSERT_EQ(points.size(), 3U);
  for (const ResponsePoint& point : points) EXPECT_EQ(point.frequency, inside);
  EXPECT_EQ(points[1].stability, Stability::unstable);
  EXPECT_TRUE(points_at_frequency(scene, curve, 3.0, options).empty());
}

TEST(Continuation, OfSeveralSolutionsItBeginsWithTheOneItIsNear) {
  const auto scene = Duffing{}.scene();
  const auto options = frequency_range(0.5, 2.5);
  const auto curve = trace_response(scene, options);
  const auto folds = marked(curve, PointMark::fold);
  const double inside = 0.5 * (folds[0].frequency + folds[1].frequency);
  const auto solutions = points_at_frequency(scene, curve, inside, options);
  ASSERT_EQ(solutions.size(), 3U);
  for (const ResponsePoint& solution : solutions) {
    ContinuationOptions there = frequency_range(inside, inside);
    there.near_begin = solution.q;
    there.near_begin->rows() *= 1.02;
    const auto from_there = trace_response(scene, there);
    ASSERT_EQ(from_there.points.size(), 1U);
    EXPECT_NEAR(from_there.points.front().amplitude, solution.amplitude, 1e-9);
  }
}

TEST(Continuation, AsksForTheResidualItIsTold) {
  // The corrector polishes as long as that pays; what counts is when it calls a point solved. The
  // range has steps long enough that a loose tolerance is met one iteration earlier.
  const Duffing duffing;
  ContinuationOptions loose = frequency_range(0.5, 2.5);
  loose.residual_tolerance = 1e-4;
  ContinuationOptions strict = loose;
  strict.residual_tolerance = 1e-13;
  const auto quick = trace_response(duffing.scene(), loose);
  const auto exact = trace_response(duffing.scene(), strict);
  ASSERT_TRUE(quick.complete && exact.complete);
  const auto effort = [](const ResponseCurve& curve) {
    return static_cast<double>(curve.iterations) / static_cast<double>(curve.points.size());
  };
  EXPECT_LT(effort(quick), 0.8 * effort(exact));
  for (const ResponsePoint& point : quick.points) EXPECT_LE(point.residual, 1e-4);
  for (const ResponsePoint& point : exact.points) EXPECT_LE(point.residual, 1e-13);
}

TEST(Continuation, RefusesAResidualToleranceThatIsNone) {
  const tests::UntrappedFloatingPoint nan_is_compared;
  const Duffing duffing;
  for (const double tolerance : {0.0, -1e-11, std::nan("")}) {
    ContinuationOptions options = frequency_range(0.5, 2.5);
    options.residual_tolerance = tolerance;
    EXPECT_THROW((void)trace_response(duffing.scene(), options), std::invalid_argument);
  }
}

TEST(Continuation, RefusesFrequenciesThatAreNone) {
  const tests::UntrappedFloatingPoint nan_is_compared;
  EXPECT_THROW(static_cast<void>(trace_response(Duffing{}.scene(), frequency_range(0.0, 1.0))),
               std::invalid_argument);
  EXPECT_THROW(
      static_cast<void>(trace_response(Duffing{}.scene(), frequency_range(1.0, std::nan("")))),
      std::invalid_argument);
}

/// Frequencies where ω(A) turns beyond the peak, ascending: a scan of dω²/dA of the closed form,
/// then bisection. ω² = p + √(p² − k² + (F/A)²) with k = 1 + ¾αA², p = k − 2ζ².
std::vector<double> closed_form_folds(const Duffing& d, double highest) {
  const double drop = 2.0 * d.zeta * d.zeta;
  const auto k = [&](double A) { return 1.0 + 0.75 * d.alpha * A * A; };
  const auto root = [&](double A) {
    return std::sqrt(drop * (drop - 2.0 * k(A)) + std::pow(d.force / A, 2));
  };
  const auto slope = [&](double A) {
    const double dk = 1.5 * d.alpha * A;
    return dk - (drop * dk + d.force * d.force / (A * A * A)) / root(A);
  };
  std::vector<double> folds;
  constexpr int n = 2000;
  for (int i = 1; i < n; ++i) {
    double low = highest * i / n;
    double high = std::min(highest * (i + 1) / n, highest * (1.0 - 1e-10));
    const bool rises = slope(low) < 0.0;
    if (rises == (slope(high) < 0.0)) continue;
    for (int j = 0; j < 100; ++j) {
      const double middle = 0.5 * (low + high);
      ((slope(middle) < 0.0) == rises ? low : high) = middle;
    }
    folds.push_back(std::sqrt(k(low) - drop + root(low)));
  }
  std::sort(folds.begin(), folds.end());
  return folds;
}

TEST(Continuation, FoldsAreThoseOfTheClosedForm) {
  const Duffing duffing;
  const auto curve = trace_response(duffing.scene(), frequency_range(0.5, 2.5));
  const auto expected = closed_form_folds(duffing, marked(curve, PointMark::peak).at(0).amplitude);
  const auto folds = marked(curve, PointMark::fold);
  ASSERT_EQ(expected.size(), 2U);
  ASSERT_EQ(folds.size(), 2U);
  // The frequency is flat at a fold: an error of the amplitude counts by its square.
  EXPECT_NEAR(folds[0].frequency, expected[1], 1e-12);
  EXPECT_NEAR(folds[1].frequency, expected[0], 1e-12);
}

// Row 70. Hard: points that pile up in tiny steps.
// Met in: 13 random scenes that used up 20 000 points.
// Right: `budget`, with the frequencies between which half of them lie.
//
// Hard case 70: where points pile up is told.
TEST(Continuation, NamesACurveThatDoesNotEndAndThePlaceWhereItsPointsAre) {
  ContinuationOptions options = frequency_range(0.5, 2.5);
  options.max_points = 20;
  const auto curve = trace_response(Duffing{}.scene(), options);
  EXPECT_FALSE(curve.complete);
  EXPECT_EQ(curve.diagnosis, Diagnosis::budget);
  double low = 0.0;
  double high = 0.0;
  ASSERT_EQ(
      std::sscanf(curve.message.c_str(),
                  "the branch did not reach the end within 20 points, half of which lie from %lf "
                  "to %lf Hz",
                  &low, &high),
      2)
      << curve.message;
  const auto half = curve.points.size() / 2;
  std::vector<double> there;
  for (std::size_t i = half; i < curve.points.size(); ++i) {
    there.push_back(curve.points[i].frequency / (2.0 * std::numbers::pi));
  }
  EXPECT_NEAR(low, *std::ranges::min_element(there), 1e-7 * low);
  EXPECT_NEAR(high, *std::ranges::max_element(there), 1e-7 * high);
}

// Row 71. Hard: a branch that leaves by the end it came in by.
// Met in: 16 random scenes that ended `out-of-range`.
// Right: walked from the other end; complete means from end to end.
TEST(Continuation, ABranchThatLeavesTheRangeWhereItBeganIsWalkedFromTheOtherEnd) {
  const Duffing duffing;
  const std::vector<double> folds = [&] {
    std::vector<double> at;
    for (const auto& fold :
         marked(trace_response(duffing.scene(), frequency_range(0.5, 2.5)), PointMark::fold)) {
      at.push_back(fold.frequency);
    }
    return at;
  }();
  ASSERT_EQ(folds.size(), 2U);
  const auto [low, high] = std::minmax(folds[0], folds[1]);
  // Down along the lower branch to its fold, and back out of the range along the unstable part.
  ContinuationOptions options = frequency_range(0.5 * (low + high), 0.8 * low);
  const Harmonics below =
      solve_at_frequency(duffing.scene(), 1.5 * high, frequency_range(1.5 * high, 1.5 * high))
          .points.front()
          .q;
  options.near_begin = below;
  const PointObserver none;
  const ResponseCurve left = CurveTracer(duffing.scene(), options, none).run();
  EXPECT_FALSE(left.complete);
  EXPECT_EQ(left.diagnosis, Diagnosis::out_of_range);
  EXPECT_EQ(marked(left, PointMark::fold).size(), 1U);
  const ResponseCurve whole = trace_response(duffing.scene(), options);
  EXPECT_TRUE(whole.complete) << whole.message;
  ASSERT_FALSE(whole.log.empty());
  EXPECT_EQ(whole.log.back().remedy, Remedy::other_end);
  EXPECT_EQ(whole.points.front().frequency, options.frequency_begin);
  EXPECT_EQ(whole.points.back().frequency, options.frequency_end);
}

TEST(Continuation, OfARangeWithoutWidthIsTheSolutionThere) {
  const Duffing duffing;
  const auto curve = trace_response(duffing.scene(), frequency_range(0.8, 0.8));
  ASSERT_TRUE(curve.complete);
  ASSERT_EQ(curve.points.size(), 1U);
  EXPECT_LT(std::abs(duffing.defect(curve.points[0].amplitude, 0.8)), 1e-12);
}

TEST(TraceLinear, EndsAtAnUndampedResonanceWithItsName) {
  tests::SinglePoint single;
  single.damping_ratio = 0.0;
  single.point = {3.0, 0.0, 0.5, 1.0};  // k_u, k_v, μ, n₀: stuck at ω = 2
  const Scene scene = tests::single_point_scene(single);
  const struct {
    LinearLimit limit;
    double begin, end, resonance;
  } cases[] = {{LinearLimit::free, 0.5, 1.5, 1.0},
               {LinearLimit::stuck, 1.5, 3.0, 2.0},
               {LinearLimit::stuck, 3.0, 1.5, 2.0}};
  for (const auto& c : cases) {
    const ResponseCurve curve = trace_linear(scene, c.limit, frequency_range(c.begin, c.end));
    EXPECT_FALSE(curve.complete);
    EXPECT_EQ(curve.diagnosis, Diagnosis::unbounded);
    ASSERT_GT(curve.points.size(), 5U);
    EXPECT_LT(curve.points.size(), 500U);
    EXPECT_EQ(curve.points.front().frequency, c.begin);
    EXPECT_NEAR(curve.points.back().frequency, c.resonance, 2e-3 * c.resonance);
    for (const ResponsePoint& point : curve.points) {
      const double exact =
          1.0 / std::abs(c.resonance * c.resonance - point.frequency * point.frequency);
      EXPECT_NEAR(point.amplitude, exact, 1e-9 * exact);
    }
  }
  // Beyond the resonance, or where nothing moves it, there is nothing to name.
  EXPECT_TRUE(trace_linear(scene, LinearLimit::free, frequency_range(1.1, 3.0)).complete);
  single.force = 0.0;
  EXPECT_TRUE(
      trace_linear(tests::single_point_scene(single), LinearLimit::free, frequency_range(0.5, 1.5))
          .complete);
}

// Friction takes 4 μn₀ A a period and the excitation gives π F A: below F = 4 μn₀ / π there is a
// peak.
TEST(Continuation, NamesAnUndampedResonanceThatFrictionDoesNotHold) {
  tests::SinglePoint single;
  single.damping_ratio = 0.0;
  single.point = {3.0, 0.0, 0.5, 1.0};
  single.force = 1.1 * 4.0 * 0.5 / M_PI;
  const ResponseCurve beyond =
      trace_response(tests::single_point_scene(single), frequency_range(0.5, 1.5));
  EXPECT_FALSE(beyond.complete);
  EXPECT_EQ(beyond.diagnosis, Diagnosis::unbounded);
  single.force = 0.9 * 4.0 * 0.5 / M_PI;
  EXPECT_TRUE(
      trace_response(tests::single_point_scene(single), frequency_range(0.5, 1.5)).complete);
}

TEST(TraceLinear, HasTheLimitsOfTheContact) {
  const Scene scene = tests::chain_scene(30.0);
  const ContinuationOptions options = frequency_range(2.0 * M_PI * 15.0, 2.0 * M_PI * 80.0);
  const Eigen::MatrixXd stuck = scene.contact->stuck_stiffness();
  for (const LinearLimit limit : {LinearLimit::free, LinearLimit::stuck}) {
    const ResponseCurve curve = trace_linear(scene, limit, options);
    ASSERT_TRUE(curve.complete);
    EXPECT_EQ(marked(curve, PointMark::peak).size(), 2U);
    const double share = limit == LinearLimit::stuck ? 1.0 : 0.0;
    for (const ResponsePoint& point : curve.points) {
      Eigen::Matrix2cd matrix = (share * stuck).cast<std::complex<double>>();
      for (Eigen::Index n = 0; n < 2; ++n) {
        const double natural = scene.natural_frequency[n];
        matrix(n, n) +=
            std::complex<double>(natural * natural - point.frequency * point.frequency,
                                 2.0 * scene.damping_ratio[n] * natural * point.frequency);
      }
      const Eigen::Vector2cd force =
          scene.excitation.rows().row(1).transpose().cast<std::complex<double>>();
      const Eigen::Vector2cd motion = matrix.inverse() * force;
      const std::complex<double> y = motion[0] * scene.output[0] + motion[1] * scene.output[1];
      EXPECT_NEAR(point.amplitude, std::abs(y), 1e-12 * motion.norm());
      EXPECT_LT(point.energy_imbalance, 1e-10);
      EXPECT_EQ(point.report.stick_share, share);
    }
  }
}

/// Five modes, two of them close, a spring between them and an output that sees all.
Scene spring_scene() {
  Scene scene;
  scene.natural_frequency = (Eigen::VectorXd(5) << 1.0, 1.7, 1.72, 2.6, 9.0).finished();
  scene.damping_ratio = (Eigen::VectorXd(5) << 0.01, 0.002, 0.004, 0.001, 0.02).finished();
  scene.excitation = Harmonics(2, 5);
  scene.excitation.rows().row(1) << 1.0, 0.5, -0.7, 0.3, 2.0;
  scene.excitation.rows().row(2) << 0.2, 0.1, 0.4, -0.3, 0.0;
  scene.excitation.rows().row(3) << 0.3, 0.0, 0.1, 0.2, 0.0;
  scene.output = (Eigen::VectorXd(5) << 1.0, 0.6, 0.9, -0.4, 0.2).finished();
  const Eigen::VectorXd shape = (Eigen::VectorXd(5) << 0.3, -0.5, 0.2, 0.8, 1.0).finished();
  scene.contact = std::make_unique<LinearForce>(3.0 * shape * shape.transpose(),
                                                contact::CycleReport{1.0, 0.0, 0.0});
  return scene;
}

// Continuation walks the same spring as if it were none.
TEST(TraceLinear, SolvesOnceAFrequencyAndHasThePeaksOfAWalk) {
  const Scene scene = spring_scene();
  for (const auto& [begin, end] : {std::pair(0.4, 4.0), std::pair(4.0, 0.4)}) {
    ContinuationOptions options = frequency_range(begin, end);
    options.n_harmonics = 2;
    const ResponseCurve curve = trace_linear(scene, LinearLimit::stuck, options);
    const ResponseCurve walked = CurveTracer(scene, options, {}).run();
    ASSERT_TRUE(curve.complete && walked.complete) << curve.message << walked.message;
    EXPECT_EQ(curve.iterations, 0);
    EXPECT_GT(walked.iterations, std::ssize(walked.points));
    EXPECT_EQ(curve.points.front().frequency, begin);
    EXPECT_EQ(curve.points.back().frequency, end);
    for (const ResponsePoint& point : curve.points) {
      EXPECT_LT(point.residual, 1e-13);
      EXPECT_EQ(point.stability, Stability::stable);
      EXPECT_EQ(point.determinant_sign, 1.0);
    }
    const auto peaks = marked(curve, PointMark::peak);
    const auto expected = marked(walked, PointMark::peak);
    ASSERT_EQ(peaks.size(), expected.size());
    ASSERT_GE(peaks.size(), 6U);  // those of the second harmonic as well
    for (std::size_t i = 0; i < peaks.size(); ++i) {
      EXPECT_NEAR(peaks[i].frequency, expected[i].frequency, 1e-10 * peaks[i].frequency);
      EXPECT_NEAR(peaks[i].amplitude, expected[i].amplitude, 1e-12 * peaks[i].amplitude);
    }
  }
}

// The half width is 1e-14 of the range: neither steps nor the slope between two of them see it.
TEST(TraceLinear, FindsANeedleInAWideRange) {
  for (const double damping : {1e-2, 1e-6, 1e-8, 1e-11, 1e-12}) {
    Scene scene;
    scene.natural_frequency = Eigen::Vector2d(1.0, 1.3);
    scene.damping_ratio = Eigen::Vector2d::Constant(damping);
    scene.excitation = Harmonics(1, 2);
    scene.excitation.rows().row(1) << 1.0, 0.5;
    scene.output = Eigen::Vector2d(1.0, 1.0);
    for (const auto& [begin, end] :
         {std::pair(0.5, 2.0), std::pair(0.05, 100.0), std::pair(100.0, 0.05)}) {
      const ResponseCurve curve =
          trace_linear(scene, LinearLimit::free, frequency_range(begin, end));
      const auto peaks = marked(curve, PointMark::peak);
      ASSERT_TRUE(curve.complete);
      ASSERT_EQ(peaks.size(), 2U) << damping << " from " << begin;
      const auto& first = begin < end ? peaks[0] : peaks[1];
      const auto& second = begin < end ? peaks[1] : peaks[0];
      const double others = 2.0 * damping;  // share of the other mode, and of the height
      EXPECT_NEAR(first.amplitude * 2.0 * damping, 1.0, others + 1e-4) << damping;
      EXPECT_NEAR(second.amplitude * 2.0 * damping * 1.69, 0.5, others + 1e-4) << damping;
    }
  }
}

// Where modes cancel a plot with logarithmic axes shows a notch, not a straight line across.
TEST(TraceLinear, IsDenseWhereModesCancel) {
  Scene scene;  // 1 / (1 − ω²) + 1 / (4 − ω²) vanishes at ω² = 2.5
  scene.natural_frequency = Eigen::Vector2d(1.0, 2.0);
  scene.damping_ratio = Eigen::Vector2d::Constant(1e-5);
  scene.excitation = Harmonics(1, 2);
  scene.excitation.rows().row(1) << 1.0, 1.0;
  scene.output = Eigen::Vector2d(1.0, 1.0);
  constexpr double begin = 1.1, end = 1.9;
  const ResponseCurve curve = trace_linear(scene, LinearLimit::free, frequency_range(begin, end));
  const ResponsePoint& least =
      *std::ranges::min_element(curve.points, {}, &ResponsePoint::amplitude);
  EXPECT_NEAR(least.frequency, std::sqrt(2.5), 1e-3);
  EXPECT_LT(least.amplitude, 1e-2);  // 5.7 at the ends
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const ResponsePoint& a = curve.points[i - 1];
    const ResponsePoint& b = curve.points[i];
    if (b.frequency - a.frequency < 1.01e-3 * (end - begin)) continue;  // less is not shown
    EXPECT_LT(std::abs(std::log(b.amplitude / a.amplitude)), 0.5) << a.frequency;
  }
}

TEST(TraceLinear, HasALineThatIsNearTheCurveBetweenItsPoints) {
  const Scene scene = spring_scene();
  ContinuationOptions options = frequency_range(0.4, 4.0);
  options.n_harmonics = 2;
  const ResponseCurve curve = trace_linear(scene, LinearLimit::stuck, options);
  const double highest = std::ranges::max(curve.points, {}, &ResponsePoint::amplitude).amplitude;
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const ResponsePoint& a = curve.points[i - 1];
    const ResponsePoint& b = curve.points[i];
    const double middle = 0.5 * (a.frequency + b.frequency);
    const ResponseCurve there = trace_linear(scene, LinearLimit::stuck, [&] {
      ContinuationOptions one = options;
      one.frequency_begin = one.frequency_end = middle;
      return one;
    }());
    ASSERT_EQ(there.points.size(), 1U);
    EXPECT_EQ(there.iterations, 0);
    // h²/8 of a step of a fifth of the half width, at most.
    EXPECT_NEAR(there.points[0].amplitude, 0.5 * (a.amplitude + b.amplitude), 0.01 * highest);
  }
}

}  // namespace
}  // namespace microslip::solver::test_continuation
