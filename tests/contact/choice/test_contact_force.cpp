#include "contact/contact_force.hpp"
#include "tests/support/floating_point_traps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/asked_force.hpp"

namespace microslip::contact::test_contact_force {
namespace {

// Lanes compute what they then do not take.
[[maybe_unused]] const tests::UntrappedFile this_file(__FILE__);

constexpr Eigen::Index n_modes = 3;

/// Points in a row whose constants and shapes are smooth functions of the place, all different.
PatchSamples samples(double begin, Eigen::Index n) {
  PatchSamples s;
  s.points = Eigen::MatrixX3d::Zero(n, 3);
  s.weights = Eigen::VectorXd::Constant(n, 0.5);
  s.stiffness.resize(n, 3);
  s.friction.resize(n);
  s.preload_field = Eigen::VectorXd::Constant(n, 1.0 / (0.5 * static_cast<double>(n)));
  s.shapes = {Eigen::MatrixXd(n, n_modes), Eigen::MatrixXd(n, n_modes),
              Eigen::MatrixXd(n, n_modes)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const double x = begin + static_cast<double>(i);
    s.points(i, 0) = x;
    s.stiffness.row(i) << 2.0 + 0.1 * x, 1.5 - 0.05 * x, 2.5;
    s.friction[i] = 0.4 + 0.02 * x;
    for (Eigen::Index m = 0; m < n_modes; ++m) {
      const double k = static_cast<double>(m + 1);
      s.shapes.u(i, m) = std::cos(0.3 * k * x);
      s.shapes.v(i, m) = 0.4 * std::sin(0.2 * k * x + 1.0);
      s.shapes.w(i, m) = 0.3 * std::cos(0.1 * k * x + 2.0);
    }
  }
  return s;
}

Patch patch_at(double begin, Eigen::Index n) {
  Patch patch;
  patch.name = "from " + std::to_string(begin);
  patch.cells = samples(begin, n);
  patch.load_share = static_cast<double>(n);
  return patch;
}

Harmonics motion(int n_harmonics) {
  Harmonics q(n_harmonics, n_modes);
  for (Eigen::Index i = 0; i < q.rows().size(); ++i) {
    q.rows().data()[i] = 0.7 * std::sin(1.0 + 2.3 * static_cast<double>(i)) /
                         (1.0 + static_cast<double>(i / (2 * n_modes)));
  }
  return q;
}

struct Case {
  const char* name;
  ContactEffects effects;
  SurfaceRules rules;
};

/// One of each method.
std::vector<Case> cases() {
  ContactEffects one;
  ContactEffects several;
  several.n_harmonics = 3;
  ContactEffects plane;
  plane.second_direction = true;
  SurfaceRules speed;
  speed.friction = FrictionLaw::exponential(0.5, 0.3, 0.2);
  SurfaceRules rough;
  rough.roughness = RoughSurface::cubic(0.2);
  return {{"closed form", one, {}},
          {"events", several, {}},
          {"by speed", several, speed},
          {"rough", one, rough},
          {"in a plane", plane, {}}};
}

double difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).norm() / (1.0 + b.norm());
}

