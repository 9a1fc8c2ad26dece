#include "contact/planar_cycle.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace microslip::contact {
namespace {

constexpr double tight = 1e-11;

// Theory section 9: u = a (cos θ, sin θ), constant load.
TEST(PlanarLaw, CircularMotionHasItsClosedForm) {
  const double k = 2.0e6;
  const double limit = 0.3 * 1e3;
  for (const double a : {1.6e-4, 3.5e-4, 2e-3}) {
    const PlanarLaw law(SurfaceLaw({k, 1e6, 0.3, 1e3}, k), tight);
    Harmonics motion(1, 3);
    motion.rows()(2, 0) = a;
    motion.rows()(1, 2) = a;
    PointTraction traction;
    law.traction(motion, 1.0, traction);
    const double lead = std::acos(limit / (k * a));
    const double scale = k * a + limit;
    EXPECT_EQ(traction.regime, CycleRegime::stick_slip);
    EXPECT_NEAR(traction.force.rows()(1, 0), -limit * std::sin(lead), tight * scale);
    EXPECT_NEAR(traction.force.rows()(2, 0), limit * std::cos(lead), tight * scale);
    EXPECT_NEAR(traction.force.rows()(1, 2), limit * std::cos(lead), tight * scale);
    EXPECT_NEAR(traction.force.rows()(2, 2), limit * std::sin(lead), tight * scale);
    EXPECT_NEAR(traction.force.rows()(0, 0), 0.0, tight * scale);

    const PointHistory history = law.history(motion, 1.0, Eigen::VectorXd(), 3);
    const double radius = std::sqrt(a * a - std::pow(limit / k, 2));
    const double D = 2.0 * std::numbers::pi * limit * radius;
    EXPECT_NEAR(history.dissipated_energy, D, 10.0 * tight * scale * a);
    EXPECT_NEAR(history.slip_distance, D / limit, 10.0 * tight * a);
    EXPECT_NEAR(history.normal_slip, D / 0.3, 100.0 * tight * scale * a);
    ASSERT_EQ(history.segments.size(), 1U);
    EXPECT_EQ(history.segments[0].state, ContactState::slip);
  }
}

}  // namespace
}  // namespace microslip::contact
