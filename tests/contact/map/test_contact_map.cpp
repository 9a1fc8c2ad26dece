#include <gtest/gtest.h>
#include "contact/closed_form/friction_cycle.hpp"
#include "contact/contact_map.hpp"
#include "contact/patch/point_motions.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace microslip::contact::test_contact_map {
namespace {

constexpr double pi = std::numbers::pi;

struct Scene {
  std::vector<PointParameters> points;
  ModalShapes shapes;
  Harmonics q;
};

// One mode; three points: stuck, slipping, opening.
Scene three_points() {
  Scene s{{{1.0, 1.0, 0.5, 50.0}, {1.0, 0.0, 0.5, 1.0}, {1.0, 1.0, 0.5, 0.1}},
          {Eigen::Vector3d(0.5, 1.0, 1.0), Eigen::Vector3d(0.1, 0.0, 1.0), {}},
          Harmonics(1, 1)};
  s.q.rows() << 0.25, 1.0, 0.5;
  return s;
}

TEST(ContactMap, FieldsObeyTheContactLaw) {
  const Scene s = three_points();
  const ContactMap map = contact_map(s.points, s.shapes, s.q, 90, 0.0);
  ASSERT_EQ(map.state.rows(), 3);
  ASSERT_EQ(map.state.cols(), 90);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const PointParameters& point = s.points[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < 90; ++j) {
      EXPECT_DOUBLE_EQ(map.phase[j], 2.0 * pi * static_cast<double>(j) / 90.0);
      const double n = map.normal_traction(i, j);
      const double f = map.friction_traction(i, j);
      const double u = map.relative_displacement(i, j);
      EXPECT_NEAR(u, s.shapes.u(i, 0) * s.q.at(map.phase[j])[0], 1e-15);  // a product or two
      EXPECT_NEAR(map.approach(i, j), s.shapes.v(i, 0) * s.q.at(map.phase[j])[0], 1e-15);
      EXPECT_NEAR(n, std::max(0.0, point.rest_load + point.normal_stiffness * map.approach(i, j)),
                  1e-14);  // of a load of 50
      EXPECT_LE(std::abs(f), point.friction_coefficient * n + 1e-15);
      EXPECT_NEAR(f, point.tangential_stiffness * (u - map.slip(i, j)), 1e-14);
      switch (static_cast<ContactState>(map.state(i, j))) {
        case ContactState::positive_slip:
          EXPECT_DOUBLE_EQ(f, point.friction_coefficient * n);
          break;
        case ContactState::negative_slip:
          EXPECT_DOUBLE_EQ(f, -point.friction_coefficient * n);
          break;
        case ContactState::separated:
          EXPECT_EQ(n, 0.0);
          EXPECT_EQ(f, 0.0);
          break;
        default:
          break;
      }
    }
  }
}

TEST(ContactMap, PointsAreInTheStatesTheirMotionAsksFor) {
  const Scene s = three_points();
  const ContactMap map = contact_map(s.points, s.shapes, s.q, 360, 0.0);
  EXPECT_TRUE((map.state.row(0).array() == 0).all());
  EXPECT_TRUE((map.state.row(1).array() == 1).any());
  EXPECT_TRUE((map.state.row(1).array() == 2).any());
  EXPECT_FALSE((map.state.row(1).array() == 3).any());
  EXPECT_TRUE((map.state.row(2).array() == 3).any());
}

// Under constant load stick starts where the motion turns back; a state that never occurs has no
// start.
TEST(ContactMap, TransitionAnglesAreWhereStatesBegin) {
  const Scene s = three_points();
  const ContactMap map = contact_map(s.points, s.shapes, s.q, 1, 0.0);
  const double u_s = s.shapes.u.row(1).dot(s.q.sine(1));
  const double u_c = s.shapes.u.row(1).dot(s.q.cosine(1));
  const double at = map.state_start(1, 0);
  EXPECT_NEAR(u_s * std::cos(at) - u_c * std::sin(at), 0.0, 1e-14 * std::hypot(u_s, u_c));
  EXPECT_NEAR(std::remainder(map.state_start(1, 2) - map.state_start(1, 1) - pi, 2.0 * pi), 0.0,
              1e-14);
  EXPECT_TRUE(std::isnan(map.state_start(1, 3)));
  EXPECT_TRUE(map.state_start.row(0).array().isNaN().all());  // sticks all the time
  constexpr double step = 1e-6;
  for (const Eigen::Index state : {0, 1, 2, 3}) {
    const double start = map.state_start(2, state);
    if (std::isnan(start)) continue;
    const auto motions = point_motions(s.shapes, s.q);
    const FrictionCycle cycle = friction_cycle(s.points[2], motions[2]);
    const auto state_at = [&](double phase) {
      return static_cast<Eigen::Index>(at_phase(cycle, s.points[2], motions[2], phase).state);
    };
    EXPECT_EQ(state_at(start + step), state);
    EXPECT_NE(state_at(start - step), state);
  }
}

// Constant load: distance 4 (a − q/k_u), energy q times that, depth K n₀ times that.
TEST(ContactMap, PerCycleFieldsHaveTheirClosedForms) {
  const Scene s = three_points();
  const double a = std::hypot(1.0, 0.5);
  const double distance = 4.0 * (a - 0.5);
  const ContactMap map = contact_map(s.points, s.shapes, s.q, 1, 1e-3);
  // A dozen roundings of numbers of order one.
  EXPECT_NEAR(map.slip_distance[1], distance, 1e-14);
  EXPECT_NEAR(map.dissipated_energy[1], 0.5 * distance, 1e-14);
  EXPECT_NEAR(map.wear_depth[1], 1e-3 * distance, 1e-17);
  EXPECT_EQ(map.wear_depth[0], 0.0);
  EXPECT_EQ(map.slip_distance[0], 0.0);
}

// The slider moves only by slipping: its path in the map is the slip distance, to O(1/n_phases²) at
// the turning points, with 4 of them of curvature a.
TEST(ContactMap, SliderPathIsTheSlipDistance) {
  const Scene s = three_points();
  constexpr int n = 2000;
  const ContactMap map = contact_map(s.points, s.shapes, s.q, n, 0.0);
  double path = 0.0;
  for (Eigen::Index j = 0; j < n; ++j) {
    path += std::abs(map.slip(1, (j + 1) % n) - map.slip(1, j));
  }
  const double h = 2.0 * pi / n;
  EXPECT_NEAR(path, map.slip_distance[1], 4.0 * h * h);
}

TEST(ContactMap, RefusesWhatDoesNotFit) {
  const Scene s = three_points();
  EXPECT_THROW((void)contact_map(s.points, s.shapes, s.q, 0, 0.0), std::invalid_argument);
  EXPECT_THROW((void)contact_map(s.points, s.shapes, s.q, 4, -1.0), std::invalid_argument);
  EXPECT_THROW((void)contact_map(s.points, s.shapes, Harmonics(1, 2), 4, 0.0),
               std::invalid_argument);
  EXPECT_THROW((void)contact_map({s.points[0]}, s.shapes, s.q, 4, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace microslip::contact::test_contact_map
