#include "contact/transient/planar_transient.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "contact/force/point_method_force.hpp"
#include "contact/plane/planar_cycle.hpp"
#include "contact/transient/patch_transient.hpp"

namespace microslip::contact::test_planar_transient {
namespace {

constexpr double pi = std::numbers::pi;
constexpr GuardScale unit_scale{1.0, 1.0};

/// One point whose modal coordinates are u, v and w.
PlanarTransient one_point(const SurfaceLaw& law, double weight = 1.0) {
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  return {Eigen::VectorXd::Constant(1, weight), {law}, ModalShapes{I.row(0), I.row(1), I.row(2)}};
}

/// The same along p alone.
PlanarTransient on_a_line(const SurfaceLaw& law) {
  return {Eigen::VectorXd::Ones(1),
          {law},
          ModalShapes{Eigen::RowVector2d(1.0, 0.0), Eigen::RowVector2d(0.0, 1.0), {}}};
}

ModalMotion still(const Eigen::VectorXd& q) { return {q, Eigen::VectorXd::Zero(q.size())}; }

SurfaceLaw smooth_law(double k_w = 5.0) { return {{5.0, 3.0, 0.4, 1.0}, k_w}; }
SurfaceLaw rough_law() {
  return {{5.0, 3.0, 0.4, 1.0}, 5.0, FrictionLaw::constant(0.4), RoughSurface::cubic(0.7)};
}
SurfaceLaw rate_law() {
  return {{5.0, 3.0, 0.4, 1.0}, 5.0, FrictionLaw::exponential(0.5, 0.2, 2.0)};
}

TEST(PlanarTransient, RefusesShapesOfAnotherSizeAndValuesThatAreNotFinite) {
  const Eigen::MatrixXd good = Eigen::MatrixXd::Ones(2, 3);
  const std::vector<SurfaceLaw> laws(2, smooth_law());
  const Eigen::VectorXd weights = Eigen::VectorXd::Ones(2);
  EXPECT_THROW(PlanarTransient(weights, laws, {Eigen::MatrixXd::Ones(3, 3), good, {}}),
               std::invalid_argument);
  EXPECT_THROW(PlanarTransient(weights, laws, {good, good, Eigen::MatrixXd::Ones(2, 2)}),
               std::invalid_argument);
  Eigen::MatrixXd bad = good;
  bad(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(PlanarTransient(weights, laws, {good, good, bad}), std::invalid_argument);
  EXPECT_THROW(PlanarTransient(Eigen::Vector3d::Ones(), laws, {good, good, {}}),
               std::invalid_argument);
  EXPECT_THROW(PlanarTransient(-weights, laws, {good, good, {}}), std::invalid_argument);
}

TEST(PlanarTransient, CarriesNoDynamicForceAtRest) {
  for (const double preload : {-2.0, 0.0, 3.0}) {
    for (const auto& roughness :
         {std::optional<RoughSurface>{}, std::optional(RoughSurface::cubic(0.3)),
          std::optional(RoughSurface::matching_gaussian(0.3))}) {
      const PlanarTransient force =
          one_point({{5.0, 7.0, 0.4, preload}, 4.0, FrictionLaw::constant(0.4), roughness});
      const TransientMemory memory = force.virgin_memory();
      const ModalMotion rest = still(Eigen::Vector3d::Zero());
      EXPECT_EQ(force.trial_force(rest, memory), Eigen::Vector3d::Zero());
      EXPECT_EQ(force.held_force(rest, memory), Eigen::Vector3d::Zero());
    }
  }
}

/// Theory section 9: (I + λK)⁻¹ f*, with |f| = μ n; between equal stiffnesses the radial return.
TEST(PlanarTransient, TrialForceIsTheReturnOfTheSection) {
  const Eigen::Vector3d q(0.6, 0.1, -0.8);
  const double limit = 0.4 * (1.0 + 3.0 * 0.1);
  const PlanarTransient round = one_point(smooth_law(), 2.0);
  const Eigen::VectorXd G = round.trial_force(still(q), round.virgin_memory());
  EXPECT_NEAR(G[0], 2.0 * limit * 0.6, 1e-15);
  EXPECT_NEAR(G[1], 2.0 * 3.0 * 0.1, 1e-15);
  EXPECT_NEAR(G[2], -2.0 * limit * 0.8, 1e-15);
  const PlanarTransient other = one_point(smooth_law(2.0));
  const Eigen::VectorXd F = other.trial_force(still(q), other.virgin_memory());
  EXPECT_NEAR(std::hypot(F[0], F[2]), limit, 1e-14);
  const double of_p = (5.0 * 0.6 / F[0] - 1.0) / 5.0;  // λ from each direction
  const double of_r = (2.0 * -0.8 / F[2] - 1.0) / 2.0;
  EXPECT_NEAR(of_p, of_r, 1e-12);
}

TEST(PlanarTransient, HeldForceAgreesWithTheTrialForceWhereTheStateHolds) {
  for (const SurfaceLaw& law : {smooth_law(), smooth_law(2.0), rough_law(), rate_law()}) {
    const PlanarTransient force = one_point(law);
    for (const Eigen::Vector3d& q :
         {Eigen::Vector3d(0.02, 0.1, 0.03), Eigen::Vector3d(0.9, 0.1, -0.4),
          Eigen::Vector3d(-0.9, 0.3, 0.2), Eigen::Vector3d(0.3, -0.9, 0.1)}) {
      const ModalMotion motion{q, Eigen::Vector3d(0.3, 0.1, 0.2)};
      TransientMemory memory = force.virgin_memory();
      force.commit(motion, memory);
      EXPECT_LT((force.held_force(motion, memory) - force.trial_force(motion, memory)).norm(),
                1e-14);
    }
  }
}

/// On a line it is the patch with one direction: forces, states and guards' signs,
/// switch by switch.
TEST(PlanarTransient, OnALineItIsThePatchWithOneDirection) {
  const PointParameters point{5.0, 3.0, 0.4, 1.0};
  const PlanarTransient planar = on_a_line({point, 5.0});
  const PatchTransient line(ContactPatch(Eigen::VectorXd::Ones(1), {point}),
                            {Eigen::RowVector2d(1.0, 0.0), Eigen::RowVector2d(0.0, 1.0), {}});
  TransientMemory a = planar.virgin_memory();
  TransientMemory b = line.virgin_memory();
  constexpr int n = 4000;
  int n_switches = 0;
  for (int i = 0; i < 2 * n; ++i) {
    const double t = 2.0 * pi * i / n;
    const ModalMotion motion{
        Eigen::Vector2d(0.8 * std::sin(t) + 0.1, 0.5 * std::cos(t + 0.4) + 0.05),
        Eigen::Vector2d(0.8 * std::cos(t), -0.5 * std::sin(t + 0.4))};
    for (int pass = 0; pass < 3; ++pass) {
      const bool ends = planar.guards(motion, a, unit_scale).minCoeff() < 0.0;
      ASSERT_EQ(ends, line.guards(motion, b, unit_scale).minCoeff() < 0.0) << i;
      if (!ends) break;
      planar.switch_state(0, motion, a);
      line.switch_state(0, motion, b);
      ++n_switches;
    }
    const bool slips =
        b.state[0] == ContactState::positive_slip || b.state[0] == ContactState::negative_slip;
    EXPECT_EQ(a.state[0], slips ? ContactState::slip : b.state[0]) << i;
    EXPECT_EQ(planar.internal_rates(motion, a, unit_scale)[0], 0.0);
    EXPECT_LT((planar.held_force(motion, a) - line.held_force(motion, b)).norm(), 1e-14) << i;
    EXPECT_NEAR(planar.slip_power(motion, a), line.slip_power(motion, b), 1e-14) << i;
  }
  EXPECT_GE(n_switches, 10);  // stick, slip both ways, separation
}

/// Circular motion (theory section 9): f leads u by arccos(μn/(k a)) and turns with it; the slider
/// runs on a circle of radius √(a² − (μn/k)²).
TEST(PlanarTransient, InCircularMotionTheForceLeadsByAnAngle) {
  const double a = 0.7;
  const double limit = 0.4;
  const PlanarTransient force = one_point(smooth_law());
  TransientMemory memory = force.virgin_memory();
  memory.state[0] = ContactState::slip;
  const double omega = 3.0;
  for (const double phase : {0.0, 1.0, 2.5, 4.0}) {
    memory.internal[0] = phase + std::acos(limit / (5.0 * a));
    const ModalMotion motion{
        Eigen::Vector3d(a * std::cos(phase), 0.0, a * std::sin(phase)),
        omega * Eigen::Vector3d(-a * std::sin(phase), 0.0, a * std::cos(phase))};
    EXPECT_NEAR(force.internal_rates(motion, memory, unit_scale)[0], omega,
                1e-7);  // (ε/r)⁴ of the turning
    const double radius = std::sqrt(a * a - std::pow(limit / 5.0, 2));
    EXPECT_NEAR(force.slip_power(motion, memory), limit * omega * radius, 1e-14);
  }
}

/// Marching with the return map: first order in the direction while slip is curved.
TEST(PlanarTransient, CommitsConvergeToCircularMotionAtFirstOrder) {
  const double a = 0.7;
  const double limit = 0.4;
  const PlanarTransient force = one_point(smooth_law());
  const double lead = std::acos(limit / (5.0 * a));
  std::array<double, 2> error{};
  for (std::size_t k = 0; k < 2; ++k) {
    const int n = k == 0 ? 2000 : 8000;
    TransientMemory memory = force.virgin_memory();
    double work = 0.0;
    for (int i = 0; i <= 3 * n; ++i) {
      const double phase = 2.0 * pi * i / n;
      const Eigen::Vector3d q(a * std::cos(phase), 0.0, a * std::sin(phase));
      const double step = force.commit(still(q), memory);
      if (i > 2 * n) work += step;
    }
    error[k] = std::abs(std::remainder(memory.internal[0] - lead, 2.0 * pi));
    const double radius = std::sqrt(a * a - std::pow(limit / 5.0, 2));
    EXPECT_NEAR(work, 2.0 * pi * limit * radius, 10.0 / n);
  }
  EXPECT_NEAR(error[0] / error[1], 4.0, 0.2);
  EXPECT_LT(error[1], 1e-3);
}

/// The rates of direction and slider are those of the steady cycle found by collocation: angle and
/// slip rate against differences along it, for every kind of law.
TEST(PlanarTransient, RatesAreThoseOfTheSteadyCycle) {
  const double omega = 1.7;
  for (const SurfaceLaw& law : {smooth_law(), smooth_law(2.0), rough_law(), rate_law()}) {
    const PlanarTransient force = one_point(law);
    Harmonics motion(1, 3);
    motion.rows() << 0.1, 0.05, -0.05, 0.8, 0.2, -0.1, 0.2, -0.1, 0.7;
    constexpr double h = 1e-4;
    const PlaneEvents cycle(law, 1e-12);
    int n_slipping = 0;
    for (int i = 0; i < 40; ++i) {
      const double phase = 0.1 + 2.0 * pi * i / 40;
      const Eigen::Vector3d phases(phase - h, phase, phase + h);
      const PointHistory history = cycle.history(motion, omega, phases, 1);
      const auto& at = history.instants;
      if (at[0].state != ContactState::slip || at[2].state != ContactState::slip) continue;
      ++n_slipping;
      const auto angle = [&](int k) {
        const auto& t = at[static_cast<std::size_t>(k)].traction;
        return std::atan2(t[2], t[0]);
      };
      TransientMemory memory = force.virgin_memory();
      memory.state[0] = ContactState::slip;
      memory.internal[0] = angle(1);
      const Eigen::VectorXd sine = motion.sine();
      const Eigen::VectorXd cosine = motion.cosine();
      const ModalMotion now{motion.at(phase),
                            omega * (sine * std::cos(phase) - cosine * std::sin(phase)),
                            -omega * omega * (sine * std::sin(phase) + cosine * std::cos(phase))};
      EXPECT_LT((force.held_force(now, memory) + Eigen::Vector3d(0.0, law.reference_load(), 0.0) -
                 at[1].traction)
                    .norm(),
                1e-9);
      const double turned = std::remainder(angle(2) - angle(0), 2.0 * pi) * omega / (2.0 * h);
      const double rate = force.internal_rates(now, memory, unit_scale)[0];
      // Central differences of 1e-4, and 1e-12 of the cycle over them.
      EXPECT_NEAR(rate, turned, 1e-5 * std::max(1.0, std::abs(turned)));
      const Eigen::Vector2d way = (at[2].slider - at[0].slider) * omega / (2.0 * h);
      const double friction = std::hypot(at[1].traction[0], at[1].traction[2]);
      EXPECT_NEAR(force.slip_power(now, memory), friction * way.norm(), 1e-5);
    }
    EXPECT_GT(n_slipping, 10);
  }
}

TEST(PlanarTransient, ContactBeginsInTheStateOfTheRates) {
  for (const double k_w : {5.0, 2.0}) {
    const PlanarTransient force = one_point({{5.0, 3.0, 0.4, 0.0}, k_w});
    const auto after = [&](const Eigen::Vector2d& rate) {
      TransientMemory memory = force.virgin_memory();
      force.switch_state(
          0, {Eigen::Vector3d(0.7, 1e-16, 0.2), Eigen::Vector3d(rate[0], 1.0, rate[1])}, memory);
      EXPECT_EQ(memory.slider, Eigen::Vector2d(0.7, 0.2));
      return memory;
    };
    // |K₀ x'| against r' = μ k_v v' = 1.2
    EXPECT_EQ(after({0.17, 0.8 / k_w}).state[0], ContactState::stick);
    const TransientMemory slips = after({0.2, 1.0 / k_w});
    EXPECT_EQ(slips.state[0], ContactState::slip);
    const Eigen::Vector2d e(std::cos(slips.internal[0]), std::sin(slips.internal[0]));
    const Eigen::Vector2d dragged =
        Eigen::Vector2d(0.2, 1.0 / k_w) - 1.2 * Eigen::Vector2d(e[0] / 5.0, e[1] / k_w);
    EXPECT_NEAR(dragged[0] * e[1] - dragged[1] * e[0], 0.0, 1e-15);  // the slider moves along f
    EXPECT_GT(dragged.dot(e), 0.0);
  }
}

TEST(PlanarTransient, RoughSurfacesTouchDownInSlip) {
  const SurfaceLaw law({5.0, 3.0, 0.4, -0.3}, 5.0, FrictionLaw::constant(0.4),
                       RoughSurface::cubic(0.7));
  const PlanarTransient force = one_point(law);
  const double touch = law.kinks().front();
  for (const double side : {0.0, 1e-13, -1e-13}) {
    TransientMemory memory = force.virgin_memory();
    const double rate = 0.4 * 3.0 / 3.0;  // r' = μ k_v/3 v' where heights begin to touch
    const auto touched = [&](double speed) {
      memory = force.virgin_memory();
      force.switch_state(
          0, {Eigen::Vector3d(0.1, touch + side, 0.0), Eigen::Vector3d(0.0, 1.0, speed)}, memory);
      return memory.state[0];
    };
    EXPECT_EQ(touched(0.99 * rate / 5.0), ContactState::stick);
    EXPECT_EQ(touched(1.01 * rate / 5.0), ContactState::slip);
    EXPECT_NEAR(memory.internal[0], 0.5 * pi, 1e-15);
  }
}

TEST(PlanarTransient, ForceIsContinuousWhereStatesChange) {
  for (const SurfaceLaw& law : {smooth_law(), smooth_law(2.0), rough_law()}) {
    const PlanarTransient force = one_point(law);
    TransientMemory memory = force.virgin_memory();
    const ModalMotion motion = still(Eigen::Vector3d(0.6, 0.2, -0.3));
    force.commit(motion, memory);
    ASSERT_EQ(memory.state[0], ContactState::slip);
    const Eigen::VectorXd before = force.held_force(motion, memory);
    force.switch_state(0, motion, memory);
    EXPECT_EQ(memory.state[0], ContactState::stick);
    EXPECT_LT((force.held_force(motion, memory) - before).norm(), 1e-14);
    force.switch_state(0, motion, memory);
    EXPECT_EQ(memory.state[0], ContactState::slip);
    EXPECT_LT((force.held_force(motion, memory) - before).norm(), 1e-14);
  }
}

TEST(PlanarTransient, ContactEndsFromEveryState) {
  for (const ContactState state : {ContactState::stick, ContactState::slip}) {
    const PlanarTransient force = one_point(smooth_law());
    TransientMemory memory = force.virgin_memory();
    memory.state[0] = state;
    const ModalMotion open{Eigen::Vector3d(0.6, -0.4, 0.2), Eigen::Vector3d(1.0, -1.0, 0.0)};
    EXPECT_LT(force.guards_of(0, open, memory, unit_scale)[1], 0.0);
    force.switch_state(0, open, memory);
    EXPECT_EQ(memory.state[0], ContactState::separated);
    EXPECT_EQ(memory.slider, Eigen::Vector2d(0.6, 0.2));
    EXPECT_EQ(force.held_force(open, memory), Eigen::Vector3d(0.0, -1.0, 0.0));
  }
}

TEST(PlanarTransient, WithoutFrictionOrStiffnessOnlyTheLoadActs) {
  const ModalMotion motion{Eigen::Vector3d(4.0, 0.1, 1.0), Eigen::Vector3d::Ones()};
  for (const auto& [law, state] :
       {std::pair{SurfaceLaw({5.0, 3.0, 0.0, 1.0}, 5.0), ContactState::slip},
        std::pair{SurfaceLaw({0.0, 3.0, 0.4, 1.0}, 0.0), ContactState::stick}}) {
    const PlanarTransient force = one_point(law);
    const TransientMemory memory = force.virgin_memory();
    EXPECT_EQ(memory.state[0], state);
    for (const Eigen::Index tangential : {0, 2}) {
      EXPECT_EQ(force.held_force(motion, memory)[tangential], 0.0);
      EXPECT_EQ(force.trial_force(motion, memory)[tangential], 0.0);
      EXPECT_EQ(force.stuck_stiffness()(tangential, tangential), 0.0);
    }
    EXPECT_EQ(force.slip_power(motion, memory), 0.0);
    EXPECT_GT(force.guards(motion, memory, unit_scale).minCoeff(), 0.0);
  }
}

TEST(PlanarTransient, GuardsOfAllPointsAreThoseOfEach) {
  const Eigen::MatrixXd u = Eigen::MatrixXd::Random(3, 2);
  const Eigen::MatrixXd v = Eigen::MatrixXd::Random(3, 2);
  const Eigen::MatrixXd w = Eigen::MatrixXd::Random(3, 2);
  const PlanarTransient force(Eigen::Vector3d(1.0, 2.0, 0.0),
                              {smooth_law(), rough_law(), rate_law()}, {u, v, w});
  const ModalMotion motion{Eigen::Vector2d(0.2, -0.1), Eigen::Vector2d(0.7, 0.4),
                           Eigen::Vector2d(-0.2, 0.3)};
  TransientMemory memory = force.virgin_memory();
  memory.state[1] = ContactState::slip;
  const auto all = force.guards(motion, memory, unit_scale);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto one = force.guards_of(i, motion, memory, unit_scale);
    EXPECT_NEAR(all(i, 0), one[0], 1e-15);
    EXPECT_NEAR(all(i, 1), one[1], 1e-15);
  }
  EXPECT_EQ(all(2, 0), 1.0);  // weight 0: never changes
}

TEST(PlanarTransient, SharesTheStuckLimitWithHarmonicBalance) {
  const Eigen::VectorXd weights = Eigen::Vector2d(0.5, 2.0);
  const std::vector<SurfaceLaw> laws{smooth_law(2.0), SurfaceLaw({2.0, 3.0, 0.0, 1.0}, 2.0)};
  const ModalShapes shapes{Eigen::MatrixXd::Random(2, 4), Eigen::MatrixXd::Random(2, 4),
                           Eigen::MatrixXd::Random(2, 4)};
  std::vector<std::shared_ptr<const PointMethod>> cycles;
  for (const SurfaceLaw& law : laws) cycles.push_back(std::make_shared<PlaneEvents>(law, 1e-10));
  EXPECT_LT((PlanarTransient(weights, laws, shapes).stuck_stiffness() -
             PointMethodForce(weights, cycles, shapes).stuck_stiffness())
                .norm(),
            1e-14);
}

}  // namespace
}  // namespace microslip::contact::test_planar_transient
