#include "solver/balance/output_amplitude.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace microslip::solver::test_output_amplitude {
namespace {

TEST(OutputAmplitude, OfOneHarmonicIsItsHypot) {
  contact::Harmonics q(1, 2);
  q.rows() << 5.0, 1.0, 3.0, 0.0, 0.0, 2.0;
  const auto output = output_amplitude(q, Eigen::Vector2d(1.0, 2.0));
  EXPECT_DOUBLE_EQ(output.half_peak_to_peak, 5.0);  // 3 sin + 4 cos
  EXPECT_DOUBLE_EQ(output.mean, 7.0);
  EXPECT_DOUBLE_EQ(output.phase, std::atan2(4.0, 3.0));
}

TEST(OutputAmplitude, OfSeveralHarmonicsIsHalfOfHighestMinusLowest) {
  contact::Harmonics q(2, 1);
  q.rows() << 1.0, 1.0, 0.0, 0.0, 0.3;  // 1 + sin θ + 0.3 cos 2θ
  const auto output = output_amplitude(q, Eigen::VectorXd::Ones(1));
  double high = -1e9;
  double low = 1e9;
  for (int i = 0; i < 100000; ++i) {
    const double value = q.at(2.0 * M_PI * i / 100000.0)[0];
    high = std::max(high, value);
    low = std::min(low, value);
  }
  EXPECT_NEAR(output.half_peak_to_peak, 0.5 * (high - low), 1e-9);  // grid: (π/1e5)² / 2
}

TEST(OutputAmplitude, GradientIsTheDifference) {
  for (const int n_harmonics : {1, 3}) {
    contact::Harmonics q(n_harmonics, 2);
    for (Eigen::Index i = 0; i < q.rows().size(); ++i) {
      q.vector()[i] = std::sin(1.3 * static_cast<double>(i) + 0.4);
    }
    const Eigen::Vector2d weights(0.7, -0.4);
    const auto output = output_amplitude(q, weights);
    for (Eigen::Index i = 0; i < q.rows().size(); ++i) {
      constexpr double h = 1e-6;
      contact::Harmonics plus = q;
      contact::Harmonics minus = q;
      plus.vector()[i] += h;
      minus.vector()[i] -= h;
      const double difference = (output_amplitude(plus, weights).half_peak_to_peak -
                                 output_amplitude(minus, weights).half_peak_to_peak) /
                                (2.0 * h);
      EXPECT_NEAR(output.gradient[i], difference, 1e-8);
    }
  }
}

TEST(OutputAmplitude, OfNoMotionIsZeroWithAFiniteGradient) {
  const auto output = output_amplitude(contact::Harmonics(1, 1), Eigen::VectorXd::Ones(1));
  EXPECT_EQ(output.half_peak_to_peak, 0.0);
  EXPECT_TRUE(output.gradient.allFinite());
}

}  // namespace
}  // namespace microslip::solver::test_output_amplitude
