#include "solver/output_amplitude.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace microslip::solver {
namespace {

contact::Harmonics motion(int n_harmonics) {
  contact::Harmonics q(n_harmonics, 2);
  for (Eigen::Index i = 0; i < q.rows().size(); ++i) {
    q.vector()[i] = std::cos(1.7 * static_cast<double>(i) + 0.3);
  }
  return q;
}

TEST(OutputAmplitude, IsThatOfTheFirstHarmonicAlone) {
  contact::Harmonics q(1, 1);
  q.vector() << 5.0, 3.0, -4.0;
  const auto result = output_amplitude(q, Eigen::VectorXd::Constant(1, -2.0));
  EXPECT_DOUBLE_EQ(result.half_peak_to_peak, 10.0);
  EXPECT_DOUBLE_EQ(result.first_harmonic, 10.0);
  EXPECT_DOUBLE_EQ(result.mean, -10.0);
  EXPECT_DOUBLE_EQ(result.phase, std::atan2(8.0, -6.0));
}

TEST(OutputAmplitude, IsHalfTheSpanOfTheSampledOutput) {
  const contact::Harmonics q = motion(4);
  const Eigen::Vector2d output(0.7, -1.1);
  double low = 1e9;
  double high = -1e9;
  const int n = 100000;  // a sample misses an extremum by (π/n)² of it at most: 1e-9
  for (int i = 0; i < n; ++i) {
    const double y = output.dot(q.at(2.0 * std::numbers::pi * i / n));
    low = std::min(low, y);
    high = std::max(high, y);
  }
  const double amplitude = output_amplitude(q, output).half_peak_to_peak;
  EXPECT_NEAR(amplitude, 0.5 * (high - low), 1e-7 * amplitude);
  EXPECT_GE(amplitude, 0.5 * (high - low));
}

TEST(OutputAmplitude, GradientIsItsDerivative) {
  const Eigen::Vector2d output(0.7, -1.1);
  for (const int n_harmonics : {1, 3}) {
    const contact::Harmonics q = motion(n_harmonics);
    const auto at = output_amplitude(q, output);
    for (Eigen::Index i = 0; i < q.rows().size(); ++i) {
      const double h = 1e-6;
      contact::Harmonics more = q;
      contact::Harmonics less = q;
      more.vector()[i] += h;
      less.vector()[i] -= h;
      const double slope = (output_amplitude(more, output).half_peak_to_peak -
                            output_amplitude(less, output).half_peak_to_peak) /
                           (2.0 * h);
      EXPECT_NEAR(at.gradient[i], slope, 1e-8);  // eps/h and h²
    }
  }
}

TEST(OutputAmplitude, VanishesAtRest) {
  const auto result = output_amplitude(contact::Harmonics(1, 2), Eigen::Vector2d(1.0, 1.0));
  EXPECT_EQ(result.half_peak_to_peak, 0.0);
  EXPECT_TRUE(result.gradient.allFinite());
}

}  // namespace
}  // namespace microslip::solver
