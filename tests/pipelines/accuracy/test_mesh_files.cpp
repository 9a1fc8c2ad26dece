#include "pipelines/accuracy/mesh_files.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "pipelines/scene/scene_file.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/temporary_folder.hpp"
#include "tests/support/box_mesh.hpp"

namespace microslip::pipelines::test_mesh_files {
namespace {

using mesh::ElementType;

const char* const box_text = R"(
[model]
kind = "mesh"
file = "middle.msh"
length_unit = "m"
[material]
youngs_modulus = 2e11
poissons_ratio = 0.3
density = 7800
[supports]
clamped = ["z0"]
[contact]
surface = "z1"
slip_direction = [1, 0, 0]
friction_coefficient = 0.4
normal_stiffness = 1e9
tangential_stiffness = 1e9
[excitation]
forces = [ { at = "x1", direction = [1, 0, 0], amplitude = 1 } ]
[response]
output = { at = "z1", direction = [1, 0, 0] }
frequency = [100, 200]
preload = [100]
)";

/// gmsh's format 2.2. @param name_of_z1  of the contact.
std::string gmsh_text(const mesh::Mesh& mesh, const std::string& name_of_z1) {
  std::ostringstream out;
  const std::vector<std::string> names = mesh.surface_names();
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" << names.size() << '\n';
  for (std::size_t i = 0; i < names.size(); ++i) {
    out << "2 " << i + 1 << " \"" << (names[i] == "z1" ? name_of_z1 : names[i]) << "\"\n";
  }
  out << "$EndPhysicalNames\n$Nodes\n" << mesh.n_nodes() << '\n';
  for (Eigen::Index i = 0; i < mesh.n_nodes(); ++i) {
    out << i + 1 << ' ' << mesh.nodes().row(i) << '\n';
  }
  std::ostringstream elements;
  Eigen::Index n = 0;
  const auto put = [&](int type, std::size_t group, const mesh::Connectivity& connectivity) {
    for (Eigen::Index e = 0; e < connectivity.rows(); ++e) {
      elements << ++n << ' ' << type << " 2 " << group << ' ' << group << ' '
               << (connectivity.row(e).array() + 1).matrix() << '\n';
    }
  };
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (const mesh::FaceBlock& block : mesh.surface(names[i]).faces) {
      put(block.type == mesh::FaceType::quad4 ? 3 : 2, i + 1, block.connectivity);
    }
  }
  for (const mesh::ElementBlock& block : mesh.elements()) {
    put(block.type == ElementType::hex8 ? 5 : 4, 0, block.connectivity);
  }
  out << "$EndNodes\n$Elements\n" << n << '\n' << elements.str() << "$EndElements\n";
  return out.str();
}

class MeshFiles : public testing::Test {
 protected:
  /// A box of 0.1 x 0.1 x 0.4 m with n elements along its shorter sides, and its name as typed.
  std::string box(const std::string& name, int n, ElementType type = ElementType::hex8,
                  double scale = 1.0, const std::string& name_of_z1 = "z1") const {
    const std::filesystem::path file = folder_.path() / name;
    std::filesystem::create_directories(file.parent_path());
    const test::BoxGrid grid{scale * Eigen::Vector3d(0.1, 0.1, 0.4), {n, n, 4 * n}, {}};
    std::ofstream(file) << gmsh_text(test::box_mesh(type, grid), name_of_z1);
    return file.string();
  }

  [[nodiscard]] SceneDescription scene() const {
    return parse_scene(box_text, "box.toml", folder_.path());
  }

