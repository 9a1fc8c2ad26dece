// A walk along branches of one unknown that are known in closed form.

#include "solver/branch/branch_walker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

namespace microslip::solver::test_branch_walker {
namespace {

BalanceEvaluation evaluation(double residual, double by_x, double by_parameter) {
  BalanceEvaluation at;
  at.residual = Eigen::VectorXd::Constant(1, residual);
  at.jacobian = Eigen::MatrixXd::Constant(1, 1, by_x);
  at.parameter_derivative = Eigen::VectorXd::Constant(1, by_parameter);
  at.contact_force = Eigen::VectorXd::Zero(1);
  return at;
}

BranchWalker walker_from(const ParametricSystem& system, double x, double parameter) {
  const Scaling unit;
  NewtonResult start = evaluated_at(system, {Eigen::VectorXd::Constant(1, x), parameter}, unit);
  EXPECT_LT(start.residual, 1e-14);
  start.converged = true;
  return {system, [=](const NewtonResult&) { return unit; }, std::move(start), 1.0};
}

double x_of(const BranchWalker& walker) { return walker.now().solution.point.x[0]; }
double parameter_of(const BranchWalker& walker) { return walker.now().solution.point.parameter; }

/// |x| = −εp + c p², p ≤ 0: two parts that meet at the origin under an angle of 2ε.
struct Tip {
  double half_angle = 0.0;
  double bend = 0.0;         ///< c where x ≥ 0
  double bend_beyond = 0.0;  ///< c where x < 0

  [[nodiscard]] double width(double p) const { return -half_angle * p + bend * p * p; }
  [[nodiscard]] ParametricSystem system() const {
    return [*this](const Eigen::VectorXd& x, double p) {
      const double bent = (x[0] < 0.0 ? bend_beyond : bend) * std::min(p, 0.0);
      return evaluation(std::abs(x[0]) + half_angle * p - bent * p, x[0] < 0.0 ? -1.0 : 1.0,
                        half_angle - 2.0 * bent);
    };
  }
};

// Row 83. Hard: two parts that meet in a tip of a few degrees: a step along one lands on the other.
// Met in: random scenes, where slip of a point begins (`hard_cases.sharp_tips`).
// Right: the walk goes on along the other part, away from the tip.
TEST(BranchWalker, ASharpTipIsPassedToTheOtherPart) {
  constexpr double start = -0.05;
  int n_tips = 0;
  for (const double half_angle : {3e-3, 1e-2, 3e-2, 0.1, 0.25, 0.4}) {
    for (const double bend : {0.0, 1.0, 10.0, 100.0}) {
      // Where the steps end before the tip is chance.
      for (const double share : {1.0, 1.03, 1.07, 1.11, 1.17}) {
        const Tip tip{half_angle, bend, bend};
        const double from = share * start;
        BranchWalker walker = walker_from(tip.system(), tip.width(from), from);
        int n_steps = 0;
        while (parameter_of(walker) >= 1.2 * start && n_steps < 500 && walker.advance()) ++n_steps;
        EXPECT_LT(parameter_of(walker), 1.2 * start) << half_angle << ' ' << bend << ' ' << share;
        EXPECT_LT(x_of(walker), 0.0) << half_angle << ' ' << bend << ' ' << share;
        ++n_tips;
      }
    }
  }
  EXPECT_EQ(n_tips, 120);
}

// Row 83. Hard: the part beyond the tip bends within the three steps that are looked back.
// Met in: rough blocks of four cells, where slip in a plane begins.
// Right: as above; it is not taken for a branch point, from which the walk would come back.
TEST(BranchWalker, ATipWhoseOtherPartBendsAtOnceIsNoBranchPoint) {
  for (const double half_angle : {3e-3, 1e-2, 3e-2, 0.1}) {
    for (const double bend : {100.0, 300.0, 1e3}) {
      for (const double times : {10.0, 30.0, 100.0, 1e3}) {
        for (const double share : {1.0, 1.03, 1.07, 1.11, 1.17}) {
          const Tip tip{half_angle, bend, times * bend};
          const double from = -1e-3 * share;
          BranchWalker walker = walker_from(tip.system(), tip.width(from), from);
          int n_steps = 0;
          while (parameter_of(walker) >= -1.2e-3 && n_steps < 500 && walker.advance()) ++n_steps;
          EXPECT_LT(parameter_of(walker), -1.2e-3) << half_angle << ' ' << bend << ' ' << times;
          EXPECT_LT(x_of(walker), 0.0) << half_angle << ' ' << bend << ' ' << times;
        }
      }
    }
  }
}

TEST(BranchWalker, ABranchPointIsNoTip) {
  // x = 0 and p = x²: the determinant p changes its sign on the way straight on.
  const ParametricSystem fork = [](const Eigen::VectorXd& x, double p) {
    return evaluation(x[0] * (p - x[0] * x[0]), p - 3.0 * x[0] * x[0], x[0]);
  };
  BranchWalker walker = walker_from(fork, 0.0, -0.3);
  for (int i = 0; i < 200 && parameter_of(walker) < 0.3; ++i) {
    const double before = parameter_of(walker);
    ASSERT_TRUE(walker.advance());
    EXPECT_GT(parameter_of(walker), before);
    EXPECT_EQ(x_of(walker), 0.0);
  }
  EXPECT_GE(parameter_of(walker), 0.3);
}

// Row 86. Hard: another branch crosses where the branch bends: it looks like a tip.
// Met in: random scenes (`hard_cases.sharp_tips`).
// Right: the walk goes on, bent.
TEST(BranchWalker, ABranchPointIsNoTipWhereTheBranchBends) {
  // x = 0 up to the branch point and x = s p beyond it, up to 27°; x = −p crosses.
  int n_bends = 0;
  for (const double slope : {-0.2, 0.1, 0.3, 0.4, 0.5}) {
    const ParametricSystem bent = [slope](const Eigen::VectorXd& x, double p) {
      const double own = x[0] - slope * std::max(p, 0.0);
      const double other = x[0] + p;
      return evaluation(own * other, own + other, own - (p > 0.0 ? slope : 0.0) * other);
    };
    for (const double share : {1.01, 1.03, 1.07, 1.11, 1.17}) {
      BranchWalker walker = walker_from(bent, 0.0, -0.3 * share);
      for (int i = 0; i < 300 && parameter_of(walker) < 0.3; ++i) {
        const double before = parameter_of(walker);
        ASSERT_TRUE(walker.advance()) << slope << ' ' << share;
        ASSERT_GT(parameter_of(walker), before) << slope << ' ' << share;
      }
      EXPECT_NEAR(x_of(walker), slope * parameter_of(walker), 1e-9) << slope << ' ' << share;
      ++n_bends;
    }
  }
  EXPECT_EQ(n_bends, 25);
}

/// p = m u up to the origin and p = −n u beyond it, with v = 0: a motion u that changes sign after
/// half a period meets two events at once. By each alone the determinant would keep its sign; both
/// change that of what breaks the symmetry, v, too.
struct TwinKink {
  double before = 0.0;  ///< m
  double after = 0.0;   ///< n
  bool twin = true;     ///< else one event alone, which v does not feel

