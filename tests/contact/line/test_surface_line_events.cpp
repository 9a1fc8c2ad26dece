/// The event-located method of any surface against the exact method of smooth ones, the planar
/// method along a line, and differences.
#include "contact/line/surface_line_events.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "contact/line/line_events.hpp"
#include "contact/plane/planar_cycle.hpp"
#include "support/motion_cases.hpp"
#include "support/surface_cases.hpp"

namespace microslip::contact::test_surface_line_events {
namespace {

using test::friction_scale;
using test::MotionCase;
using test::MotionStratum;
using test::normal_scale;
using test::SurfaceCase;
using Random = std::mt19937_64;

constexpr double pi = std::numbers::pi;
constexpr double frequency = test::surface_frequency;
constexpr double smallest = 1e-300;

PointTraction traction(const PointMethod& method, const Harmonics& motion,
                       double omega = frequency) {
  PointTraction result;
  method.traction(motion, omega, result);
  return result;
}

double difference(const Harmonics& a, const Harmonics& b, Eigen::Index column) {
  return (a.rows().col(column) - b.rows().col(column)).cwiseAbs().maxCoeff();
}

/// Relative to the force scales.
double error(const Harmonics& a, const Harmonics& b, const MotionCase& c) {
  return std::max(difference(a, b, 0) / (friction_scale(c) + smallest),
                  difference(a, b, 1) / (normal_scale(c) + smallest));
}

std::vector<MotionCase> motions(int n, unsigned seed) {
  Random random(seed);
  std::vector<MotionCase> cases;
  for (int i = 0; i < n; ++i) {
    const auto& stratum = test::motion_strata()[i % 2 == 0 ? 1 : 5];  // comparable, loaded
    cases.push_back(stratum.draw(random));
  }
  return cases;
}

class SmoothLimit : public testing::TestWithParam<MotionStratum> {};

// Smooth surfaces with a constant coefficient have an exact method. Sums over a hundred
// nodes of a few panels.
TEST_P(SmoothLimit, IsTheLineEvents) {
  Random random(31);
  for (int i = 0; i < 300; ++i) {
    const MotionCase c = GetParam().draw(random);
    const PointTraction exact = traction(LineEvents(c.point), c.motion);
    const PointTraction now = traction(SurfaceLineEvents(test::smooth_surface(c)), c.motion);
    constexpr double rounding = 5e-15;
    ASSERT_LE(difference(now.force, exact.force, 0), rounding * friction_scale(c) + smallest) << i;
    ASSERT_LE(difference(now.force, exact.force, 1), rounding * normal_scale(c) + smallest) << i;
    ASSERT_TRUE(now.jacobian.allFinite());
  }
}

INSTANTIATE_TEST_SUITE_P(Strata, SmoothLimit, testing::ValuesIn(test::motion_strata()),
                         [](const auto& instance) { return std::string(instance.param.name); });

double stiffness_scale(const MotionCase& c) {
  return c.point.tangential_stiffness +
         (1.0 + c.point.friction_coefficient) * c.point.normal_stiffness;
}

class AllSurfaceLineEvents : public testing::TestWithParam<SurfaceCase> {};

// The planar method along a line is integrated to its tolerance; an independent way to the same
// cycle.
TEST_P(AllSurfaceLineEvents, AgreeWithThePlaneEventsAlongALine) {
  for (const MotionCase& drawn : motions(60, 32)) {
    MotionCase c = drawn;
    c.motion.rows().col(2).setZero();
    const SurfaceLaw surface = GetParam().make(c);
    const PointTraction planar = traction(PlaneEvents(surface, 1e-13), c.motion);
    const PointTraction now = traction(SurfaceLineEvents(surface), c.motion);
    // Ten times what the quadrature of the planar method was measured to leave, and its derivative.
    ASSERT_LE(error(now.force, planar.force, c), 2e-11);
    for (Eigen::Index row = 0; row < now.jacobian.rows(); ++row) {
      for (Eigen::Index k = 0; k < now.jacobian.cols(); ++k) {
        if (row % 3 == 2 || k % 3 == 2) continue;
        ASSERT_NEAR(now.jacobian(row, k), planar.jacobian(row, k), 1e-9 * stiffness_scale(c));
      }
    }
    ASSERT_EQ(now.regime, planar.regime);
  }
}

TEST_P(AllSurfaceLineEvents, AreFiniteInEveryStratum) {
  for (const MotionStratum& stratum : test::motion_strata()) {
    Random random(34);
    for (int i = 0; i < 60; ++i) {
      MotionCase c = stratum.draw(random);
      if (c.point.normal_stiffness == 0.0) c.point.normal_stiffness = 1.0;  // heights need one
      if (!(normal_scale(c) / c.point.normal_stiffness > 0.0)) continue;
      const SurfaceLineEvents method(GetParam().make(c));
      const PointTraction now = traction(method, c.motion);
      ASSERT_TRUE(now.force.rows().allFinite()) << stratum.name << ' ' << i;
      ASSERT_TRUE(now.jacobian.allFinite()) << stratum.name << ' ' << i;
      ASSERT_TRUE(now.frequency_derivative.allFinite()) << stratum.name << ' ' << i;
    }
  }
}

/// Fourth order.
Eigen::VectorXd central(const SurfaceLineEvents& method, const Harmonics& motion, Eigen::Index k,
                        double h) {
  const auto at = [&](double x) -> Eigen::VectorXd {
    Harmonics moved = motion;
    moved.vector()[k] += x;
    return traction(method, moved).force.vector();
  };
  return (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
}

// Forces round at 1e-13, so differences at 1e-13/1e-4; where differences at h and h/2 differ by
// more than 1e-8 the motion is near a kink.
TEST_P(AllSurfaceLineEvents, HaveTheJacobianOfDifferences) {
  int n_checked = 0;
  int n_drawn = 0;
  for (const MotionCase& c : motions(40, 35)) {
    const SurfaceLineEvents method(GetParam().make(c));
    const PointTraction now = traction(method, c.motion);
    const double scale = stiffness_scale(c);
    for (Eigen::Index k = 0; k < now.jacobian.cols(); ++k) {
      if (k % 3 == 2) {
        ASSERT_TRUE(now.jacobian.col(k).isZero(0.0));
        continue;
      }
      ++n_drawn;
      const double h = 1e-4 * (k % 3 == 0 ? friction_scale(c) / c.point.tangential_stiffness
                                          : normal_scale(c) / c.point.normal_stiffness);
      const Eigen::VectorXd fine = central(method, c.motion, k, 0.5 * h);
      const Eigen::VectorXd coarse = central(method, c.motion, k, h);
      if ((coarse - fine).cwiseAbs().maxCoeff() > 1e-8 * scale) continue;
      ++n_checked;
      ASSERT_LE((now.jacobian.col(k) - fine).cwiseAbs().maxCoeff(), 2e-8 * scale) << k;
    }
  }
  EXPECT_GT(n_checked, n_drawn / 2);
}

TEST_P(AllSurfaceLineEvents, HaveTheFrequencyDerivativeOfDifferences) {
  int n_checked = 0;
  for (const MotionCase& c : motions(40, 36)) {
    const SurfaceLineEvents method(GetParam().make(c));
    const PointTraction now = traction(method, c.motion);
    const auto central_of = [&](double h) -> Eigen::VectorXd {
      return (traction(method, c.motion, frequency + h).force.vector() -
              traction(method, c.motion, frequency - h).force.vector()) /
             (2.0 * h);
    };
    const double scale = (friction_scale(c) + normal_scale(c)) / frequency;
    const Eigen::VectorXd fine = central_of(5e-5 * frequency);
    if ((central_of(1e-4 * frequency) - fine).cwiseAbs().maxCoeff() > 1e-7 * scale) continue;
    ASSERT_LE((now.frequency_derivative - fine).cwiseAbs().maxCoeff(), 1e-7 * scale);
    ++n_checked;
  }
  EXPECT_GT(n_checked, 25);
}

// Theory sections 7, 11: the normal method is elastic; the work of friction is that of slip where
// the tangential stiffness does not depend on the load.
TEST_P(AllSurfaceLineEvents, BalanceTheirWork) {
  for (const MotionCase& c : motions(100, 37)) {
    const SurfaceLaw surface = GetParam().make(c);
    const int H = c.motion.n_harmonics();
    const PointHistory history = SurfaceLineEvents(surface).history(c.motion, frequency, {}, H);
    const double u = friction_scale(c) / c.point.tangential_stiffness;
    const double v = c.motion.rows().col(1).tail(2 * H).cwiseAbs().sum();
    // 1e-13 for the forces, times the highest harmonic.
    ASSERT_LE(std::abs(test::cycle_work(c.motion, history.force, 1)),
              1e-12 * H * normal_scale(c) * v);
    if (!surface.is_smooth()) continue;
    ASSERT_NEAR(test::cycle_work(c.motion, history.force, 0), history.dissipated_energy,
                1e-12 * H * friction_scale(c) * u);
  }
}

// What is told of the cycle is the cycle: forces at instants add up to the coefficients, the slider
// keeps to the method, slip by slip to what is dissipated.
TEST_P(AllSurfaceLineEvents, TellTheCycleThatTheyIntegrate) {
  constexpr int n = 4096;
  Eigen::VectorXd phases(n);
  for (int i = 0; i < n; ++i) phases[i] = 2.0 * pi * i / n - 1.0;
  for (const MotionCase& c : motions(16, 38)) {
    const SurfaceLaw surface = GetParam().make(c);
    const PointHistory history = SurfaceLineEvents(surface).history(c.motion, frequency, phases, 2);
    ASSERT_LE(error(history.force,
                    SurfaceLineEvents(surface).history(c.motion, frequency, {}, 2).force, c),
              0.0);
    const double k_u = surface.first_stiffness();
    double friction = 0.0;
    double dissipated = 0.0;
    for (int i = 0; i < n; ++i) {
      const PointInstant& now = history.instants[static_cast<std::size_t>(i)];
      const PointInstant& next = history.instants[static_cast<std::size_t>((i + 1) % n)];
      const SurfaceState y = surface.at(now.motion[1], 0.0);
      friction += now.traction[0] / n;
      if (now.state == ContactState::separated) {
        ASSERT_LE(y.load, 1e-13 * normal_scale(c));
        continue;
      }
      ASSERT_NEAR(now.traction[0], k_u * y.stiffness_ratio * (now.motion[0] - now.slider[0]),
                  1e-13 * (friction_scale(c) + k_u * std::abs(now.motion[0])));
      if (next.state == ContactState::separated) continue;
      dissipated += 0.5 * (now.traction[0] + next.traction[0]) * (next.slider[0] - now.slider[0]);
    }
    // Kinks within a step of 2π/4096: its square, times a dozen events.
    constexpr double sampling = 3e-5;
    ASSERT_NEAR(friction, history.force.mean()[0], sampling * friction_scale(c));
    ASSERT_NEAR(dissipated, history.dissipated_energy,
                10.0 * sampling * friction_scale(c) * friction_scale(c) / k_u);
    double total = 0.0;
    for (const CycleSegment& segment : history.segments) total += segment.length;
    ASSERT_NEAR(total, 2.0 * pi, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, AllSurfaceLineEvents, testing::ValuesIn(test::surface_cases()),
                         [](const auto& instance) { return instance.param.name; });

// Heights that vanish leave the smooth method; what they change is of their own size.
TEST(SurfaceLineEvents, VanishingHeightsAreSmooth) {
  for (const MotionCase& c : motions(60, 39)) {
    const double height = 1e-9 * normal_scale(c) / c.point.normal_stiffness;
    const SurfaceLaw rough(c.point, 0.0, FrictionLaw::constant(c.point.friction_coefficient),
                           RoughSurface::cubic(height));
    const PointTraction exact = traction(LineEvents(c.point), c.motion);
    const PointTraction now = traction(SurfaceLineEvents(rough), c.motion);
    // Half the height along q; near grazing the square root of it in time, of which the force has a
    // part.
    ASSERT_LE(error(now.force, exact.force, c), 1e-7);
  }
}

// A coefficient that rises with the rate is smallest where the motion turns back: the slider is
// left there, at the kink of |u'|, and the kink moves with the motion.
TEST(SurfaceLineEvents, FollowsTheKinkWhereTheMotionTurns) {
  Harmonics motion(2, 3);
  motion.rows().col(0) << 0.0, 1.0, 0.2, 0.1, -0.1;
  motion.rows().col(1) << 0.0, 0.2, 0.3, 0.05, 0.1;
  const PointParameters point{1.0, 0.5, 0.3, 1.0};
  const SurfaceLineEvents method(SurfaceLaw(point, 0.0, FrictionLaw::exponential(0.3, 0.9, 0.05)));
  const PointTraction now = traction(method, motion);
  ASSERT_EQ(now.regime, CycleRegime::stick_slip);
  // The slider rests from where the motion turns back.
  const PointHistory history = method.history(motion, frequency, {}, 1);
  int n_turning = 0;
  for (const CycleSegment& segment : history.segments) {
    if (segment.state != ContactState::stick) continue;
    const double rate =
        (motion.at(segment.start + 1e-5) - motion.at(segment.start - 1e-5))[0] / 2e-5;
    n_turning += std::abs(rate) < 1e-8 ? 1 : 0;
  }
  ASSERT_EQ(n_turning, 2);
  for (Eigen::Index k = 0; k < now.jacobian.cols(); ++k) {
    // The step 1e-3 to its fourth power, or 1e-15 over it.
    const Eigen::VectorXd expected = central(method, motion, k, 1e-3);
    EXPECT_LE((now.jacobian.col(k) - expected).cwiseAbs().maxCoeff(), 1e-9) << k;
  }
}

// Full stick: the virgin slider, and pushed to either end of its band.
TEST(SurfaceLineEvents, FollowsTheActiveEndOfTheBandInFullStick) {
  Harmonics motion(2, 3);
  motion.rows().col(0) << 0.0, 1.0, 0.2, 0.3, -0.1;
  motion.rows().col(1) << 0.0, 0.1, 0.4, 0.2, 0.0;
  const PointParameters point{1.0, 0.8, 0.5, 6.0};
  for (const SurfaceCase& surface : test::surface_cases()) {
    for (const double mean : {0.3, 50.0, -50.0}) {
      motion.rows()(0, 0) = mean;
      const SurfaceLineEvents method(surface.make({point, motion}));
      const PointTraction now = traction(method, motion);
      ASSERT_EQ(now.regime, CycleRegime::full_stick) << surface.name;
      EXPECT_EQ(now.jacobian(0, 0) > 0.0, mean == 0.3) << surface.name;
      for (Eigen::Index k = 0; k < now.jacobian.cols(); ++k) {
        // The step to its fourth power.
        EXPECT_LE((now.jacobian.col(k) - central(method, motion, k, 1e-3)).cwiseAbs().maxCoeff(),
                  1e-8)
            << surface.name << ' ' << k;
      }
    }
  }
}

TEST(SurfaceLineEvents, StatesAreThoseOfTheForce) {
  for (const SurfaceCase& surface : test::surface_cases()) {
    for (const MotionCase& c : motions(20, 42)) {
      const SurfaceLineEvents method(surface.make(c));
      const PointTraction now = traction(method, c.motion);
      PointTraction told;
      method.states(c.motion, frequency, told);
      ASSERT_EQ(told.regime, now.regime) << surface.name;
      ASSERT_EQ(told.period.changed(now.period), 0.0) << surface.name;
    }
  }
}

TEST(SurfaceLineEvents, ForcesFollowTheUnitToTheLastBit) {
  for (const MotionCase& c : motions(60, 40)) {
    const PointTraction plain = traction(SurfaceLineEvents(test::smooth_surface(c)), c.motion);
    for (const double factor : {0x1p-970, 0x1p-70, 0x1p63, 0x1p900}) {
      MotionCase scaled = c;
      scaled.motion.rows() *= factor;
      scaled.point.rest_load *= factor;
      const PointTraction other =
          traction(SurfaceLineEvents(test::smooth_surface(scaled)), scaled.motion);
      ASSERT_EQ(other.force.rows(), (factor * plain.force.rows()).eval());
      ASSERT_EQ(other.jacobian, plain.jacobian);
    }
  }
}

TEST(SurfaceLineEvents, DoesNotSeeTheSecondDirection) {
  for (const SurfaceCase& surface : test::surface_cases()) {
    for (MotionCase c : motions(10, 41)) {
      const SurfaceLineEvents method(surface.make(c));
      const PointTraction plain = traction(method, c.motion);
      c.motion.rows().col(2).setConstant(std::numeric_limits<double>::quiet_NaN());
      const PointTraction other = traction(method, c.motion);
      ASSERT_EQ(other.force.rows(), plain.force.rows());
      ASSERT_EQ(other.jacobian, plain.jacobian);
    }
  }
}

// A layer around u' = 0 in which the coefficient falls to what it is elsewhere, thinner than any
// cell or panel: a force of the layer's own area. Where contact sticks throughout the layer has its
// say.
TEST(SurfaceLineEvents, AThinLayerOfTheRateIsTheLawWithoutIt) {
  for (const double thinness : {1e2, 1e4, 1e6, 1e9, 1e13, 1e100}) {
    for (const MotionCase& c : motions(40, 42)) {
      const double mu = c.point.friction_coefficient;
      const double decay =
          thinness * c.point.tangential_stiffness / (frequency * friction_scale(c));
      const SurfaceLaw layered(c.point, 0.0, FrictionLaw::exponential(2.0 * mu, mu, decay));
      const PointTraction exact = traction(LineEvents(c.point), c.motion);
      if (exact.regime == CycleRegime::full_stick) continue;
      const PointTraction now = traction(SurfaceLineEvents(layered), c.motion);
      ASSERT_TRUE(now.jacobian.allFinite());
      // |u''| is of the size of u; the layer lasts as long as λ|u'| is of order one, up to 1e-9 of
      // a panel, which is where panels end.
      ASSERT_LE(error(now.force, exact.force, c), 20.0 / thinness + 1e-9) << thinness;
    }
  }
}

// In layers of any thickness the planar method along a line agrees.
TEST(SurfaceLineEvents, LayersOfTheRateAreThoseOfThePlaneEvents) {
  for (const double thinness : {10.0, 100.0, 1000.0}) {
    for (MotionCase c : motions(20, 43)) {
      c.motion.rows().col(2).setZero();
      const double mu = c.point.friction_coefficient;
      const double decay =
          thinness * c.point.tangential_stiffness / (frequency * friction_scale(c));
      const SurfaceLaw layered(c.point, 0.0, FrictionLaw::exponential(mu, 1.5 * mu, decay));
      const PointTraction planar = traction(PlaneEvents(layered, 1e-13), c.motion);
      const PointTraction now = traction(SurfaceLineEvents(layered), c.motion);
      ASSERT_LE(error(now.force, planar.force, c), 1e-9) << thinness;
    }
  }
}

TEST(SurfaceLineEvents, NoSpringIsNoFriction) {
  const SurfaceLineEvents method(SurfaceLaw({0.0, 1.0, 0.5, 0.3}, 0.0));
  Harmonics motion(2, 3);
  motion.rows().col(0) << 0.1, 1.0, 0.2, 0.3, 0.4;
  motion.rows().col(1) << 0.0, 0.5, 0.2, 0.3, 0.4;
  const PointHistory history = method.history(motion, 1.0, Eigen::VectorXd::Zero(1), 2);
  EXPECT_TRUE(history.force.rows().col(0).isZero(0.0));
  EXPECT_EQ(history.dissipated_energy, 0.0);
  EXPECT_EQ(history.segments.size(), 2U);
  EXPECT_EQ(method.stuck_stiffness(), Eigen::Vector3d(0.0, 1.0, 0.0));
  EXPECT_TRUE(traction(method, motion).jacobian.topLeftCorner(1, 15).isZero(0.0));
}

TEST(SurfaceLineEvents, StiffnessAndLoadAtRest) {
  const PointParameters point{3.0, 2.0, 0.5, 7.0};
  EXPECT_EQ(SurfaceLineEvents(SurfaceLaw(point, 1.0)).stuck_stiffness(),
            Eigen::Vector3d(3.0, 2.0, 0.0));
  EXPECT_EQ(SurfaceLineEvents(SurfaceLaw(point, 1.0)).reference_load(), 7.0);
  const PointParameters gap{3.0, 2.0, 0.0, -7.0};
  EXPECT_EQ(SurfaceLineEvents(SurfaceLaw(gap, 1.0)).stuck_stiffness(),
            Eigen::Vector3d(0.0, 2.0, 0.0));
}

TEST(SurfaceLineEvents, RefusesWhatIsNoMotion) {
  const SurfaceLineEvents method(SurfaceLaw({1.0, 1.0, 0.5, 1.0}, 0.0));
  PointTraction result;
  EXPECT_THROW(method.traction(Harmonics(0, 3), 1.0, result), std::invalid_argument);
  EXPECT_THROW(method.traction(Harmonics(2, 2), 1.0, result), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(method.history(Harmonics(0, 3), 1.0, {}, 1)),
               std::invalid_argument);
}

}  // namespace
}  // namespace microslip::contact::test_surface_line_events