// Row 17. Hard: contacts that are apart: sums over patches may forget or double a part.
// Met in: blades that rub at several faces.
// Right: every force, report and memory is that of the one patch they make up.
//
// Points are the same, in another order of sums.
TEST(ContactForce, TwoPatchesAreTheOneTheyMakeUp) {
  for (const Case& c : cases()) {
    std::vector<Patch> whole{patch_at(0.0, 12)};
    std::vector<Patch> halves{patch_at(0.0, 8), patch_at(8.0, 4)};
    for (auto* patches : {&whole, &halves}) {
      for (Patch& patch : *patches) patch.rules = c.rules;
    }
    for (const double load : {4.0, -2.0}) {
      const ContactForce one(whole, c.effects, load);
      const ContactForce two(halves, c.effects, load);
      const Harmonics q = motion(c.effects.n_harmonics);
      const ForceAndJacobian a = tests::evaluate(*one.modal_force(), q, 1.3);
      const ForceAndJacobian b = tests::evaluate(*two.modal_force(), q, 1.3);
      EXPECT_LT(difference(b.force.vector(), a.force.vector()), 1e-11) << c.name;
      EXPECT_LT((a.jacobian - b.jacobian).norm(), 1e-9 * (1.0 + a.jacobian.norm())) << c.name;
      const CycleReport all = tests::report(*one.modal_force(), q, 1.3);
      const CycleReport near = tests::report(*two.modal_force(0), q, 1.3);
      const CycleReport far = tests::report(*two.modal_force(1), q, 1.3);
      EXPECT_NEAR((8.0 * near.slip_share + 4.0 * far.slip_share) / 12.0, all.slip_share, 1e-11);
      EXPECT_NEAR(near.slip_work + far.slip_work, all.slip_work, 1e-10 * (1.0 + all.slip_work));
      const TransientMemory memory = one.transient_force()->virgin_memory();
      const ModalMotion now{Eigen::Vector3d(0.3, -0.2, 0.5), Eigen::Vector3d::Zero()};
      EXPECT_LT(difference(two.transient_force()->trial_force(now, memory),
                           one.transient_force()->trial_force(now, memory)),
                1e-12)
          << c.name;
    }
  }
}

// Whatever has few points is solved event by event; of others what sampling errs by is asked for.
TEST(ContactForce, IsSampledFromAsManyPointsAsThatPaysAndAgreesWithLocatedEvents) {
  const auto patches_of = [](Eigen::Index n, const Case& c) {
    std::vector<Patch> patches{patch_at(0.0, n)};
    patches.front().cells.stiffness.col(1).setConstant(1.2);
    patches.front().rules = c.rules;
    return patches;
  };
  for (Case c : cases()) {
    c.effects.n_harmonics = 3;
    const Eigen::Index least = std::string(c.name) == "by speed" ||
                                       std::string(c.name) == "rough" || c.effects.second_direction
                                   ? 9
                                   : 48;
    const std::vector<Patch> patches = patches_of(least, c);
    EXPECT_FALSE(is_sampled(patches_of(least - 1, c), c.effects)) << c.name;
    EXPECT_TRUE(is_sampled(patches, c.effects)) << c.name;
    ContactEffects located = c.effects;
    located.located = true;
    const auto sampled = ContactForce(patches, c.effects, 6.0).modal_force();
    const auto exact = ContactForce(patches, located, 6.0).modal_force();
    const Eigen::VectorXd force = tests::evaluate(*sampled, motion(3), 1.3).force.vector();
    const double error = difference(force, tests::evaluate(*exact, motion(3), 1.3).force.vector());
    EXPECT_LT(error, c.effects.force_tolerance) << c.name;
    EXPECT_GT(error, 0.0) << c.name << ": another method";
  }
}

/// Whose third mode moves the points as the first two do.
Patch two_motions(Eigen::Index n) {
  Patch patch = patch_at(0.0, n);
  for (Eigen::MatrixXd* shape :
       {&patch.cells.shapes.u, &patch.cells.shapes.v, &patch.cells.shapes.w}) {
    shape->col(2) = 0.7 * shape->col(0) - 0.05 * shape->col(1);
  }
  patch.cells.stiffness.col(1).setConstant(1.2);
  return patch;
}

