// [[contact]] in a scene with a mesh (share/doc/interfaces.md): read, refused, changed and written
// back.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "pipelines/scene/scene_file.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines::test_several_contacts {
namespace {

std::string scene_with(const std::string& first, const std::string& second) {
  const std::string common =
      "friction_coefficient = 0.4\nnormal_stiffness = 1e11\ntangential_stiffness = 2e11\n";
  return "[model]\nkind = \"blade\"\n[material]\nyoungs_modulus = \"210 GPa\"\n"
         "poissons_ratio = 0.3\ndensity = 7800\n[supports]\nclamped = [\"root\"]\n"
         "[[contact]]\n" +
         common + first + "\n[[contact]]\n" + common + second +
         "\n[excitation]\nforces = [ { at = \"B\", direction = [1, 0, 0], amplitude = 1 } ]\n"
         "[response]\noutput = { at = \"A\", direction = [1, 0, 0] }\nfrequency = [250, 350]\n"
         "preload = [100]\n";
}

SceneDescription parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_scene(text, "scene.toml", "/nowhere", overrides);
}

std::string complaint(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    static_cast<void>(parse(text, overrides));
    return {};
  } catch (const SceneError& error) {
    return error.what();
  }
}

const std::string two =
    scene_with("surface = \"a\"", "surface = \"b\"\nname = \"upper\"\npoints = 50");

TEST(SeveralContacts, EachHasItsOwnKeys) {
  const SceneDescription scene = parse(two);
  ASSERT_EQ(scene.contacts.size(), 2U);
  EXPECT_EQ(scene.contacts[0].name, "a");
  EXPECT_EQ(scene.contacts[1].name, "upper");
  EXPECT_EQ(scene.contacts[1].surface, "b");
  EXPECT_EQ(scene.settings.patches[0].n_points, std::nullopt);
  EXPECT_EQ(scene.settings.patches[1].n_points, 50);
  EXPECT_EQ(scene.contacts[1].key, "contact[1]");
}

TEST(SeveralContacts, OneIsChangedByItsNumber) {
  const SceneDescription scene = parse(two, {"contact[1].friction_coefficient=0.1"});
  EXPECT_EQ(std::get<double>(scene.contacts[0].friction.value), 0.4);
  EXPECT_EQ(std::get<double>(scene.contacts[1].friction.value), 0.1);
  const SceneDescription changed = with_value(scene, "contact[0].friction_coefficient", 0.7);
  EXPECT_EQ(std::get<double>(changed.contacts[0].friction.value), 0.7);
  EXPECT_EQ(std::get<double>(changed.contacts[1].friction.value), 0.1);
  EXPECT_NE(complaint(two, {"contact.friction_coefficient=0.1"}).find("contact[0]"),
            std::string::npos);
  EXPECT_NE(complaint(two, {"contact[2].friction_coefficient=0.1"}).find("no entry 2"),
            std::string::npos);
}

TEST(SeveralContacts, TheCompletedSceneIsTheSameScene) {
  const SceneDescription scene = parse(two);
  const SceneDescription again = parse(scene.complete_toml);
  EXPECT_EQ(again.complete_toml, scene.complete_toml);
  EXPECT_EQ(again.contacts[1].name, "upper");
  EXPECT_EQ(again.settings.patches[1].n_points, 50);
}

TEST(SeveralContacts, MistakesAreToldWithTheContactTheyAreIn) {
  EXPECT_NE(complaint(scene_with("surface = \"a\"", "surface = \"b\"\npoint = 5"))
                .find("contact[1].point"),
            std::string::npos);
  EXPECT_NE(complaint(scene_with("surface = \"a\"", "surface = \"a\"")).find("same surface"),
            std::string::npos);
  EXPECT_NE(
      complaint(scene_with("surface = \"a\"", "surface = \"b\"\nname = \"a\"")).find("same name"),
      std::string::npos);
  EXPECT_NE(
      complaint(scene_with("surface = \"a\"\npreload_share = 2", "surface = \"b\"")).find("to all"),
      std::string::npos);
  EXPECT_NE(complaint(scene_with("surface = \"a/b\"", "surface = \"b\"")).find("contact.name"),
            std::string::npos);
}

TEST(SeveralContacts, SharesOfThePreloadAreRelativeWeights) {
  const SceneDescription scene =
      parse(scene_with("surface = \"a\"\npreload_share = 3", "surface = \"b\"\npreload_share = 1"));
  EXPECT_EQ(scene.contacts[0].preload_share, 3.0);
  EXPECT_EQ(scene.contacts[1].preload_share, 1.0);
}

}  // namespace
}  // namespace microslip::pipelines::test_several_contacts
