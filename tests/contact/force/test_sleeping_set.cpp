#include "contact/force/sleeping_set.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <random>

#include "contact/force/point_method_force.hpp"
#include "contact/line/line_events.hpp"
#include "contact/line/surface_line_events.hpp"
#include "contact/plane/planar_cycle.hpp"
#include "tests/support/asked_force.hpp"
#include "tests/support/sleepless_method.hpp"

namespace microslip::contact::test_sleeping_set {
namespace {

constexpr Eigen::Index n_modes = 4;

using Methods = std::vector<std::shared_ptr<const PointMethod>>;
using MakeMethod =
    std::function<std::shared_ptr<const PointMethod>(const PointParameters&, double second)>;

struct Patch {
  PointMethodForce sleeping;
  PointMethodForce sleepless;
};

Patch patch_of(const Eigen::VectorXd& weights, const Methods& methods, const ModalShapes& shapes) {
  Methods bare;
  for (const auto& method : methods)
    bare.push_back(std::make_shared<tests::SleeplessMethod>(method));
  return {PointMethodForce(weights, methods, shapes), PointMethodForce(weights, bare, shapes)};
}

enum class Directions : std::uint8_t { one, two };

// Preloads from gaps to loads that hold everything; points without friction, without normal
// stiffness.
Patch random_patch(Eigen::Index n, const MakeMethod& make, Directions directions,
                   std::mt19937_64& random) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  Eigen::VectorXd weights(n);
  Methods methods;
  for (Eigen::Index i = 0; i < n; ++i) {
    weights[i] = i % 11 == 3 ? 0.0 : 1.1 + u(random);
    const PointParameters point{i % 13 == 0 ? 0.0 : 1.1 + u(random),
                                i % 7 == 1 ? 0.0 : 1.1 + u(random),
                                i % 5 == 0 ? 0.0 : 0.5 + 0.4 * u(random), 6.0 * u(random) + 2.0};
    methods.push_back(make(point, i % 9 == 0 ? 0.0 : 1.1 + u(random)));
  }
  const auto shape = [&] {
    return Eigen::MatrixXd::NullaryExpr(n, n_modes, [&] { return u(random); });
  };
  ModalShapes shapes{shape(), shape(), {}};
  if (directions == Directions::two) shapes.w = shape();
  return patch_of(weights, methods, shapes);
}

Harmonics random_motion(int n_harmonics, double size, std::mt19937_64& random) {
  std::normal_distribution<double> g(0.0, size);
  Harmonics q(n_harmonics, n_modes);
  for (Eigen::Index k = 0; k < q.rows().rows(); ++k) {
    for (Eigen::Index m = 0; m < n_modes; ++m) {
      q.rows()(k, m) = g(random) / static_cast<double>((k + 3) / 2);
    }
  }
  return q;
}

struct Seen {
  double least = 1.0;
  double most = 0.0;
};

// Motions of every size up to one that wakes nearly everything. @param accuracy  of the method, in
// shares of the forces; sums of n terms of size 10 come on top.
void expect_same(Patch& p, int n_harmonics, double accuracy, std::mt19937_64& random, Seen& seen) {
  for (const double size : {0.02, 0.1, 0.3, 0.6, 1.2}) {
    const Harmonics q = random_motion(n_harmonics, size, random);
    const ForceAndJacobian a = tests::evaluate(p.sleeping, q, 2.0);
    const ForceAndJacobian b = tests::evaluate(p.sleepless, q, 2.0);
    const double force = b.force.vector().norm();
    const double stiffness = b.jacobian.norm() + 1.0;
    ASSERT_LE((a.force.vector() - b.force.vector()).norm(), accuracy * (force + 1.0)) << size;
    ASSERT_LE((a.jacobian - b.jacobian).norm(), accuracy * stiffness) << size;
    ASSERT_LE((a.frequency_derivative - b.frequency_derivative).norm(), accuracy * (force + 1.0));
    const CycleReport r = tests::report(p.sleeping, q, 2.0);
    const CycleReport s = tests::report(p.sleepless, q, 2.0);
    EXPECT_NEAR(r.stick_share, s.stick_share, 1e-13);
    EXPECT_NEAR(r.slip_share, s.slip_share, 1e-13);
    EXPECT_NEAR(r.separated_share, s.separated_share, 1e-13);
    EXPECT_NEAR(r.three_states_share, s.three_states_share, 1e-13);
    EXPECT_NEAR(r.slip_work, s.slip_work, 1e-13 * (1.0 + s.slip_work));
    EXPECT_EQ(s.awake_share, 1.0);
    seen.least = std::min(seen.least, r.awake_share);
    seen.most = std::max(seen.most, r.awake_share);
  }
}

// Sums of a few hundred numbers of either sign in another order.
constexpr double rounding = 2e-14;

std::shared_ptr<const PointMethod> event(const PointParameters& point, double /*second*/) {
  return std::make_shared<LineEvents>(point);
}

TEST(SleepingSet, EventPointsGiveWhatEvaluationGives) {
  std::mt19937_64 random(1);
  Seen seen;
  for (int n_harmonics = 1; n_harmonics <= 5; ++n_harmonics) {
    for (const Eigen::Index n : {1, 40, 233}) {
      Patch p = random_patch(n, event, Directions::one, random);
      expect_same(p, n_harmonics, rounding, random, seen);
    }
  }
  EXPECT_LT(seen.least, 0.2);
  EXPECT_GT(seen.most, 0.8);
}

// k_p ≠ k_r. Stuck cycles are integrated by quadrature: a little more than rounding.
TEST(SleepingSet, PlanarPointsGiveWhatEvaluationGives) {
  const MakeMethod planar = [](const PointParameters& point, double second) {
    return std::make_shared<PlaneEvents>(SurfaceLaw(point, second), 1e-9);
  };
  std::mt19937_64 random(2);
  Seen seen;
  for (int n_harmonics = 1; n_harmonics <= 5; n_harmonics += 2) {
    Patch p = random_patch(60, planar, Directions::two, random);
    expect_same(p, n_harmonics, 1e-13, random, seen);
  }
  EXPECT_LT(seen.least, 0.2);
  EXPECT_GT(seen.most, 0.5);
}

// What the product makes of points along p that are rough or whose friction depends on the speed.
std::shared_ptr<const PointMethod> surface_event(const PointParameters& point, double second,
                                                 const FrictionLaw& friction,
                                                 const std::optional<RoughSurface>& roughness) {
  PointParameters stiff = point;
  if (roughness) stiff.normal_stiffness = std::max(stiff.normal_stiffness, 0.1);
  return std::make_shared<SurfaceLineEvents>(SurfaceLaw(stiff, second, friction, roughness));
}

// Friction falls and rises with the speed: sleep is judged by the smallest coefficient that is
// reached.
TEST(SleepingSet, FrictionThatDependsOnTheSpeedSleepsAsWell) {
  const auto make = [](const FrictionLaw& friction) -> MakeMethod {
    return [friction](const PointParameters& point, double second) {
      return surface_event(point, second, friction, {});
    };
  };
  std::mt19937_64 random(4);
  Seen seen;
  for (const FrictionLaw& friction :
       {FrictionLaw::exponential(0.5, 0.2, 0.7), FrictionLaw::exponential(0.2, 0.6, 0.7),
        FrictionLaw::hyperbolic(0.6, 0.3)}) {
    Patch p = random_patch(150, make(friction), Directions::one, random);
    expect_same(p, 2, rounding, random, seen);
  }
  EXPECT_LT(seen.least, 0.3);
}

TEST(SleepingSet, RoughSurfacesSleepOnlyWhereOpen) {
  const auto make = [](const RoughSurface& surface) -> MakeMethod {
    return [surface](const PointParameters& point, double second) {
      return surface_event(point, second, FrictionLaw::constant(point.friction_coefficient),
                           surface);
    };
  };
  std::mt19937_64 random(5);
  Seen cubic;
  Patch cubic_patch = random_patch(150, make(RoughSurface::cubic(0.5)), Directions::one, random);
  expect_same(cubic_patch, 2, rounding, random, cubic);
  EXPECT_LT(cubic.least, 0.9);
  EXPECT_GT(cubic.least, 0.5);  // two thirds are pressed
  Seen gaussian;
  Patch gaussian_patch =
      random_patch(50, make(RoughSurface::matching_gaussian(0.5)), Directions::one, random);
  expect_same(gaussian_patch, 2, rounding, random, gaussian);
  // Nine deviations beyond the mean height they are open as well.
  EXPECT_LT(gaussian.least, 0.9);
  EXPECT_GT(gaussian.least, 0.5);
}

TEST(SleepingSet, SurfaceEventPointsGiveWhatEvaluationGivesAndSleep) {
  const MakeMethod plain = [](const PointParameters& point, double second) {
    return surface_event(point, second, FrictionLaw::constant(point.friction_coefficient), {});
  };
  const MakeMethod by_speed = [](const PointParameters& point, double second) {
    return surface_event(point, second, FrictionLaw::exponential(0.5, 0.2, 0.7), {});
  };
  const MakeMethod rough = [](const PointParameters& point, double second) {
    return surface_event(point, second, FrictionLaw::constant(point.friction_coefficient),
                         RoughSurface::cubic(0.5));
  };
  std::mt19937_64 random(8);
  for (const MakeMethod* make : {&plain, &by_speed, &rough}) {
    Seen seen;
    for (const int n_harmonics : {1, 3}) {
      Patch p = random_patch(60, *make, Directions::one, random);
      expect_same(p, n_harmonics, 1e-12, random, seen);
    }
    EXPECT_LT(seen.least, make == &rough ? 0.9 : 0.3);
    if (make == &rough) {
      EXPECT_GT(seen.least, 0.5);  // two thirds are pressed
    }
  }
}

// The method does not resist along r, asleep or awake, whatever moves there.
TEST(SleepingSet, SurfaceEventPointsSleepWithoutForceAlongR) {
  const MakeMethod plain = [](const PointParameters& point, double second) {
    return surface_event(point, second, FrictionLaw::constant(point.friction_coefficient), {});
  };
  std::mt19937_64 random(9);
  Seen seen;
  Patch patch = random_patch(60, plain, Directions::two, random);
  expect_same(patch, 2, 1e-12, random, seen);
  EXPECT_LT(seen.least, 0.3);
}

// Whatever was asked before.
TEST(SleepingSet, EqualMotionsGiveEqualBits) {
  std::mt19937_64 random(6);
  const auto seed = random();
  std::mt19937_64 one(seed);
  std::mt19937_64 other(seed);
  Patch walked = random_patch(300, event, Directions::one, one);
  Patch fresh = random_patch(300, event, Directions::one, other);
  const auto work = walked.sleeping.workspace();
  for (int step = 0; step < 30; ++step) {
    (void)tests::evaluate(walked.sleeping, random_motion(3, 0.05 * step, random), 1.0, *work);
  }
  const Harmonics q = random_motion(3, 0.3, random);
  const ForceAndJacobian a = tests::evaluate(walked.sleeping, q, 1.0, *work);
  const ForceAndJacobian b = tests::evaluate(fresh.sleeping, q, 1.0);
  EXPECT_EQ(a.force.rows(), b.force.rows());
  EXPECT_EQ(a.jacobian, b.jacobian);
}

TEST(SleepingSet, SomeRowsAreThoseOfAll) {
  std::mt19937_64 random(7);
  Patch p = random_patch(120, event, Directions::one, random);
  const Harmonics q = random_motion(2, 0.2, random);
  const std::vector<Eigen::Index> rows{1, 2, 4};
  const ForceAndJacobian some = tests::evaluate(p.sleeping, q, 1.0, {.rows = rows});
  const ForceAndJacobian all = tests::evaluate(p.sleepless, q, 1.0);
  EXPECT_LE((some.force.vector() - all.force.vector()).norm(),
            rounding * all.force.vector().norm());
  for (Eigen::Index k = 0; k < 3; ++k) {
    for (Eigen::Index l = 0; l < 3; ++l) {
      const Eigen::MatrixXd block =
          all.jacobian.block(n_modes * rows[static_cast<std::size_t>(k)],
                             n_modes * rows[static_cast<std::size_t>(l)], n_modes, n_modes);
      EXPECT_LE((some.jacobian.block(n_modes * k, n_modes * l, n_modes, n_modes) - block).norm(),
                rounding * all.jacobian.norm());
    }
  }
}

TEST(SleepingSet, LinearStateIsProvedOfAPlanarBall) {
  Eigen::MatrixXd phi(1, 1);
  phi << 1.0;
  const auto force = [&](double preload) {
    return PointMethodForce(
        Eigen::VectorXd::Ones(1),
        {std::make_shared<PlaneEvents>(SurfaceLaw({2.0, 0.0, 0.5, preload}, 1.0))},
        {phi, 0.0 * phi, phi});
  };
  Harmonics q(1, 1);
  q.rows()(1, 0) = 1.0;  // |K x| = √5 against μ n = 5
  EXPECT_EQ(force(10.0).linear_state(q, 0.0), LinearState::stuck);
  // √5 √2 radius uses up the rest, 2.76.
  EXPECT_EQ(force(10.0).linear_state(q, 0.87), LinearState::stuck);
  EXPECT_EQ(force(10.0).linear_state(q, 0.88), LinearState::unknown);
  EXPECT_EQ(force(-1.0).linear_state(q, 1e6), LinearState::free);  // constant gap
  EXPECT_EQ(force(0.0).linear_state(q, 0.0), LinearState::unknown);
}

TEST(SleepingSet, LinearStateIsProvedOfSeveralHarmonics) {
  Eigen::MatrixXd phi(1, 1);
  phi << 1.0;
  PointMethodForce force(Eigen::VectorXd::Ones(1),
                         {std::make_shared<LineEvents>(PointParameters{2.0, 1.0, 0.5, 10.0})},
                         {phi, 0.0 * phi, {}});
  Harmonics q(2, 1);
  q.rows() << 0.0, 1.0, 0.0, 1.0, 0.0;  // 2 |u| ≤ 3.52: sin θ + sin 2θ stays below 1.76
  EXPECT_EQ(force.linear_state(q, 0.0), LinearState::stuck);
  EXPECT_EQ(force.linear_state(q, 0.4), LinearState::stuck);  // 2 √3 0.4 = 1.39 < 1.48
  EXPECT_EQ(force.linear_state(q, 0.44), LinearState::unknown);
  q.vector() *= 1.5;  // 5.28 > 5, while the amplitudes add up to 6
  EXPECT_EQ(force.linear_state(q, 0.0), LinearState::unknown);
}

}  // namespace
}  // namespace microslip::contact::test_sleeping_set
