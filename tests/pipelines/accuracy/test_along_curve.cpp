#include "pipelines/accuracy/along_curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
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
  SceneDescription scene;
  ReducedModel model;
  CurveResult curve;
};

Solved solved(const std::vector<std::string>& changes) {
  std::vector<std::string> words{"response.harmonics=1", "response.preload=[100]"};
  words.insert(words.end(), changes.begin(), changes.end());
  Solved result{read_scene(MICROSLIP_SCENES "/chain_3dof_normal.toml", words), {}, {}};
  std::vector<std::string> warnings;
  result.model = model_of(result.scene, nullptr, warnings);
  result.curve = trace_curve(result.model, result.scene, CurveRequest{"curve", preload},
                             [](const auto&) { return true; });
  return result;
}

Solved solved() { return solved({"effects.normal_motion=off"}); }

/// Of the one effect.
ErrorRow row_of(const std::string& effect, const Solved& of,
                const std::vector<RicherModel>& others = {}) {
  for (const IndicatorOfCurve& one : indicators_along(of.model, of.scene, others, of.curve)) {
    if (one.effect == effect) return largest_along(one, of.curve);
  }
  ADD_FAILURE() << effect << " is not looked at";
  return {};
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
  const ErrorRow row = row_of("normal_motion", of, {{"normal_motion", of.model}});
  EXPECT_EQ(row.goal, largest_indicator_goal);
  EXPECT_NEAR(row.effect, expected, 1e-12 * expected);
  const auto there = std::ranges::find_if(of.curve.curve.points, [&](const auto& point) {
    return point.frequency / (2.0 * std::numbers::pi) == row.where_hz;
  });
  EXPECT_NE(there, of.curve.curve.points.end());
}

// The mean alone, of a load that varies and drifts.
TEST(AlongCurve, TheIndicatorOfMeanCouplingIsTheLargestDriftOfTheLoad) {
  const Solved of = solved({});
  const contact::PatchSamples& cells = of.model.patches.at(0).cells;
  const double at_rest =
      contact::ContactForce(of.model.patches, {}, preload).points(0).at(0).rest_load;
  double expected = 0.0;
  for (const solver::ResponsePoint& point : of.curve.curve.points) {
    const double mean = std::abs(cells.shapes.v.row(0).dot(point.q.mean()));
    expected = std::max(expected, cells.stiffness(0, 1) * mean / at_rest);
  }
  ASSERT_GT(expected, 0.0);
  EXPECT_NEAR(row_of("mean_coupling", of, {{"mean_coupling", of.model}}).effect, expected,
              1e-12 * expected);
}

// μ(σ) = μ₀/(1 + pσ) at the amplitude times the frequency.
TEST(AlongCurve, TheIndicatorOfRateDependenceIsTheLargestChangeOfTheCoefficient) {
  Solved of = solved();
  constexpr double p = 3.0;
  const double coefficient = of.model.patches.at(0).cells.friction[0];
  ASSERT_GT(coefficient, 0.0);
  of.scene.rules.friction = contact::FrictionLaw::hyperbolic(coefficient, p);
  double fastest = 0.0;
  for (const solver::ResponsePoint& point : of.curve.curve.points) {
    const auto u = of.model.patches.at(0).cells.shapes.u.row(0);
    fastest = std::max(
        fastest, point.frequency * std::hypot(u.dot(point.q.sine()), u.dot(point.q.cosine())));
  }
  const double expected = 1.0 - 1.0 / (1.0 + p * fastest);
  EXPECT_NEAR(row_of("rate_dependence", of, {{"rate_dependence", of.model}}).effect, expected,
              1e-12);
}

TEST(AlongCurve, WhatHasNoIndicatorOfTheMotionTellsNothing) {
  const Solved of = solved();
  const auto all = indicators_along(of.model, of.scene, {{"cells", of.model}}, of.curve);
  for (const IndicatorOfCurve& one : all) EXPECT_NE(one.effect, "cells");
}

TEST(AlongCurve, AnIndicatorIsToldAndIsNoBound) {
  std::vector<EffectRecord> effects{{.name = "normal_motion",
                                     .setting = "off",
                                     .simulated = Simulated::no,
                                     .reason = "asked for"}};
  tell_bounds(
      {{"a", largest_indicator_goal, "normal_motion", 0.2, ErrorKind::estimated, 0.0},
       {"b", largest_indicator_goal, "normal_motion", 0.7, ErrorKind::estimated, 0.0, 32.5}},
      0.02, effects);
  EXPECT_EQ(effects[0].reason,
            "asked for; along the curves its indicator is 0.7 at most (b at 32.5 Hz)");
  ASSERT_TRUE(effects[0].along.has_value());
  EXPECT_EQ(effects[0].along->frequency_hz, 32.5);
  EXPECT_FALSE(effects[0].bound.has_value());
  EXPECT_EQ(effects[0].objection, "");
}

TEST(AlongCurve, AnIndicatorOfZeroTakesNoWords) {
  std::vector<EffectRecord> effects{{"second_direction", "auto", Simulated::no, "asked for"}};
  tell_bounds({{"a", largest_indicator_goal, "second_direction", 0.0, ErrorKind::estimated, 0.0}},
              0.02, effects);
  EXPECT_EQ(effects[0].reason, "asked for");
  EXPECT_TRUE(effects[0].along.has_value());
}

}  // namespace
}  // namespace microslip::pipelines::test_along_curve
