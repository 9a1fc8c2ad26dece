#include "solver/continuation.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "tests/support/modal_scenes.hpp"

namespace microslip::solver {
namespace {

ContinuationOptions range(double begin, double end) {
  ContinuationOptions options;
  options.frequency_begin = begin;
  options.frequency_end = end;
  return options;
}

/// Hardens enough for two folds.
constexpr tests::Duffing hardening{1.0, 0.02, 0.1, 0.05};

std::vector<ResponsePoint> marked(const ResponseCurve& curve, PointMark mark) {
  std::vector<ResponsePoint> list;
  std::copy_if(curve.points.begin(), curve.points.end(), std::back_inserter(list),
               [&](const ResponsePoint& point) { return point.mark == mark; });
  return list;
}

double bisect(const std::function<double(double)>& f, double low, double high) {
  const bool rises = f(low) < 0.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    ((f(middle) < 0.0) == rises ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Where both frequencies of one amplitude meet: the peak, (amplitude, ω).
std::pair<double, double> duffing_peak(const tests::Duffing& d) {
  const auto k = [&](double a) { return d.frequency * d.frequency + 0.75 * d.gamma * a * a; };
  const double drop = 2.0 * std::pow(d.damping_ratio * d.frequency, 2);
  // p² − k² + (F/a)² = 0, p = k − drop
  const double a = bisect(
      [&](double x) { return std::pow(d.force / x, 2) - drop * (2.0 * k(x) - drop); }, 0.1, 100.0);
  return {a, std::sqrt(k(a) - drop)};
}

/// Frequencies where ω(a) turns on the far side of the peak, by a scan and bisection of dω²/da.
std::vector<double> duffing_folds(const tests::Duffing& d) {
  const auto slope = [&](double a) {
    const double drop = 2.0 * std::pow(d.damping_ratio * d.frequency, 2);
    const double k = d.frequency * d.frequency + 0.75 * d.gamma * a * a;
    const double dk = 1.5 * d.gamma * a;
    const double p = k - drop;
    const double root = std::sqrt(p * p - k * k + std::pow(d.force / a, 2));
    return dk + (p * dk - k * dk - d.force * d.force / (a * a * a)) / root;
  };
  std::vector<double> folds;
  const double top = duffing_peak(d).first;
  const int n = 2000;
  for (int i = 1; i < n; ++i) {
    const double low = top * i / n;
    const double high = std::min(top * (i + 1) / n, top * (1.0 - 1e-12));
    if ((slope(low) > 0.0) == (slope(high) > 0.0)) continue;
    folds.push_back(d.frequencies(bisect(slope, low, high)).first);
  }
  std::sort(folds.begin(), folds.end());
  return folds;
}

TEST(TraceResponse, FollowsDuffingsClosedForm) {
  const ResponseCurve curve = trace_response(hardening.scene(), range(0.5, 2.0));
  ASSERT_TRUE(curve.complete) << curve.message;
  for (const ResponsePoint& point : curve.points) {
    const tests::Duffing& d = hardening;
    const double square = point.frequency * point.frequency;
    const double stiffness =
        d.frequency * d.frequency + 0.75 * d.gamma * point.amplitude * point.amplitude;
    const double force =
        point.amplitude *
        std::hypot(stiffness - square, 2.0 * d.damping_ratio * d.frequency * point.frequency);
    // Rounding of the terms that cancel, at most (k + ω²) a.
    EXPECT_NEAR(force, d.force, 1e-15 * (stiffness + square) * point.amplitude + 1e-15);
    EXPECT_LT(point.residual, 1e-13);
    EXPECT_LT(point.energy_imbalance, 1e-12);
  }
}

TEST(TraceResponse, EndsExactlyAtBothEnds) {
  for (const auto& [begin, end] : {std::pair{0.5, 2.0}, std::pair{2.0, 0.5}}) {
    const ResponseCurve curve = trace_response(hardening.scene(), range(begin, end));
    ASSERT_TRUE(curve.complete);
    EXPECT_EQ(curve.points.front().frequency, begin);
    EXPECT_EQ(curve.points.back().frequency, end);
  }
}

TEST(TraceResponse, SolvesForThePeak) {
  for (const auto& [begin, end] : {std::pair{0.5, 2.0}, std::pair{2.0, 0.5}}) {
    const auto peaks =
        marked(trace_response(hardening.scene(), range(begin, end)), PointMark::peak);
    const auto [amplitude, omega] = duffing_peak(hardening);
    ASSERT_EQ(peaks.size(), 1U);
    EXPECT_NEAR(peaks[0].amplitude, amplitude, 1e-12 * amplitude);
    EXPECT_NEAR(peaks[0].frequency, omega, 1e-11 * omega);  // solved for, not read off
  }
}

TEST(TraceResponse, SolvesForBothFolds) {
  const auto expected = duffing_folds(hardening);
  ASSERT_EQ(expected.size(), 2U);
  auto folds = marked(trace_response(hardening.scene(), range(0.5, 2.0)), PointMark::fold);
  ASSERT_EQ(folds.size(), 2U);
  std::sort(folds.begin(), folds.end(),
            [](const auto& a, const auto& b) { return a.frequency < b.frequency; });
  EXPECT_NEAR(folds[0].frequency, expected[0], 1e-12);
  EXPECT_NEAR(folds[1].frequency, expected[1], 1e-12);
}

TEST(TraceResponse, IsUnstableBetweenTheFoldsOnly) {
  const ResponseCurve curve = trace_response(hardening.scene(), range(0.5, 2.0));
  int n_folds = 0;
  int n_unstable = 0;
  for (const ResponsePoint& point : curve.points) {
    if (point.mark == PointMark::fold) {
      ++n_folds;
      continue;  // neutral
    }
    EXPECT_EQ(point.stability, n_folds == 1 ? Stability::unstable : Stability::stable)
        << point.frequency;
    EXPECT_EQ(point.determinant_sign, n_folds == 1 ? -1.0 : 1.0);
    n_unstable += n_folds == 1 ? 1 : 0;
  }
  EXPECT_GT(n_unstable, 5);
}

TEST(TraceResponse, LooksSmoothAndIsNotCrowded) {
  const ResponseCurve curve = trace_response(hardening.scene(), range(0.5, 2.0));
  EXPECT_GT(curve.points.size(), 40U);
  EXPECT_LT(curve.points.size(), 250U);
  double largest = 0.0;
  for (const ResponsePoint& point : curve.points) largest = std::max(largest, point.amplitude);
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    // Steps are a fifth of the amplitude and of the resonance's width at most.
    EXPECT_LT(std::abs(curve.points[i].amplitude - curve.points[i - 1].amplitude), 0.25 * largest);
  }
}

TEST(TraceResponse, StopsWhenAskedToAndKeepsWhatItHas) {
  int seen = 0;
  const ResponseCurve curve = trace_response(hardening.scene(), range(0.5, 2.0),
                                             [&](const ResponsePoint&) { return ++seen < 12; });
  EXPECT_FALSE(curve.complete);
  EXPECT_EQ(curve.diagnosis, "interrupted");
  EXPECT_EQ(curve.points.size(), 12U);
}

TEST(TraceResponse, NamesACurveThatDoesNotEnd) {
  ContinuationOptions options = range(0.5, 2.0);
  options.max_points = 20;
  const ResponseCurve curve = trace_response(hardening.scene(), options);
  EXPECT_FALSE(curve.complete);
  EXPECT_EQ(curve.diagnosis, "loop");
  EXPECT_FALSE(curve.message.empty());
}

TEST(TraceResponse, FlagsALargestAmplitudeAtTheEndOfTheRange) {
  const ResponseCurve inside = trace_response(hardening.scene(), range(0.5, 2.0));
  EXPECT_TRUE(inside.message.empty());
  const ResponseCurve cut = trace_response(hardening.scene(), range(0.5, 1.05));
  EXPECT_TRUE(cut.complete);
  EXPECT_NE(cut.message.find("boundary"), std::string::npos);
  EXPECT_TRUE(marked(cut, PointMark::peak).empty());
}

TEST(TraceResponse, RefusesFrequenciesThatAreNone) {
  EXPECT_THROW(static_cast<void>(trace_response(hardening.scene(), range(0.0, 1.0))),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(trace_response(hardening.scene(), range(1.0, std::nan("")))),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(solve_at_frequency(hardening.scene(), -1.0, {})),
               std::invalid_argument);
}

TEST(TraceResponse, OfARangeWithoutWidthIsTheSolutionThere) {
  const ResponseCurve curve = trace_response(hardening.scene(), range(0.8, 0.8));
  ASSERT_TRUE(curve.complete);
  ASSERT_EQ(curve.points.size(), 1U);
  EXPECT_NEAR(hardening.frequencies(curve.points[0].amplitude).second, 0.8, 1e-12);
}

TEST(PointsAtFrequency, AreThreeBetweenTheFolds) {
  const auto folds = duffing_folds(hardening);
  const double omega = 0.5 * (folds[0] + folds[1]);
  const Scene scene = hardening.scene();
  const ContinuationOptions options = range(0.5, 2.0);
  const auto points = points_at_frequency(scene, trace_response(scene, options), omega, options);
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[0].stability, Stability::stable);
  EXPECT_EQ(points[1].stability, Stability::unstable);
  EXPECT_EQ(points[2].stability, Stability::stable);
  for (const ResponsePoint& point : points) {
    EXPECT_EQ(point.frequency, omega);
    const auto [above, below] = hardening.frequencies(point.amplitude);
    EXPECT_LT(std::fmin(std::abs(above - omega), std::abs(below - omega)), 1e-12);
  }
}

TEST(TraceLinear, HasTheLimitsOfTheContact) {
  const Scene scene = tests::chain_scene(30.0);
  const ContinuationOptions options = range(2.0 * M_PI * 15.0, 2.0 * M_PI * 80.0);
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

}  // namespace
}  // namespace microslip::solver
