#include "pipelines/accuracy/along_curve.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "contact/contact_force.hpp"
#include "pipelines/accuracy/effect_bounds.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/scene/scene_file.hpp"

namespace microslip::pipelines::test_along_curve {
namespace {

constexpr double preload = 100.0;

struct Solved {
  ReducedModel model;
  CurveResult curve;
};

Solved solved() {
  const SceneDescription scene =
      read_scene(MICROSLIP_SCENES "/chain_3dof_normal.toml",
                 {"effects.normal_motion=off", "response.harmonics=1", "response.preload=[100]"});
  std::vector<std::string> warnings;
  Solved result{model_of(scene, nullptr, warnings), {}};
  result.curve = trace_curve(result.model, scene, CurveRequest{"curve", preload},
                             [](const auto&) { return true; });
  return result;
}

// One point: k_v (|mean| + amplitude) over its load, by hand.
TEST(AlongCurve, TheIndicatorOfNormalMotionIsTheLargestChangeOfTheLoad) {
  const Solved of = solved();
  const contact::PatchSamples& cells = of.model.patches.at(0).cells;
  ASSERT_EQ(cells.size(), 1);
  const double at_rest =
      contact::ContactForce(of.model.patches, {}, preload).points(0).at(0).rest_load;
  double expected = 0.0;
  for (const solver::ResponsePoint& point : of.curve.curve.points) {
    const double mean = cells.shapes.v.row(0).dot(point.q.mean());
    const double sine = cells.shapes.v.row(0).dot(point.q.sine());
    const double cosine = cells.shapes.v.row(0).dot(point.q.cosine());
    expected = std::max(
        expected, cells.stiffness(0, 1) * (std::abs(mean) + std::hypot(sine, cosine)) / at_rest);
  }
  ASSERT_GT(expected, 0.0);
  const auto rows = rows_along_curve(of.model, {{"normal_motion", of.model}}, of.curve);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].goal, largest_indicator_goal);
  EXPECT_NEAR(rows[0].effect, expected, 1e-12 * expected);
}

TEST(AlongCurve, WhatHasNoIndicatorOfTheMotionTellsNothing) {
  const Solved of = solved();
  EXPECT_TRUE(rows_along_curve(of.model, {{"cells", of.model}}, of.curve).empty());
}

TEST(AlongCurve, AnIndicatorIsToldAndIsNoBound) {
  std::vector<EffectRecord> effects{{.name = "normal_motion",
                                     .setting = "off",
                                     .simulated = Simulated::no,
                                     .reason = "asked for"}};
  tell_bounds({{"a", largest_indicator_goal, "normal_motion", 0.2, ErrorKind::estimated, 0.0},
               {"b", largest_indicator_goal, "normal_motion", 0.7, ErrorKind::estimated, 0.0}},
              0.02, effects);
  EXPECT_EQ(effects[0].reason, "asked for; along the curves its indicator is 0.7 at most (b)");
  EXPECT_FALSE(effects[0].bound.has_value());
  EXPECT_EQ(effects[0].objection, "");
}

}  // namespace
}  // namespace microslip::pipelines::test_along_curve
