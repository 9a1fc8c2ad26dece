#include "pipelines/accuracy/refinement.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "pipelines/accuracy/bar_counts.hpp"
#include "pipelines/scene/scene_file.hpp"

namespace microslip::pipelines::test_refinement {
namespace {

constexpr double tolerance = 0.02;
constexpr SpentSeconds spent{.structure = 10.0, .curves = 10.0};

SceneDescription blade() {
  SceneDescription scene;
  scene.model = BladeModel{.geometry = {}, .sizes = {0.004}};
  scene.settings.patches.resize(1);
  scene.settings.harmonics = {.highest = 1, .orders = {}, .tolerance = 0.0};
  return scene;
}

CurveBudget budget(const std::vector<std::pair<std::string, double>>& effects) {
  CurveBudget result;
  for (const auto& [source, effect] : effects) {
    result.rows.push_back({"curve", peak_amplitude_goal, source, effect, ErrorKind::solved, 1.0});
  }
  return result;
}

TEST(Refinement, RefinesWhatContributesMostAndNothingElse) {
  std::string left;
  const std::vector<CurveBudget> told{
      budget({{"cells", 1e-3}, {"fit", 1e-5}, {"harmonics", -0.5}})};
  EXPECT_DOUBLE_EQ(largest_bar(told), 0.50101);
  const auto step = refinement(blade(), told, tolerance, spent, left);
  ASSERT_TRUE(step.has_value());
  EXPECT_TRUE(step->scene.settings.harmonics.chosen());
  EXPECT_LE(step->scene.settings.harmonics.tolerance, 0.5 * tolerance);
  EXPECT_EQ(step->scene.settings.patches[0].n_points, blade().settings.patches[0].n_points);
  EXPECT_FALSE(step->new_mesh);
  EXPECT_EQ(left, "");
}

TEST(Refinement, KeepsTheToleranceForTheGoalsThatAreAsked) {
  CurveBudget told = budget({{"cells", 1e-4}});
  told.rows.push_back({"curve", dissipated_energy_goal, "cells", 0.1, ErrorKind::solved, 1.0});
  AccuracyRequest accuracy{.tolerance = tolerance};
  EXPECT_TRUE(is_exact(told, accuracy));
  accuracy.goals = {dissipated_energy_goal};
  EXPECT_FALSE(is_exact(told, accuracy));
  EXPECT_DOUBLE_EQ(largest_bar({told}, accuracy.goals), 0.1);
  SceneDescription scene = blade();
  scene.accuracy = accuracy;
  std::string left;
  const auto step = refinement(scene, {told}, tolerance, spent, left);
  ASSERT_TRUE(step.has_value());
  EXPECT_GT(step->scene.settings.patches[0].n_points, scene.settings.patches[0].n_points);
}

// One after the other would forget what the first has done: both are read by formulas.
TEST(Refinement, GivesABarMorePointsAndModes) {
  const SceneDescription bar =
      read_scene(MICROSLIP_SCENES "/bar_constant_1000.toml",
                 {"contact.points=5", "modes.count=2", "response.optimum=preload",
                  "response.optimum_range=[0.1, 10]", "response.frequency=[900, 1100]"});
  std::string left;
  const auto points = refinement(bar, {budget({{"cells", 0.05}})}, tolerance, spent, left);
  ASSERT_TRUE(points.has_value());
  EXPECT_GE(bar_counts(points->scene)->points, 20);
  EXPECT_EQ(bar_counts(points->scene)->modes, 2);
  EXPECT_TRUE(points->scene.response->optimum.has_value());
  const auto both = refinement(points->scene, {budget({{"cells", 0.05}, {"basis", 0.05}})},
                               tolerance, spent, left);
  ASSERT_TRUE(both.has_value());
  EXPECT_GT(bar_counts(both->scene)->points, bar_counts(points->scene)->points);
  EXPECT_GT(bar_counts(both->scene)->modes, 2);
  EXPECT_FALSE(both->only_harmonics);
  // A search over another number goes on from there.
  const auto other = bar_counts(with_value(both->scene, "contact.friction_coefficient", 0.2));
  EXPECT_EQ(other->points, bar_counts(both->scene)->points);
  EXPECT_EQ(other->modes, bar_counts(both->scene)->modes);
}

// Best values were searched on the points, harmonics and elements of before.
TEST(Refinement, StaysWhereAnotherNumberIsSearched) {
  const SceneDescription scene = read_scene(MICROSLIP_SCENES "/blade_to_ground.toml");
  std::string left;
  const auto step = refinement(scene, {budget({{"mesh", 0.1}, {"harmonics", 0.1}, {"cells", 0.1}})},
                               tolerance, spent, left);
  ASSERT_TRUE(step.has_value());
  for (const char* key : {"contact.friction_coefficient", "material.density"}) {
    const SceneDescription other = with_value(step->scene, key, 0.25);
    EXPECT_LT(element_size_of(other), element_size_of(scene)) << key;
    EXPECT_EQ(element_size_of(other), element_size_of(step->scene)) << key;
    EXPECT_EQ(other.settings.patches[0].n_points, step->scene.settings.patches[0].n_points) << key;
    EXPECT_EQ(other.settings.harmonics.tolerance, step->scene.settings.harmonics.tolerance) << key;
  }
  EXPECT_EQ(element_size_of(with_value(step->scene, "model.element_size", 0.007)), 0.007);
}

TEST(Refinement, ObeysHarmonicsThatAreOff) {
  SceneDescription scene = blade();
  scene.effects.emplace_back("higher_harmonics", "off");
  std::string left;
  EXPECT_FALSE(refinement(scene, {budget({{"harmonics", 0.2}})}, tolerance, spent, left));
  EXPECT_EQ(left, "harmonics (effects.higher_harmonics = \"off\")");
}

TEST(Refinement, SharesTheToleranceAmongSources) {
  std::string left;
  const auto step =
      refinement(blade(), {budget({{"mesh", 0.03}, {"harmonics", 0.02}, {"cells", 0.01}})},
                 tolerance, spent, left);
  ASSERT_TRUE(step.has_value());
  EXPECT_TRUE(step->new_mesh);
  EXPECT_FALSE(step->only_harmonics);
  EXPECT_TRUE(step->scene.settings.harmonics.chosen());
  EXPECT_GT(step->seconds, spent.structure + spent.curves);
}

// Curves that are exact enough stay where harmonics alone change, and cost nothing.
TEST(Refinement, PricesHarmonicsByTheCurvesThatAreSolvedAgain) {
  std::string left;
  const std::vector<CurveBudget> told{budget({{"mesh", 0.005}, {"harmonics", 0.05}})};
  SpentSeconds few = spent;
  few.inexact_curves = 0.1 * spent.curves;
  const auto all = refinement(blade(), told, tolerance, spent, left);
  const auto some = refinement(blade(), told, tolerance, few, left);
  ASSERT_TRUE(all && some);
  EXPECT_TRUE(some->only_harmonics);
  EXPECT_LT(some->seconds, all->seconds);
  const AccuracyRequest accuracy{.tolerance = tolerance};
  EXPECT_TRUE(is_exact(budget({{"mesh", 0.5 * tolerance}}), accuracy));
  EXPECT_FALSE(is_exact(told[0], accuracy));
}

TEST(Refinement, PricesTheErrorsThatAreToldAgain) {
  std::string left;
  const std::vector<CurveBudget> told{budget({{"harmonics", 0.03}})};
  SpentSeconds with_errors = spent;
  with_errors.errors = 0.5 * spent.curves;
  const auto alone = refinement(blade(), told, tolerance, spent, left);
  const auto both = refinement(blade(), told, tolerance, with_errors, left);
  ASSERT_TRUE(alone && both);
  EXPECT_EQ(both->curve_seconds, alone->curve_seconds);
  EXPECT_NEAR(both->seconds, 1.5 * alone->seconds, 1e-9 * alone->seconds);
}

TEST(Refinement, TakesTheCheapestWayThatIsEnough) {
  std::string left;
  const std::vector<CurveBudget> told{
      budget({{"harmonics", 0.03}, {"second_direction", 0.004}, {"cells", 0.002}}),
      budget({{"harmonics", 0.002}, {"mesh", 0.012}})};
  const auto step = refinement(blade(), told, tolerance, spent, left);
  ASSERT_TRUE(step.has_value());
  EXPECT_TRUE(step->only_harmonics) << step->text;
  EXPECT_FALSE(step->new_mesh) << "errors of different curves do not add up";
}

TEST(Refinement, ACurveThatCannotBeRefinedDoesNotStopTheOthers) {
  std::string left;
  const auto step = refinement(blade(), {budget({{"basis", 0.3}}), budget({{"harmonics", 0.1}})},
                               tolerance, spent, left);
  ASSERT_TRUE(step.has_value());
  EXPECT_TRUE(step->only_harmonics);
  EXPECT_EQ(left, "basis");
  const auto both =
      refinement(blade(), {budget({{"basis", 0.3}, {"harmonics", 0.05}})}, tolerance, spent, left);
  ASSERT_TRUE(both.has_value());
  EXPECT_FALSE(
      refinement(blade(), {budget({{"basis", 0.3}, {"harmonics", 0.015}})}, tolerance, spent, left)
          .has_value())
      << "not worth a round";
}

SceneDescription mesh_file(int refinement) {
  SceneDescription scene = blade();
  MeshFileModel file;
  file.refinement = refinement;
  scene.model = file;
  scene.accuracy.tolerance = tolerance;
  return scene;
}

TEST(Refinement, CutsTheElementsOfAMeshFile) {
  std::string left;
  const auto once = refinement(mesh_file(0), {budget({{"mesh", 0.03}})}, tolerance, spent, left);
  ASSERT_TRUE(once.has_value());
  EXPECT_EQ(std::get<MeshFileModel>(once->scene.model).refinement, 1);
  EXPECT_TRUE(once->new_mesh);
  EXPECT_EQ(once->text, "elements of the file cut once");
  // Of elements cut twice modes are extrapolated.
  const auto twice = refinement(mesh_file(0), {budget({{"mesh", 0.06}})}, tolerance, spent, left);
  ASSERT_TRUE(twice.has_value());
  EXPECT_EQ(std::get<MeshFileModel>(twice->scene.model).refinement, 2);
  EXPECT_GT(twice->seconds, 5.0 * once->seconds);
  EXPECT_FALSE(
      refinement(mesh_file(3), {budget({{"mesh", 0.06}})}, tolerance, spent, left).has_value());
  EXPECT_EQ(left, "mesh");
}

TEST(Refinement, CutsNoMoreThanMemoryHolds) {
  std::string left;
  const std::vector<CurveBudget> told{budget({{"mesh", 0.06}})};
  SpentSeconds small = spent;
  small.cuts_in_memory = 1;
  const auto step = refinement(mesh_file(0), told, tolerance, small, left);
  ASSERT_TRUE(step.has_value());
  EXPECT_EQ(step->text, "elements of the file cut once") << "though twice would be wanted";
  small.cuts_in_memory = 0;
  EXPECT_FALSE(refinement(mesh_file(0), told, tolerance, small, left).has_value());
  EXPECT_NE(left.find("memory"), std::string::npos) << left;
}

// Of linear elements, and of bodies that rotate, the jumps of stress do not tell the error.
TEST(Refinement, RefinesAMeshOfAFileUntilItsErrorIsKnown) {
  CurveBudget told = budget({{"cells", 1e-4}});
  EXPECT_FALSE(has_mesh_to_tell(mesh_file(0), {told}));
  told.unknown.emplace_back("mesh");
  EXPECT_TRUE(has_mesh_to_tell(mesh_file(0), {told}));
  EXPECT_FALSE(has_mesh_to_tell(mesh_file(3), {told})) << "cut as often as may be";
  std::string left;
  const auto cut = refinement(mesh_file(0), {told}, tolerance, spent, left);
  ASSERT_TRUE(cut.has_value());
  EXPECT_EQ(cut->text, "elements of the file cut once");
  SpentSeconds linear = spent;
  linear.linear_elements = true;
  const auto midside = refinement(mesh_file(0), {told}, tolerance, linear, left);
  ASSERT_TRUE(midside.has_value());
  EXPECT_EQ(midside->text, "midside nodes");
  EXPECT_TRUE(std::get<MeshFileModel>(midside->scene.model).midside_nodes);
  EXPECT_EQ(std::get<MeshFileModel>(midside->scene.model).refinement, 0);
  EXPECT_TRUE(midside->new_mesh);
}

TEST(Refinement, RefinesAtSharpEdgesBeforeEverywhere) {
  std::string left;
  const auto step = refinement(blade(), {budget({{"mesh", 0.03}})}, tolerance, spent, left);
  ASSERT_TRUE(step.has_value());
  const mesh::ElementSizes& sizes = std::get<BladeModel>(step->scene.model).sizes;
  EXPECT_DOUBLE_EQ(sizes.element_size, 0.004);
  ASSERT_TRUE(sizes.edge_size.has_value());
  EXPECT_LT(*sizes.edge_size, 0.004);
  const auto finer = refinement(step->scene, {budget({{"mesh", 0.03}})}, tolerance, spent, left);
  ASSERT_TRUE(finer.has_value());
  const mesh::ElementSizes& again = std::get<BladeModel>(finer->scene.model).sizes;
  EXPECT_DOUBLE_EQ(again.element_size, 0.004);
  EXPECT_LT(*again.edge_size, *sizes.edge_size);
  const auto both = refinement(finer->scene, {budget({{"mesh", 0.03}})}, tolerance, spent, left);
  ASSERT_TRUE(both.has_value());
  EXPECT_LT(*element_size_of(both->scene), 0.004) << "and then everywhere";
}

TEST(Refinement, TheErrorOfTheMeshIsDoubtedWhereHarmonicsMoveThePeak) {
  std::string left;
  const auto step_with = [&](double mesh, double harmonics) {
    return refinement(blade(), {budget({{"mesh", mesh}, {"harmonics", harmonics}})}, tolerance,
                      spent, left);
  };
  const auto near = step_with(0.006, 0.0195);
  const auto far = step_with(0.006, 0.1);
  ASSERT_TRUE(near && far);
  EXPECT_FALSE(near->new_mesh) << near->text;
  EXPECT_TRUE(far->new_mesh) << far->text;
  const auto out_of_reach = step_with(0.1, 0.1);
  ASSERT_TRUE(out_of_reach.has_value()) << "what comes as near as can be";
  EXPECT_TRUE(out_of_reach->new_mesh);
}

// Several times as slow, and told at a peak that more harmonics move.
TEST(Refinement, FrictionAlongRWaitsWhereHarmonicsMoveThePeak) {
  std::string left;
  const auto takes_it = [&](double along_r, double harmonics) {
    const auto step =
        refinement(blade(), {budget({{"second_direction", along_r}, {"harmonics", harmonics}})},
                   tolerance, spent, left);
    return step && step->text.find("both directions") != std::string::npos;
  };
  EXPECT_TRUE(takes_it(0.019, 0.015));
  EXPECT_FALSE(takes_it(0.019, 0.05));
  EXPECT_TRUE(takes_it(0.1, 0.05)) << "it alone is too much";
}

// The curve that is nearly exact enough waits for the next round, when the others are known better.
TEST(Refinement, LargeErrorsAreNotRefinedToTheEndAtOnce) {
  std::string left;
  const std::vector<std::pair<std::string, double>> nearly{{"mesh", 0.004},
                                                           {"second_direction", 0.017}};
  const auto step =
      refinement(blade(), {budget(nearly), budget({{"harmonics", 0.15}})}, tolerance, spent, left);
  ASSERT_TRUE(step.has_value());
  EXPECT_TRUE(step->only_harmonics) << step->text;
  const auto alone = refinement(blade(), {budget(nearly)}, tolerance, spent, left);
  ASSERT_TRUE(alone.has_value());
  EXPECT_FALSE(alone->only_harmonics) << alone->text;
}

// More contact points for 0.4 % would make the curves of every round to come four times as dear.
TEST(Refinement, WhatIsSmallWaitsWhereOthersAreFarOff) {
  std::string left;
  const auto moves_cells = [&](double mesh) {
    const auto step = refinement(blade(), {budget({{"cells", 0.004}, {"mesh", mesh}})}, tolerance,
                                 {.structure = 200.0, .curves = 1.0}, left);
    EXPECT_TRUE(step.has_value()) << mesh;
    return step && step->scene.settings.patches[0].n_points != blade().settings.patches[0].n_points;
  };
  for (double mesh = 0.08; mesh < 0.3; mesh *= 1.02) EXPECT_FALSE(moves_cells(mesh)) << mesh;
  EXPECT_TRUE(moves_cells(0.0165));
}

// What nothing can be done about does not make others wait.
TEST(Refinement, RoughIsWhatCanBeRefined) {
  std::string left;
  const auto step = refinement(blade(), {budget({{"basis", 0.4}}), budget({{"mesh", 0.09}})},
                               tolerance, spent, left);
  ASSERT_TRUE(step.has_value());
  EXPECT_TRUE(step->new_mesh);
  EXPECT_EQ(left, "basis");
}

// Of modes extrapolated the next term is left: elements of the same size leave less.
TEST(Refinement, OfExtrapolatedModesLargerElementsAreEnough) {
  std::string left;
  SpentSeconds extrapolated = spent;
  extrapolated.extrapolated = true;
  const std::vector<CurveBudget> told{budget({{"mesh", 0.05}})};
  const auto usual = refinement(blade(), told, tolerance, spent, left);
  const auto step = refinement(blade(), told, tolerance, extrapolated, left);
  ASSERT_TRUE(usual && step);
  EXPECT_LT(step->seconds, usual->seconds);
}

TEST(Refinement, WithLittleTimeDoesWhatThereIsTimeFor) {
  std::string left;
  const std::vector<CurveBudget> told{budget({{"harmonics", 0.5}, {"mesh", 0.08}})};
  const auto all = refinement(blade(), told, tolerance, spent, left);
  ASSERT_TRUE(all.has_value());
  EXPECT_TRUE(all->new_mesh);
  SpentSeconds hurried = spent;
  hurried.structure = 100.0 * spent.structure;
  hurried.curves = 0.01 * spent.curves;
  hurried.available = spent.structure;
  const auto step = refinement(blade(), told, tolerance, hurried, left);
  ASSERT_TRUE(step.has_value());
  EXPECT_TRUE(step->only_harmonics) << step->text;
  EXPECT_LE(step->seconds, hurried.available);
}

TEST(Refinement, LeavesTimeToTheBestValue) {
  std::string left;
  const std::vector<CurveBudget> told{budget({{"harmonics", 0.08}})};
  SpentSeconds hurried = spent;
  const auto alone = refinement(blade(), told, tolerance, hurried, left);
  hurried.after = 2.0 * spent.curves;
  const auto with_search = refinement(blade(), told, tolerance, hurried, left);
  hurried.jobs = 2;
  const auto shared = refinement(blade(), told, tolerance, hurried, left);
  ASSERT_TRUE(alone && with_search && shared);
  EXPECT_DOUBLE_EQ(alone->until_end, alone->seconds);
  EXPECT_DOUBLE_EQ(with_search->seconds, alone->seconds);
  // A search takes longer with the harmonics of the round, though less so than the curves.
  EXPECT_GT(with_search->until_end, alone->seconds + hurried.after);
  EXPECT_LT(with_search->until_end, alone->seconds * (1.0 + hurried.after / spent.curves));
  EXPECT_DOUBLE_EQ(shared->until_end, with_search->until_end - 0.5 * alone->seconds);
}

// A round that there is time for, and that leaves nearly all, is no reason to be silent about what
// would be needed.
TEST(Refinement, NamesTheRoundThatThereIsNoTimeFor) {
  std::string left;
  const std::vector<CurveBudget> told{budget({{"harmonics", 0.08}, {"fit", 0.005}})};
  SpentSeconds hurried = spent;
  hurried.available = 1.5 * spent.curves;
  const auto step = refinement(blade(), told, tolerance, hurried, left);
  ASSERT_TRUE(step.has_value());
  EXPECT_TRUE(step->scene.settings.harmonics.chosen()) << step->text;
  EXPECT_GT(step->seconds, hurried.available);
}

// With a budget of time the first choice is a step on the way, told errors or not.
TEST(Refinement, WithABudgetUnknownHarmonicsAreChosenRoughlyFirst) {
  std::string left;
  CurveBudget lost = budget({{"cells", 1e-4}});
  lost.unknown.emplace_back("harmonics");
  SceneDescription hurried = blade();
  hurried.accuracy.budget = 60.0;
  const auto step = refinement(hurried, {lost}, tolerance, spent, left);
  const auto unhurried = refinement(blade(), {lost}, tolerance, spent, left);
  ASSERT_TRUE(step && unhurried);
  EXPECT_GT(step->scene.settings.harmonics.tolerance,
            unhurried->scene.settings.harmonics.tolerance);
  EXPECT_LT(step->scene.settings.harmonics.tolerance, 0.1);
}

TEST(Refinement, WhatCannotBeRefinedDoesNotMakeTheRestDear) {
  std::string left;
  const std::vector<CurveBudget> told{
      budget({{"basis", 0.05}, {"harmonics", 0.05}, {"cells", 1e-3}})};
  const auto step = refinement(blade(), told, tolerance, spent, left);
  ASSERT_TRUE(step.has_value());
  EXPECT_EQ(left, "basis");
  EXPECT_TRUE(step->only_harmonics) << step->text;
  EXPECT_GE(step->scene.settings.harmonics.tolerance, 0.25 * tolerance);
}

TEST(Refinement, ChosenHarmonicsAreChosenCloser) {
  std::string left;
  SceneDescription scene = blade();
  scene.settings.harmonics.tolerance = 0.5 * tolerance;
  const auto step = refinement(scene, {budget({{"harmonics", 0.03}})}, tolerance, spent, left);
  ASSERT_TRUE(step.has_value());
  EXPECT_DOUBLE_EQ(step->scene.settings.harmonics.tolerance, 0.25 * tolerance);
}

TEST(Refinement, HarmonicsThatCannotBeToldAreRefinedFirst) {
  std::string left;
  CurveBudget lost = budget({{"cells", 1e-4}});
  lost.unknown.emplace_back("harmonics");
  EXPECT_TRUE(std::isinf(largest_bar({lost})));
  const auto step = refinement(blade(), {lost}, tolerance, spent, left);
  ASSERT_TRUE(step.has_value());
  EXPECT_TRUE(step->scene.settings.harmonics.chosen());
}

TEST(Refinement, NamesWhatItCannotRefine) {
  std::string left;
  SceneDescription scene = mesh_file(0);
  std::get<MeshFileModel>(scene.model).modes = ModesFile{};  // of another code, on this mesh
  EXPECT_FALSE(refinement(scene, {budget({{"mesh", 0.05}})}, tolerance, spent, left).has_value());
  EXPECT_EQ(left, "mesh");
}

TEST(Refinement, WithoutABudgetNothingIsKnown) {
  EXPECT_TRUE(std::isinf(largest_bar({CurveBudget{}})));
  EXPECT_DOUBLE_EQ(largest_bar({CurveBudget{}, budget({{"cells", 0.01}})}), 0.01);
  CurveBudget partial = budget({{"cells", 0.01}});
  partial.unknown.emplace_back("mesh");
  EXPECT_EQ(not_in_bars({partial, partial}), std::vector<std::string>{"mesh"});
}

TEST(Refinement, HarmonicsAreChosenAsCloselyAsCanBe) {
  std::string left;
  SceneDescription scene = blade();
  const auto step = refinement(scene, {budget({{"harmonics", 0.5}})}, 1e-5, spent, left);
  ASSERT_TRUE(step.has_value());
  EXPECT_DOUBLE_EQ(step->scene.settings.harmonics.tolerance, 1e-5);
  EXPECT_FALSE(
      refinement(step->scene, {budget({{"harmonics", 2e-5}})}, 1e-5, spent, left).has_value());
  EXPECT_EQ(left, "harmonics");
}

}  // namespace
}  // namespace microslip::pipelines::test_refinement
