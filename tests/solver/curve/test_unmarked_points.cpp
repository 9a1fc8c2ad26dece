#include "solver/curve/unmarked_points.hpp"

#include <initializer_list>

#include <gtest/gtest.h>

namespace microslip::solver::test_unmarked_points {
namespace {

struct Row {
  double frequency, amplitude;
  PointMark mark = PointMark::none;
};

ResponseCurve curve_of(std::initializer_list<Row> rows) {
  ResponseCurve curve;
  curve.complete = true;
  for (const Row& row : rows) {
    ResponsePoint point;
    point.frequency = row.frequency;
    point.amplitude = row.amplitude;
    point.mark = row.mark;
    curve.points.push_back(point);
  }
  return curve;
}

TEST(UnmarkedPoints, ALargestRowWithoutAPeakIsMarkedAndLogged) {
  ResponseCurve curve = curve_of({{1.0, 1.0}, {1.1, 2.0}, {1.2, 3.0}, {1.3, 2.5}, {1.4, 2.0}});
  mark_unsolved(curve);
  EXPECT_EQ(curve.points[2].mark, PointMark::peak);
  ASSERT_EQ(curve.log.size(), 1U);
  EXPECT_EQ(curve.log[0].remedy, Remedy::peak_unsolved);
  EXPECT_EQ(curve.log[0].frequency, 1.2);
}

TEST(UnmarkedPoints, ARowWhereTheFrequencyTurnsIsMarkedAndLogged) {
  ResponseCurve curve = curve_of({{1.0, 1.0}, {1.1, 2.0}, {1.05, 3.0}, {1.02, 4.0}, {1.01, 5.0}});
  mark_unsolved(curve);
  EXPECT_EQ(curve.points[1].mark, PointMark::fold);
  ASSERT_EQ(curve.log.size(), 1U);
  EXPECT_EQ(curve.log[0].remedy, Remedy::fold_unsolved);
}

TEST(UnmarkedPoints, SolvedPeaksRoundingAndBrokenCurvesAreLeftAlone) {
  ResponseCurve solved =
      curve_of({{1.0, 1.0}, {1.1, 2.0}, {1.15, 2.1, PointMark::peak}, {1.2, 2.0}, {1.3, 1.0}});
  ResponseCurve rounded = curve_of({{1.0, 1.0}, {1.1, 2.0}, {1.2, 1.9999999}, {1.3, 3.0}});
  ResponseCurve broken = curve_of({{1.0, 1.0}, {1.1, 2.0}, {1.2, 1.0}});
  broken.complete = false;
  ResponseCurve jumped = curve_of({{1.0, 1.0}, {1.1, 2.0}, {1.2, 1.0}});
  jumped.log.push_back({1.1, Remedy::homotopy});
  for (ResponseCurve* curve : {&solved, &rounded, &broken, &jumped}) {
    const std::size_t n_logged = curve->log.size();
    mark_unsolved(*curve);
    EXPECT_EQ(curve->log.size(), n_logged);
    EXPECT_EQ(curve->points[1].mark, PointMark::none);
  }
}

}  // namespace
}  // namespace microslip::solver::test_unmarked_points
