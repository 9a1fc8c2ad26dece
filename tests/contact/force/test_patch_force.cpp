#include "contact/force/patch_force.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "contact/closed_form/friction_cycle.hpp"
#include "contact/patch/point_motions.hpp"
#include "tests/support/asked_force.hpp"
#include "tests/support/readable_patch.hpp"

namespace microslip::contact::test_patch_force {
namespace {

constexpr Eigen::Index n_modes = 4;

ContactPatch random_patch(Eigen::Index n, double preload, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  Eigen::VectorXd weights(n);
  std::vector<PointParameters> points;
  for (Eigen::Index i = 0; i < n; ++i) {
    weights[i] = 0.1 + u(random);
    points.push_back({0.5 + u(random), 0.5 + u(random), 0.3 + u(random), preload * u(random)});
  }
  return {weights, points};
}

ModalShapes random_shapes(Eigen::Index n, unsigned seed) {
  std::srand(seed);
  ModalShapes shapes;
  shapes.u = Eigen::MatrixXd::Random(n, n_modes);
  shapes.v = Eigen::MatrixXd::Random(n, n_modes);
  return shapes;
}

Harmonics random_motion(unsigned seed) {
  std::srand(seed);
  Harmonics q(1, n_modes);
  q.rows().setRandom();
  return q;
}

// The sum of the theory, point by point with dense matrices.
ForceAndJacobian by_definition(const tests::ReadablePatch& patch, const Harmonics& q) {
  const Eigen::Index N = patch.n_modes();
  ForceAndJacobian sum{Harmonics(1, N), Eigen::MatrixXd::Zero(3 * N, 3 * N), {}};
  const std::vector<PointMotion> motions = point_motions(patch.shapes(), q);
  for (Eigen::Index i = 0; i < patch.patch().n_points(); ++i) {
    const PointParameters& point = patch.patch().points()[static_cast<std::size_t>(i)];
    const FrictionCycle c = friction_cycle(point, motions[static_cast<std::size_t>(i)]);
    Eigen::MatrixXd Phi = Eigen::MatrixXd::Zero(6, 3 * N);
    for (Eigen::Index h = 0; h < 3; ++h) {
      Phi.block(h, h * N, 1, N) = patch.shapes().u.row(i);
      Phi.block(3 + h, h * N, 1, N) = patch.shapes().v.row(i);
    }
    Eigen::VectorXd f(6);
    f << c.friction.mean, c.friction.sin, c.friction.cos,
        c.normal.mean - std::max(point.rest_load, 0.0), c.normal.sin, c.normal.cos;
    const double w = patch.patch().weights()[i];
    sum.force.vector() += w * Phi.transpose() * f;
    sum.jacobian += w * Phi.transpose() * c.jacobian * Phi;
  }
  return sum;
}

class PatchForceSizes : public testing::TestWithParam<int> {};

// Blocks of 64 points, whole, broken and padded; sums of n terms in another order: n roundings.
TEST_P(PatchForceSizes, IsTheWeightedSumOverThePoints) {
  const Eigen::Index n = GetParam();
  for (const double preload : {-2.0, 0.0, 0.5, 3.0}) {
    const tests::ReadablePatch patch(random_patch(n, preload, 1), random_shapes(n, 2));
    const Harmonics q = random_motion(3);
    const ForceAndJacobian ours = tests::evaluate(patch, q, 1.0);
    const ForceAndJacobian expected = by_definition(patch, q);
    const double rounding = 1e-15 * static_cast<double>(n);
    EXPECT_LE((ours.force.vector() - expected.force.vector()).cwiseAbs().maxCoeff(),
              10.0 * rounding);
    EXPECT_LE((ours.jacobian - expected.jacobian).cwiseAbs().maxCoeff(), 10.0 * rounding);
    EXPECT_TRUE(ours.frequency_derivative.isZero(0.0));
    EXPECT_EQ(ours.frequency_derivative.size(), 3 * n_modes);
  }
}
INSTANTIATE_TEST_SUITE_P(Counts, PatchForceSizes, testing::Values(1, 2, 63, 64, 65, 130));

TEST(PatchForce, JacobianAgreesWithCentralDifferences) {
  PatchForce patch(random_patch(50, 1.0, 4), random_shapes(50, 5));
  const Harmonics q = random_motion(6);
  const Eigen::MatrixXd J = tests::evaluate(patch, q, 1.0).jacobian;
  // 50 points: none within h = 1e-6 of a kink at this seed; truncation h² times curvatures that
  // grow near kinks, rounding 1e-15/h = 1e-9.
  const double h = 1e-6;
  for (Eigen::Index k = 0; k < q.vector().size(); ++k) {
    Harmonics up = q;
    Harmonics down = q;
    up.vector()[k] += h;
    down.vector()[k] -= h;
    const Eigen::VectorXd difference = (tests::evaluate(patch, up, 1.0).force.vector() -
                                        tests::evaluate(patch, down, 1.0).force.vector()) /
                                       (2.0 * h);
    EXPECT_LE((difference - J.col(k)).cwiseAbs().maxCoeff(), 1e-7) << k;
  }
}

TEST(PatchForce, EqualInputGivesEqualBits) {
  PatchForce patch(random_patch(777, 1.0, 7), random_shapes(777, 8));
  const Harmonics q = random_motion(9);
  const ForceAndJacobian a = tests::evaluate(patch, q, 1.0);
  const ForceAndJacobian b = tests::evaluate(patch, q, 2.0);
  EXPECT_EQ(a.force.vector(), b.force.vector());
  EXPECT_EQ(a.jacobian, b.jacobian);
}

// Points fall asleep and wake up on the way: who sleeps depends on the motion alone.
TEST(PatchForce, GivesTheSameBitsWhateverWasAskedBefore) {
  const ContactPatch points = random_patch(300, 6.0, 10);
  const ModalShapes shapes = random_shapes(300, 11);
  const PatchForce force(points, shapes);
  const auto walked = force.workspace();
  Harmonics q = random_motion(12);
  q.vector() *= 30.0;
  double least_awake = 1.0;
  double most_awake = 0.0;
  for (int step = 0; step < 40; ++step) {
    q.vector() *= step < 20 ? 0.8 : 1.2;
    const ForceAndJacobian a = tests::evaluate(force, q, 1.0, *walked);
    const ForceAndJacobian b = tests::evaluate(force, q, 1.0);
    ASSERT_EQ(a.force.vector(), b.force.vector());
    ASSERT_EQ(a.jacobian, b.jacobian);
    const double awake = force.report(q, 1.0, *walked).awake_share;
    least_awake = std::min(least_awake, awake);
    most_awake = std::max(most_awake, awake);
  }
  EXPECT_LT(least_awake, 0.3);
  EXPECT_GT(most_awake, 0.8);
}

TEST(PatchForce, PowersOfTwoScaleBitByBit) {
  const Eigen::Index n = 100;
  const ContactPatch patch = random_patch(n, 0.7, 10);
  std::vector<PointParameters> points = patch.points();
  for (PointParameters& point : points) {
    point.rest_load *= 0.125;
  }
  const ModalShapes shapes = random_shapes(n, 11);
  const Harmonics q = random_motion(12);
  Harmonics small = q;
  small.vector() *= 0.125;
  const ForceAndJacobian a = tests::evaluate(PatchForce(patch, shapes), q, 1.0);
  const ForceAndJacobian b =
      tests::evaluate(PatchForce(ContactPatch(patch.weights(), points), shapes), small, 1.0);
  EXPECT_EQ((0.125 * a.force.vector()).eval(), b.force.vector());
  EXPECT_EQ(a.jacobian, b.jacobian);
}

// M11: with a preload that nothing can overcome the force is linear, with the stuck stiffness.
TEST(PatchForce, StuckLimitIsTheStuckStiffness) {
  PatchForce patch(ContactPatch(Eigen::VectorXd::Constant(70, 0.3),
                                std::vector<PointParameters>(70, {2.0, 3.0, 0.5, 1e3})),
                   random_shapes(70, 13));
  const Harmonics q = random_motion(14);
  const ForceAndJacobian ours = tests::evaluate(patch, q, 1.0);
  const Eigen::MatrixXd K = patch.stuck_stiffness();
  const Eigen::MatrixXd expected = q.rows() * K;
  // The load is a difference from 1000: 1e3 · 70 points · 1e-16.
  EXPECT_LE((ours.force.rows() - expected).cwiseAbs().maxCoeff(), 1e-11);
  for (Eigen::Index h = 0; h < 3; ++h) {
    EXPECT_LE(
        (ours.jacobian.block(h * n_modes, h * n_modes, n_modes, n_modes) - K).cwiseAbs().maxCoeff(),
        1e-13);  // sums of 70 products of order one
  }
}

TEST(PatchForce, PointsWithoutFrictionDoNotStick) {
  const ModalShapes shapes = random_shapes(5, 15);
  PatchForce patch(
      ContactPatch(Eigen::VectorXd::Ones(5), std::vector<PointParameters>(5, {2.0, 3.0, 0.0, 1.0})),
      shapes);
  EXPECT_LE((patch.stuck_stiffness() - 3.0 * shapes.v.transpose() * shapes.v).cwiseAbs().maxCoeff(),
            1e-14);  // five products
}

// Energy: the modal force does the work of slip, and what the springs store comes back.
TEST(PatchForce, WorkOfTheModalForceIsTheWorkOfSlip) {
  for (const double preload : {-1.0, 0.0, 0.6, 2.0}) {
    PatchForce patch(random_patch(200, preload, 16), random_shapes(200, 17));
    const Harmonics q = random_motion(18);
    const ForceAndJacobian f = tests::evaluate(patch, q, 1.0);
    const double work =
        std::numbers::pi * (q.sine().dot(f.force.cosine()) - q.cosine().dot(f.force.sine()));
    // 200 points of work of order one.
    EXPECT_NEAR(work, tests::report(patch, q, 1.0).slip_work, 1e-12);
  }
}

TEST(PatchForce, SplittingAPointInTwoHalvesChangesNothing) {
  const ContactPatch whole = random_patch(3, 0.7, 19);
  const ModalShapes shapes = random_shapes(3, 20);
  Eigen::VectorXd weights(6);
  weights << 0.5 * whole.weights(), 0.5 * whole.weights();
  std::vector<PointParameters> points = whole.points();
  points.insert(points.end(), whole.points().begin(), whole.points().end());
  ModalShapes twice{Eigen::MatrixXd(6, n_modes), Eigen::MatrixXd(6, n_modes), {}};
  twice.u << shapes.u, shapes.u;
  twice.v << shapes.v, shapes.v;
  const Harmonics q = random_motion(21);
  const ForceAndJacobian a = tests::evaluate(PatchForce(whole, shapes), q, 1.0);
  const ForceAndJacobian b =
      tests::evaluate(PatchForce(ContactPatch(weights, points), twice), q, 1.0);
  // Six products of order one in another order.
  EXPECT_LE((a.force.vector() - b.force.vector()).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LE((a.jacobian - b.jacobian).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(PatchForce, TellsTheRegimeOfEachPoint) {
  // One mode, φ_u = φ_v = 1, q = sin θ: u and v of amplitude 1.
  const std::vector<PointParameters> points{{1.0, 0.0, 0.5, 10.0},    // 5 N hold 1 N
                                            {1.0, 0.0, 0.5, 1.0},     // 0.5 N do not
                                            {1.0, 2.0, 0.5, 1.0},     // 2 N lift 1 N
                                            {1.0, 2.0, 0.5, -10.0}};  // a gap of 5
  const ModalShapes shapes{Eigen::MatrixXd::Ones(4, 1), Eigen::MatrixXd::Ones(4, 1), {}};
  PatchForce force(ContactPatch(Eigen::VectorXd::Ones(4), points), shapes);
  Harmonics q(1, 1);
  q.rows()(1, 0) = 1.0;
  const ContactStates states = tests::states(force, q, 1.0);
  ASSERT_EQ(states.size(), 4U);
  EXPECT_EQ(states[0].cycle.regime, CycleRegime::full_stick);
  EXPECT_EQ(states[1].cycle.regime, CycleRegime::stick_slip);
  EXPECT_EQ(states[2].cycle.regime, CycleRegime::separation);
  EXPECT_EQ(states[3].cycle.regime, CycleRegime::separated);
  EXPECT_THROW((void)tests::states(force, Harmonics(2, 1), 1.0), std::invalid_argument);
}

TEST(PatchForce, RefusesWhatDoesNotFit) {
  EXPECT_THROW(PatchForce(random_patch(3, 1.0, 1), random_shapes(4, 1)), std::invalid_argument);
  ModalShapes broken = random_shapes(3, 1);
  broken.v(1, 1) = std::nan("");
  EXPECT_THROW(PatchForce(random_patch(3, 1.0, 1), broken), std::invalid_argument);
  PatchForce patch(random_patch(3, 1.0, 1), random_shapes(3, 1));
  EXPECT_THROW((void)tests::evaluate(patch, Harmonics(2, n_modes), 1.0), std::invalid_argument);
  EXPECT_THROW((void)tests::evaluate(patch, Harmonics(1, n_modes + 1), 1.0), std::invalid_argument);
  EXPECT_THROW((void)tests::report(patch, Harmonics(0, n_modes), 1.0), std::invalid_argument);
}

TEST(PatchForce, DoesNotReadTheShapesItHasNoUseFor) {
  ModalShapes shapes = random_shapes(3, 1);
  shapes.w = Eigen::MatrixXd::Constant(3, n_modes, std::nan(""));
  PatchForce patch(random_patch(3, 1.0, 1), shapes);
  EXPECT_TRUE(tests::evaluate(patch, random_motion(2), std::nan("")).jacobian.allFinite());
}

}  // namespace
}  // namespace microslip::contact::test_patch_force
