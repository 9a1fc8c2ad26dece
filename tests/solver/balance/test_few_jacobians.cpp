#include "solver/balance/few_jacobians.hpp"

#include <cstdio>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "solver/branch/start_point.hpp"
#include "solver/continuation.hpp"
#include "tests/support/modal_scenes.hpp"

namespace microslip::solver::test_few_jacobians {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// A balance with a solved point, and counts of what is evaluated.
struct Bench {
  Bench(double preload, const HarmonicSet& set, double hertz)
      : scene(tests::three_dof_scene(preload)) {
    tests::use_event_cycles(scene);
    balance = std::make_unique<HarmonicBalance>(scene, set);
    auto start = find_start(*balance, two_pi * hertz, 1e-11);
    EXPECT_TRUE(start.solution.has_value());
    at = std::move(*start.solution);
    scaling = natural_scaling(*balance, at.point.x, at.point.parameter);
    system.whole = [this](const Eigen::VectorXd& x, double frequency) {
      ++n_whole;
      return balance->evaluate(x, frequency);
    };
    system.residual = [this](const Eigen::VectorXd& x, double frequency) {
      ++n_residual;
      return balance->residual(x, frequency);
    };
    hold = {Eigen::VectorXd::Zero(balance->size()), 1.0};
  }

  [[nodiscard]] NewtonResult solved(const BranchVector& guess) {
    return solve_with_few_jacobians(system, guess, hold, scaling, {});
  }

  Scene scene;
  std::unique_ptr<HarmonicBalance> balance;
  NewtonResult at;
  Scaling scaling;
  EconomicSystem system;
  BranchVector hold;
  int n_whole = 0;
  int n_residual = 0;
};

TEST(FewJacobians, OneJacobianLeadsToTheSolutionOfNewtonsMethod) {
  for (const double preload : {10.0, 50.0, 100.0}) {
    Bench bench(preload, 5, 21.0);
    const double frequency = two_pi * 21.002;
    const NewtonResult found = bench.solved({bench.at.point.x, frequency});
    ASSERT_TRUE(found.converged) << preload;
    EXPECT_EQ(bench.n_whole, 1) << preload;
    EXPECT_EQ(found.evaluations, bench.n_whole + bench.n_residual);
    EXPECT_LE(found.residual, 1e-11);
    const NewtonResult expected = solve_at(*bench.balance, bench.at.point.x, frequency, {});
    ASSERT_TRUE(expected.converged);
    EXPECT_LT((found.point.x - expected.point.x).norm(), 1e-8 * expected.point.x.norm());
    const BalanceEvaluation there = bench.balance->evaluate(found.point.x, frequency);
    // Made at the guess, which is near.
    EXPECT_LT((there.jacobian.dense() - found.evaluation.jacobian.dense()).norm(),
              1e-2 * there.jacobian.dense().norm());
    EXPECT_LT((there.residual - found.evaluation.residual).norm(), 1e-14 * bench.scaling.residual);
    std::printf("%g N: %d forces and one Jacobian\n", preload, bench.n_residual);
  }
}

TEST(FewJacobians, FarFromTheChordItIsNewtonsMethod) {
  Bench bench(50.0, 3, 21.0);
  const NewtonResult found = bench.solved({1.3 * bench.at.point.x, two_pi * 21.5});
  ASSERT_TRUE(found.converged);
  EXPECT_GT(bench.n_whole, 1);
  EXPECT_LE(found.residual, 1e-11);
  EXPECT_EQ(found.evaluations, bench.n_whole + bench.n_residual);
}

TEST(FewJacobians, FactorsOfAnotherPlaceSaveTheJacobianOfAGuess) {
  Bench bench(50.0, 5, 21.0);
  const double frequency = two_pi * 21.1;
  const BranchVector guess{1.001 * bench.at.point.x, frequency};
  const NewtonResult alone = bench.solved(guess);
  ASSERT_TRUE(alone.converged);
  const int n_alone = std::exchange(bench.n_whole, 0);
  const BranchFactors factors(bench.at.evaluation, bench.hold, bench.scaling);
  const NewtonResult led =
      solve_with_few_jacobians(bench.system, guess, bench.hold, bench.scaling, {}, &factors);
  ASSERT_TRUE(led.converged);
  EXPECT_EQ(bench.n_whole, 1);
  EXPECT_GT(n_alone, 1);
  EXPECT_LT((led.point.x - alone.point.x).norm(), 1e-8 * alone.point.x.norm());
  ASSERT_NE(led.factors, nullptr);
}

TEST(FewJacobians, WithoutNewtonsMethodWhatIsFarIsGivenUp) {
  Bench bench(50.0, 3, 21.0);
  const BranchFactors factors(bench.at.evaluation, bench.hold, bench.scaling);
  const NewtonResult lost =
      solve_with_few_jacobians(bench.system, {-40.0 * bench.at.point.x, two_pi * 27.0}, bench.hold,
                               bench.scaling, {.max_iterations = 0}, &factors);
  EXPECT_FALSE(lost.converged);
  EXPECT_EQ(bench.n_whole, 0);
  EXPECT_EQ(lost.evaluations, bench.n_residual);
}

TEST(FewJacobians, ResidualAloneIsThatOfTheWholeEvaluation) {
  Bench bench(30.0, HarmonicSet(std::vector<int>{1, 2, 5}), 21.0);
  const Eigen::VectorXd x = 1.1 * bench.at.point.x;
  const BalanceEvaluation whole = bench.balance->evaluate(x, two_pi * 22.0);
  const BalanceEvaluation alone = bench.balance->residual(x, two_pi * 22.0);
  EXPECT_LT((whole.residual - alone.residual).norm(), 1e-14 * whole.residual.norm());
  EXPECT_LT((whole.contact_force - alone.contact_force).norm(), 1e-14 * whole.residual.norm());
  EXPECT_TRUE(alone.jacobian.empty());
}

TEST(FewJacobians, ACurveCostsFewWholeEvaluations) {
  Bench bench(50.0, 3, 18.0);
  ContinuationOptions range;
  range.frequency_begin = two_pi * 18.0;
  range.frequency_end = two_pi * 28.0;
  range.n_harmonics = 3;
  const ResponseCurve curve = trace_response(bench.scene, range);
  ASSERT_TRUE(curve.complete) << curve.diagnosis;
  const double per_point =
      static_cast<double>(curve.contact_evaluations) / static_cast<double>(curve.points.size());
  std::printf("%zu points, %.1f evaluations each\n", curve.points.size(), per_point);
  EXPECT_LT(per_point, 14.0);
}

}  // namespace
}  // namespace microslip::solver::test_few_jacobians
