/// What is hard: limits of a point with two tangential directions: no motion along one of them or
/// both, contact that only just begins or ends, no preload, events that meet, amplitudes of any
/// size. Where: theory sections 4.2, 4.5, 9. Right: finite forces that agree with the method of one
/// direction where the motion is straight, works that balance,
/// derivatives that are those of one side.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "contact/line/line_events.hpp"
#include "contact/plane/planar_cycle.hpp"
#include "support/motion_cases.hpp"
#include "support/planar_cases.hpp"

namespace microslip::test::planar_point {
namespace {

using contact::CycleRegime;
using contact::Harmonics;
using contact::LineEvents;
using contact::PlaneEvents;
using contact::PointHistory;
using contact::PointMethod;
using contact::PointParameters;
using contact::PointTraction;
using contact::SurfaceLaw;

constexpr double pi = std::numbers::pi;
constexpr double tight = 1e-11;
constexpr double smallest = 1e-290;  // what the planar method takes for no force at all

PointTraction traction(const PointMethod& method, const Harmonics& motion) {
  PointTraction result;
  method.traction(motion, 1.0, result);
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
    const PlaneEvents method(SurfaceLaw(c.point, c.point.tangential_stiffness), tight);
    const PointTraction now = traction(method, turned(c.motion, angle));
    const PointTraction exact = traction(LineEvents(c.point), c.motion);
    const double scale = friction_scale(c);
    const Eigen::VectorXd f = exact.force.rows().col(0);
    // Ten times the tolerance, as measured for any motion.
    ASSERT_LE((now.force.rows().col(0) - std::cos(angle) * f).cwiseAbs().maxCoeff(),
              10.0 * tight * scale + smallest)
        << i;
    ASSERT_LE((now.force.rows().col(2) - std::sin(angle) * f).cwiseAbs().maxCoeff(),
              10.0 * tight * scale + smallest)
        << i;
    ASSERT_LE((now.force.rows() - exact.force.rows()).col(1).cwiseAbs().maxCoeff(),
              10.0 * tight * normal_scale(c) + smallest)
        << i;
    ASSERT_TRUE(now.jacobian.allFinite()) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Strata, StraightMotion, testing::ValuesIn(motion_strata()),
                         [](const auto& instance) { return std::string(instance.param.name); });

double amplitude(const Harmonics& motion, Eigen::Index signal) {
  return motion.rows().col(signal).tail(motion.rows().rows() - 1).cwiseAbs().sum();
}

class PlaneMotion : public testing::TestWithParam<MotionStratum> {};

// Theory section 7 for two directions: ∮ f·dx = ∮ μ n |ds|, ∮ n dv = 0. The second motion is as
// large as the first and of any shape; the second stiffness another.
TEST_P(PlaneMotion, BalancesItsWork) {
  std::mt19937_64 random(52);
  for (int i = 0; i < 60; ++i) {
    MotionCase c = GetParam().draw(random);
    const double size = amplitude(c.motion, 2);
    if (size > 0.0) c.motion.rows().col(2) *= amplitude(c.motion, 0) / size;
    const double second = 2.0 * c.point.tangential_stiffness;
    const PlaneEvents method(SurfaceLaw(c.point, second), tight);
    const int H = c.motion.n_harmonics();
    const PointTraction now = traction(method, c.motion);
    ASSERT_TRUE(now.force.rows().allFinite()) << i;
    ASSERT_TRUE(now.jacobian.allFinite()) << i;
    const PointHistory history = method.history(c.motion, 1.0, {}, H);
    const double scale = friction_scale(c) + second * amplitude(c.motion, 2);
    const double way =
        c.point.tangential_stiffness > 0.0 ? scale / c.point.tangential_stiffness : 0.0;
    const double done =
        test::cycle_work(c.motion, history.force, 0) + test::cycle_work(c.motion, history.force, 2);
    // Ten times the tolerance for each force; what the search did not reach on top.
    ASSERT_NEAR(done, history.dissipated_energy,
                (20.0 * H * tight * scale + history.defect) * way + smallest)
        << i;
    ASSERT_LE(std::abs(test::cycle_work(c.motion, history.force, 1)),
              1e-12 * H * normal_scale(c) * amplitude(c.motion, 1) + smallest)
        << i;
    ASSERT_GE(history.dissipated_energy, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Strata, PlaneMotion, testing::ValuesIn(motion_strata()),
                         [](const auto& instance) { return std::string(instance.param.name); });

/// An ellipse, never separated from a load that varies.
MotionCase ellipse(double size) {
  MotionCase c{{2.0, 1.0, 0.5, 1.3}, Harmonics(1, 3)};
  c.motion.rows() << 0.0, 0.0, 0.0,  //
      size, 0.3, 0.4 * size,         //
      0.2 * size, 1.0, -0.6 * size;
  return c;
}

double force_change(const PlaneEvents& method, const Harmonics& a, const Harmonics& b) {
  return (traction(method, a).force.rows() - traction(method, b).force.rows())
      .cwiseAbs()
      .maxCoeff();
}

// No motion along one direction is the limit of ever less of it, down to subnormal numbers.
TEST(PlanarPointHard, VanishingMotionAlongOneDirectionIsTheLimitOfSmallMotion) {
  for (const double size : {0.1, 0.5, 3.0}) {
    for (const Eigen::Index signal : {0, 2}) {
      const MotionCase c = ellipse(size);
      const PlaneEvents method(SurfaceLaw(c.point, 3.0), tight);
      Harmonics none = c.motion;
      none.rows().col(signal).setZero();
      for (const double share : {1e-6, 1e-9, 1e-15, 1e-100, 1e-300, 1e-323}) {
        Harmonics little = none;
        little.rows().col(signal) = share * c.motion.rows().col(signal);
        // The stiffness at most, times ten for what turns the slip.
        ASSERT_LE(force_change(method, little, none), 30.0 * share * size + 10.0 * tight) << share;
      }
    }
  }
  const MotionCase c = ellipse(0.0);
  const PointTraction rest = traction(PlaneEvents(SurfaceLaw(c.point, 3.0), tight), c.motion);
  EXPECT_EQ(rest.regime, CycleRegime::full_stick);
  EXPECT_EQ(rest.force.rows().col(0).norm(), 0.0);
  EXPECT_EQ(rest.force.rows().col(2).norm(), 0.0);
}

// The least load passes zero: with the square root of the distance in time, smoothly in force.
TEST(PlanarPointHard, GrazingContactIsContinuous) {
  const double least = std::hypot(0.3, 1.0);
  for (const double size : {0.1, 0.5, 3.0}) {
    MotionCase c = ellipse(size);
    Eigen::MatrixXd before;
    for (const double aside : {-1e-6, -1e-8, -1e-12, -1e-16, 0.0, 1e-16, 1e-12, 1e-8, 1e-6}) {
      c.point.rest_load = least * (1.0 + aside);
      const PointTraction now = traction(PlaneEvents(SurfaceLaw(c.point, 3.0), tight), c.motion);
      // n₀ − b̄ changes by 1e-6; what the slider forgets is the force left at the least load, its
      // square root times the rate of the motion.
      if (before.size() > 0) {
        ASSERT_LE((now.force.rows() - before).cwiseAbs().maxCoeff(), 1e-2 * size + 1e-5) << aside;
      }
      before = now.force.rows();
    }
  }
}

// No preload: closed for half of the period; a gap barely touched; a gap never closed.
TEST(PlanarPointHard, ContactFadesOutWithTheGap) {
  const double reach = std::hypot(0.3, 1.0);
  MotionCase c = ellipse(0.5);
  double before = 1e300;
  for (const double share : {0.0, 0.5, 0.9, 1.0 - 1e-3, 1.0 - 1e-6, 1.0 - 1e-9, 1.0 - 1e-12}) {
    c.point.rest_load = -share * reach;
    const PlaneEvents method(SurfaceLaw(c.point, 3.0), tight);
    const PointTraction now = traction(method, c.motion);
    EXPECT_EQ(now.regime, CycleRegime::separation) << share;
    const double load = now.force.rows()(0, 1);
    EXPECT_GT(load, 0.0) << share;
    EXPECT_LT(load, before) << share;
    // |f| ≤ μ n at every instant; a load that is all but lost in the rounding of the gap keeps as
    // many digits.
    EXPECT_LE(std::hypot(now.force.rows()(0, 0), now.force.rows()(0, 2)),
              0.5 * load * (1.0 + 1e-9 + 1e-15 / (1.0 - share)))
        << share;
    before = load;
  }
  for (const double share : {1.0, 1.0 + 1e-15, 2.0}) {
    c.point.rest_load = -share * reach;
    const PointTraction now = traction(PlaneEvents(SurfaceLaw(c.point, 3.0), tight), c.motion);
    EXPECT_LE(now.force.rows().norm(), share == 1.0 ? 1e-20 : 0.0) << share;
  }
}

/// Second order, from one side.
Eigen::VectorXd one_sided(const PlaneEvents& method, const Harmonics& motion, Eigen::Index k,
                          double h) {
  const auto at = [&](double x) -> Eigen::VectorXd {
    Harmonics moved = motion;
    moved.vector()[k] += x;
    return traction(method, moved).force.vector();
  };
  return (4.0 * at(h) - 3.0 * at(0.0) - at(2.0 * h)) / (2.0 * h);
}

// At the onset of slip, exactly: the derivative is that of the stuck side, where every smaller
// motion is.
TEST(PlanarPointHard, TheJacobianAtTheOnsetOfSlipIsOneSided) {
  Harmonics circle(1, 3);
  circle.rows()(1, 0) = 1.0;
  circle.rows()(2, 2) = 1.0;
  const PlaneEvents method(SurfaceLaw({1.0, 0.5, 0.5, 2.0}, 1.0), tight);  // k a = μ n
  const PointTraction now = traction(method, circle);
  ASSERT_EQ(now.regime, CycleRegime::full_stick);
  EXPECT_EQ(now.jacobian(3, 3), 1.0);
  EXPECT_EQ(now.jacobian(8, 8), 1.0);
  for (const Eigen::Index k : {3, 8}) {
    const Eigen::VectorXd inside = one_sided(method, circle, k, -1e-6);
    EXPECT_LE((now.jacobian.col(k) - inside).cwiseAbs().maxCoeff(), 1e-9) << k;  // 1e-15/1e-6
  }
  // Beyond, slip takes what the motion adds.
  const Eigen::VectorXd outside = one_sided(method, circle, 3, 1e-4);
  EXPECT_GT((now.jacobian.col(3) - outside).cwiseAbs().maxCoeff(), 0.1);
}

// Where the load grazes zero the slider is wiped from one side only; the derivative by the mean
// load is that of the side the method is on.
TEST(PlanarPointHard, TheJacobianNextToGrazingContactIsThatOfItsSide) {
  const double least = std::hypot(0.3, 1.0);
  for (const double aside : {-1e-3, 1e-3}) {
    MotionCase c = ellipse(1.5);
    c.point.rest_load = least * (1.0 + aside);
    const PlaneEvents method(SurfaceLaw(c.point, 3.0), 1e-13);
    const PointTraction now = traction(method, c.motion);
    EXPECT_EQ(now.regime, aside < 0.0 ? CycleRegime::separation : CycleRegime::stick_slip);
    for (const Eigen::Index k : {1, 3, 4, 5, 6, 7, 8}) {
      // Away from grazing by up to 2e-6 of 1e-3: the third derivative of a square root over 1e-3 is
      // 1e7, times the square of the step.
      const Eigen::VectorXd away =
          one_sided(method, c.motion, k, k == 1 ? std::copysign(1e-6, aside) : 1e-6);
      EXPECT_LE((now.jacobian.col(k) - away).cwiseAbs().maxCoeff(), 1e-4) << k << ", " << aside;
    }
  }
}

/// Ever less friction against the same motion.
struct LittleFriction {
  double rest_load;  ///< in the unit of load
  double stiffness;  ///< k_v, against an approach of amplitude 1; likewise
  double load_unit;
  double friction_unit = 1.0;
};

constexpr double half = 0.5;  // μ in its unit

MotionCase vanishing(const LittleFriction& x) {
  const double mu = half * x.friction_unit;
  MotionCase c{{1.0, x.stiffness * x.load_unit, mu, x.rest_load * x.load_unit}, Harmonics(1, 3)};
  c.motion.rows() << 0.0, 0.0, 0.0,  //
      0.0, 0.0, 0.2,                 //
      1.0, 1.0, 0.3;
  return c;
}

/// Friction without memory, μ n x'/|x'|, by the trapezoidal rule.
struct Memoryless {
  Eigen::Matrix3d force = Eigen::Matrix3d::Zero();         ///< / (μn), as Harmonics::rows()
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(9, 9);  ///< of friction alone
  double dissipation = 0.0;
};

Memoryless memoryless(const LittleFriction& x) {
  const Harmonics motion = vanishing(x).motion;
  constexpr int n_samples = 40000;
  Memoryless sum;
  for (int i = 0; i < n_samples; ++i) {
    const double angle = 2.0 * pi * (i + 0.5) / n_samples;
    const Eigen::Vector3d basis(1.0, std::sin(angle), std::cos(angle));
    const Eigen::Vector3d rate(0.0, basis[2], -basis[1]);
    const Eigen::Vector3d x_rate = motion.rows().transpose() * rate;
    const Eigen::Vector2d v(x_rate[0], x_rate[2]);
    const Eigen::Vector2d e = v.normalized();
    const double load = x.rest_load + x.stiffness * basis[2];
    if (load <= 0.0) continue;
    const Eigen::Vector3d weight = basis.cwiseProduct(Eigen::Vector3d(1.0, 2.0, 2.0)) / n_samples;
    sum.force.col(0) += half * load * e[0] * weight;
    sum.force.col(2) += half * load * e[1] * weight;
    sum.dissipation += 2.0 * pi / n_samples * half * load * v.norm();
    const Eigen::Matrix2d turn =
        half * load / v.norm() * (Eigen::Matrix2d::Identity() - e * e.transpose());
    for (Eigen::Index k = 0; k < 3; ++k) {
      Eigen::Matrix<double, 2, 3> change;
      change << turn.col(0) * rate[k], half * x.stiffness * basis[k] * e, turn.col(1) * rate[k];
      for (Eigen::Index j = 0; j < 3; ++j) {
        sum.jacobian.block<1, 3>(3 * j, 3 * k) += weight[j] * change.row(0);
        sum.jacobian.block<1, 3>(3 * j + 2, 3 * k) += weight[j] * change.row(1);
      }
    }
  }
  return sum;
}

// Forces that are lost in the rounding of the slider, whose squares underflow, that are subnormal:
// relative to μ n all are the same.
TEST(PlanarPointHard, VanishingFrictionFollowsTheMotionWithoutMemory) {
  std::vector<LittleFriction> cases;
  for (const double n : {1e-30, 1e-100, 1e-120, 1e-140, 1e-155, 1e-200, 1e-310}) {
    cases.push_back({1.0, 0.0, n});
    cases.push_back({1.0, 1.0, n});  // touches zero load
    cases.push_back({0.5, 1.0, n});
    cases.push_back({1.0, 0.9, 1.0, n});
  }
  for (const LittleFriction& x : cases) {
    const MotionCase c = vanishing(x);
    const PlaneEvents method(SurfaceLaw(c.point, 2.0), tight);
    const PointTraction now = traction(method, c.motion);
    const double scale = x.load_unit * x.friction_unit;
    const Memoryless exact = memoryless(x);
    const std::string name = std::to_string(std::log10(scale)) + ", " + std::to_string(x.stiffness);
    // 1e-15 of the slider in its velocity, by five stages, is 1e-10 in the direction.
    constexpr double near = 1e-8;
    EXPECT_EQ(now.defect, 0.0) << name;
    for (const Eigen::Index i : {0, 2}) {
      const Eigen::Vector3d force = now.force.rows().col(i) / scale;
      EXPECT_LE((force - exact.force.col(i)).cwiseAbs().maxCoeff(), near) << name;
    }
    ASSERT_TRUE(now.jacobian.allFinite()) << name;
    const bool separates = x.rest_load < x.stiffness;
    for (Eigen::Index row = 0; row < 9 && !separates; ++row) {
      if (row % 3 == 1) continue;
      const Eigen::RowVectorXd J = now.jacobian.row(row) / scale;
      EXPECT_LE((J - exact.jacobian.row(row)).cwiseAbs().maxCoeff(), near) << name;
    }
    const Eigen::VectorXd phases = Eigen::VectorXd::LinSpaced(7, 0.1, 5.9);
    const PointHistory history = method.history(c.motion, 1.0, phases, 3);
    EXPECT_NEAR(history.dissipated_energy / scale, exact.dissipation, near) << name;
    for (Eigen::Index i = 0; i < phases.size(); ++i) {
      const Eigen::Vector3d& f = history.instants[static_cast<std::size_t>(i)].traction;
      const double load = std::max(0.0, x.rest_load + x.stiffness * std::cos(phases[i]));
      EXPECT_NEAR(std::hypot(f[0] / scale, f[2] / scale), half * load, near)
          << name << ", " << phases[i];
    }
  }
}

// Along a line friction jumps where the motion turns back, at n = 1e-6 within √(4 r/(k a)) = 2e-3.
TEST(PlanarPointHard, VanishingFrictionOfAStraightMotionIsItsSign) {
  for (const double share : {0.0, 0.3}) {
    for (const double n : {1e-6, 1e-30, 1e-155, 1e-200, 1e-310}) {
      MotionCase c = vanishing({1.0, 0.0, n});
      c.motion.rows().col(2) = share * c.motion.rows().col(0);
      const PlaneEvents method(SurfaceLaw(c.point, 2.0), tight);
      const PointTraction now = traction(method, c.motion);
      const Eigen::Vector3d f = now.force.rows().col(0) / n;
      const double along = 1.0 / std::hypot(1.0, share);
      constexpr double near = 2e-3;
      EXPECT_NEAR(f[1], -0.5 * along * 4.0 / pi, near) << n;
      EXPECT_NEAR(f[2], 0.0, near) << n;
      EXPECT_TRUE(now.jacobian.allFinite()) << n;
      const PointHistory history = method.history(c.motion, 1.0, {}, 1);
      EXPECT_NEAR(history.dissipated_energy / n, 0.5 * 4.0 / along, near) << n;
    }
  }
  const MotionCase none = vanishing({0.0, 0.0, 1.0});
  const PointTraction now = traction(PlaneEvents(SurfaceLaw(none.point, 2.0), tight), none.motion);
  EXPECT_EQ(now.force.rows().norm(), 0.0);
}

// exp(−λσ) underflows where the motion is fast, or everywhere.
TEST(PlanarPointHard, FrictionThatUnderflowsWithTheRateIsNone) {
  for (const double decay : {600.0, 2e3, 2e4, 1e6, 1e9}) {
    for (const double preload : {2.0, 1.0, 0.8}) {
      for (const double second : {0.0, 0.02, 0.2}) {
        MotionCase c = vanishing({preload, 1.0, 1.0});
        c.motion.rows().col(2) *= second;
        const contact::FrictionLaw friction = contact::FrictionLaw::exponential(0.3, 0.0, decay);
        const PlaneEvents method(SurfaceLaw(c.point, 2.0, friction), tight);
        const PointTraction now = traction(method, c.motion);
        ASSERT_TRUE(now.force.rows().allFinite() && now.jacobian.allFinite()) << decay;
        // |f| ≤ μ n: at most the part of the period with λσ < 1, at either turn, and its tail.
        const double most = 2.0 * 0.3 * (preload + 1.0) * 4.0 / decay;
        EXPECT_LE(now.force.rows().col(0).cwiseAbs().maxCoeff(), most) << decay;
        const PointHistory history = method.history(c.motion, 1.0, {}, 1);
        const double done = test::cycle_work(c.motion, history.force, 0) +
                            test::cycle_work(c.motion, history.force, 2);
        // Ten times the tolerance for each force, along the way.
        EXPECT_NEAR(done, history.dissipated_energy, 20.0 * tight) << decay << ", " << second;
      }
    }
  }
}

}  // namespace
}  // namespace microslip::test::planar_point
