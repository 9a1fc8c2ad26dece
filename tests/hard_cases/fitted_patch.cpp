/// @file
/// Hard: the quadrature of a patch follows the slip line, and the line appears, runs over the edges and
/// closes while the load grows (hard case 50d).
/// Met: a rule fitted inside Newton changes the residual under its feet; fitted after it, a line at the
/// edge can be there for one result and gone for the next, and the two chase each other for ever.
/// Right: every load converges within the allowed refits, to the response on very many points.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "contact/force/fitted_patch_force.hpp"
#include "contact/force/patch_force.hpp"
#include "solver/balance/harmonic_balance.hpp"
#include "solver/balance/newton.hpp"

namespace microslip::solver {
namespace {

using contact::FittedPatchForce;
using contact::ModalShapes;
using contact::PointParameters;
using contact::Refit;

contact::PatchCells patch() { return contact::rectangle_cells({0.0, 0.0}, {1.0, 0.5}, 1, 1); }

ModalShapes shapes_at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) {
  ModalShapes shapes{Eigen::MatrixXd(p.size(), 2), Eigen::MatrixXd(p.size(), 2), {}};
  shapes.u << (1.0 + 0.5 * p.array() * r.array()).matrix(), (2.0 * p.array()).cos().matrix();
  shapes.v << 0.3 * r, (0.4 * p.array().square()).matrix();
  return shapes;
}

// Lowest in the middle of the patch: the first slip is a closed line.
std::vector<PointParameters> parameters_at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) {
  std::vector<PointParameters> points;
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    const double distance = std::hypot(p[i] - 0.45, r[i] - 0.25);
    points.push_back({1.0, 1.0, 0.5, 0.8 + 2.0 * distance * distance});
  }
  return points;
}

Scene scene(double force, std::unique_ptr<contact::ModalForce> law) {
  Scene scene;
  scene.natural_frequency = Eigen::Vector2d(1.0, 1.7);
  scene.damping_ratio = Eigen::Vector2d(0.02, 0.02);
  scene.excitation = Harmonics(1, 2);
  scene.excitation.rows().row(1) << force, 0.3 * force;
  scene.output = Eigen::Vector2d(1.0, 0.5);
  scene.contact = std::move(law);
  return scene;
}

constexpr double frequency = 1.1;

Eigen::VectorXd solved(const HarmonicBalance& balance, const Eigen::VectorXd& start) {
  const Scaling scaling{1.0, 1.0, balance.force_scale(frequency), 0.0};
  const NewtonResult result = solve_newton(
      [&balance](const Eigen::VectorXd& x, double omega) { return balance.evaluate(x, omega); },
      {start, frequency}, scaling, {.tolerance = 1e-11, .max_iterations = 40});
  EXPECT_TRUE(result.converged) << result.residual;
  return result.point.x;
}

Eigen::VectorXd on_many_points(double force, const Eigen::VectorXd& start) {
  const contact::PatchRule rule =
      contact::midpoint_rule(contact::rectangle_cells({0.0, 0.0}, {1.0, 0.5}, 300, 150));
  const Scene many =
      scene(force, std::make_unique<contact::PatchForce>(
                       contact::ContactPatch(rule.weights, parameters_at(rule.p, rule.r)),
                       shapes_at(rule.p, rule.r)));
  return solved(HarmonicBalance(many, 1), start);
}

TEST(FittedPatchInSolver, ConvergesWhileLinesAppearTouchEdgesAndClose) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(6);
  double smallest_stick = 1.0;
  double largest_separation = 0.0;
  for (int step = 0; step <= 40; ++step) {
    const double force = 0.05 * std::pow(40.0, step / 40.0);
    auto owned = std::make_unique<FittedPatchForce>(patch(), shapes_at, parameters_at,
                                                    contact::FittedPatchOptions{});
    FittedPatchForce& law = *owned;
    const Scene fitted = scene(force, std::move(owned));
    const HarmonicBalance balance(fitted, 1);
    law.begin_point();
    Refit refit;
    int n_solves = 0;
    do {
      x = solved(balance, x);
      refit = law.refit(balance.harmonics(x), frequency);
      ++n_solves;
    } while (refit.outcome == Refit::Outcome::replaced);
    EXPECT_EQ(refit.outcome, Refit::Outcome::kept) << force << ": " << refit.change;
    EXPECT_LE(n_solves, 4) << force;
    const contact::CycleReport report = law.report(balance.harmonics(x), frequency);
    smallest_stick = std::min(smallest_stick, report.stick_share);
    largest_separation = std::max(largest_separation, report.separated_share);
    if (step % 8 == 0) {
      // 45 000 midpoints err by 1e-5 of the force; resonance amplifies less than tenfold here.
      EXPECT_LT((x - on_many_points(force, x)).norm(), 1e-4 * x.norm()) << force;
    }
  }
  EXPECT_LT(smallest_stick, 0.5);
  EXPECT_GT(largest_separation, 0.0);
}

}  // namespace
}  // namespace microslip::solver
