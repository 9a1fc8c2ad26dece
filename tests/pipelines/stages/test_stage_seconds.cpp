#include "pipelines/effects/picture_cost.hpp"
#include "pipelines/stages/stage_seconds.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "pipelines/scene/scene_file.hpp"

namespace microslip::pipelines::test_stage_seconds {
namespace {

std::vector<CurveResult> curves(double seconds, int n) {
  CurveResult one;
  one.load = 100.0;
  one.curve.seconds = seconds;
  return {static_cast<std::size_t>(n), one};
}

// How many harmonics matter, and how long Newton's method takes, is known then.
TEST(StageSeconds, ErrorsOfCurvesThatTookLongTakeLong) {
  const SceneDescription scene = read_scene(MICROSLIP_SCENES "/blade_to_ground.toml", {});
  const auto forecast = [&](double seconds, int jobs) {
    return accuracy_seconds({}, scene, curves(seconds, 3), 6000.0, jobs);
  };
  EXPECT_DOUBLE_EQ(forecast(1e-3, 1), accuracy_seconds({}, scene, {}, 6000.0, 1));
  EXPECT_GT(forecast(20.0, 1), 30.0);
  EXPECT_LT(forecast(20.0, 1), 70.0);
  EXPECT_LT(forecast(20.0, 2), 0.6 * forecast(20.0, 1));
}

// It solves whole curves with the harmonics that they have needed.
TEST(StageSeconds, ABestValueBesideCurvesThatTookLongTakesLonger) {
  const SceneDescription scene = read_scene(MICROSLIP_SCENES "/blade_to_ground.toml", {});
  const auto forecast = [&](double seconds) {
    return optimum_seconds({}, scene, curves(seconds, 5), false);
  };
  EXPECT_DOUBLE_EQ(forecast(1e-3), optimum_seconds({}, scene, {}, false));
  EXPECT_GT(forecast(1e3), 5e3);
  const SceneDescription one =
      read_scene(MICROSLIP_SCENES "/blade_to_ground.toml", {"response.harmonics=1"});
  EXPECT_DOUBLE_EQ(optimum_seconds({}, one, curves(1e3, 5), false),
                   optimum_seconds({}, one, {}, false));
}

TEST(StageSeconds, MotionsInTimeAndLimitsHaveNoSuchErrors) {
  const SceneDescription scene = read_scene(MICROSLIP_SCENES "/blade_to_ground.toml", {});
  std::vector<CurveResult> others = curves(100.0, 2);
  others[0].integrated = true;
  others[1].load = LimitName::stuck;
  EXPECT_DOUBLE_EQ(accuracy_seconds({}, scene, others, 6000.0, 1),
                   accuracy_seconds({}, scene, {}, 6000.0, 1));
}

// Linear limits have no maps.
TEST(StageSeconds, PicturesFollowTheCurvesAndMapsAskedFor) {
  const auto of = [](const std::vector<std::string>& overrides) {
    return picture_seconds(read_scene(MICROSLIP_SCENES "/blade_to_ground.toml", overrides));
  };
  const PictureSeconds two = of({"response.preload=[\"free\", 100, 200, \"stuck\"]"});
  const PictureSeconds four = of({"response.preload=[100, 200, 300, 400]"});
  const PictureSeconds none = of({"response.maps=[]", "response.preload=[100, 200]"});
  EXPECT_GT(two.maps, 0.0);
  EXPECT_DOUBLE_EQ(four.maps, 2.0 * two.maps);
  EXPECT_GT(four.plots, two.plots);
  EXPECT_EQ(none.maps, 0.0);  // nor motions
  EXPECT_GT(none.plots, 0.0);
}

// The highest that may be chosen is 30; those that are chosen are some twelve.
TEST(StageSeconds, MapsHaveTheHarmonicsThatAreUsuallyChosen) {
  const auto maps = [](const char* harmonics) {
    return picture_seconds(read_scene(MICROSLIP_SCENES "/blade_to_ground.toml",
                                      {std::string("response.harmonics=") + harmonics}))
        .maps;
  };
  EXPECT_GT(maps("auto"), maps("3"));
  EXPECT_LT(maps("auto"), maps("25"));
}

}  // namespace
}  // namespace microslip::pipelines::test_stage_seconds