  [[nodiscard]] ParametricSystem system() const {
    return [*this](const Eigen::VectorXd& x, double p) {
      const double u = x[0];
      const double v = x[1];
      const double slope = u < 0.0 ? before : -after;
      const double plus = twin && u + v > 0.0 ? 1.0 : -1.0;
      const double minus = twin && u - v > 0.0 ? 1.0 : -1.0;
      BalanceEvaluation at;
      at.residual = Eigen::Vector2d(p - slope * u, 0.5 * (minus * (u - v) - plus * (u + v)));
      at.jacobian = Eigen::MatrixXd{{-slope, 0.0}, {0.5 * (minus - plus), -0.5 * (minus + plus)}};
      at.parameter_derivative = Eigen::Vector2d(1.0, 0.0);
      at.contact_force = Eigen::Vector2d::Zero();
      return at;
    };
  }
};

/// Walks past the kink and says how often the walker told that the branch turns back.
int n_turns_back(const TwinKink& kink, double u) {
  const Scaling unit;
  NewtonResult start =
      evaluated_at(kink.system(), {Eigen::Vector2d(u, 0.0), kink.before * u}, unit);
  start.converged = true;
  BranchWalker walker(
      kink.system(), [=](const NewtonResult&) { return unit; }, std::move(start), 1.0);
  int n_turns = 0;
  for (int i = 0; i < 300 && x_of(walker) < 0.3 && x_of(walker) >= u && walker.advance(); ++i) {
    if (!walker.kink()) continue;
    ++n_turns;
    EXPECT_LT(walker.kink()->solution.point.x.norm(), 1e-6);
    EXPECT_NEAR(walker.kink()->tangent.parameter, -kink.after * walker.kink()->tangent.x[0], 1e-9);
  }
  EXPECT_GE(x_of(walker), 0.3);
  EXPECT_NEAR(parameter_of(walker), -kink.after * x_of(walker), 1e-9);
  return n_turns;
}

// Row 87. Hard: two events at once turn the sign of the determinant.
// Met in: motions that change sign after half a period.
// Right: the kink is left along the part the walk did not come by.
TEST(BranchWalker, KinksAtWhichTheBranchTurnsBackAreLeftAndTold) {
  // With two events at once the determinant turns with the branch.
  constexpr double first = -0.3;  // of u
  int n_kinks = 0;
  for (const bool twin : {true, false}) {
    for (const auto& [before, after] :
         {std::pair{3.0, 1.5}, {1.2, 5.0}, {0.9, 2.0}, {4.0, 0.6}, {1.2, 1.0}, {9.0, 11.0}}) {
      for (const double share : {1.0, 1.03, 1.07, 1.11, 1.17}) {
        SCOPED_TRACE(testing::Message() << twin << ' ' << before << ' ' << after << ' ' << share);
        EXPECT_EQ(n_turns_back({before, after, twin}, share * first), 1);
        ++n_kinks;
      }
    }
  }
  EXPECT_EQ(n_kinks, 60);
}

/// p = u, v = 0 up to the origin, where two events meet: u + v = 0 and u − v = 0. Beyond them
/// M = max(u + v, u − v) acts in 0 = u − p + α M and 0 = v + β M: the branch goes on where v has
/// the sign of −β, with p = u (1 + α − |β|)/(1 − |β|). Straight on, v = 0, both regimes are as
/// near; the determinant 1 + α ± |β| changes its sign in one of them alone.
struct TwoRegimes {
  double alpha = 0.0;
  double beta = 0.0;

