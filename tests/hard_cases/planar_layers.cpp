/// What is hard: a point with two tangential directions whose limit of friction changes within a small part
/// of the period: a coefficient that falls with the speed, where the motion all but stops; contact that is
/// lost and found again within a few hundredths of a radian; Gaussian heights under amplitudes of hundreds
/// of them. Where: theory sections 8, 9, 10, 11. Right: every slip phase is there, forces agree with marches
/// of many steps.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "contact/planar_cycle.hpp"
#include "contact/surface_event_law.hpp"
#include "support/motion_cases.hpp"

namespace microslip::test {
namespace {

using contact::ContactState;
using contact::CycleSegment;
using contact::FrictionLaw;
using contact::Harmonics;
using contact::PlanarLaw;
using contact::PointHistory;
using contact::PointTraction;
using contact::SurfaceLaw;

constexpr double omega = 2.0 * std::numbers::pi * 22.0;

PointHistory history_of(const PlanarLaw& law, const Harmonics& motion) {
  return law.history(motion, omega, Eigen::VectorXd(), motion.n_harmonics());
}

// Where the motion is slowest μ rises to its value at rest and the point sticks; before and after, it
// slips for a hundredth of a radian. Phases from 2²⁰ steps of implicit returns.
TEST(PlanarLayers, SlipOnEitherSideOfTheSlowestPhaseIsThere) {
  Harmonics motion(1, 3);
  motion.rows() << 1.3424046010932618e-05, 0.0, 7.868121592385793e-07,  //
      -0.004122253914124401, 0.00018716850230972857, 3.153639968678628e-05,
      -0.0011171170710556724, 4.9701360214217237e-05, 3.9760212371149026e-05;
  const double k = 40527.21635712456;
  const PlanarLaw law(
      SurfaceLaw({k, 3e4, 0.6, 10.0}, k, FrictionLaw::hyperbolic(0.6, 22.589156413277653)));
  const std::vector<CycleSegment> segments = history_of(law, motion).segments;
  const std::vector<double> expected{1.1917, 1.4112, 1.4212, 1.5864,
                                     4.3887, 4.4974, 4.5080, 4.6143};
  ASSERT_EQ(segments.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(segments[i].state, i % 2 == 0 ? ContactState::stick : ContactState::slip);
    EXPECT_NEAR(segments[i].start, expected[i], 2e-4) << i;  // their last digit
  }
}

// The load has three zeros within a fortieth of the period.
TEST(PlanarLayers, ContactLostForAMomentIsLost) {
  Harmonics motion(2, 3);
  motion.rows() << 0.0, 0.0, 0.0,                                     //
      0.0, -0.4481310771220178, 0.0010463607786834913,                //
      0.0, 0.2914837927854719, -0.10539320784222622,                  //
      0.0, -0.000405441803525197, -0.07127489093254999,               //
      0.0, 0.25997968828898527, 0.05575020670222891;
  const PlanarLaw law(SurfaceLaw({1.0, 1.0, 0.8185837886747866, -0.11038665088185172}, 1.0));
  PointTraction traction;
  law.traction(motion, 1.0, traction);
  EXPECT_NEAR(traction.force.mean()[1], 0.11503068952, 1e-11);
  EXPECT_NEAR(traction.force.sine(1)[1], -0.0915037544, 1e-10);
  EXPECT_NEAR(traction.force.sine(1)[2], -0.00687214670, 1e-10);
}

/// Largest difference of the friction of a straight motion turned by an angle from that of one direction.
double turned_difference(const SurfaceLaw& surface, const Harmonics& motion, double frequency) {
  constexpr double angle = 0.7;
  Harmonics turned = motion;
  turned.rows().col(2) = std::sin(angle) * motion.rows().col(0);
  turned.rows().col(0) *= std::cos(angle);
  PointTraction planar;
  PointTraction exact;
  PlanarLaw(surface, 1e-11).traction(turned, frequency, planar);
  contact::SurfaceEventLaw(surface).traction(motion, frequency, exact);
  const Eigen::VectorXd f = exact.force.rows().col(0);
  return ((planar.force.rows().col(0) - std::cos(angle) * f).cwiseAbs() +
          (planar.force.rows().col(2) - std::sin(angle) * f).cwiseAbs())
      .maxCoeff();
}

// Layers from the whole period down to 1e-5 of it.
TEST(PlanarLayers, SteepRatesAlongALineAreThoseOfOneDirection) {
  std::mt19937_64 random(71);
  for (int i = 0; i < 120; ++i) {
    const MotionCase c = motion_strata()[static_cast<std::size_t>(i % 6)].draw(random);
    const double rate = std::pow(10.0, std::uniform_real_distribution<double>(-1.0, 5.0)(random));
    const double mu = c.point.friction_coefficient;
    const FrictionLaw friction = i % 2 == 0 ? FrictionLaw::exponential(mu, 0.4 * mu, rate)
                                            : FrictionLaw::hyperbolic(mu, rate);
    const SurfaceLaw surface(c.point, c.point.tangential_stiffness, friction);
    EXPECT_LE(turned_difference(surface, c.motion, 1.0), 1e-9 * friction_scale(c)) << i;
  }
}

// Amplitudes of up to a thousand deviations of the heights, over gaps and under preload.
TEST(PlanarLayers, LowGaussianHeightsAlongALineAreThoseOfOneDirection) {
  std::mt19937_64 random(72);
  for (int i = 0; i < 120; ++i) {
    const MotionCase c = motion_strata()[static_cast<std::size_t>(i % 6)].draw(random);
    if (!(c.point.normal_stiffness > 0.0)) continue;
    const double size = normal_scale(c) / c.point.normal_stiffness;
    if (!(size > 0.0)) continue;
    const double share = std::pow(10.0, std::uniform_real_distribution<double>(-4.0, 1.0)(random));
    const SurfaceLaw surface(c.point, c.point.tangential_stiffness,
                             FrictionLaw::constant(c.point.friction_coefficient),
                             contact::RoughSurface::matching_gaussian(share * size));
    EXPECT_LE(turned_difference(surface, c.motion, 1.0), 1e-9 * friction_scale(c)) << i;
  }
}

}  // namespace
}  // namespace microslip::test
