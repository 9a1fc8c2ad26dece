/// Layers of a coefficient that depends on the rate: where they are, and the speed in them.
#include "contact/line/band_layers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace microslip::contact::test_band_layers {
namespace {

constexpr double pi = std::numbers::pi;

/// 0, sin, cos, sin 2, …
Eigen::VectorXd random_wave(std::mt19937_64& random, int n_harmonics) {
  std::normal_distribution<double> g;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(2 * n_harmonics + 1);
  for (Eigen::Index i = 1; i < u.size(); ++i) u[i] = g(random);
  return u;
}

long double velocity(const Eigen::VectorXd& u, long double phase) {
  long double sum = 0.0L;
  for (Eigen::Index h = 1; 2 * h < u.size(); ++h) {
    const auto order = static_cast<long double>(h);
    sum += order * (u[2 * h - 1] * std::cos(order * phase) - u[2 * h] * std::sin(order * phase));
  }
  return sum;
}

// sin θ turns at π/2 and 3π/2; |u'| = |x| next to them, on both sides.
TEST(BandLayers, StopsPassTheGradesNextToATurn) {
  BandLayers layers;
  const Eigen::Vector3d u(0.0, 1.0, 0.0);
  for (const double thinness : {1e2, 1e6, 1e14, 1e100}) {
    layers.set(u, FrictionLaw::exponential(0.5, 0.3, thinness), 1.0);
    ASSERT_EQ(layers.stands().size(), 2U);
    ASSERT_EQ(layers.stops().size(), 16U);  // four grades, two sides, two turns
    std::vector<double> offsets;
    for (const BandPlace& stop : layers.stops()) {
      EXPECT_NEAR(std::abs(std::cos(stop.anchor.phase)), 0.0, 1e-15);
      offsets.push_back(std::abs(stop.offset) * thinness);
    }
    std::sort(offsets.begin(), offsets.end());
    const double grades[] = {1.0, 4.0, 16.0, 40.0};
    for (std::size_t i = 0; i < 16; ++i) {
      // Stops meet their grade to a twentieth; sin 0.4 for 0.4.
      EXPECT_NEAR(offsets[i] / grades[i / 4], 1.0, 0.08) << thinness;
    }
  }
}

TEST(BandLayers, SlowChangesHaveNoStops) {
  BandLayers layers;
  const Eigen::Vector3d u(0.0, 1.0, 0.0);
  layers.set(u, FrictionLaw::exponential(0.5, 0.3, 0.9), 1.0);
  EXPECT_EQ(layers.stands().size(), 2U);
  EXPECT_TRUE(layers.stops().empty());
  EXPECT_FALSE(layers.place(1.0).anchor.layered);
  EXPECT_EQ(layers.place(1.0).phase(), 1.0);
  layers.set(u, FrictionLaw::constant(0.5), 1.0);
  EXPECT_TRUE(layers.stands().empty());
}

// u' = cos 2θ − (1 − 1e-7) cos 3θ nearly stands at 0: a layer without a turn.
TEST(BandLayers, StopsPassTheGradesWhereTheMotionNearlyStands) {
  BandLayers layers;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(7);
  u[3] = 0.5;
  u[5] = -(1.0 - 1e-7) / 3.0;
  constexpr double decay = 1e6;  // grades from 1e-6
  layers.set(u, FrictionLaw::exponential(0.5, 0.3, decay), 1.0);
  int n_at_0 = 0;
  for (const BandPlace& stop : layers.stops()) {
    const double from_0 = std::remainder(stop.anchor.phase, 2.0 * pi);
    if (std::abs(from_0) > 1e-6) continue;
    ++n_at_0;
    const double grade = decay * std::abs(static_cast<double>(velocity(u, stop.phase())));
    EXPECT_TRUE(std::abs(grade - 1.0) < 0.06 || std::abs(grade - 4.0) < 0.21 ||
                std::abs(grade - 16.0) < 0.81 || std::abs(grade - 40.0) < 2.1)
        << grade;
  }
  EXPECT_EQ(n_at_0, 8);
}

// Relative to itself, next to a place where it vanishes.
TEST(BandLayers, TheSpeedKeepsItsDigitsNextToATurn) {
  std::mt19937_64 random(5);
  BandLayers layers;
  for (int i = 0; i < 50; ++i) {
    const Eigen::VectorXd u = random_wave(random, 1 + i % 5);
    layers.set(u, FrictionLaw::hyperbolic(0.5, 1e9), 1.0);
    for (const double stand : layers.stands()) {
      const BandAnchor anchor = layers.place(stand).anchor;
      ASSERT_TRUE(anchor.layered);
      ASSERT_EQ(anchor.velocity, 0.0);
      const long double at_stand = velocity(u, stand);
      for (const double x : {1e-3, -1e-5, 1e-9, -1e-12}) {
        const BandPlace place{anchor, x};
        ASSERT_TRUE(layers.is_near(place));
        const long double exact = velocity(u, static_cast<long double>(stand) + x) - at_stand;
        // The reference loses 1e-19 of |u'| over |u''| x, which is 1e-7 at 1e-12.
        const double own = 1e-18 * u.cwiseAbs().sum() * 25.0;
        ASSERT_NEAR(layers.velocity(place), static_cast<double>(exact),
                    2e-14 * std::abs(static_cast<double>(exact)) + own);
      }
    }
  }
}

TEST(BandLayers, ThePlaceOfAPhaseIsThePhase) {
  std::mt19937_64 random(6);
  BandLayers layers;
  layers.set(random_wave(random, 3), FrictionLaw::hyperbolic(0.5, 1e3), 1.0);
  for (double phase = -1.0; phase < 9.0; phase += 0.1) {
    const BandPlace place = layers.place(phase);
    EXPECT_TRUE(place.anchor.layered);
    EXPECT_NEAR(place.phase(), phase, 2e-15 * 9.0);
    EXPECT_LE(std::abs(place.offset), pi);
  }
}

}  // namespace
}  // namespace microslip::contact::test_band_layers
