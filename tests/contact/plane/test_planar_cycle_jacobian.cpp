// Derivatives of the converged planar cycle against central differences of the forces.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "contact/plane/planar_cycle.hpp"

namespace microslip::contact::test_planar_cycle_jacobian {
namespace {

// Forces are known to 1e-12 of their scale; with this step the differences err by 1e-12/1e-5 = 1e-7
// and by the third derivative times 1e-10, which is large only beside events that appear or vanish.
constexpr double step = 1e-5;
constexpr double tight = 1e-12;

Eigen::VectorXd difference(const PlaneEvents& method, const Harmonics& motion, Eigen::Index j) {
  Harmonics plus = motion;
  Harmonics minus = motion;
  plus.vector()[j] += step;
  minus.vector()[j] -= step;
  PointTraction right;
  PointTraction left;
  method.traction(plus, 1.0, right);
  method.traction(minus, 1.0, left);
  return (right.force.vector() - left.force.vector()) / (2.0 * step);
}

double jacobian_error(const PlaneEvents& method, const Harmonics& motion,
                      const PointTraction& traction) {
  double error = 0.0;
  for (Eigen::Index j = 0; j < motion.vector().size(); ++j) {
    const Eigen::VectorXd expected = difference(method, motion, j);
    error = std::max(error, (expected - traction.jacobian.col(j)).cwiseAbs().maxCoeff());
  }
  return error / traction.jacobian.cwiseAbs().maxCoeff();
}

TEST(PlaneEventsJacobian, MeetsCentralDifferencesOnRandomOrbits) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> g;
  int tested = 0;
  for (int i = 0; i < 90; ++i) {
    Harmonics motion(1 + i % 3, 3);
    const PointParameters point{std::exp(g(random)), std::exp(g(random)),
                                std::exp(0.7 * g(random) - 0.5), 1.5 * g(random) + 0.7};
    const double k_w = i % 4 == 0 ? point.tangential_stiffness : std::exp(g(random));
    for (Eigen::Index row = 0; row < motion.rows().rows(); ++row) {
      for (Eigen::Index signal = 0; signal < 3; ++signal) {
        motion.rows()(row, signal) = g(random) / (1.0 + static_cast<double>(row / 2));
      }
    }
    const PlaneEvents method(SurfaceLaw(point, k_w), tight);
    PointTraction traction;
    method.traction(motion, 1.0, traction);
    if (traction.regime == CycleRegime::separated) continue;
    ++tested;
    EXPECT_LT(jacobian_error(method, motion, traction), 5e-6)
        << "case " << i << ", regime " << static_cast<int>(traction.regime);
    EXPECT_TRUE(traction.frequency_derivative.isZero(0.0));
  }
  EXPECT_GT(tested, 60);
}

Harmonics lissajous() {
  Harmonics motion(2, 3);
  motion.rows() << 0.1, 0.2, -0.3,  //
      1.0, 0.4, 0.2,                //
      0.3, -0.6, 0.8,               //
      0.2, 0.3, 0.4,                //
      -0.5, 0.1, 0.1;
  return motion;
}

// ∂/∂ω as well: the coefficient falls with the speed ω hypot(u', w').
TEST(PlaneEventsJacobian, OfARateDependentCoefficientMeetsDifferences) {
  for (const FrictionLaw& friction :
       {FrictionLaw::exponential(0.8, 0.3, 0.7), FrictionLaw::hyperbolic(0.7, 0.4)}) {
    for (const double preload : {0.6, 2.0}) {
      const PlaneEvents method(SurfaceLaw({2.0, 1.5, 0.6, preload}, 0.7, friction), tight);
      PointTraction traction;
      method.traction(lissajous(), 1.0, traction);
      EXPECT_LT(jacobian_error(method, lissajous(), traction), 5e-6) << "preload " << preload;
      PointTraction faster;
      PointTraction slower;
      method.traction(lissajous(), 1.0 + step, faster);
      method.traction(lissajous(), 1.0 - step, slower);
      const Eigen::VectorXd expected =
          (faster.force.vector() - slower.force.vector()) / (2.0 * step);
      EXPECT_GT(expected.norm(), 1e-3);
      EXPECT_LT((expected - traction.frequency_derivative).cwiseAbs().maxCoeff(), 1e-6);
    }
  }
}

// Along a line the speed passes zero. A coefficient that rises with it leaves the slider there, at
// a kink that moves with the motion.
TEST(PlaneEventsJacobian, OfACoefficientThatRisesWithTheRateMeetsDifferencesAlongALine) {
  for (const double angle : {0.0, 0.5 * std::numbers::pi, 0.7}) {
    Harmonics motion(2, 3);
    motion.rows().col(1) << 0.0, 0.2, 0.3, 0.05, 0.1;
    const Eigen::VectorXd way = (Eigen::VectorXd(5) << 0.0, 1.0, 0.2, 0.1, -0.1).finished();
    motion.rows().col(0) = std::cos(angle) * way;
    motion.rows().col(2) = std::sin(angle) * way;
    const PlaneEvents method(
        SurfaceLaw({1.0, 0.5, 0.3, 1.0}, 1.0, FrictionLaw::exponential(0.3, 0.9, 2.0)), tight);
    PointTraction now;
    method.traction(motion, 1.0, now);
    ASSERT_EQ(now.regime, CycleRegime::stick_slip);
    // Motions that stay on the line.
    for (Eigen::Index k = 0; k < 5; ++k) {
      Harmonics plus = motion;
      Harmonics minus = motion;
      for (const auto& [signal, share] :
           {std::pair{0, std::cos(angle)}, std::pair{2, std::sin(angle)}}) {
        plus.rows()(k, signal) += step * share;
        minus.rows()(k, signal) -= step * share;
      }
      PointTraction right;
      PointTraction left;
      method.traction(plus, 1.0, right);
      method.traction(minus, 1.0, left);
      const Eigen::VectorXd expected = (right.force.vector() - left.force.vector()) / (2.0 * step);
      const Eigen::VectorXd along =
          std::cos(angle) * now.jacobian.col(3 * k) + std::sin(angle) * now.jacobian.col(3 * k + 2);
      EXPECT_LE((along - expected).cwiseAbs().maxCoeff(), 1e-6) << k << ", " << angle;
      const Eigen::VectorXd by_load = now.jacobian.col(3 * k + 1);
      EXPECT_LE((by_load - difference(method, motion, 3 * k + 1)).cwiseAbs().maxCoeff(), 1e-6) << k;
    }
  }
}

TEST(PlaneEventsJacobian, OfRoughSurfacesMeetsDifferences) {
  for (const RoughSurface& rough :
       {RoughSurface::cubic(0.8), RoughSurface::matching_gaussian(0.8)}) {
    for (const double preload : {0.3, 2.0}) {
      const PlaneEvents method(
          SurfaceLaw({2.0, 1.5, 0.6, preload}, 2.0, FrictionLaw::constant(0.6), rough), tight);
      PointTraction traction;
      method.traction(lissajous(), 1.0, traction);
      EXPECT_LT(jacobian_error(method, lissajous(), traction), 5e-6) << "preload " << preload;
    }
  }
}

// Bodies in series, unequal along p and r: the ratio of the stiffnesses depends on v.
TEST(PlaneEventsJacobian, OfBodiesOfUnequalStiffnessMeetsDifferences) {
  const SeriesCompliance series{0.3, 0.2, 2.0};
  for (const RoughSurface& rough :
       {RoughSurface::cubic(0.8), RoughSurface::matching_gaussian(0.8)}) {
    for (const double preload : {-0.1, 0.3, 2.0, 12.0}) {
      const PlaneEvents method(SurfaceLaw({2.0, 1.5, 0.6, preload}, 1.3,
                                          FrictionLaw::hyperbolic(0.7, 0.4), rough, series),
                               tight);
      PointTraction traction;
      method.traction(lissajous(), 1.0, traction);
      EXPECT_LT(jacobian_error(method, lissajous(), traction), 5e-6) << "preload " << preload;
    }
  }
}

Harmonics stuck_motion() {
  Harmonics motion(1, 3);
  motion.rows() << 0.02, 0.0, -0.01,  //
      0.05, 0.2, 0.01,                //
      0.01, 0.1, 0.04;
  return motion;
}

TEST(PlaneEventsJacobian, OfAVirginStuckPointIsItsStiffness) {
  const PlaneEvents method(SurfaceLaw({2.0, 1.0, 0.5, 1.0}, 3.0), tight);
  PointTraction traction;
  method.traction(stuck_motion(), 1.0, traction);
  EXPECT_EQ(traction.regime, CycleRegime::full_stick);
  const Eigen::Vector3d k(2.0, 1.0, 3.0);
  EXPECT_EQ(method.stuck_stiffness(), k);
  for (Eigen::Index i = 0; i < 9; ++i) {
    for (Eigen::Index j = 0; j < 9; ++j) {
      EXPECT_NEAR(traction.jacobian(i, j), i == j ? k[i % 3] : 0.0, 1e-14);
    }
  }
}

// A large mean drags the virgin slider: the point ends up stuck with a mean that depends on the
// motion.
TEST(PlaneEventsJacobian, OfADraggedStuckPointMeetsDifferences) {
  const PlaneEvents method(SurfaceLaw({2.0, 1.0, 0.5, 1.0}, 3.0), tight);
  Harmonics motion = stuck_motion();
  motion.rows()(0, 0) = 0.7;
  motion.rows()(0, 2) = 0.4;
  PointTraction traction;
  method.traction(motion, 1.0, traction);
  EXPECT_EQ(traction.regime, CycleRegime::full_stick);
  EXPECT_LT(jacobian_error(method, motion, traction), 1e-6);
  EXPECT_GT(traction.jacobian.row(0).segment(3, 6).norm(), 0.01);
}

}  // namespace
}  // namespace microslip::contact::test_planar_cycle_jacobian
