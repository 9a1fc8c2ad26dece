/// What is hard: limits of a point with two tangential directions: no motion along one of them or both,
/// contact that only just begins or ends, no preload, events that meet, amplitudes of any size.
/// Where: theory sections 4.2, 4.5, 9. Right: finite forces that agree with the law of one direction where
/// the motion is straight, works that balance, derivatives that are those of one side.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "contact/event_law.hpp"
#include "contact/planar_cycle.hpp"
#include "support/motion_cases.hpp"
#include "support/planar_cases.hpp"

namespace microslip::test {
namespace {

using contact::CycleRegime;
using contact::EventLaw;
using contact::Harmonics;
using contact::PlanarLaw;
using contact::PointHistory;
using contact::PointLaw;
using contact::PointParameters;
using contact::PointTraction;
using contact::SurfaceLaw;

constexpr double pi = std::numbers::pi;
constexpr double tight = 1e-11;
constexpr double smallest = 1e-290;  // what the planar law takes for no force at all

PointTraction traction(const PointLaw& law, const Harmonics& motion) {
  PointTraction result;
  law.traction(motion, 1.0, result);
  return result;
}

/// u along (cos, sin) of an angle.
Harmonics turned(const Harmonics& motion, double angle) {
  Harmonics straight = motion;
  straight.rows().col(2) = std::sin(angle) * motion.rows().col(0);
  straight.rows().col(0) *= std::cos(angle);
  return straight;
}

class StraightMotion : public testing::TestWithParam<MotionStratum> {};

// In every limit that is hard for one direction.
TEST_P(StraightMotion, InAnyDirectionIsTheLawOfOneDirection) {
  std::mt19937_64 random(51);
  for (int i = 0; i < 100; ++i) {
    const MotionCase c = GetParam().draw(random);
    const double angle = std::uniform_real_distribution<double>(0.0, 2.0 * pi)(random);
    const PlanarLaw law(SurfaceLaw(c.point, c.point.tangential_stiffness), tight);
    const PointTraction now = traction(law, turned(c.motion, angle));
    const PointTraction exact = traction(EventLaw(c.point), c.motion);
    const double scale = friction_scale(c);
    const Eigen::VectorXd f = exact.force.rows().col(0);
    // Ten times the tolerance, as measured for any motion.
    EXPECT_LE((now.force.rows().col(0) - std::cos(angle) * f).cwiseAbs().maxCoeff(),
              10.0 * tight * scale + smallest)
        << i;
    EXPECT_LE((now.force.rows().col(2) - std::sin(angle) * f).cwiseAbs().maxCoeff(),
              10.0 * tight * scale + smallest)
        << i;
    EXPECT_LE((now.force.rows() - exact.force.rows()).col(1).cwiseAbs().maxCoeff(),
              10.0 * tight * normal_scale(c) + smallest)
        << i;
    ASSERT_TRUE(now.jacobian.allFinite()) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Strata, StraightMotion, testing::ValuesIn(motion_strata()),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace microslip::test
