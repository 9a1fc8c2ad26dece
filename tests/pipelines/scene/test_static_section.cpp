#include "pipelines/scene/static_section.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "pipelines/scene/scene_file.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/units.hpp"

namespace microslip::pipelines {
namespace {

constexpr double pi = std::numbers::pi;
constexpr const char* axis = "static.axis={ origin = [\"10 mm\", 0, 0.2], direction = [0, 0, 2] }";

SceneDescription scene_with(const std::vector<std::string>& overrides) {
  return parse_scene(R"([model]
kind = "blade"
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
density = 7800
)",
                     "scene.toml", ".", overrides);
}

std::string complaint(const std::vector<std::string>& overrides) {
  try {
    static_cast<void>(scene_with(overrides));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words)
    EXPECT_NE(text.find(word), std::string::npos) << word << " in: " << text;
}

TEST(StaticSection, GivesARotationAboutAnAxis) {
  const SceneDescription scene = scene_with({"static.speed=\"3000 rpm\"", axis});
  ASSERT_TRUE(scene.rotation);
  EXPECT_NEAR(scene.rotation->speed, 100.0 * pi, 1e-10);
  EXPECT_EQ(scene.rotation->origin, Eigen::Vector3d(0.01, 0.0, 0.2));
  EXPECT_EQ(scene.rotation->direction, Eigen::Vector3d::UnitZ());
  const SceneDescription again = parse_scene(scene.complete_toml, "again.toml", ".", {});
  EXPECT_EQ(again.rotation->speed, scene.rotation->speed);
  EXPECT_EQ(again.rotation->origin, scene.rotation->origin);
}

TEST(StaticSection, NeedNotBeThere) {
  EXPECT_FALSE(scene_with({}).rotation);
  EXPECT_EQ(scene_with({axis}).rotation->speed, 0.0);
}

TEST(StaticSection, TakesTurnsAndAnglesPerTime) {
  EXPECT_DOUBLE_EQ(rotation_speed("50 Hz"), 100.0 * pi);
  EXPECT_DOUBLE_EQ(rotation_speed("3000 rpm"), 100.0 * pi);
  EXPECT_DOUBLE_EQ(rotation_speed("12 rad/s"), 12.0);
  EXPECT_DOUBLE_EQ(rotation_speed("1.2e1"), 12.0);
  EXPECT_EQ(rotation_speed("0"), 0.0);
  for (const char* text : {"-3 rpm", "3 m", "", "rpm", "1e200"})
    EXPECT_THROW(static_cast<void>(rotation_speed(text)), UnitError) << text;
}

TEST(StaticSection, ASpeedNeedsAnAxis) {
  expect_words(complaint({"static.speed=\"3000 rpm\""}), {"static.speed", "static.axis"});
}

TEST(StaticSection, SaysWhatIsWrong) {
  expect_words(complaint({"static.axis={ direction = [0, 0, 0] }"}), {"static.axis.direction"});
  expect_words(complaint({"static.axis={ origin = [0, 0, 0] }"}),
               {"static.axis.direction", "missing"});
  expect_words(complaint({"static.axis={ origin = [0, 0], direction = [1, 0, 0] }"}),
               {"static.axis.origin", "three"});
  expect_words(complaint({"static.axis=\"z\""}), {"static.axis", "origin"});
  expect_words(complaint({axis, "static.speed=-1"}), {"static.speed", "-1"});
  expect_words(complaint({axis, "static.sped=1"}), {"static.sped", "did you mean \"speed\""});
}

}  // namespace
}  // namespace microslip::pipelines
