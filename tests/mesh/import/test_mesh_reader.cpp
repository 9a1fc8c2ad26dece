#include "mesh/mesh_reader.hpp"

#include <random>

#include <gtest/gtest.h>

#include "mesh/checks/mesh_quality.hpp"
#include "mesh/element_shape.hpp"
#include "mesh/import/gmsh_elements.hpp"
#include "tests/mesh/sample_meshes.hpp"
#include "tests/support/gmsh_text.hpp"

namespace microslip::mesh::test_mesh_reader {
namespace {

using tests::curved_element;
using tests::gmsh_file;

constexpr double formats[] = {2.2, 4.1};

/// ∫ det(I + 0.1 [0 y 0; 0 0 z; x 0 0]) dV = ∫ (1 + 0.001 xyz) dV of x ↦ x + 0.05 (y², z², x²):
/// 1/6 + 0.001/720 on the simplex, that of the straight element where x or z is odd.
double exact_volume(ElementType type) {
  switch (solid(type)) {
    case Solid::tetrahedron:
      return 1.0 / 6.0 + 0.001 / 720.0;
    case Solid::hexahedron:
      return 8.0;
    case Solid::wedge:
      return 1.0;
    case Solid::pyramid:
      return 4.0 / 3.0;
  }
  return 0.0;
}

TEST(MeshReader, ReadsCurvedElementsInEveryFormatWithTheirVolume) {
  for (const ElementType type : tests::quadratic_types) {
    for (const double version : formats) {
      for (const bool binary : {false, true}) {
        const Mesh mesh =
            test::read_gmsh_text(gmsh_file(curved_element(type), version, binary), "x.msh");
        EXPECT_NEAR(mesh.volume(), exact_volume(type), 1e-14 * 8) << version << binary;
        EXPECT_EQ(mesh.n_nodes(), n_nodes(type)) << "the node no element uses is dropped";
      }
    }
  }
}

// Row 56. Hard: every code has an order of nodes of its own; a straight element hides a wrong one.
// Met in: gmsh, VTK, Abaqus and Nastran.
// Right: one curved element of each type has its volume.
TEST(MeshReader, PutsNodesIntoTheProjectsOrder) {
  for (const ElementType type : tests::quadratic_types) {
    const auto element = curved_element(type);
    const Mesh mesh = test::read_gmsh_text(gmsh_file(element, 4.1, true), "x.msh");
    const auto& block = mesh.elements().front();
    for (Eigen::Index a = 0; a < element.nodes.rows(); ++a) {
      EXPECT_EQ(mesh.nodes().row(block.connectivity(0, a)), element.nodes.row(a))
          << name(type) << a;
    }
  }
}

TEST(MeshReader, KeepsNamesAndConvertsUnits) {
  const Mesh mesh = test::read_gmsh_text(gmsh_file(curved_element(ElementType::tet10), 2.2, false),
                                         "x.msh", 1e-3);
  EXPECT_EQ(mesh.surface_names(), std::vector<std::string>{"face one"});
  EXPECT_EQ(mesh.surface("face one").nodes.size(), 6U);
  EXPECT_EQ(mesh.node_set("tip").size(), 1U);
  EXPECT_NEAR(mesh.volume(), 1e-9 * exact_volume(ElementType::tet10), 1e-22);
}

TEST(MeshReader, AcceptsDosLineEnds) {
  std::string text;
  for (const char c : gmsh_file(curved_element(ElementType::tet10), 4.1, false)) {
    if (c == '\n') text += '\r';
    text += c;
  }
  EXPECT_EQ(test::read_gmsh_text(text, "x.msh").n_elements(), 1);
}

std::string message_of(const std::string& content) {
  try {
    static_cast<void>(test::read_gmsh_text(content, "x.msh"));
  } catch (const MeshError& error) {
    return error.what();
  }
  return "no error";
}

// Row 55. Hard: a file may end anywhere, and what is there is right.
// Met in: full disks and broken copies.
// Right: refused with line or entity, whatever byte it ends at.
TEST(MeshReader, EveryTruncationIsToldByPlace) {
  for (const double version : formats) {
    for (const bool binary : {false, true}) {
      const std::string whole = gmsh_file(curved_element(ElementType::tet10), version, binary);
      const std::size_t end = whole.find("$EndElements") + 5;
      for (std::size_t length = 0; length < end; length += 7) {
        const std::string message = message_of(whole.substr(0, length));
        EXPECT_TRUE(message.starts_with("x.msh:")) << length << ": " << message;
      }
    }
  }
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  text.replace(text.find(what), what.size(), by);
  return text;
}

TEST(MeshReader, NamesWhatIsWrong) {
  const std::string good = gmsh_file(curved_element(ElementType::tet10), 2.2, false);
  EXPECT_NE(message_of("solid cube").find("not a gmsh mesh"), std::string::npos);
  EXPECT_NE(message_of(replaced(good, "2.2", "4.0")).find("format 4.0"), std::string::npos);
  EXPECT_NE(message_of(replaced(good, "\n107 ", "\n100 ")).find("stands twice"), std::string::npos);
  EXPECT_NE(message_of(replaced(good, "\n107 ", "\n108 ")).find("which is not there"),
            std::string::npos);
  EXPECT_NE(message_of(replaced(good, "\n93 9 ", "\n93 nan ")).find("not a finite number"),
            std::string::npos);
  EXPECT_NE(message_of(replaced(good, "3 11 2", "3 13 2"))
                .find("wedge18 elements: nodes in the middle of faces are not read: mesh with "
                      "Mesh.SecondOrderIncomplete = 1"),
            std::string::npos);
  EXPECT_NE(message_of(replaced(good, "3 11 2", "3 99 2")).find("element type 99"),
            std::string::npos);
  EXPECT_NE(
      message_of(replaced(good, "$Elements\n3", "$Elements\n2")).find("expected $EndElements"),
      std::string::npos);
  EXPECT_NE(message_of(replaced(good, "$Nodes\n11", "$Nodes\n99999999999")).find("does not fit"),
            std::string::npos);
}

TEST(MeshReader, RefusesABodyOfASizeThatNoneHas) {
  const std::string good = gmsh_file(curved_element(ElementType::tet10), 2.2, false);
  for (const double unit : {1e-60, 1e-20, 1e20, 1e60}) {
    EXPECT_THROW(static_cast<void>(test::read_gmsh_text(good, "mesh.msh", unit)), MeshError)
        << unit;
  }
  EXPECT_GT(test::read_gmsh_text(good, "mesh.msh", 1e-6).volume(), 0.0);
}

// Format 2.2 writes an element once for each group it is in; the same group twice is a repetition.
TEST(MeshReader, CountsRepeatedElements) {
  GmshContent content;
  content.node_tags = {1, 2, 3, 4};
  content.coordinates = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const auto element = [](std::int64_t tag, std::vector<std::int64_t> groups) {
    return GmshElement{4, tag, std::move(groups), {1, 2, 3, 4}};
  };
  content.elements = {element(10, {1}), element(11, {2})};
  const Mesh grouped = make_mesh(content, 1.0, "m");
  EXPECT_EQ(grouped.n_elements(), 1);
  EXPECT_EQ(grouped.n_repeated_elements(), 0);
  EXPECT_TRUE(shape_warnings(grouped).empty());
  content.elements.push_back(element(12, {1}));
  content.elements.push_back(element(13, {2}));
  const Mesh repeated = make_mesh(content, 1.0, "m");
  EXPECT_EQ(repeated.n_elements(), 1);
  EXPECT_EQ(repeated.n_repeated_elements(), 2);
  ASSERT_EQ(shape_warnings(repeated).size(), 1U);
  EXPECT_EQ(shape_warnings(repeated)[0].rfind("2 volume elements", 0), 0U);
}

TEST(MeshReader, MissingFilesAreNamed) {
  try {
    static_cast<void>(read_gmsh("no/such/file.msh"));
    FAIL();
  } catch (const MeshError& error) {
    EXPECT_STREQ(error.what(), "no/such/file.msh: no such file");
  }
}

TEST(MeshReader, DamagedFilesGiveAMeshOrAMeshError) {
  std::mt19937 random(20261121);
  int read = 0;
  int refused = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string text =
        gmsh_file(curved_element(ElementType::tet10), formats[i % 2], (i / 2) % 2 == 0);
    const int n_changes = 1 + static_cast<int>(random() % 4);
    for (int k = 0; k < n_changes; ++k) {
      const std::size_t at = random() % text.size();
      switch (random() % 3) {
        case 0:
          text[at] = static_cast<char>(random());
          break;
        case 1:
          text.erase(at, random() % 9);
          break;
        default:
          text.insert(at, std::string(random() % 5, static_cast<char>(random())));
      }
    }
    try {
      static_cast<void>(test::read_gmsh_text(text, "x.msh"));
      ++read;
    } catch (const MeshError&) {
      ++refused;
    }
  }
  EXPECT_EQ(read + refused, 4000);
  EXPECT_GT(read, 100);
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace microslip::mesh::test_mesh_reader