  [[nodiscard]] std::string complaint(const SceneDescription& scene,
                                      const std::vector<std::string>& files) const {
    try {
      static_cast<void>(ladder_of_files(scene, files));
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  }
  [[nodiscard]] std::string complaint(const std::vector<std::string>& files) const {
    return complaint(scene(), files);
  }

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

void expect_in(const std::string& part, const std::string& whole) {
  EXPECT_NE(whole.find(part), std::string::npos) << whole;
  EXPECT_EQ(whole.find('\n'), std::string::npos) << whole;
}

TEST_F(MeshFiles, AreRungsWithTheSizeOfTheirElements) {
  const Ladder ladder = ladder_of_files(scene(), {box("coarse.msh", 1), box("middle.msh", 2)});
  EXPECT_EQ(ladder.knob, "mesh_file");
  EXPECT_EQ(ladder.source, "mesh");
  ASSERT_EQ(ladder.rungs.size(), 2U);
  EXPECT_EQ(ladder.rungs[0].value, "coarse.msh");
  EXPECT_EQ(ladder.rungs[1].value, "middle.msh");
  EXPECT_NEAR(ladder.rungs[0].size, 0.1, 1e-12);
  EXPECT_NEAR(ladder.rungs[1].size, 0.05, 1e-12);
  EXPECT_FALSE(ladder.rungs[0].scene.settings.harmonics.checked);
}

// The modes of the scene serve where one of the files is its own, and nowhere else.
TEST_F(MeshFiles, AreSolvedAnewButForThatOfTheScene) {
  const std::string coarse = box("coarse.msh", 1);
  const Ladder ladder = ladder_of_files(scene(), {coarse, box("middle.msh", 2)});
  EXPECT_FALSE(ladder.rungs[0].same_mesh);
  EXPECT_FALSE(ladder.rungs[0].same_basis);
  EXPECT_EQ(std::get<MeshFileModel>(ladder.rungs[0].scene.model).file, coarse);
  EXPECT_TRUE(ladder.rungs[1].same_mesh);
  EXPECT_TRUE(ladder.rungs[1].same_basis);
}

TEST_F(MeshFiles, OfOneNameAreToldApartByTheirFolders) {
  const std::string coarse = box("coarse/box.msh", 1);
  const Ladder ladder = ladder_of_files(scene(), {coarse, box("fine/box.msh", 2)});
  EXPECT_EQ(ladder.rungs[0].value, coarse);
  EXPECT_NE(ladder.rungs[1].value, coarse);
}

TEST_F(MeshFiles, OfOtherElementsHaveNoSizesToCompare) {
  const Ladder ladder =
      ladder_of_files(scene(), {box("coarse.msh", 1), box("fine.msh", 2, ElementType::tet4)});
  EXPECT_EQ(ladder.rungs[0].size, 0.0);
  EXPECT_EQ(ladder.rungs[1].size, 0.0);
}

TEST_F(MeshFiles, AreRefusedWithTheReason) {
  const std::string coarse = box("coarse.msh", 1);
  const std::string middle = box("middle.msh", 2);
  expect_in("coarse.msh: one mesh does not converge: expected two files or more",
            complaint({coarse}));
  expect_in("expected from coarse to fine: ", complaint({middle, coarse}));
  expect_in("box.step: meshes are read from files that end in",
            complaint({coarse, (folder() / "box.step").string()}));
  expect_in("coarsest.msh: no such file; did you mean \"coarse.msh\"?",
            complaint({(folder() / "coarsest.msh").string(), middle}));
  const std::string nameless = box("nameless.msh", 3, ElementType::hex8, 1.0, "zone");
  expect_in("nothing is named \"z1\"", complaint({coarse, nameless}));
  expect_in("--meshes " + nameless + ": box.toml:", complaint({coarse, nameless}));
  expect_in("another body, or another unit",
            complaint({coarse, box("in_mm.msh", 3, ElementType::hex8, 1000.0)}));
}

TEST_F(MeshFiles, AreOfKindMeshAlone) {
  const std::vector<std::string> files{box("coarse.msh", 1), box("middle.msh", 2)};
  expect_in("is of kind \"blade\": its elements are made here",
            complaint(read_scene(MICROSLIP_SCENES "/blade_to_ground.toml"), files));
  expect_in("is of kind \"chain\"",
            complaint(read_scene(MICROSLIP_SCENES "/chain_2dof.toml"), files));
}

}  // namespace
}  // namespace microslip::pipelines::test_mesh_files