  [[nodiscard]] ParametricSystem system() const {
    return [*this](const Eigen::VectorXd& x, double p) {
      const double side = x[1] * beta < 0.0 ? -beta : beta;  // a tie is taken for the wrong one
      const Eigen::RowVector2d slope(1.0, side > 0.0 ? 1.0 : -1.0);
      const bool acts = slope.dot(x) > 0.0;
      const Eigen::Vector2d force(alpha, beta);
      BalanceEvaluation at;
      at.residual = Eigen::Vector2d(x[0] - p, x[1]);
      Eigen::Matrix2d jacobian = Eigen::Matrix2d::Identity();
      if (acts) {
        at.residual += force * slope.dot(x);
        jacobian += force * slope;
      }
      at.jacobian = jacobian;
      at.parameter_derivative = Eigen::Vector2d(-1.0, 0.0);
      at.contact_force = Eigen::Vector2d::Zero();
      return at;
    };
  }
};

// Row 89. Hard: several events at a kink: straight on lies a regime that is not the branch's.
// Met in: friction that falls with the speed.
// Right: the walk goes on into the regime in which its own tangent ends.
TEST(BranchWalker, AKinkIsLeftIntoTheRegimeItsTangentEndsIn) {
  int n_kinks = 0;
  for (const auto& [alpha, beta] :
       {std::pair{-1.0, 0.5}, {-1.0, -0.5}, {-1.2, 0.6}, {-0.9, 0.45}}) {
    const ParametricSystem system = TwoRegimes{alpha, beta}.system();
    for (const double share : {1.0, 1.03, 1.07, 1.11, 1.17}) {
      SCOPED_TRACE(testing::Message() << alpha << ' ' << beta << ' ' << share);
      const Scaling unit;
      const double begin = -0.3 * share;
      NewtonResult start = evaluated_at(system, {Eigen::Vector2d(begin, 0.0), begin}, unit);
      start.converged = true;
      BranchWalker walker(
          system, [=](const NewtonResult&) { return unit; }, std::move(start), 1.0);
      for (int i = 0; i < 300 && x_of(walker) < 0.3 && x_of(walker) >= begin; ++i) {
        ASSERT_TRUE(walker.advance());
      }
      EXPECT_GE(x_of(walker), 0.3);
      const double width = 1.0 - std::abs(beta);
      EXPECT_NEAR(parameter_of(walker), (width + alpha) / width * x_of(walker), 1e-9);
      EXPECT_NEAR(walker.now().solution.point.x[1], -beta / width * x_of(walker), 1e-9);
      ++n_kinks;
    }
  }
  EXPECT_EQ(n_kinks, 20);
}

// Row 94. Hard: a step to a part beside the one walked, both tangents along it.
// Met in: scene 501.30: complete with 2 folds of 8.
// Right: refused: a range and its parts have the same folds.
//
/// p = x − a tanh(x / w): the branch turns back on its way from one line to another beside it, and
/// for steps longer than w both are as good.
TEST(BranchWalker, AStepDoesNotLeadPastTwoFolds) {
  int n_walks = 0;
  for (const double half_offset : {0.015, 0.02, 0.03, 0.04}) {
    for (const double width : {0.003, 0.006, 0.01}) {
      const ParametricSystem system = [=](const Eigen::VectorXd& x, double p) {
        const double rise = std::tanh(x[0] / width);
        return evaluation(p - x[0] + half_offset * rise,
                          -1.0 + half_offset / width * (1.0 - rise * rise), 1.0);
      };
      // Where the steps end before the folds is chance.
      for (const double share : {1.0, 1.03, 1.07, 1.11, 1.17}) {
        SCOPED_TRACE(testing::Message() << half_offset << ' ' << width << ' ' << share);
        const double begin = -share;
        BranchWalker walker = walker_from(system, begin, begin + half_offset);
        int n_folds = 0;
        while (x_of(walker) < 1.0) {
          ASSERT_TRUE(walker.advance());
          if (walker.now().tangent.parameter * walker.before().tangent.parameter < 0.0) ++n_folds;
        }
        EXPECT_EQ(n_folds, 2);
        ++n_walks;
      }
    }
  }
  EXPECT_EQ(n_walks, 60);
}

}  // namespace
}  // namespace microslip::solver::test_branch_walker
