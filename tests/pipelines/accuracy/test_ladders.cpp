#include "pipelines/accuracy/ladders.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "pipelines/accuracy/bar_counts.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines::test_ladders {
namespace {

SceneDescription scene(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return read_scene(MICROSLIP_SCENES "/" + name + ".toml", overrides);
}

std::vector<std::string> knobs_of(const SceneDescription& scene) {
  std::vector<std::string> knobs;
  for (const Ladder& ladder : ladders(scene)) knobs.push_back(ladder.knob);
  return knobs;
}

Ladder ladder(const SceneDescription& scene, const std::string& knob) {
  const std::vector<Ladder> all = ladders(scene);
  const auto found = std::ranges::find(all, knob, &Ladder::knob);
  return found == all.end() ? Ladder{} : *found;
}

std::vector<std::string> values_of(const Ladder& ladder) {
  std::vector<std::string> values;
  for (const Rung& rung : ladder.rungs) values.push_back(rung.value);
  return values;
}

using Names = std::vector<std::string>;

TEST(Ladders, AreOfWhatTheSceneHas) {
  EXPECT_EQ(knobs_of(scene("chain_2dof")), (Names{"harmonics", "method"}));
  EXPECT_EQ(knobs_of(scene("bar_constant_1000")),
            (Names{"points", "modes", "harmonics", "method"}));
  EXPECT_EQ(knobs_of(scene("oscillator_1dof")), (Names{"steps", "method"}));
  const Names of_contact{"modes", "residual",         "attachment_degree", "cells",
                         "fit",   "second_direction", "harmonics",         "instants"};
  Names of_blade = of_contact;
  of_blade.insert(of_blade.begin(), "element_size");
  EXPECT_EQ(knobs_of(scene("blade_to_ground")), of_blade);
  Names of_mesh = of_contact;
  of_mesh.insert(of_mesh.begin(), "refinement");
  EXPECT_EQ(knobs_of(scene("plate_mesh")), of_mesh);
}

// Five times the same answer would be told as convergence.
TEST(Ladders, OfMotionsInTimeGoOverStepsInPlaceOfHarmonics) {
  const Names knobs = knobs_of(scene("blade_to_ground", {"response.method=time"}));
  EXPECT_EQ(std::ranges::count(knobs, "harmonics"), 0);
  EXPECT_EQ(std::ranges::count(knobs, "instants"), 0);
  EXPECT_EQ(std::ranges::count(knobs, "steps"), 1);
  const Ladder steps = ladder(scene("oscillator_1dof"), "steps");
  EXPECT_EQ(steps.rungs.front().scene.response->steps_per_period, 250);
  EXPECT_EQ(steps.rungs.back().value, "located");
  EXPECT_EQ(steps.rungs.back().scene.response->steps_per_period, 0);
}

TEST(Ladders, OfBarsHaveOtherPointsAndModes) {
  const SceneDescription bar = scene("bar_constant_1000", {"contact.points=40", "modes.count=8"});
  const Ladder points = ladder(bar, "points");
  EXPECT_EQ(points.source, "cells");
  EXPECT_EQ(values_of(points), (Names{"2", "10", "40", "160", "640"}));
  EXPECT_EQ(bar_counts(points.rungs[3].scene)->points, 160);
  EXPECT_EQ(bar_counts(points.rungs[3].scene)->modes, 8);
  EXPECT_NEAR(points.rungs[3].size, 1.0 / 160.0, 1e-15);
  const Ladder modes = ladder(bar, "modes");
  EXPECT_EQ(values_of(modes), (Names{"2", "4", "8", "16", "32"}));
  EXPECT_EQ(bar_counts(modes.rungs[4].scene)->modes, 32);
  EXPECT_EQ(bar_counts(modes.rungs[4].scene)->points, 40);
}

// Modes that are picked one by one have no other number.
TEST(Ladders, TellWhatABarCannotHave) {
  const Ladder modes = ladder(scene("bar_constant_1000", {"modes.which=[1,3]"}), "modes");
  for (const Rung& rung : modes.rungs) EXPECT_EQ(rung.refused.empty(), rung.value == "2");
}

TEST(Ladders, OfAMeshFileCutItsElements) {
  const Ladder refinement = ladder(scene("plate_mesh"), "refinement");
  ASSERT_EQ(values_of(refinement), (Names{"given", "halved"}));
  EXPECT_TRUE(refinement.rungs[0].same_mesh);
  EXPECT_FALSE(refinement.rungs[1].same_mesh);
  EXPECT_EQ(std::get<MeshFileModel>(refinement.rungs[1].scene.model).refinement, 1);
  EXPECT_DOUBLE_EQ(refinement.rungs[1].size, 0.5 * refinement.rungs[0].size);
  const Ladder further = ladder(scene("plate_mesh", {"model.refinement=1"}), "refinement");
  ASSERT_EQ(values_of(further), (Names{"given", "halved", "quartered"}));
  EXPECT_TRUE(further.rungs[1].same_mesh);
  EXPECT_EQ(std::get<MeshFileModel>(further.rungs[0].scene.model).refinement, 0);
}

TEST(Ladders, SetBalanceAgainstTimeAtThePeaksOfBalance) {
  const Ladder method = ladder(scene("oscillator_1dof"), "method");
  ASSERT_EQ(values_of(method), (Names{"harmonic_balance", "time"}));
  EXPECT_EQ(method.rungs[0].scene.response->method, ResponseDescription::Method::harmonic_balance);
  EXPECT_TRUE(method.rungs[0].scene.settings.harmonics.chosen());
  EXPECT_FALSE(method.rungs[0].in_time);
  EXPECT_TRUE(method.rungs[1].in_time);
}

TEST(Ladders, OfTheResidualKeepTheBasisOfTheScene) {
  const Ladder residual = ladder(scene("blade_to_ground"), "residual");
  ASSERT_EQ(values_of(residual), (Names{"none", "stiffness", "attachment"}));
  EXPECT_FALSE(residual.rungs[0].same_basis);
  EXPECT_TRUE(residual.rungs[2].same_basis);
}

std::string complaint(const SceneDescription& scene, const std::vector<double>& sizes) {
  try {
    static_cast<void>(ladder_of_sizes(scene, sizes));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(Ladders, OfElementSizesAreThoseAskedFor) {
  const SceneDescription blade = scene("blade_to_ground");  // of 3 mm
  const Ladder sizes = ladder_of_sizes(blade, {0.006, 0.003});
  EXPECT_EQ(values_of(sizes), (Names{"0.006", "0.003"}));
  EXPECT_DOUBLE_EQ(*element_size_of(sizes.rungs[0].scene), 0.006);
  EXPECT_FALSE(sizes.rungs[0].same_mesh);
  EXPECT_TRUE(sizes.rungs[1].same_mesh);
  EXPECT_NE(complaint(blade, {0.006}).find("one size"), std::string::npos);
  EXPECT_NE(complaint(blade, {0.003, 0.006}).find("from coarse to fine"), std::string::npos);
  EXPECT_NE(complaint(scene("plate_mesh"), {0.006, 0.003}).find("give --meshes"),
            std::string::npos);
}

}  // namespace
}  // namespace microslip::pipelines::test_ladders
