// Wedges and pyramids as gmsh makes and writes them: an extruded sector of a hollow cylinder, whose
// volume tells every edge node in a wrong place, and a block of hexahedra under a block of
// tetrahedra.
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <tuple>

#include <gmsh.h>
#include <gtest/gtest.h>

#include "mesh/mesh_reader.hpp"
#include "tests/mesh/given_mesh.hpp"
#include "tests/support/temporary_folder.hpp"

namespace microslip::mesh::test_extruded {
namespace {

namespace occ = gmsh::model::occ;

class GmshMeshes : public testing::Test {
 protected:
  GmshMeshes() {
    gmsh::initialize();
    set("General.Terminal", 0);
    set("General.NumThreads", 1);
    set("Mesh.SecondOrderIncomplete", 1);
    gmsh::model::add("test");
  }
  ~GmshMeshes() override { gmsh::finalize(); }
  GmshMeshes(const GmshMeshes&) = delete;
  GmshMeshes& operator=(const GmshMeshes&) = delete;
  GmshMeshes(GmshMeshes&&) = delete;
  GmshMeshes& operator=(GmshMeshes&&) = delete;

  static void set(const char* option, double value) { gmsh::option::setNumber(option, value); }

  /// As a file of the version, read back.
  [[nodiscard]] Mesh written_and_read(double version) const {
    set("Mesh.MshFileVersion", version);
    const auto file = folder_.path() / "mesh.msh";
    gmsh::write(file.string());
    return read_gmsh(file);
  }

