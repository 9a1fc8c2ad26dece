#include "pipelines/structure/mesh_excess.hpp"

#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "pipelines/scene/scene_file.hpp"
#include "pipelines/structure/structure_stage.hpp"
#include "pipelines/system/temporary_folder.hpp"

namespace microslip::pipelines::test_mesh_excess {
namespace {

MeshExcess excess_of(const std::string& scene_file, const std::vector<std::string>& overrides) {
  const SceneDescription scene =
      read_scene(std::string(MICROSLIP_SCENES) + "/" + scene_file, overrides);
  if (!has_elements_of_file(scene)) return {};
  const TemporaryFolder folder;
  const SolvedStructure structure = solved_structure(scene, folder.path() / "mesh.msh");
  return mesh_excess(frequency_excess(structure.mesh, structure.modes, scene), scene);
}

TEST(MeshExcess, OfAGivenMeshIsToldOfTheModesUpToTheEndOfTheRange) {
  const std::string one = excess_of("plate_mesh.toml", {}).text;
  EXPECT_NE(one.find("(mode 1)"), std::string::npos) << one;
  EXPECT_EQ(one.find("(mode 2)"), std::string::npos) << one;
  const std::string more =
      excess_of("plate_mesh.toml", {"response.frequency=[\"10 Hz\", \"90 kHz\"]"}).text;
  EXPECT_NE(more.find("), "), std::string::npos) << more;
}

// Shapes of a wave in an element are nothing but jumps: still no frequency is too high by itself.
TEST(MeshExcess, OfShortWavesIsBelowAllThereIs) {
  const MeshExcess told = excess_of(
      "plate_mesh.toml", {"modes.count=100", "response.frequency=[\"100 Hz\", \"300 kHz\"]"});
  const std::regex each(R"(([0-9.e+-]+) % \(mode)");
  int n = 0;
  for (auto i = std::sregex_iterator(told.text.begin(), told.text.end(), each);
       i != std::sregex_iterator(); ++i, ++n) {
    EXPECT_LT(std::stod((*i)[1]), 100.0) << told.text;
  }
  EXPECT_EQ(n, 4) << told.text;
}

TEST(MeshExcess, IsNotToldOfWhatRotates) {
  const std::vector<std::string> rotating{"static.speed=\"3000 rpm\"",
                                          "static.axis={origin=[0, -0.3, 0], direction=[1, 0, 0]}"};
  EXPECT_EQ(excess_of("plate_mesh.toml", rotating).text, "");
}

// Where an accuracy is asked for a run cuts the elements, but for those of which it is not told.
TEST(MeshExcess, IsAWarningWhereNothingIsDoneAboutIt) {
  SceneDescription scene;
  FrequencyExcess large{{0}, Eigen::VectorXd::Constant(1, 0.03), true};
  const std::string warning = mesh_excess(large, scene).warning;
  EXPECT_NE(warning.find("model.refinement = 1"), std::string::npos) << warning;
  scene.accuracy.tolerance = 0.01;
  EXPECT_EQ(mesh_excess(large, scene).warning, "");
  EXPECT_NE(mesh_excess(large, scene).text, "");
  large.is_whole = false;
  EXPECT_NE(mesh_excess(large, scene).warning.find("quadratic"), std::string::npos);
  scene.accuracy.tolerance = 0.0;
  const FrequencyExcess small{{0}, Eigen::VectorXd::Constant(1, 0.01), true};
  EXPECT_EQ(mesh_excess(small, scene).warning, "");
}

TEST(MeshExcess, IsNotToldWhereTheErrorBudgetTellsIt) {
  EXPECT_EQ(excess_of("plate_mesh.toml", {"model.refinement=1"}).text, "");
  EXPECT_EQ(excess_of("blade_to_ground.toml", {"model.element_size=\"20 mm\""}).text, "");
}

TEST(MeshExcess, IsNotToldOfModesAndMatricesOfAnotherCode) {
  for (const char* scene : {"plate_calculix.toml", "plate_matrices.toml"}) {
    EXPECT_EQ(excess_of(scene, {}).text, "") << scene;
  }
}

}  // namespace
}  // namespace microslip::pipelines::test_mesh_excess
