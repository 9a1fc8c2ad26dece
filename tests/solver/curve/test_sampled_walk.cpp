// Signs that errors of sampled forces lead a walk (row 104 of the project's list of hard cases).

#include "solver/sampled_walk.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace microslip::solver::test_sampled_walk {
namespace {

ResponsePoint point_at(double frequency, double amplitude, PointMark mark) {
  ResponsePoint point;
  point.frequency = frequency;
  point.amplitude = amplitude;
  point.mark = mark;
  return point;
}

/// Two folds with a point between.
std::vector<ResponsePoint> pair_of_folds(double frequency, double amplitude) {
  return {point_at(100.0, 1.0, PointMark::fold), point_at(100.0, 1.0, PointMark::none),
          point_at(frequency, amplitude, PointMark::fold)};
}

TEST(SampledWalk, IsToldByFoldsCloserThanSuchForcesTell) {
  EXPECT_TRUE(is_led_by_errors(pair_of_folds(100.002, 1.01)));
  EXPECT_FALSE(is_led_by_errors(pair_of_folds(100.01, 1.01)));  // a small hysteresis
  EXPECT_FALSE(is_led_by_errors(pair_of_folds(100.002, 2.0)));  // a steep one
}

TEST(SampledWalk, IsToldByItsNumberOfPoints) {
  std::vector<ResponsePoint> branch(500, point_at(100.0, 1.0, PointMark::none));
  EXPECT_FALSE(is_led_by_errors(branch));
  branch.push_back(branch.back());
  EXPECT_TRUE(is_led_by_errors(branch));
}

}  // namespace
}  // namespace microslip::solver::test_sampled_walk
