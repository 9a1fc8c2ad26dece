#include "contact/force/sleeping_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "contact/closed_form/friction_cycle.hpp"
#include "contact/force/patch_force.hpp"
#include "contact/patch/point_motions.hpp"

namespace microslip::contact {
namespace {

constexpr Eigen::Index n_modes = 4;

struct Patch {
  Eigen::VectorXd weights;
  std::vector<PointParameters> points;
  ModalShapes shapes;
};

// Preloads from gaps to loads that hold everything; some points without friction.
Patch random_patch(Eigen::Index n, std::mt19937_64& random) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  Patch patch{Eigen::VectorXd(n), {}, {}};
  for (Eigen::Index i = 0; i < n; ++i) {
    patch.weights[i] = 1.1 + u(random);
    patch.points.push_back({1.1 + u(random), i % 7 == 0 ? 0.0 : 1.1 + u(random),
                            i % 5 == 0 ? 0.0 : 0.5 + 0.4 * u(random), 6.0 * u(random) + 2.0});
  }
  patch.shapes.u = Eigen::MatrixXd::NullaryExpr(n, n_modes, [&] { return u(random); });
  patch.shapes.v = Eigen::MatrixXd::NullaryExpr(n, n_modes, [&] { return u(random); });
  return patch;
}

Harmonics random_motion(double size, std::mt19937_64& random) {
  std::normal_distribution<double> g(0.0, size);
  Harmonics q(1, n_modes);
  for (double& x : q.vector()) {
    x = g(random);
  }
  return q;
}

// A patch that has seen a walk of motions against one that has never seen any. One that sleeps adds
// in another order: rounding of sums of n terms of size 10.
TEST(SleepingPoints, GiveWhatPointsEvaluatedOneByOneGive) {
  std::mt19937_64 random(1);
  double least_awake = 1.0;
  for (int scene = 0; scene < 20; ++scene) {
    const Eigen::Index n = 16 + 37 * scene;
    const Patch p = random_patch(n, random);
    PatchForce walked(ContactPatch(p.weights, p.points), p.shapes);
    Harmonics q = random_motion(0.5, random);
    for (int step = 0; step < 60; ++step) {
      // Steps from the size of a Newton correction to one that wakes everything.
      const double size = std::pow(10.0, -6.0 + 0.1 * step);
      q.vector() += random_motion(size, random).vector();
      q.vector() *= 0.7 / std::max(0.7, q.vector().norm() / 4.0);
      PatchForce fresh(ContactPatch(p.weights, p.points), p.shapes);
      const ForceAndJacobian a = walked.evaluate(q, 1.0);
      const ForceAndJacobian b = fresh.evaluate(q, 1.0);
      const double rounding = 1e-14 * static_cast<double>(n);
      ASSERT_LE((a.force.vector() - b.force.vector()).cwiseAbs().maxCoeff(), rounding);
      ASSERT_LE((a.jacobian - b.jacobian).cwiseAbs().maxCoeff(), rounding);
      least_awake = std::min(least_awake, walked.report(q, 1.0).awake_share);
    }
  }
  EXPECT_LT(least_awake, 0.7);  // some of the 1 200 motions did let points sleep
}

// Against the definition, so that both ways cannot be wrong together.
TEST(SleepingPoints, LinearPartIsThatOfTheCycles) {
  std::mt19937_64 random(2);
  const Patch p = random_patch(300, random);
  PatchForce force(ContactPatch(p.weights, p.points), p.shapes);
  const Harmonics q = random_motion(0.4, random);
  const ForceAndJacobian ours = force.evaluate(q, 1.0);
  ASSERT_LT(force.report(q, 1.0).awake_share, 0.8);
  Harmonics expected(1, n_modes);
  const std::vector<PointMotion> motions = point_motions(p.shapes, q);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const FrictionCycle c = friction_cycle(p.points[i], motions[i]);
    Eigen::Vector3d f(c.friction.mean, c.friction.sin, c.friction.cos);
    Eigen::Vector3d n(c.normal.mean - std::max(p.points[i].preload, 0.0), c.normal.sin,
                      c.normal.cos);
    expected.rows() += p.weights[row] * (f * p.shapes.u.row(row) + n * p.shapes.v.row(row));
  }
  EXPECT_LE((ours.force.rows() - expected.rows()).cwiseAbs().maxCoeff(), 3e-13);
}

// A proof is a promise for a ball: at random motions on its surface the point is still linear.
TEST(SleepingPoints, ProofHoldsUpToItsRadius) {
  std::mt19937_64 random(3);
  const Patch p = random_patch(4000, random);
  int n_proved = 0;
  for (std::size_t i = 0; i < p.points.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const ModalShapes shapes{p.shapes.u.row(row), p.shapes.v.row(row), {}};
    const Harmonics q = random_motion(0.4, random);
    const SleepProof proof =
        prove_asleep(p.points[i], point_motions(shapes, q)[0], shapes.u.norm(), shapes.v.norm());
    if (proof.state == SleepState::awake) {
      continue;
    }
    ++n_proved;
    for (int trial = 0; trial < 10; ++trial) {
      Harmonics moved = q;
      const Harmonics direction = random_motion(1.0, random);
      const double step = std::min(proof.radius, 1e3) * (1.0 - 1e-9) / direction.vector().norm();
      moved.vector() += step * direction.vector();
      const PointMotion motion = point_motions(shapes, moved)[0];
      const CycleForce force = cycle_force(p.points[i], motion);
      if (proof.state == SleepState::open) {
        ASSERT_EQ(force.regime, CycleRegime::separated);
      } else if (p.points[i].friction_coefficient > 0.0) {
        ASSERT_EQ(force.regime, CycleRegime::full_stick);
        ASSERT_EQ(force.mean_by_u_mean, p.points[i].tangential_stiffness);  // mean not clipped
      } else {
        ASSERT_EQ(force.normal_by_v[0][0], p.points[i].normal_stiffness);
      }
    }
  }
  EXPECT_GT(n_proved, 400);
}

TEST(SleepingPoints, NothingSleepsAtALimit) {
  const PointMotion still{};
  EXPECT_EQ(prove_asleep({1.0, 1.0, 0.3, 0.0}, still, 1.0, 1.0).state, SleepState::awake);
  // n₀ = B: the load touches zero.
  EXPECT_EQ(prove_asleep({1.0, 1.0, 0.0, 2.0}, {.v_sin = 2.0}, 1.0, 1.0).state, SleepState::awake);
  // L₁ + L₂ = 2q: onset of slip.
  EXPECT_EQ(prove_asleep({1.0, 0.0, 0.5, 2.0}, {.u_sin = 1.0}, 1.0, 1.0).state, SleepState::awake);
  // The mean force is at the end of its interval: stuck, but not linear.
  EXPECT_EQ(prove_asleep({1.0, 0.0, 0.5, 4.0}, {.u_mean = 5.0, .u_sin = 1.0}, 1.0, 1.0).state,
            SleepState::awake);
  EXPECT_EQ(prove_asleep({1.0, 0.0, 0.5, 4.0}, {.u_mean = 0.5, .u_sin = 1.0}, 1.0, 1.0).state,
            SleepState::stuck);
}

}  // namespace
}  // namespace microslip::contact
