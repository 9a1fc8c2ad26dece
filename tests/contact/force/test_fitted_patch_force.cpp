#include "contact/force/fitted_patch_force.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "contact/force/patch_force.hpp"

namespace microslip::contact {
namespace {

PatchCells patch() { return rectangle_cells({0.0, 0.0}, {1.0, 0.5}, 1, 1); }

ModalShapes shapes_at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) {
  ModalShapes shapes{Eigen::MatrixXd(p.size(), 2), Eigen::MatrixXd(p.size(), 2), {}};
  shapes.u << (1.0 + p.array() * r.array()).matrix(), p.array().cos().matrix();
  shapes.v << 0.3 * r, (0.2 * p.array().square()).matrix();
  return shapes;
}

std::vector<PointParameters> parameters_at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) {
  std::vector<PointParameters> points;
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    points.push_back({1.0, 1.0, 0.5, 1.0 + 0.5 * p[i] - 0.3 * r[i]});
  }
  return points;
}

// Amplitude 1: the onset of slip crosses the patch; small ones stick.
Harmonics motion(double amplitude) {
  Harmonics q(1, 2);
  q.rows() << 0.02, -0.01, 0.45, 0.1, 0.1, -0.05;
  q.rows() *= amplitude;
  return q;
}

Eigen::VectorXd force_by_many_points(const Harmonics& q) {
  const PatchRule rule = fitted_rule(patch(), regime_guards(shapes_at, parameters_at, {q}),
                                     {.order = 20, .line_tolerance = 1e-12});
  const PatchForce force(ContactPatch(rule.weights, parameters_at(rule.p, rule.r)),
                         shapes_at(rule.p, rule.r));
  return force.evaluate(q, 1.0).force.vector();
}

FittedPatchForce fitted(const FittedPatchOptions& options) {
  return {patch(), shapes_at, parameters_at, options};
}

TEST(FittedPatchForce, KeepsItsRuleWhereNothingSlips) {
  FittedPatchForce force = fitted({});
  const Eigen::Index n = force.rule().n_points();
  const Refit refit = force.refit(motion(0.01), 1.0);
  EXPECT_EQ(refit.outcome, Refit::Outcome::kept);
  EXPECT_EQ(refit.change, 0.0);
  EXPECT_EQ(force.rule().n_points(), n);
  EXPECT_EQ(n, 64);
}

TEST(FittedPatchForce, FollowsTheSlipLineAndThenStandsStill) {
  FittedPatchForce force = fitted({});
  const Harmonics q = motion(1.0);
  const Eigen::VectorXd exact = force_by_many_points(q);
  const auto error = [&] {
    return (force.evaluate(q, 1.0).force.vector() - exact).norm() / exact.norm();
  };
  EXPECT_GT(error(), 1e-6);  // one Gauss rule over the kink
  const CycleReport report = force.report(q, 1.0);
  EXPECT_GT(report.slip_share, 0.05);
  EXPECT_GT(report.stick_share, 0.05);

  const Refit first = force.refit(q, 1.0);
  EXPECT_EQ(first.outcome, Refit::Outcome::replaced);
  EXPECT_GT(first.change, 1e-6);
  EXPECT_LT(error(), 1e-8);
  EXPECT_EQ(first.n_points, force.rule().n_points());
  EXPECT_EQ(force.refit(q, 1.0).outcome, Refit::Outcome::kept);
}

// A rule fitted nearby errs with the square of the distance.
TEST(FittedPatchForce, ErrsWithTheSquareOfWhatTheLineMoved) {
  FittedPatchForce force = fitted({.rule = {.order = 12}, .force_tolerance = 1e-14});
  (void)force.refit(motion(1.0), 1.0);
  const auto error = [&force](double step) {
    const Harmonics q = motion(1.0 + step);
    return (force.evaluate(q, 1.0).force.vector() - force_by_many_points(q)).norm();
  };
  // 16 for an integral; a line that passes points on its way makes it uneven.
  EXPECT_GT(error(4e-2) / error(1e-2), 8.0);
}

// Hard case 50d: a line that is there for one result and gone for the next.
TEST(FittedPatchForce, DoesNotCycleWhenALineAppearsAndDisappears) {
  FittedPatchForce force =
      fitted({.rule = {.order = 4}, .force_tolerance = 1e-12, .max_refits = 6});
  int n_solves = 0;
  Refit refit;
  do {
    // An iteration that answers each rule with the other of two states.
    refit = force.refit(motion(n_solves % 2 == 0 ? 1.0 : 0.8), 1.0);
    ++n_solves;
  } while (refit.outcome == Refit::Outcome::replaced && n_solves < 100);
  EXPECT_LE(n_solves, 7);
  // The rule kept both lines: either state is right on it.
  for (const double amplitude : {1.0, 0.8}) {
    const Harmonics q = motion(amplitude);
    const Eigen::VectorXd exact = force_by_many_points(q);
    EXPECT_LT((force.evaluate(q, 1.0).force.vector() - exact).norm() / exact.norm(), 1e-8);
  }
  force.begin_point();
  EXPECT_NE(force.refit(motion(0.5), 1.0).outcome, Refit::Outcome::exhausted);
}

TEST(FittedPatchForce, RunsOutOfRefitsWithItsErrorNamed) {
  FittedPatchForce force =
      fitted({.rule = {.order = 2}, .force_tolerance = 1e-16, .max_refits = 1});
  EXPECT_EQ(force.refit(motion(1.0), 1.0).outcome, Refit::Outcome::replaced);
  const Eigen::Index n = force.rule().n_points();
  const Refit refit = force.refit(motion(1.3), 1.0);
  EXPECT_EQ(refit.outcome, Refit::Outcome::exhausted);
  EXPECT_GT(refit.change, 1e-16);
  EXPECT_EQ(force.rule().n_points(), n);
}

TEST(FittedPatchForce, IsTheForceOfItsPoints) {
  FittedPatchForce force = fitted({});
  const Harmonics q = motion(1.0);
  (void)force.refit(q, 1.0);
  const PatchRule& rule = force.rule();
  const PatchForce expected(ContactPatch(rule.weights, parameters_at(rule.p, rule.r)),
                            shapes_at(rule.p, rule.r));
  EXPECT_EQ(force.n_modes(), 2);
  EXPECT_EQ(force.evaluate(q, 1.0).jacobian, expected.evaluate(q, 1.0).jacobian);
  EXPECT_EQ(force.stuck_stiffness(), expected.stuck_stiffness());
}

TEST(FittedPatchForce, RefusesBrokenOptions) {
  EXPECT_THROW((void)fitted({.rule = {}, .force_tolerance = 0.0}), std::invalid_argument);
  EXPECT_THROW((void)fitted({.rule = {}, .max_refits = 0}), std::invalid_argument);
  EXPECT_THROW((void)fitted({.rule = {.order = 0}}), std::invalid_argument);
}

}  // namespace
}  // namespace microslip::contact
