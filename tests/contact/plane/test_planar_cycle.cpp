#include "contact/plane/planar_cycle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

#include "support/cycle_cases.hpp"

namespace microslip::contact::test_planar_cycle {
namespace {

constexpr double tight = 1e-11;

// Theory section 9: u = a (cos θ, sin θ), constant load.
TEST(PlaneEvents, CircularMotionHasItsClosedForm) {
  const double k = 2.0e6;
  const double limit = 0.3 * 1e3;
  for (const double a : {1.6e-4, 3.5e-4, 2e-3}) {
    const PlaneEvents law(SurfaceLaw({k, 1e6, 0.3, 1e3}, k), tight);
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

/// Motion u of a single direction, along (cos, sin) of an angle.
Harmonics straight(const PointMotion& m, double angle) {
  const Eigen::Vector3d u(m.u_mean, m.u_sin, m.u_cos);
  Harmonics motion(1, 3);
  motion.rows().col(0) = std::cos(angle) * u;
  motion.rows().col(1) << m.v_mean, m.v_sin, m.v_cos;
  motion.rows().col(2) = std::sin(angle) * u;
  return motion;
}

double straight_error(const PlaneEvents& law, const test::CycleCase& c, double angle) {
  const FrictionCycle expected = friction_cycle(c.point, c.motion);
  PointTraction traction;
  law.traction(straight(c.motion, angle), 1.0, traction);
  const Eigen::Vector3d f(expected.friction.mean, expected.friction.sin, expected.friction.cos);
  const Eigen::Vector3d n(expected.normal.mean, expected.normal.sin, expected.normal.cos);
  const auto& rows = traction.force.rows();
  const double friction = (rows.col(0) - std::cos(angle) * f).cwiseAbs().maxCoeff() +
                          (rows.col(2) - std::sin(angle) * f).cwiseAbs().maxCoeff();
  const double load = (rows.col(1) - n).cwiseAbs().maxCoeff();
  return std::max(friction / test::friction_scale(c), load / test::normal_scale(c));
}

TEST(PlaneEvents, StraightMotionInAnyDirectionIsTheLawOfOneDirection) {
  test::Random random(5);
  for (int i = 0; i < 500; ++i) {
    const test::CycleCase c = test::generic_case(random);
    const PlaneEvents law(SurfaceLaw(c.point, c.point.tangential_stiffness), 1e-10);
    EXPECT_LT(straight_error(law, c, 0.37 + i), 1e-9) << "case " << i;
  }
}

TEST(PlaneEvents, StraightMotionAlongAnAxisFeelsTheStiffnessOfThatAxisAlone) {
  test::Random random(6);
  for (int i = 0; i < 100; ++i) {
    const test::CycleCase c = test::generic_case(random);
    const double k = c.point.tangential_stiffness;
    for (const double other : {0.0, 0.3 * k, 5.0 * k}) {
      const PlaneEvents along_p(SurfaceLaw(c.point, other), 1e-10);
      EXPECT_LT(straight_error(along_p, c, 0.0), 1e-9) << "case " << i;
      PointParameters turned = c.point;
      turned.tangential_stiffness = other;
      const PlaneEvents along_r(SurfaceLaw(turned, k), 1e-10);
      EXPECT_LT(straight_error(along_r, c, 0.5 * std::numbers::pi), 1e-9) << "case " << i;
    }
  }
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

TEST(PlaneEvents, TurningTheMotionTurnsTheForce) {
  const PlaneEvents law(SurfaceLaw({2.0, 1.5, 0.6, 0.9}, 2.0), tight);
  const Harmonics motion = lissajous();
  PointTraction plain;
  law.traction(motion, 1.0, plain);
  for (const double angle : {0.3, 1.7, 4.0}) {
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    R(0, 0) = R(2, 2) = std::cos(angle);
    R(2, 0) = std::sin(angle);
    R(0, 2) = -R(2, 0);
    Harmonics turned(2, 3);
    turned.rows() = motion.rows() * R.transpose();
    PointTraction traction;
    law.traction(turned, 1.0, traction);
    const Eigen::MatrixXd expected = plain.force.rows() * R.transpose();
    EXPECT_LT((traction.force.rows() - expected).cwiseAbs().maxCoeff(), 10.0 * tight);
  }
}

// Sums over instants meet the coefficients of the same cycle: what maps show is what the solver
// feels.
TEST(PlaneEvents, InstantsAddUpToTheCoefficients) {
  const PlaneEvents law(SurfaceLaw({2.0, 1.5, 0.6, 0.9}, 0.7), 1e-10);
  constexpr int n = 4000;
  const Eigen::VectorXd phases =
      Eigen::VectorXd::LinSpaced(n, 0.0, 2.0 * std::numbers::pi * (n - 1) / n);
  const PointHistory history = law.history(lissajous(), 1.0, phases, 2);
  Eigen::Vector3d sine = Eigen::Vector3d::Zero();
  for (int i = 0; i < n; ++i) {
    const PointInstant& now = history.instants[static_cast<std::size_t>(i)];
    sine += 2.0 / n * std::sin(phases[i]) * now.traction;
    const double friction = std::hypot(now.traction[0], now.traction[2]);
    EXPECT_LE(friction, 0.6 * now.traction[1] * (1.0 + 1e-12) + 1e-14);
    if (now.state == ContactState::slip) {
      EXPECT_NEAR(friction, 0.6 * now.traction[1], 1e-9);
    }
    if (now.state == ContactState::separated) {
      EXPECT_EQ(now.traction.norm(), 0.0);
    }
  }
  // Forces have kinks: the sum of n samples errs by about 1/n².
  EXPECT_LT((sine - history.force.sine(1).transpose()).cwiseAbs().maxCoeff(), 1e-5);
  double length = 0.0;
  for (const CycleSegment& segment : history.segments) length += segment.length;
  EXPECT_NEAR(length, 2.0 * std::numbers::pi, 1e-12);
}

TEST(PlaneEvents, TractionAloneIsThatWithDerivatives) {
  for (const auto& [load, regime] :
       {std::pair{0.9, CycleRegime::separation}, std::pair{3.0, CycleRegime::stick_slip},
        std::pair{50.0, CycleRegime::full_stick}}) {
    const PlaneEvents law(SurfaceLaw({2.0, 1.5, 0.6, load}, 2.0));
    PointTraction whole;
    PointTraction alone;
    law.traction(lissajous(), 1.0, whole);
    law.traction_alone(lissajous(), 1.0, alone);
    EXPECT_EQ(alone.force.vector(), whole.force.vector());
    EXPECT_EQ(alone.regime, whole.regime);
    EXPECT_EQ(alone.regime, regime);
    EXPECT_EQ(alone.defect, whole.defect);
    EXPECT_EQ(alone.jacobian.size(), 0);
  }
}

TEST(PlaneEvents, WithoutFrictionOnlyTheLoadIsLeft) {
  PointTraction traction;
  for (const auto& [mu, k] : {std::pair{0.0, 2.0}, std::pair{0.5, 0.0}}) {
    const PlaneEvents law(SurfaceLaw({k, 1.5, mu, 0.9}, k), tight);
    law.traction(lissajous(), 1.0, traction);
    EXPECT_EQ(traction.force.rows().col(0).norm(), 0.0);
    EXPECT_EQ(traction.force.rows().col(2).norm(), 0.0);
    EXPECT_GT(traction.force.mean()[1], 0.9);
    const PointHistory history = law.history(lissajous(), 1.0, Eigen::VectorXd(), 2);
    EXPECT_EQ(history.dissipated_energy, 0.0);
  }
}

TEST(PlaneEvents, AGapNeverClosedIsAsleep) {
  const PlaneEvents law(SurfaceLaw({2.0, 1.0, 0.5, -5.0}, 3.0), tight);
  PointTraction traction;
  law.traction(lissajous(), 1.0, traction);
  EXPECT_EQ(traction.regime, CycleRegime::separated);
  EXPECT_EQ(traction.force.vector().norm(), 0.0);
  EXPECT_EQ(traction.jacobian.norm(), 0.0);
}

TEST(PlaneEvents, ALooserToleranceIsMet) {
  PointTraction exact;
  PlaneEvents(SurfaceLaw({2.0, 1.5, 0.6, 0.9}, 0.7), 1e-13).traction(lissajous(), 1.0, exact);
  for (const double tolerance : {1e-10, 1e-8, 1e-6, 1e-4}) {
    PointTraction traction;
    PlaneEvents(SurfaceLaw({2.0, 1.5, 0.6, 0.9}, 0.7), tolerance)
        .traction(lissajous(), 1.0, traction);
    const double error = (traction.force.vector() - exact.force.vector()).cwiseAbs().maxCoeff();
    EXPECT_LT(error, 10.0 * tolerance);
  }
}

// Motion and preload times a power of two: forces follow, derivatives stay, to the last bit.
TEST(PlaneEvents, ForcesFollowTheUnitToTheLastBit) {
  Eigen::VectorXd phases(2);
  phases << 0.3, 4.0;
  for (const double preload : {0.9, 5.0, 60.0}) {
    const PointParameters point{2.0, 1.5, 0.6, preload};
    PointTraction plain;
    PlaneEvents(SurfaceLaw(point, 0.7, FrictionLaw::hyperbolic(0.6, 0.2)), tight)
        .traction(lissajous(), 1.0, plain);
    for (const int exponent : {-330, -200, -1, 3, 200, 330}) {
      const double unit = std::ldexp(1.0, exponent);
      PointParameters scaled = point;
      scaled.rest_load *= unit;
      Harmonics motion = lissajous();
      motion.rows() *= unit;
      const PlaneEvents law(SurfaceLaw(scaled, 0.7, FrictionLaw::hyperbolic(0.6, 0.2)), tight);
      PointTraction traction;
      law.traction(motion, 1.0 / unit, traction);
      EXPECT_EQ(traction.force.vector() / unit, plain.force.vector()) << exponent;
      EXPECT_EQ(traction.jacobian, plain.jacobian) << exponent;
      EXPECT_EQ(traction.frequency_derivative / unit / unit, plain.frequency_derivative);
      const PointHistory history = law.history(motion, 1.0 / unit, phases, 2);
      EXPECT_EQ(history.force.vector() / unit, plain.force.vector());
      EXPECT_EQ(history.instants[0].motion / unit, lissajous().at(0.3));
    }
  }
}

// All sizes that a scene may give, and lengths of kilometres; stiffness as of metals.
TEST(PlaneEvents, NoAmplitudeIsTooSmallOrTooLarge) {
  for (const double size : {1e-100, 1e-50, 1e-15, 1e3}) {
    for (const double preload : {0.0, 1e-100, 1e6}) {
      Harmonics motion = lissajous();
      motion.rows() *= size;
      const PlaneEvents law(SurfaceLaw({2e12, 1.5e12, 0.6, preload}, 0.7e12), tight);
      PointTraction traction;
      law.traction(motion, 1.0, traction);
      EXPECT_TRUE(traction.force.vector().allFinite()) << size;
      EXPECT_TRUE(traction.jacobian.allFinite()) << size;
      EXPECT_GT(traction.force.rows().col(0).cwiseAbs().maxCoeff(), 0.0) << size << ", " << preload;
      EXPECT_GT(traction.force.rows().col(2).cwiseAbs().maxCoeff(), 0.0) << size << ", " << preload;
    }
  }
}

// A mean beyond all measure only says from where the slider is dragged.
TEST(PlaneEvents, AMeanBeyondAllMeasureIsDragged) {
  Harmonics motion = lissajous();
  motion.rows().bottomRows(4).col(1).setZero();
  motion.rows().bottomRows(4) *= 0.01;
  motion.rows().row(0) << 3e200, 0.0, -4e200;
  PointTraction traction;
  PlaneEvents(SurfaceLaw({2.0, 1.5, 0.6, 0.9}, 2.0), tight).traction(motion, 1.0, traction);
  EXPECT_EQ(traction.regime, CycleRegime::full_stick);
  EXPECT_NEAR(traction.force.mean()[0], 0.6 * 0.54, 0.05);
  EXPECT_NEAR(traction.force.mean()[2], -0.8 * 0.54, 0.05);
}

TEST(PlaneEvents, RefusesWhatItCannotMeet) {
  const SurfaceLaw surface({2.0, 1.5, 0.6, 0.9}, 0.7);
  EXPECT_THROW(PlaneEvents(surface, 0.0), std::invalid_argument);
  EXPECT_THROW(PlaneEvents(surface, 1.0), std::invalid_argument);
  PointTraction traction;
  EXPECT_THROW(PlaneEvents(surface).traction(Harmonics(1, 2), 1.0, traction),
               std::invalid_argument);
}

// Sixty deviations apart Gaussian heights carry less than the smallest number. A period was judged
// by its middle: with that at θ = π all contact was missed, anywhere else it was found.
TEST(PlaneEvents, GaussianHeightsThatPartFarTouchAgain) {
  const SurfaceLaw law({2.0, 1.0, 0.4, 0.01}, 1.4, FrictionLaw::constant(0.4),
                       RoughSurface::matching_gaussian(0.1));
  PointTraction first;
  for (const double turn : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0}) {
    Harmonics motion(1, 3);
    motion.rows().row(1) = Eigen::RowVector3d(1.0, std::sin(turn) * -1.4, 0.3);
    motion.rows().row(2) = Eigen::RowVector3d(-0.2, std::cos(turn) * 1.4, 0.5);
    // The whole motion is turned, not the approach alone.
    const double c = std::cos(turn);
    const double d = std::sin(turn);
    for (const Eigen::Index column : {0, 2}) {
      const double sine = motion.rows()(1, column);
      const double cosine = motion.rows()(2, column);
      motion.rows()(1, column) = c * sine - d * cosine;
      motion.rows()(2, column) = d * sine + c * cosine;
    }
    PointTraction traction;
    PlaneEvents(law).traction(motion, 1.0, traction);
    EXPECT_EQ(traction.regime, CycleRegime::separation) << turn;
    const auto size = [](const PointTraction& of, Eigen::Index column) {
      return of.force.rows().col(column).tail(2).norm();
    };
    if (turn == 0.0) first = traction;
    for (const Eigen::Index column : {0, 1, 2}) {
      EXPECT_GT(size(traction, column), 1e-2);
      EXPECT_NEAR(size(traction, column), size(first, column), 1e-8) << turn;
      EXPECT_NEAR(traction.force.mean()[column], first.force.mean()[column], 1e-8) << turn;
    }
  }
}

// What a control of steps is told needs no forces, and no events closer than it tells them.
TEST(PlaneEvents, StatesAreThoseOfTheForce) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> g;
  int different = 0;
  constexpr int tried = 300;
  for (int i = 0; i < tried; ++i) {
    Harmonics motion(1 + i % 3, 3);
    for (double& x : motion.vector()) x = g(random);
    const PointParameters point{std::exp(g(random)), std::exp(g(random)),
                                std::exp(0.7 * g(random) - 0.5), 1.5 * g(random) + 0.7};
    const PlaneEvents method(SurfaceLaw(point, std::exp(g(random))), 1e-11);
    PointTraction exact;
    PointTraction told;
    method.traction_alone(motion, 1.0, exact);
    method.states(motion, 1.0, told);
    EXPECT_EQ(told.regime, exact.regime) << i;
    different += told.period.changed(exact.period) > 0.0 ? 1 : 0;
  }
  EXPECT_EQ(different, 0);
}

}  // namespace
}  // namespace microslip::contact::test_planar_cycle
