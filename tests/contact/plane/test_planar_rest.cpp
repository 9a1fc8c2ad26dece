// Whether a slider can rest for a whole period: against the onset of slip of motions that are
// known, and against what the ellipses of many phases say.
#include "contact/plane/planar_rest.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/SVD>

#include <gtest/gtest.h>

#include "contact/plane/planar_cycle.hpp"
#include "support/planar_cases.hpp"

namespace microslip::contact::test_planar_rest {
namespace {

using Answer = RestPlace::Answer;

RestPlace rest_of(const PlanarMotion& motion) {
  return best_rest(motion, planar_intervals(motion), motion.virgin_slider());
}

/// max |K (x − s)| − r over many phases.
double excess_of(const PlanarMotion& motion, const Eigen::Vector2d& slider) {
  double excess = -1.0;
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i) {
    const PlanarInstant now = motion.at(2.0 * std::numbers::pi * i / n);
    excess = std::max(excess, now.force(slider).norm() - now.radius);
  }
  return excess;
}

// K x of one harmonic runs along an ellipse, the limit is constant: the best place is the middle,
// G* the larger half-axis less the limit, however small.
TEST(PlanarRest, TheOnsetOfSlipIsTheLargerHalfAxis) {
  std::mt19937_64 random(7);
  int undecided = 0;
  for (int i = 0; i < 1000; ++i) {
    const test::PlanarCase c = test::onset_planar(random);
    const SurfaceLaw law(c.point, c.second_stiffness);
    const PlanarMotion motion(law, c.motion, 1.0);
    Eigen::Matrix2d force;
    force.row(0) = c.point.tangential_stiffness * c.motion.rows().col(0).tail<2>().transpose();
    force.row(1) = c.second_stiffness * c.motion.rows().col(2).tail<2>().transpose();
    const double axis = Eigen::JacobiSVD<Eigen::Matrix2d>(force).singularValues()[0];
    const double expected =
        (axis - c.point.friction_coefficient * c.point.rest_load) / motion.force_scale();
    const RestPlace place = rest_of(motion);
    // Nearly a circle: almost every phase is a window.
    undecided += place.answer == Answer::undecided;
    if (place.answer == Answer::undecided) continue;
    EXPECT_EQ(place.answer, expected > 0.0 ? Answer::slips : Answer::rests) << i;
    if (!place.converged) continue;
    EXPECT_NEAR(place.excess, expected, 1e-14) << i;  // 50 roundings
  }
  EXPECT_LE(undecided, 3);
}

// All phases are alike where nothing moves: a mean beyond the limit is let slip to it, once.
TEST(PlanarRest, AMeanWithoutMotionRestsAtTheLimit) {
  Harmonics motion(2, 3);
  motion.rows()(0, 0) = 3.0;
  motion.rows()(0, 2) = -4.0;
  const PlaneEvents law(SurfaceLaw({1.0, 1.0, 0.5, 2.0}, 1.0));
  PointTraction traction;
  law.traction(motion, 1.0, traction);
  EXPECT_EQ(traction.regime, CycleRegime::full_stick);
  EXPECT_NEAR(traction.force.mean()[0], 0.6, 1e-9);
  EXPECT_NEAR(traction.force.mean()[2], -0.8, 1e-9);
}

// Around a circle under constant load every phase is a window of the middle. Next to the onset the
// march comes close like 1/periods: what rests is found on the way to the middle, and the defect
// says how far apart such sliders are.
TEST(PlanarRest, ACircleIsDecidedByItsRadius) {
  for (const double aside : {-1e-2, -1e-6, -1e-9, 1e-9, 1e-6, 1e-2}) {
    Harmonics motion(1, 3);
    motion.rows()(0, 0) = 0.7;
    motion.rows()(1, 0) = 1.0 + aside;
    motion.rows()(2, 2) = 1.0 + aside;
    PointTraction traction;
    PlaneEvents(SurfaceLaw({1.0, 0.0, 1.0, 1.0}, 1.0), 1e-11).traction(motion, 1.0, traction);
    EXPECT_EQ(traction.regime, aside > 0.0 ? CycleRegime::stick_slip : CycleRegime::full_stick);
    const double mean = std::hypot(traction.force.mean()[0], traction.force.mean()[2]);
    EXPECT_LE(mean, aside > 0.0 ? 1e-10 : -1.01 * aside) << aside;
    EXPECT_LE(traction.defect, aside > 0.0 ? 0.0 : 3.0 * std::abs(aside)) << aside;
    if (aside < 0.0) {
      EXPECT_NEAR(traction.force.sine(1)[0], 1.0 + aside, 1e-12) << aside;
    }
  }
}

// Several harmonics, load that varies, different stiffness: no slider nearby has less excess.
TEST(PlanarRest, NoPlaceNearbyIsBetter) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> angle(0.0, 2.0 * std::numbers::pi);
  int resting = 0;
  int slipping = 0;
  for (int i = 0; i < 300; ++i) {
    const test::PlanarCase c = test::creeping_planar(random);
    const SurfaceLaw law(c.point, c.second_stiffness);
    const PlanarMotion motion(law, c.motion, 1.0);
    const RestPlace place = rest_of(motion);
    const double least = excess_of(motion, place.slider);
    resting += place.answer == Answer::rests;
    slipping += place.answer == Answer::slips;
    if (place.answer == Answer::rests) {
      EXPECT_LE(least, rest_rounding) << i;
    }
    if (place.answer != Answer::slips) continue;
    EXPECT_GT(place.excess, 0.0);
    if (!place.converged) continue;
    for (const double distance : {1e-4, 1e-2, 0.3}) {
      const double turn = angle(random);
      const Eigen::Vector2d aside(distance * std::cos(turn), distance * std::sin(turn));
      const Eigen::Vector2d other = place.slider + aside.cwiseQuotient(motion.stiffness());
      // The maximum between two of the phases is missed by 1e-6.
      EXPECT_GT(excess_of(motion, other), place.excess - 1e-5) << i;
    }
  }
  EXPECT_GT(resting, 100);
  EXPECT_GT(slipping, 10);
}

}  // namespace
}  // namespace microslip::contact::test_planar_rest
