#include "pipelines/structure/extrapolated_modes.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "pipelines/effects/model_family.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "pipelines/structure/larger_elements.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/temporary_folder.hpp"

namespace microslip::pipelines::test_extrapolated_modes {
namespace {

SolvedStructure blade(const std::vector<std::string>& overrides) {
  std::vector<std::string> all{"model.element_size=\"5 mm\""};
  all.insert(all.end(), overrides.begin(), overrides.end());
  const SceneDescription scene = read_scene(MICROSLIP_SCENES "/blade_to_ground.toml", all);
  const TemporaryFolder folder;
  return solved_structure(scene, folder.path() / "mesh.msh");
}

const SolvedStructure& raw_blade() {
  static const SolvedStructure raw = blade({});
  return raw;
}

const SolvedStructure& extrapolated_blade() {
  static const SolvedStructure extrapolated = blade({"accuracy.tolerance=0.02"});
  return extrapolated;
}

double in_hz(const SolvedStructure& structure, Eigen::Index mode) {
  return structure.modes.basis.frequency[mode] / (2.0 * std::numbers::pi);
}

// Known to 2e-4 from elements of 2 and 4 mm (189 984 unknowns), of 3 and 6 mm with a fifth of that
// at sharp edges, and of 3 and 4 mm with a fifth of that there.
TEST(ExtrapolatedModes, LackMostOfTheErrorOfTheMesh) {
  const SolvedStructure& raw = raw_blade();
  const SolvedStructure& extrapolated = extrapolated_blade();
  EXPECT_FALSE(raw.coarser);
  ASSERT_TRUE(extrapolated.coarser);
  constexpr std::array known{293.36, 955.1, 1804.6};  // [Hz]
  for (Eigen::Index mode = 0; mode < 3; ++mode) {
    const double limit = known[static_cast<std::size_t>(mode)];
    const double error = std::abs(in_hz(extrapolated, mode) - limit);
    EXPECT_LT(error, 0.4 * std::abs(in_hz(raw, mode) - limit)) << mode;
  }
}

// A shape is scaled by its mass: that of a structure which answers as the limit does.
TEST(ExtrapolatedModes, KeepTheirShapes) {
  const SolvedStructure& raw = raw_blade();
  const SolvedStructure& extrapolated = extrapolated_blade();
  ASSERT_EQ(raw.modes.basis.shapes.cols(), extrapolated.modes.basis.shapes.cols());
  for (Eigen::Index mode = 0; mode < 3; ++mode) {
    const Eigen::VectorXd before = raw.modes.basis.shapes.col(mode);
    const Eigen::VectorXd after = extrapolated.modes.basis.shapes.col(mode);
    EXPECT_LT((after - before).norm(), 0.1 * before.norm()) << mode;
    EXPECT_GT((after - before).norm(), 0.0) << mode;
  }
}

TEST(ExtrapolatedModes, AreLeftWhereTheSceneSaysSo) {
  const auto asks = [](const std::vector<std::string>& overrides) {
    return is_extrapolated(read_scene(MICROSLIP_SCENES "/blade_to_ground.toml", overrides));
  };
  EXPECT_TRUE(asks({"accuracy.tolerance=0.02"}));
  EXPECT_FALSE(asks({}));
  EXPECT_FALSE(asks({"accuracy.tolerance=0.02", "accuracy.extrapolation=off"}));
}

// The first frequencies of such elements say nothing of their limit.
TEST(ExtrapolatedModes, AreLeftWhereCoarserMeshesDoNotConverge) {
  const SolvedStructure coarse = blade({"accuracy.tolerance=0.02", "model.element_size=\"30 mm\""});
  EXPECT_FALSE(coarse.coarser);
}

/// The first frequency of a blade of another thickness [Hz].
double likewise_in_hz(const std::string& neck, const SolvedStructure& like) {
  const SceneDescription scene =
      read_scene(MICROSLIP_SCENES "/blade_to_ground.toml",
                 {"model.element_size=\"5 mm\"", "accuracy.tolerance=0.02", neck});
  const TemporaryFolder folder;
  return in_hz(solved_likewise(scene, like, folder.path() / "mesh.msh"), 0);
}

// A search over a number of the geometry asks for modes at many values: those of one scene decide
// for all, or the frequencies would jump by the error of the mesh, 1 % here.
TEST(ExtrapolatedModes, OfASearchAreThoseOfItsSceneOrOfNone) {
  const std::string same = "model.element_size=\"5 mm\"";
  EXPECT_NEAR(likewise_in_hz(same, raw_blade()), in_hz(raw_blade(), 0), 1e-6);
  EXPECT_NEAR(likewise_in_hz(same, extrapolated_blade()), in_hz(extrapolated_blade(), 0), 1e-6);
  EXPECT_GT(in_hz(raw_blade(), 0), in_hz(extrapolated_blade(), 0) + 1.0);
}

TEST(ExtrapolatedModes, OfASearchAreNotExtrapolatedWhereThoseOfItsSceneAreNot) {
  const SceneDescription scene =
      read_scene(MICROSLIP_SCENES "/blade_to_ground.toml",
                 {"model.element_size=\"5 mm\"", "accuracy.tolerance=0.02"});
  std::vector<std::string> warnings;
  const auto raw = std::make_shared<const SolvedStructure>(raw_blade());
  const ReducedModel model = model_of(scene, raw.get(), warnings);
  ModelFamily family(scene, "material.poissons_ratio", model, raw);
  EXPECT_NEAR(family.at(0.3).frequency[0], model.frequency[0], 1e-6 * model.frequency[0]);
}

// Where these elements alone say that frequencies do not converge.
TEST(ExtrapolatedModes, OfASearchAreExtrapolatedWhereAloneTheyWouldNotBe) {
  const std::string coarse = "model.element_size=\"30 mm\"";
  const double raw = likewise_in_hz(coarse, raw_blade());
  EXPECT_LT(likewise_in_hz(coarse, extrapolated_blade()), raw - 1.0);
}

TEST(ExtrapolatedModes, AreLeftWhereTheBudgetHasNoRoomForCoarserMeshes) {
  const SceneDescription scene =
      read_scene(MICROSLIP_SCENES "/blade_to_ground.toml",
                 {"model.element_size=\"5 mm\"", "accuracy.tolerance=0.02"});
  SolvedStructure structure = raw_blade();
  begin_deadline(3.0, 0.0);  // a second and a half to work in
  LargerElements larger(scene, structure.mesh, 1);
  const std::string text = extrapolate_modes(structure, scene, larger);
  begin_deadline(std::numeric_limits<double>::infinity());
  EXPECT_NE(text.find("the budget leaves"), std::string::npos) << text;
  EXPECT_FALSE(structure.coarser);
  EXPECT_FALSE(was_cut_short());
}

// Frequencies on elements of 2, 4 and 8 mm of the default blade show 1.56, of 3, 6 and 12 mm with a
// fifth at sharp edges 2.9: both have their limit by 2.13 (share/doc/accuracy.md).
TEST(ExtrapolatedModes, RatesAreThoseOfSharpEdgesButWhereFieldsAreSmooth) {
  constexpr double of_edges = 2.127;
  EXPECT_DOUBLE_EQ(observed_ratio(295.068, 297.0, 300.006), of_edges);
  EXPECT_DOUBLE_EQ(observed_ratio(294.456, 295.666, 299.182), of_edges);
  EXPECT_DOUBLE_EQ(observed_ratio(1.0, 1.0, 1.0), of_edges);
  EXPECT_NEAR(observed_ratio(1.0, 1.02, 1.16), 7.0, 1e-12);
  EXPECT_DOUBLE_EQ(observed_ratio(1.0, 1.02, 3.0), of_edges) << "an accident";
  EXPECT_DOUBLE_EQ(observed_ratio(307.079, 317.982, 422.333), of_edges) << "30, 60 and 120 mm";
}

// Row 100. Hard: elements larger than the body is thick: nothing to extrapolate by.
// Met in: the default blade at 12 mm.
// Right: modes stay as they are where the meshes hardly differ.
//
// Elements of 24 mm are thicker than this blade, and its mesh has as many nodes as that of 32 mm:
// the first frequency on 12 mm, 304.5 Hz, was taken to 302.2, where 293.4 is right.
TEST(ExtrapolatedModes, AreLeftWhereElementsAreTooLargeToGrow) {
  const SolvedStructure structure =
      blade({"accuracy.tolerance=0.02", "model.element_size=\"12 mm\""});
  EXPECT_FALSE(structure.coarser);
  EXPECT_NEAR(in_hz(structure, 0), 304.5, 0.1);
}

TEST(ExtrapolatedModes, RefinementIsTwoAtMostAndOneOfTheSameMesh) {
  const mesh::Mesh& mesh = raw_blade().mesh;
  SceneDescription scene = read_scene(MICROSLIP_SCENES "/blade_to_ground.toml", {});
  EXPECT_EQ(refinement_between(mesh, mesh, scene), 1.0);
  scene.model = MeshFileModel{};
  EXPECT_EQ(refinement_between(mesh, mesh, scene), 2.0) << "each element cut";
  EXPECT_DOUBLE_EQ(ratio_over(2.0, 2.127), 2.127);
  EXPECT_NEAR(ratio_over(std::sqrt(2.0), 4.0), 2.0, 1e-12);
  EXPECT_EQ(ratio_over(1.0, 4.0), 1.0);
}

// Row 100b. Hard: large elements with small ones at the sharp edges: the nodes are at the edges,
// the error is not.
// Met in: the default blade on 13.3 mm, 3.3 mm at sharp edges: 0.15 % of the first frequency told,
// 1.6 % true.
// Right: what two such meshes tell is the error, and modes are not extrapolated from them.
TEST(ExtrapolatedModes, SmallElementsAtEdgesDoNotHideLargeOnes) {
  constexpr double known = 293.36;  // [Hz], as above
  const std::array<std::array<const char*, 3>, 3> sizes{
      {{"20 mm", "4 mm", "8 mm"}, {"13.3 mm", "3.3 mm", "6.6 mm"}, {"10 mm", "5 mm", "10 mm"}}};
  const std::array larger{"40 mm", "26.6 mm", "20 mm"};
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const auto& [size, edge, larger_edge] = sizes[i];
    const auto solved = [](const std::string& body, const std::string& edges) {
      return blade({"model.element_size=\"" + body + "\"", "model.edge_size=\"" + edges + "\"",
                    "accuracy.tolerance=0.02"});
    };
    const SolvedStructure fine = solved(size, edge);
    const SolvedStructure coarse = solved(larger[i], larger_edge);
    EXPECT_FALSE(fine.coarser) << size;
    const SceneDescription scene = read_scene(MICROSLIP_SCENES "/blade_to_ground.toml", {});
    const double ratio =
        ratio_over(refinement_between(fine.mesh, coarse.mesh, scene), ratio_of_edges);
    const double told = (in_hz(coarse, 0) - in_hz(fine, 0)) / (ratio - 1.0);
    const double error = in_hz(fine, 0) - known;
    EXPECT_GT(told, 0.8 * error) << size;
    EXPECT_LT(told, 2.0 * error) << size;
  }
}

}  // namespace
}  // namespace microslip::pipelines::test_extrapolated_modes
