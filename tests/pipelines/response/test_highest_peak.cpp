#include "pipelines/response/highest_peak.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace microslip::pipelines::test_highest_peak {
namespace {

using solver::PointMark;

solver::ResponseCurve curve_of(const std::vector<std::pair<double, PointMark>>& points) {
  solver::ResponseCurve curve;
  for (const auto& [amplitude, mark] : points) {
    solver::ResponsePoint& point = curve.points.emplace_back();
    point.amplitude = amplitude;
    point.mark = mark;
  }
  return curve;
}

TEST(HighestPeak, IsTheHighestThatWasSolvedForElseTheLargestPoint) {
  EXPECT_EQ(highest_peak({}), nullptr);
  const auto two =
      curve_of({{1.0, PointMark::none}, {2.0, PointMark::peak}, {3.0, PointMark::peak}});
  EXPECT_EQ(highest_peak(two), &two.points[2]);
  const auto none = curve_of({{1.0, PointMark::none}, {4.0, PointMark::fold}});
  EXPECT_EQ(highest_peak(none), &none.points[1]);
}

// A branch that still rises at the end of a range has its peak beyond, whatever small one it
// passes.
TEST(HighestPeak, IsAboveAllWhereNothingElseIsLarger) {
  EXPECT_EQ(peak_above_all({}), nullptr);
  const auto top =
      curve_of({{1.0, PointMark::none}, {2.0, PointMark::peak}, {1.5, PointMark::fold}});
  EXPECT_EQ(peak_above_all(top), &top.points[1]);
  EXPECT_EQ(peak_above_all(curve_of({{9.0, PointMark::none}, {2.0, PointMark::peak}})), nullptr);
  EXPECT_EQ(peak_above_all(curve_of({{1.0, PointMark::none}, {2.0, PointMark::none}})), nullptr);
}

}  // namespace
}  // namespace microslip::pipelines::test_highest_peak
