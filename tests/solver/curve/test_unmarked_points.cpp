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

// Row 69. Hard: a peak at a kink where the frequency turns: one mark of two is lost.
// Met in: tangential stiffness 1e10, damping 8e-6: 15 folds of 16.
// Right: peak and fold, so that folds are even in number.
TEST(UnmarkedPoints, APeakAtWhichTheBranchTurnsIsAFoldAsWell) {
  // Up to a fold, back to a peak and on: as many turns to the left as to the right.
  ResponseCurve curve = curve_of({{1.0, 1.0},
                                  {1.1, 2.0},
                                  {1.2, 2.5, PointMark::fold},
                                  {1.1999, 2.6, PointMark::peak},
                                  {1.3, 2.0},
                                  {1.4, 1.0}});
  mark_unsolved(curve);
  ASSERT_EQ(curve.points.size(), 7U);
  EXPECT_EQ(curve.points[3].mark, PointMark::fold);
  EXPECT_EQ(curve.points[3].frequency, 1.1999);
  EXPECT_EQ(curve.points[4].mark, PointMark::peak);
  ASSERT_EQ(curve.log.size(), 1U);
  EXPECT_EQ(curve.log[0].remedy, Remedy::fold_unsolved);
}

TEST(UnmarkedPoints, AKinkThatIsApproachedInTinyStepsIsAFold) {
  ResponseCurve curve = curve_of(
      {{1.0, 1.0}, {1.1, 2.0}, {1.1 + 2e-9, 2.1}, {1.1 + 3e-9, 2.2}, {1.05, 3.0}, {1.0, 4.0}});
  mark_unsolved(curve);
  ASSERT_EQ(curve.log.size(), 1U);
  EXPECT_EQ(curve.points[3].mark, PointMark::fold);
}

// Random scene 301.61: a fold at a kink, solved for within 1.5e-8 of its frequency, stood between
// two rows that lie lower, so that three folds were told.
TEST(UnmarkedPoints, AFoldThatIsSolvedBesideItsKinkIsOne) {
  ResponseCurve curve = curve_of({{1.1, 1.0},
                                  {1.05, 2.0},
                                  {1.0 + 5e-9, 3.0},
                                  {1.0 + 1.5e-8, 3.1, PointMark::fold},
                                  {1.0, 3.2},
                                  {1.0 + 1e-9, 3.3},
                                  {1.05, 4.0},
                                  {1.1, 5.0}});
  mark_unsolved(curve);
  EXPECT_TRUE(curve.log.empty());
}

TEST(UnmarkedPoints, APeakBesideTheFoldOfItsKinkIsNone) {
  ResponseCurve curve = curve_of({{1.0, 1.0},
                                  {1.1, 2.0},
                                  {1.2, 2.6, PointMark::peak},
                                  {1.2 + 1e-13, 2.6, PointMark::fold},
                                  {1.1, 2.5},
                                  {1.0, 2.4}});
  mark_unsolved(curve);
  EXPECT_EQ(curve.points.size(), 6U);
  EXPECT_TRUE(curve.log.empty());
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