// In lanes, along a line and in a plane: two coordinates say what three modes do.
TEST(ContactForce, IsThatOfAllModesThroughAsManyCoordinatesAsThePatchHasMotions) {
  MotionCoordinates two;
  two.of_modes = Eigen::MatrixXd{{2.0, 0.0, 1.4}, {0.5, 1.0, 0.3}};
  two.motion = Eigen::MatrixXd{{0.5, 0.0}, {-0.25, 1.0}, {0.0, 0.0}};
  ASSERT_TRUE((two.of_modes * two.motion).isIdentity(1e-15));
  std::vector<Patch> patches{two_motions(60)};
  const Harmonics q = motion(3);
  for (const bool planar : {false, true}) {
    ContactEffects effects;
    effects.n_harmonics = 3;
    effects.second_direction = planar;
    ASSERT_TRUE(is_sampled(patches, effects));
    const auto all = ContactForce(patches, effects, 40.0).modal_force();
    const auto few = ContactForce(patches, effects, 40.0, two).modal_force();
    for (const std::vector<Eigen::Index>& rows :
         {std::vector<Eigen::Index>{0, 1, 2, 3, 4, 5, 6}, {0, 1, 2, 5, 6}, {}}) {
      const ForceAndJacobian a = tests::evaluate(*all, q, 1.3, {.rows = rows});
      const ForceAndJacobian b = tests::evaluate(*few, q, 1.3, {.rows = rows});
      EXPECT_LT(difference(b.force.vector(), a.force.vector()), 1e-12);
      ASSERT_EQ(b.jacobian.rows(), a.jacobian.rows());
      EXPECT_LT((a.jacobian - b.jacobian).norm(), 1e-11 * (1.0 + a.jacobian.norm()));
    }
    EXPECT_LT((all->stuck_stiffness() - few->stuck_stiffness()).norm(),
              1e-13 * all->stuck_stiffness().norm());
    EXPECT_NEAR(tests::report(*all, q, 1.3).slip_work, tests::report(*few, q, 1.3).slip_work,
                1e-10);
    const ContactStates of_all = tests::states(*all, q, 1.3);
    const ContactStates of_few = tests::states(*few, q, 1.3);
    EXPECT_LT(state_change(of_all, of_few).largest, 1e-9);
    // Proved of few only where it is of all: their ball of motions is no smaller.
    for (const double radius : {1e-6, 1e-3, 1.0}) {
      if (few->linear_state(Harmonics(1, n_modes), radius) == LinearState::unknown) continue;
      EXPECT_EQ(few->linear_state(Harmonics(1, n_modes), radius),
                all->linear_state(Harmonics(1, n_modes), radius));
    }
  }
  two.of_modes.conservativeResize(2, 2);
  EXPECT_THROW(static_cast<void>(tests::evaluate(
                   *ContactForce(patches, {.n_harmonics = 3}, 40.0, two).modal_force(), q, 1.3)),
               std::invalid_argument);
}

/// Two points whose modes are their own motions u, v, w.
Patch points_alone() {
  Patch patch = patch_at(0.0, 2);
  const Eigen::MatrixXd own = Eigen::MatrixXd::Identity(6, 6);
  patch.cells.shapes = {own.topRows(2), own.middleRows(2, 2), own.bottomRows(2)};
  return patch;
}

// Exact: the force on two points under whatever moves them, and its derivatives.
TEST(ContactForce, OfFewPointsAndManyModesIsThatOfTheMotionsOfThePoints) {
  constexpr Eigen::Index many = 40;
  const Eigen::MatrixXd S =
      Eigen::MatrixXd::NullaryExpr(6, many, [](Eigen::Index i, Eigen::Index n) {
        return std::sin(1.0 + 1.7 * static_cast<double>(i) + 0.9 * static_cast<double>(n * n));
      });
  for (const Case& c : cases()) {
    std::vector<Patch> alone{points_alone()};
    std::vector<Patch> moved{points_alone()};
    moved[0].cells.shapes = {S.topRows(2), S.middleRows(2, 2), S.bottomRows(2)};
    for (auto* patches : {&alone, &moved}) patches->front().rules = c.rules;
    Harmonics q(c.effects.n_harmonics, many);
    for (Eigen::Index i = 0; i < q.rows().size(); ++i) {
      q.rows().data()[i] = 0.2 * std::cos(0.3 + 1.3 * static_cast<double>(i));
    }
    Harmonics x(c.effects.n_harmonics, 6);
    x.rows() = q.rows() * S.transpose();
    for (const double load : {4.0, -2.0}) {
      const auto of_points = ContactForce(alone, c.effects, load).modal_force();
      const auto of_modes = ContactForce(moved, c.effects, load).modal_force();
      const ForceAndJacobian a = tests::evaluate(*of_points, x, 1.3);
      const ForceAndJacobian b = tests::evaluate(*of_modes, q, 1.3);
      const Eigen::MatrixXd G = a.force.rows() * S;
      EXPECT_LT((b.force.rows() - G).norm(), 1e-11 * (1.0 + G.norm())) << c.name;
      const Eigen::Index n_rows = q.rows().rows();
      double error = 0.0;
      for (Eigen::Index i = 0; i < n_rows; ++i) {
        for (Eigen::Index k = 0; k < n_rows; ++k) {
          const Eigen::MatrixXd K = a.jacobian.block(6 * i, 6 * k, 6, 6);
          const Eigen::MatrixXd J = b.jacobian.block(many * i, many * k, many, many);
          error = std::max(error, (J - S.transpose() * K * S).norm());
        }
      }
      EXPECT_LT(error, 1e-8 * (1.0 + b.jacobian.norm())) << c.name;
      const auto parts = of_modes->evaluate(q, 1.3, {.fewer = true}, *of_modes->workspace());
      ASSERT_TRUE(parts.fewer) << c.name;
      EXPECT_LE(parts.fewer->of_modes.rows(), 6) << c.name;
    }
  }
}

