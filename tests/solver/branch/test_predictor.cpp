#include "solver/branch/predictor.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace microslip::solver::test_predictor {
namespace {

/// A branch that turns and twists: (cos s, sin s, s³/20) with a tangent of length one.
WalkerPoint at(double s) {
  WalkerPoint point;
  point.solution.point = {Eigen::Vector2d(std::cos(s), std::sin(s)), s * s * s / 20.0};
  point.tangent = {Eigen::Vector2d(-std::sin(s), std::cos(s)), 3.0 * s * s / 20.0};
  const double size = length(point.tangent);
  point.tangent.x /= size;
  point.tangent.parameter /= size;
  return point;
}

double error(const BranchPredictor& predictor, double from, double step) {
  const WalkerPoint before = at(from - step);
  const WalkerPoint now = at(from);
  const WalkerPoint next = at(from + step);
  const BranchVector way = difference(next.solution.point, now.solution.point, now.scaling);
  const BranchVector guess = predictor.point(before, now, dot(way, now.tangent));
  return length(difference(guess, next.solution.point, now.scaling));
}

TEST(BranchPredictor, KnowsTheTangentAtFirst) {
  const BranchPredictor fresh;
  EXPECT_NEAR(error(fresh, 0.5, 0.1) / error(fresh, 0.5, 0.05), 4.0, 0.5);
}

TEST(BranchPredictor, LearnsWhatForetellsBest) {
  BranchPredictor learned;
  learned.learn(at(0.4), at(0.45), at(0.5).solution.point);
  const BranchPredictor fresh;
  EXPECT_LT(error(learned, 0.5, 0.05), 0.05 * error(fresh, 0.5, 0.05));
  // Third order at least.
  EXPECT_GT(error(learned, 0.5, 0.1) / error(learned, 0.5, 0.05), 7.0);
}

TEST(BranchPredictor, StaysOnTheTangentAfterAKink) {
  BranchPredictor predictor;
  WalkerPoint now = at(0.45);
  const BranchVector straight = moved(now.solution.point, now.tangent, 0.05, now.scaling);
  predictor.learn(at(0.4), now, straight);
  const BranchVector guess = predictor.point(at(0.4), now, 0.05);
  EXPECT_LT(length(difference(guess, straight, now.scaling)), 1e-15);
}

TEST(BranchPredictor, OfOnePointAloneIsTheTangent) {
  BranchPredictor predictor;
  predictor.learn(at(0.4), at(0.45), at(0.5).solution.point);
  const WalkerPoint only = at(0.5);
  const BranchVector guess = predictor.point(only, only, 0.1);
  const BranchVector straight = moved(only.solution.point, only.tangent, 0.1, only.scaling);
  EXPECT_EQ(length(difference(guess, straight, only.scaling)), 0.0);
}

}  // namespace
}  // namespace microslip::solver::test_predictor
