/// What is hard: a point with two tangential directions whose limit of friction changes within a
/// small part of the period: a coefficient that falls with the speed, where the motion all but
/// stops; contact that is lost and found again within a few hundredths of a radian; Gaussian
/// heights under amplitudes of hundreds of them. Where: theory sections 8, 9, 10, 11. Right: every
/// slip phase is there, forces agree with marches of many steps.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "contact/line/surface_line_events.hpp"
#include "contact/plane/planar_cycle.hpp"
#include "support/motion_cases.hpp"
#include "support/planar_events.hpp"

namespace microslip::test::planar_layers {
namespace {

using contact::ContactState;
using contact::CycleSegment;
using contact::FrictionLaw;
using contact::Harmonics;
using contact::PlaneEvents;
using contact::PointHistory;
using contact::PointTraction;
using contact::SurfaceLaw;

constexpr double omega = 2.0 * std::numbers::pi * 22.0;

PointHistory history_of(const PlaneEvents& method, const Harmonics& motion) {
  return method.history(motion, omega, Eigen::VectorXd(), motion.n_harmonics());
}

// Where the motion is slowest μ rises to its value at rest and the point sticks; before and after,
// it slips for a hundredth of a radian. Phases from 2²⁰ steps of implicit returns.
TEST(PlanarLayers, SlipOnEitherSideOfTheSlowestPhaseIsThere) {
  Harmonics motion(1, 3);
  motion.rows() << 1.3424046010932618e-05, 0.0, 7.868121592385793e-07,  //
      -0.004122253914124401, 0.00018716850230972857, 3.153639968678628e-05, -0.0011171170710556724,
      4.9701360214217237e-05, 3.9760212371149026e-05;
  const double k = 40527.21635712456;
  const PlaneEvents method(
      SurfaceLaw({k, 3e4, 0.6, 10.0}, k, FrictionLaw::hyperbolic(0.6, 22.589156413277653)));
  const std::vector<CycleSegment> segments = history_of(method, motion).segments;
  const std::vector<double> expected{1.1917, 1.4112, 1.4212, 1.5864,
                                     4.3887, 4.4974, 4.5080, 4.6143};
  ASSERT_EQ(segments.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(segments[i].state, i % 2 == 0 ? ContactState::stick : ContactState::slip);
    EXPECT_NEAR(segments[i].start, expected[i], 2e-4) << i;  // their last digit
  }
}

// Nearly rigid along r and soft along p: friction is seven digits smaller than k a. It is known to
// what rounding of the slider, 1e-15 of k a, leaves of it.
TEST(PlanarLayers, FrictionOfARigidPointHasTheDigitsOfItsLimit) {
  Harmonics motion(2, 3);
  motion.rows() << 0.0, 0.0, 0.0,                                        //
      -0.6152718847161129, -0.02703430124837775, -2.441485314800169,     //
      -0.05208585127062094, -0.017530897499907556, 3.3498874178834686,   //
      -0.31098971643996504, 0.0069324294202068515, -1.3877872968152443,  //
      -1.303072881278316, -0.003684510100480665, -0.29346055902668244;
  const SurfaceLaw surface({0.10398449861900015, 1.0, 0.9206879295782183, 0.09346776669679172},
                           103984.49861900015);
  PointTraction exact;
  PlaneEvents(surface, 1e-13).traction(motion, 1.0, exact);
  for (const double tolerance : {1e-8, 1e-9}) {
    PointTraction traction;
    PlaneEvents(surface, tolerance).traction(motion, 1.0, traction);
    const double error = (traction.force.vector() - exact.force.vector()).cwiseAbs().maxCoeff();
    EXPECT_LE(error, (10.0 * tolerance + 1e-8) * 0.1) << tolerance;
  }
}

// The load has three zeros within a fortieth of the period.
TEST(PlanarLayers, ContactLostForAMomentIsLost) {
  Harmonics motion(2, 3);
  motion.rows() << 0.0, 0.0, 0.0,                        //
      0.0, -0.4481310771220178, 0.0010463607786834913,   //
      0.0, 0.2914837927854719, -0.10539320784222622,     //
      0.0, -0.000405441803525197, -0.07127489093254999,  //
      0.0, 0.25997968828898527, 0.05575020670222891;
  const PlaneEvents method(SurfaceLaw({1.0, 1.0, 0.8185837886747866, -0.11038665088185172}, 1.0));
  PointTraction traction;
  method.traction(motion, 1.0, traction);
  EXPECT_NEAR(traction.force.mean()[1], 0.11503068952, 1e-11);
  EXPECT_NEAR(traction.force.sine(1)[1], -0.0915037544, 1e-10);
  EXPECT_NEAR(traction.force.sine(1)[2], -0.00687214670, 1e-10);
}

/// Largest error of the friction of a point whose coefficient falls with the rate, relative to its
/// force scale.
double error_of_events(const EventCase& c, double tolerance) {
  const EventReference reference = planar_events(c, 20);
  EXPECT_TRUE(reference.settled);
  const double mu = c.point.point.friction_coefficient;
  PointTraction traction;
  PlaneEvents(SurfaceLaw(c.point.point, c.point.second_stiffness,
                         FrictionLaw::exponential(mu, c.kinetic, c.rate)),
              tolerance)
      .traction(c.point.motion, 1.0, traction);
  double error = 0.0;
  for (std::size_t i = 0; i < reference.first.size(); ++i) {
    const auto& force = traction.force.rows().row(static_cast<Eigen::Index>(i));
    error = std::max({error, std::abs(static_cast<double>(reference.first[i]) - force[0]),
                      std::abs(static_cast<double>(reference.second[i]) - force[2])});
  }
  return error / planar_scale(c.point);
}

// The motion across is a millionth of that along: μ rises as the speed falls, until within 1e-6 of
// the slowest phase it rises no more. The slider stops 0.013 before and begins again 0.003 after,
// but within the layer its rate is that of slip: 1e-7 of the force scale was lost.
TEST(PlanarLayers, RestAroundTheTurnOfANearlyStraightMotionIsSeen) {
  EventCase c;
  c.point.motion = Harmonics(1, 3);
  c.point.motion.rows() << 2.4251673855241804e-05, 0.0, 3.1615147279646294e-11,  //
      -0.003001722862335924, 0.000150089803158537, 1.9217273838134028e-09,       //
      -0.002035826254260553, 5.088469791673126e-05, 2.298889408107178e-09;
  c.point.point = {2e4, 3e4, 0.5, 10.0};
  c.point.second_stiffness = 2e4;
  c.kinetic = 0.3;
  c.rate = 3.0 * omega;  // 3 s/m
  for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
    EXPECT_LE(error_of_events(c, tolerance), 10.0 * tolerance) << tolerance;
  }
}

constexpr double angle = 0.7;

Harmonics turned(const Harmonics& motion) {
  Harmonics straight = motion;
  straight.rows().col(2) = std::sin(angle) * motion.rows().col(0);
  straight.rows().col(0) *= std::cos(angle);
  return straight;
}

/// Phases at which slip begins, in whatever direction.
std::vector<double> slip_starts(const std::vector<CycleSegment>& segments) {
  std::vector<double> starts;
  for (const CycleSegment& segment : segments) {
    const bool slips =
        segment.state != ContactState::stick && segment.state != ContactState::separated;
    if (slips) starts.push_back(segment.start);
  }
  return starts;
}

/// Largest difference of the friction of a straight motion turned by an angle from that of one
/// direction.
double turned_difference(const SurfaceLaw& surface, const Harmonics& motion, double frequency) {
  PointTraction planar;
  PointTraction exact;
  PlaneEvents(surface, 1e-11).traction(turned(motion), frequency, planar);
  contact::SurfaceLineEvents(surface).traction(motion, frequency, exact);
  const Eigen::VectorXd f = exact.force.rows().col(0);
  return ((planar.force.rows().col(0) - std::cos(angle) * f).cwiseAbs() +
          (planar.force.rows().col(2) - std::sin(angle) * f).cwiseAbs())
      .maxCoeff();
}

// Layers from the whole period down to 1e-5 of it: the events of the one are those of the other.
TEST(PlanarLayers, SteepRatesAlongALineHaveThePhasesOfOneDirection) {
  std::mt19937_64 random(71);
  for (int i = 0; i < 240; ++i) {
    const MotionCase c = motion_strata()[static_cast<std::size_t>(i % 6)].draw(random);
    const double rate = std::pow(10.0, std::uniform_real_distribution<double>(-1.0, 5.0)(random));
    const double mu = c.point.friction_coefficient;
    const FrictionLaw friction = i % 2 == 0 ? FrictionLaw::exponential(mu, 0.4 * mu, rate)
                                            : FrictionLaw::hyperbolic(mu, rate);
    const SurfaceLaw surface(c.point, c.point.tangential_stiffness, friction);
    const int H = c.motion.n_harmonics();
    const auto planar = PlaneEvents(surface, 1e-11).history(turned(c.motion), 1.0, {}, H).segments;
    const auto exact = contact::SurfaceLineEvents(surface).history(c.motion, 1.0, {}, H).segments;
    EXPECT_EQ(slip_starts(planar).size(), slip_starts(exact).size()) << i;
    if (slip_starts(planar).size() != slip_starts(exact).size()) continue;
    for (std::size_t j = 0; j < slip_starts(exact).size(); ++j) {
      // Onsets where the force all but rests at its limit are known to the root of rounding.
      EXPECT_NEAR(slip_starts(planar)[j], slip_starts(exact)[j], 1e-7) << i;
    }
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
}  // namespace microslip::test::planar_layers