TEST(ContactForce, MapsShowTheForceThatIsSimulated) {
  for (const Case& c : cases()) {
    std::vector<Patch> patches{patch_at(0.0, 12)};
    patches[0].rules = c.rules;
    const ContactForce contact(patches, c.effects, 4.0);
    const Harmonics q = motion(c.effects.n_harmonics);
    constexpr int n_phases = 4096;
    const ContactMap map = contact.map(0, Places::cells, q, 1.3, n_phases);
    const Harmonics force = tests::evaluate(*contact.modal_force(), q, 1.3).force;
    const PatchSamples& cells = patches[0].cells;
    Eigen::VectorXd sine = Eigen::VectorXd::Zero(n_modes);
    for (int j = 0; j < n_phases; ++j) {
      const double s = 2.0 / n_phases * std::sin(map.phase[j]);
      sine +=
          s * cells.shapes.u.transpose() * cells.weights.cwiseProduct(map.friction_traction.col(j));
      sine +=
          s * cells.shapes.v.transpose() * cells.weights.cwiseProduct(map.normal_traction.col(j));
      if (map.friction_traction_r.cols() == 0) continue;
      sine += s * cells.shapes.w.transpose() *
              cells.weights.cwiseProduct(map.friction_traction_r.col(j));
    }
    const double least = is_sampled(patches, c.effects) ? c.effects.force_tolerance : 1e-5;
    EXPECT_LT(difference(sine, force.sine().transpose()), least) << c.name;  // of 4096 samples
    EXPECT_EQ(map.friction_coefficient, cells.friction) << c.name;
  }
}

TEST(ContactForce, ALoadThatPressesIsSharedAndAGapIsNot) {
  std::vector<Patch> patches{patch_at(0.0, 4), patch_at(4.0, 4)};
  patches[0].load_share = 3.0;
  patches[1].load_share = 1.0;
  const ContactForce pressed(patches, {}, 8.0);
  const auto carried = [&](std::size_t patch) {
    double sum = 0.0;
    for (const PointParameters& point : pressed.points(patch)) sum += 0.5 * point.rest_load;
    return sum;
  };
  EXPECT_NEAR(carried(0), 6.0, 1e-14);
  EXPECT_NEAR(carried(1), 2.0, 1e-14);
  EXPECT_NEAR(pressed.at_rest().carried, 8.0, 1e-14);
  double total = 0.0;
  for (const Patch& patch : patches) total += patch.cells.stiffness.col(1).dot(patch.cells.weights);
  const ContactForce open(patches, {}, -3.0);
  for (const std::size_t patch : {0U, 1U}) {
    for (const PointParameters& point : open.points(patch)) {
      EXPECT_NEAR(-point.rest_load / point.normal_stiffness, 3.0 / total, 1e-15);
    }
  }
  for (Patch& patch : patches) patch.cells.stiffness.col(1).setZero();
  EXPECT_THROW(ContactForce(patches, {}, -3.0), LoadError);
}

}  // namespace
}  // namespace microslip::contact::test_contact_force
