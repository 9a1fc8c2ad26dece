#include "contact/force/any_harmonics_force.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "contact/line/event_law.hpp"

namespace microslip::contact {
namespace {

constexpr Eigen::Index n_points = 4;
constexpr Eigen::Index n_modes = 2;

/// Points that stick, slip and separate under waves of size one.
ContactPatch some_patch() {
  return {
      Eigen::Vector4d(1.0, 0.5, 0.8, 1.2),
      {{1.0, 1.0, 0.3, 0.5}, {2.0, 0.5, 0.4, 5.0}, {1.0, 2.0, 0.2, -0.1}, {1.5, 0.0, 0.5, 0.3}}};
}

ModalShapes some_shapes() {
  ModalShapes shapes{Eigen::MatrixXd(n_points, n_modes), Eigen::MatrixXd(n_points, n_modes),
                     Eigen::MatrixXd::Constant(n_points, n_modes, 0.7)};
  for (Eigen::Index i = 0; i < n_points; ++i) {
    for (Eigen::Index k = 0; k < n_modes; ++k) {
      shapes.u(i, k) = std::cos(1.1 * static_cast<double>(i + 2 * k) + 0.2);
      shapes.v(i, k) = 0.6 * std::sin(0.9 * static_cast<double>(2 * i + k) + 0.5);
    }
  }
  return shapes;
}

Harmonics wave(int n_harmonics) {
  Harmonics q(n_harmonics, n_modes);
  for (Eigen::Index i = 0; i < q.rows().size(); ++i) {
    q.vector()[i] =
        std::cos(2.3 * static_cast<double>(i) + 0.4) / (1.0 + static_cast<double>(i / 4));
  }
  return q;
}

TEST(AnyHarmonicsForce, OneHarmonicIsTheClosedForm) {
  const AnyHarmonicsForce force(some_patch(), some_shapes());
  const PatchForce closed(some_patch(), some_shapes());
  EXPECT_EQ(force.evaluate(wave(1), 1.0).force.rows(), closed.evaluate(wave(1), 1.0).force.rows());
  EXPECT_EQ(force.report(wave(1), 1.0).slip_work, closed.report(wave(1), 1.0).slip_work);
  EXPECT_EQ(force.stuck_stiffness(), closed.stuck_stiffness());
  EXPECT_EQ(force.n_modes(), n_modes);
}

TEST(AnyHarmonicsForce, SeveralHarmonicsAreEventsWithoutTheSecondDirection) {
  const AnyHarmonicsForce force(some_patch(), some_shapes());
  std::vector<std::shared_ptr<const PointLaw>> laws;
  const ContactPatch patch = some_patch();
  for (const PointParameters& point : patch.points()) {
    laws.push_back(std::make_shared<EventLaw>(point));
  }
  ModalShapes shapes = some_shapes();
  shapes.w.resize(0, 0);
  const LawPatchForce events(some_patch().weights(), laws, shapes);
  const ForceAndJacobian one = force.evaluate(wave(3), 1.0);
  const ForceAndJacobian other = events.evaluate(wave(3), 1.0);
  EXPECT_EQ(one.force.rows(), other.force.rows());
  EXPECT_EQ(one.jacobian, other.jacobian);
  EXPECT_EQ(force.report(wave(3), 1.0).slip_work, events.report(wave(3), 1.0).slip_work);
}

TEST(AnyHarmonicsForce, ForcesBeyondTheMotionAreThoseOfMotionPaddedWithZeros) {
  const AnyHarmonicsForce force(some_patch(), some_shapes());
  for (const int n_harmonics : {1, 3}) {
    const Harmonics alone = force.force_up_to(wave(n_harmonics), 1.0, 9);
    Harmonics wide(9, n_modes);
    wide.rows().topRows(2 * n_harmonics + 1) = wave(n_harmonics).rows();
    const Harmonics whole = force.evaluate(wide, 1.0).force;
    EXPECT_GT(whole.rows().bottomRows(4).norm(), 1e-6 * whole.rows().norm());
    // Sums of the same terms in another order.
    EXPECT_LT((alone.rows() - whole.rows()).norm(), 1e-14 * whole.rows().norm());
  }
}

TEST(AnyHarmonicsForce, BothRoadsMeetWhereHigherHarmonicsVanish) {
  const AnyHarmonicsForce force(some_patch(), some_shapes());
  Harmonics wide(4, n_modes);
  wide.rows().topRows(3) = wave(1).rows();
  const ForceAndJacobian narrow = force.evaluate(wave(1), 1.0);
  const ForceAndJacobian more = force.evaluate(wide, 1.0);
  // Both are exact to some 1e-16 of the forces per phase (event_law.hpp), derivatives to 1e-12.
  EXPECT_LT((more.force.rows().topRows(3) - narrow.force.rows()).norm(),
            1e-14 * narrow.force.rows().norm());
  EXPECT_LT((more.jacobian.topLeftCorner(6, 6) - narrow.jacobian).norm(),
            1e-12 * narrow.jacobian.norm());
  EXPECT_GT(more.force.rows().bottomRows(6).norm(), 0.01);  // what one harmonic cannot see
}

TEST(AnyHarmonicsForce, LinearityIsUnknownOfPointsThatSeparate) {
  const AnyHarmonicsForce force(some_patch(), some_shapes());
  EXPECT_EQ(force.linear_state(Harmonics(1, n_modes), 1e9), LinearState::unknown);
  const PatchForce closed(some_patch(), some_shapes());
  EXPECT_EQ(force.linear_state(Harmonics(1, n_modes), 1e-9),
            closed.linear_state(Harmonics(1, n_modes), 1e-9));
  EXPECT_EQ(force.linear_state(Harmonics(2, n_modes), 1e-9), LinearState::unknown);
}

}  // namespace
}  // namespace microslip::contact
