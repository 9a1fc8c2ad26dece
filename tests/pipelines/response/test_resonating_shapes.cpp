// Where harmonics meet resonances of attachment shapes.
#include "pipelines/response/resonating_shapes.hpp"

#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace microslip::pipelines::test_resonating_shapes {
namespace {

/// Two modes and two shapes, the lower at ten times the excitation and a half,
/// at points that are so far open.
std::string told(double highest, const std::vector<double>& open_shares,
                 Eigen::Index n_attachment = 2) {
  const Eigen::Vector4d frequency(1.0, 40.0, 105.0, 300.0);
  solver::ResponseCurve curve;
  for (const double share : open_shares) {
    solver::ResponsePoint& point = curve.points.emplace_back();
    point.frequency = curve.points.size() == 1 ? 9.0 : 10.0;
    point.report.separated_share = share;
  }
  tell_shapes_resonate(frequency, n_attachment, highest, curve);
  return curve.message;
}

constexpr double in_time = std::numeric_limits<double>::infinity();

TEST(ResonatingShapes, AreToldFromTheFirstHarmonicThatMeetsThem) {
  EXPECT_NE(told(10, {0.1, 0.4}).find("harmonics from 10 on"), std::string::npos);
  EXPECT_NE(told(in_time, {0.1, 0.4}).find("harmonics from 10 on"), std::string::npos);
  EXPECT_EQ(told(9, {0.1, 0.4}), "");
}

TEST(ResonatingShapes, MatterWhereContactClosesAgain) {
  EXPECT_EQ(told(in_time, {0.0, 0.0}), "");
  EXPECT_EQ(told(in_time, {0.3, 0.3}), "") << "open at rest";
  EXPECT_NE(told(in_time, {0.3}), "") << "one point does not tell";
  EXPECT_EQ(told(in_time, {}), "");
}

TEST(ResonatingShapes, AreNoModes) { EXPECT_EQ(told(in_time, {0.1, 0.4}, 0), ""); }

std::string unasked(int highest, const std::vector<double>& open_shares) {
  solver::ResponseCurve curve;
  for (const double share : open_shares) {
    curve.points.emplace_back().report.separated_share = share;
  }
  tell_unasked(highest, 30, curve);
  return curve.message;
}

TEST(UnaskedHarmonics, AreToldWhereContactCloses) {
  EXPECT_NE(unasked(18, {0.1, 0.4}).find("harmonics above 18"), std::string::npos);
  EXPECT_EQ(unasked(18, {0.0, 0.0}), "");
  EXPECT_EQ(unasked(30, {0.1, 0.4}), "") << "all were asked";
}

}  // namespace
}  // namespace microslip::pipelines::test_resonating_shapes
