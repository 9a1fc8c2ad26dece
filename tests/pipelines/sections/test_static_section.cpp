#include "pipelines/sections/static_section.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "pipelines/scene/scene_file.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/units.hpp"

namespace microslip::pipelines::test_static_section {
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

constexpr const char* held = "supports.clamped=[\"root\"]";
constexpr const char* push =
    "static.forces=[{ at = \"platform_left\", direction = [2, 0, 0], amplitude = \"1 kN\" }]";

/// A scene with a contact whose preload is that of static loads.
std::vector<std::string> with_contact(std::vector<std::string> more) {
  more.insert(more.begin(), {"contact.surface=\"contact\"", "contact.friction_coefficient=0.3",
                             "contact.normal_stiffness=1e12", "contact.tangential_stiffness=1e12",
                             "contact.preload=\"static\"", held});
  return more;
}

TEST(StaticSection, GivesForcesAndPressures) {
  const SceneDescription scene =
      scene_with(with_contact({push, "static.pressure=[{ surface = \"tip\", value = \"2 bar\" }]",
                               "contact.gap=\"3 um\""}));
  ASSERT_EQ(scene.static_loads.forces.size(), 1U);
  EXPECT_EQ(scene.static_loads.forces[0].at, "platform_left");
  EXPECT_EQ(scene.static_loads.forces[0].direction, Eigen::Vector3d::UnitX());
  EXPECT_EQ(scene.static_loads.forces[0].amplitude, 1000.0);
  ASSERT_EQ(scene.static_loads.pressures.size(), 1U);
  EXPECT_NEAR(scene.static_loads.pressures[0].pressure, 2e5, 1e-9);
  EXPECT_TRUE(has_static_preload(scene));
  EXPECT_NEAR(scene.contacts[0].gap, 3e-6, 1e-20);
  const SceneDescription again = parse_scene(scene.complete_toml, "again.toml", ".", {});
  EXPECT_EQ(again.static_loads.forces[0].amplitude, 1000.0);
  EXPECT_EQ(again.static_loads.pressures[0].surface, "tip");
  EXPECT_EQ(again.contacts[0].gap, scene.contacts[0].gap);
}

TEST(StaticSection, APreloadOfLoadsIsACurveOfItsOwn) {
  const std::vector<std::string> response{"response.output={ at = \"A\", direction = [1, 0, 0] }",
                                          "response.frequency=[200, 400]"};
  auto overrides = with_contact({push});
  overrides.insert(overrides.end(), response.begin(), response.end());
  const std::vector<PreloadEntry> preload = scene_with(overrides).response->preload;
  EXPECT_EQ(preload,
            (std::vector<PreloadEntry>{LimitName::free, StaticPreload{}, LimitName::stuck}));
  overrides.emplace_back("response.preload=[\"static\", 200]");
  overrides.insert(overrides.end(), {"response.optimum=\"static.forces[0].amplitude\"",
                                     "response.optimum_range=[\"100 N\", \"5 kN\"]",
                                     "response.optimum_at=\"static\""});
  EXPECT_FALSE(scene_with(overrides).response->optimum->load);
  overrides.back() = "response.optimum_at=150";
  EXPECT_EQ(scene_with(overrides).response->optimum->load, 150.0);
}

TEST(StaticSection, LoadsContactAndSupportsMustFit) {
  const std::string turning = "static.speed=\"3000 rpm\"";
  EXPECT_EQ(complaint(with_contact({turning, axis})), "");
  EXPECT_EQ(complaint(with_contact({"contact.gap=\"-1 um\""})), "");
  expect_words(complaint(with_contact({})), {"contact.preload", "needs a load", "static.forces"});
  expect_words(complaint(with_contact({axis})), {"contact.preload", "needs a load"});
  expect_words(complaint({push}), {"static.forces", "acts on nothing", "contact.preload"});
  expect_words(complaint(with_contact({push, "supports.clamped=[]"})),
               {"contact.preload", "supports.clamped"});
  expect_words(complaint(with_contact({push, "contact.preload=\"dynamic\""})),
               {"contact.preload", "static"});
  expect_words(complaint(with_contact({push, "contact.preload_field=\"1 + p\""})),
               {"contact.preload_field", "static"});
  expect_words(complaint(with_contact({push, "contact.normal_stiffness=0"})),
               {"contact.normal_stiffness", "N/m^3"});
  expect_words(complaint(with_contact({push, "contact.normal_stiffness=\"rigid\""})),
               {"contact.normal_stiffness", "N/m^3", "edge"});
  EXPECT_EQ(
      complaint(with_contact({push, "contact.roughness={ law = \"cubic\", height = \"5 um\" }"})),
      "");
  auto no_preload = with_contact({held, "contact.gap=1e-6"});
  no_preload.erase(no_preload.begin() + 4);
  expect_words(complaint(no_preload), {"contact.gap", "preload = \"static\""});
  no_preload.back() = "response.preload=\"static\"";
  no_preload.insert(no_preload.end(), {"response.output={ at = \"A\", direction = [1, 0, 0] }",
                                       "response.frequency=[200, 400]"});
  expect_words(complaint(no_preload), {"response.preload", "contact.preload = \"static\""});
}

/// A scene of kind "modes" with a contact that static loads press.
std::string complaint_of_given(const std::string& model, std::vector<std::string> more) {
  more = with_contact(std::move(more));
  std::erase(more, held);
  try {
    static_cast<void>(parse_scene("[model]\nkind = \"modes\"\nlength_unit = \"mm\"\n" + model,
                                  "scene.toml", ".", more));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(StaticSection, MatricesHaveAStiffnessAndModesOfAFileHaveNone) {
  const std::string matrices =
      "stiffness = \"K.mtx\"\nmass = \"M.mtx\"\nnodes = \"nodes.csv\"\nmesh = \"blade.inp\"\n";
  EXPECT_EQ(complaint_of_given(matrices, {push}), "");
  expect_words(complaint_of_given(matrices, {push, "static.speed=100"}),
               {"static.speed", "unknown"});
  expect_words(complaint_of_given("file = \"blade.frd\"\nmesh = \"blade.inp\"\n", {push}),
               {"contact.preload", "model.stiffness", "preload_field"});
}

TEST(StaticSection, SaysWhatIsWrongWithALoad) {
  const auto told = [](const std::string& load) { return complaint(with_contact({load})); };
  expect_words(told("static.forces={ at = \"tip\" }"), {"static.forces", "list"});
  expect_words(told("static.forces=[{ at = \"tip\", direction = [1, 0, 0] }]"),
               {"static.forces.amplitude", "missing"});
  expect_words(
      told("static.forces=[{ at = \"tip\", direction = [1, 0, 0], amplitude = \"3 mm\" }]"),
      {"static.forces.amplitude", "N"});
  expect_words(
      told("static.forces=[{ at = \"tip\", direction = [1, 0, 0], amplitude = 1, phase = 3 }]"),
      {"static.forces.phase"});
  expect_words(told("static.pressure=[{ surfce = \"tip\", value = 1 }]"),
               {"static.pressure.surfce", "did you mean \"surface\""});
  expect_words(told("static.pressure=[{ surface = \"tip\", value = \"3 N\" }]"),
               {"static.pressure.value", "Pa"});
}

}  // namespace
}  // namespace microslip::pipelines::test_static_section