 private:
  test::TemporaryFolder folder_;
};

std::map<ElementType, Eigen::Index> counts(const Mesh& mesh) {
  std::map<ElementType, Eigen::Index> found;
  for (const ElementBlock& block : mesh.elements()) found[block.type] = block.connectivity.rows();
  return found;
}

/// A quarter of a cylinder, radii 1 and 2, height 1, of triangles extruded along the axis; `foot` z
/// = 0 and `outside`, r = 2, are named.
void mesh_sector(double size, int order) {
  gmsh::clear();
  gmsh::model::add("sector");
  const int line = occ::addLine(occ::addPoint(1, 0, 0), occ::addPoint(2, 0, 0));
  gmsh::vectorpair made;
  occ::revolve({{1, line}}, 0, 0, 0, 0, 0, 1, std::numbers::pi / 2, made);
  int foot = 0;
  for (const auto& [dimension, tag] : made) {
    if (dimension == 2) foot = tag;
  }
  occ::extrude({{2, foot}}, 0, 0, 1, made, {static_cast<int>(std::lround(1.0 / size))}, {}, true);
  occ::synchronize();
  int body = 0;
  int outside = 0;
  for (const auto& [dimension, tag] : made) {
    if (dimension == 3) body = tag;
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    if (dimension == 2) occ::getCenterOfMass(2, tag, x, y, z);
    // The middle of an arc is 2 √2 / π of its radius away.
    if (std::abs(std::hypot(x, y) - 4.0 * std::numbers::sqrt2 / std::numbers::pi) < 1e-6)
      outside = tag;
  }
  for (const auto& [dimension, tag, group] :
       {std::tuple{3, body, "body"}, {2, foot, "foot"}, {2, outside, "outside"}}) {
    const int number = gmsh::model::addPhysicalGroup(dimension, {tag});
    gmsh::model::setPhysicalName(dimension, number, group);
  }
  gmsh::option::setNumber("Mesh.MeshSizeMin", size);
  gmsh::option::setNumber("Mesh.MeshSizeMax", size);
  gmsh::model::mesh::generate(3);
  gmsh::model::mesh::setOrder(order);
}

constexpr double sector_volume = 3.0 * std::numbers::pi / 4.0;

TEST_F(GmshMeshes, ExtrudedTrianglesAreWedgesInBothVersions) {
  for (const auto& [order, type] : {std::pair{1, ElementType::wedge6}, {2, ElementType::wedge15}}) {
    mesh_sector(0.4, order);
    const Mesh old_version = written_and_read(2.2);
    const Mesh mesh = written_and_read(4.1);
    ASSERT_EQ(counts(mesh).size(), 1U);
    EXPECT_EQ(mesh.elements().front().type, type);
    EXPECT_EQ(counts(mesh), counts(old_version));
    EXPECT_NEAR(mesh.volume(), old_version.volume(), 1e-13);
    EXPECT_EQ(mesh.surface("foot").faces.front().type,
              order == 1 ? FaceType::tri3 : FaceType::tri6);
    EXPECT_EQ(mesh.surface("outside").faces.front().type,
              order == 1 ? FaceType::quad4 : FaceType::quad8);
  }
}

// Arcs of parabolas: the area under one errs by the fourth power of its angle, inside and outside.
TEST_F(GmshMeshes, CurvedWedgesFillACylinder) {
  std::array<double, 2> error{};
  for (std::size_t i = 0; i < 2; ++i) {
    mesh_sector(std::numbers::pi / (i == 0 ? 8.0 : 16.0), 2);  // 4 and 8 edges on the inner arc
    const Mesh mesh = written_and_read(4.1);
    error[i] = std::abs(mesh.volume() / sector_volume - 1.0);
    std::printf("%td wedge15: volume %.9f, exact %.9f, area outside %.9f, exact %.9f\n",
                mesh.n_elements(), mesh.volume(), sector_volume, mesh.surface("outside").area,
                std::numbers::pi);
    EXPECT_NEAR(mesh.surface("outside").area, std::numbers::pi, 1e-3);
    EXPECT_NEAR(mesh.surface("foot").area, sector_volume, 1e-3);
  }
  EXPECT_LT(error[0], 1e-4);
  EXPECT_GT(std::log2(error[0] / error[1]), 3.5) << error[0] << " " << error[1];
}

TEST_F(GmshMeshes, CompleteSecondOrderIsRefusedWithTheRemedy) {
  set("Mesh.SecondOrderIncomplete", 0);
  mesh_sector(0.5, 2);
  const std::string message = tests::message_of([&] { static_cast<void>(written_and_read(2.2)); });
  EXPECT_NE(message.find("Mesh.SecondOrderIncomplete = 1"), std::string::npos) << message;
}

/// A unit cube of 3³ hexahedra under one of tetrahedra: gmsh sets pyramids between them.
void mesh_blocks(int order) {
  gmsh::clear();
  gmsh::model::add("blocks");
  const int low = occ::addBox(0, 0, 0, 1, 1, 1);
  const int high = occ::addBox(0, 0, 1, 1, 1, 1);
  gmsh::vectorpair made;
  std::vector<gmsh::vectorpair> parts;
  occ::fragment({{3, low}}, {{3, high}}, made, parts);
  occ::synchronize();
  gmsh::vectorpair sides;
  gmsh::model::getBoundary({{3, low}}, sides, false, false, false);
  for (const auto& side : sides) {
    gmsh::vectorpair edges;
    gmsh::model::getBoundary({side}, edges, false, false, false);
    for (const auto& edge : edges) gmsh::model::mesh::setTransfiniteCurve(edge.second, 4);
    gmsh::model::mesh::setTransfiniteSurface(side.second);
    gmsh::model::mesh::setRecombine(2, side.second);
  }
  gmsh::model::mesh::setTransfiniteVolume(low);
  gmsh::option::setNumber("Mesh.MeshSizeMin", 0.0);
  gmsh::option::setNumber("Mesh.MeshSizeMax", 0.4);
  gmsh::model::mesh::generate(3);
  gmsh::model::mesh::setOrder(order);
}

TEST_F(GmshMeshes, PyramidsJoinHexahedraAndTetrahedra) {
  for (const int order : {1, 2}) {
    mesh_blocks(order);
    for (const double version : {2.2, 4.1}) {
      const Mesh mesh = written_and_read(version);
      const auto found = counts(mesh);
      EXPECT_EQ(found.size(), 3U);
      EXPECT_EQ(found.at(order == 1 ? ElementType::hex8 : ElementType::hex20), 27);
      EXPECT_EQ(found.at(order == 1 ? ElementType::pyramid5 : ElementType::pyramid13), 9);
      EXPECT_NEAR(mesh.volume(), 2.0, 1e-12);
    }
  }
}

}  // namespace
}  // namespace microslip::mesh::test_extruded
