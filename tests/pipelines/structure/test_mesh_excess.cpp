#include "pipelines/structure/mesh_excess.hpp"

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
  const TemporaryFolder folder;
  const SolvedStructure structure = solved_structure(scene, folder.path() / "mesh.msh");
  return mesh_excess(structure.mesh, structure.modes, scene);
}

TEST(MeshExcess, OfAGivenMeshIsToldOfTheModesUpToTheEndOfTheRange) {
  const std::string one = excess_of("plate_mesh.toml", {}).text;
  EXPECT_NE(one.find("(mode 1)"), std::string::npos) << one;
  EXPECT_EQ(one.find("(mode 2)"), std::string::npos) << one;
  const std::string more =
      excess_of("plate_mesh.toml", {"response.frequency=[\"10 Hz\", \"90 kHz\"]"}).text;
  EXPECT_NE(more.find("(mode 1), "), std::string::npos) << more;
}

TEST(MeshExcess, IsAWarningWhereMoreAccuracyIsAskedFor) {
  EXPECT_EQ(excess_of("plate_mesh.toml", {"accuracy.tolerance=0.2"}).warning, "");
  const std::string warning = excess_of("plate_mesh.toml", {"accuracy.tolerance=0.001"}).warning;
  EXPECT_NE(warning.find("model.file"), std::string::npos) << warning;
}

TEST(MeshExcess, IsNotToldWhereTheErrorBudgetTellsIt) {
  EXPECT_EQ(excess_of("blade_to_ground.toml", {"model.element_size=\"20 mm\""}).text, "");
}

TEST(MeshExcess, IsNotToldOfModesAndMatricesOfAnotherCode) {
  for (const char* scene : {"plate_calculix.toml", "plate_matrices.toml"}) {
    EXPECT_EQ(excess_of(scene, {}).text, "") << scene;
  }
}

}  // namespace
}  // namespace microslip::pipelines::test_mesh_excess
