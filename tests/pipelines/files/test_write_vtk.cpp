#include "pipelines/files/write_vtk.hpp"

#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellType.h>
#include <vtkPointData.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "pipelines/system/output_file.hpp"
#include "tests/pipelines/synthetic_run.hpp"
#include "tests/pipelines/vtk_reading.hpp"
#include "tests/support/box_mesh.hpp"

namespace microslip::pipelines::test_write_vtk {
namespace {

constexpr std::array<std::array<int, 2>, 6> tet_edges{
    {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};

/// Two ten-node tetrahedra on the common face 1 2 3, edges of 10 mm; 14 nodes.
mesh::Mesh two_tets() {
  std::vector<Eigen::RowVector3d> nodes{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  const std::array<std::array<Eigen::Index, 4>, 2> corners{{{0, 1, 2, 3}, {1, 4, 2, 3}}};
  std::map<std::pair<Eigen::Index, Eigen::Index>, Eigen::Index> middles;
  mesh::Connectivity elements(2, 10);
  for (Eigen::Index e = 0; e < 2; ++e) {
    const auto& corner = corners[static_cast<std::size_t>(e)];
    for (std::size_t k = 0; k < 4; ++k) elements(e, static_cast<Eigen::Index>(k)) = corner[k];
    for (std::size_t k = 0; k < tet_edges.size(); ++k) {
      const Eigen::Index a = corner[static_cast<std::size_t>(tet_edges[k][0])];
      const Eigen::Index b = corner[static_cast<std::size_t>(tet_edges[k][1])];
      const auto [entry, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<Eigen::Index>(nodes.size()));
      if (is_new) {
        nodes.emplace_back(
            (nodes[static_cast<std::size_t>(a)] + nodes[static_cast<std::size_t>(b)]) / 2);
      }
      elements(e, static_cast<Eigen::Index>(4 + k)) = entry->second;
    }
  }
  Eigen::MatrixX3d coordinates(static_cast<Eigen::Index>(nodes.size()), 3);
  for (Eigen::Index i = 0; i < coordinates.rows(); ++i) {
    coordinates.row(i) = 0.01 * nodes[static_cast<std::size_t>(i)];
  }
  mesh::Connectivity face(1, 6);
  face << elements(0, 0), elements(0, 2), elements(0, 1), elements(0, 6), elements(0, 5),
      elements(0, 4);
  return {coordinates,
          {{mesh::ElementType::tet10, elements, {1, 2}}},
          {{"contact", {{mesh::FaceType::tri6, face}}}},
          {{"A", {4}}}};
}

/// Two made-up modes; every number is different.
fem::ModalBasis basis_for(const mesh::Mesh& mesh) {
  fem::ModalBasis basis;
  basis.frequency = Eigen::Vector2d(100.0, 250.5) * 2.0 * std::numbers::pi;
  basis.shapes.resize(3 * mesh.n_nodes(), 2);
  for (Eigen::Index i = 0; i < basis.shapes.size(); ++i) {
    basis.shapes.data()[i] = std::sin(1.0 + static_cast<double>(i));
  }
  return basis;
}

TEST(WriteVtk, ModesReadBackOnQuadraticCells) {
  const synthetic::Folder folder("modes_vtu");
  const mesh::Mesh mesh = two_tets();
  const fem::ModalBasis basis = basis_for(mesh);
  write_modes_vtu(folder.path() / "modes.vtu", mesh, basis);
  const auto grid = read_vtu(folder.path() / "modes.vtu");
  ASSERT_EQ(grid->GetNumberOfPoints(), mesh.n_nodes());
  ASSERT_EQ(grid->GetNumberOfCells(), 2);
  EXPECT_EQ(grid->GetCellType(0), VTK_QUADRATIC_TETRA);
  EXPECT_EQ(grid->GetPoint(4)[2], mesh.nodes()(4, 2));
  const Eigen::MatrixXd mode = values(*grid->GetPointData(), "mode_2");
  ASSERT_EQ(mode.rows(), mesh.n_nodes());
  ASSERT_EQ(mode.cols(), 3);
  for (Eigen::Index node = 0; node < mode.rows(); ++node) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(mode(node, axis), basis.shapes(3 * node + axis, 1));
    }
  }
  const Eigen::MatrixXd frequency = values(*grid->GetFieldData(), "frequency_Hz");
  ASSERT_EQ(frequency.rows(), 2);
  EXPECT_DOUBLE_EQ(frequency(1, 0), 250.5);
}

TEST(WriteVtk, NamedSurfacesAndPointsAreMarkedAtTheirNodes) {
  const synthetic::Folder folder("names_vtu");
  const mesh::Mesh mesh = two_tets();
  write_modes_vtu(folder.path() / "modes.vtu", mesh, basis_for(mesh));
  const auto grid = read_vtu(folder.path() / "modes.vtu");
  const Eigen::MatrixXd contact = values(*grid->GetPointData(), "surface_contact");
  EXPECT_EQ(contact.sum(), 6.0);
  EXPECT_EQ(contact(3, 0), 0.0) << "node 3 is opposite to the face";
  EXPECT_EQ(values(*grid->GetPointData(), "set_A")(4, 0), 1.0);
  EXPECT_EQ(values(*grid->GetPointData(), "set_A").sum(), 1.0);
}

TEST(WriteVtk, ModesReadBackWithMeshio) {
  const synthetic::Folder folder("modes_meshio");
  const mesh::Mesh mesh = two_tets();
  write_modes_vtu(folder.path() / "modes.vtu", mesh, basis_for(mesh));
  write_whole(folder.path() / "check.py",
              "import sys, math, meshio\n"
              "mesh = meshio.read(sys.argv[1])\n"
              "assert mesh.points.shape == (14, 3), mesh.points.shape\n"
              "assert [c.type for c in mesh.cells] == ['tetra10'], mesh.cells\n"
              "assert mesh.cells[0].data.shape == (2, 10)\n"
              "mode = mesh.point_data['mode_1']\n"
              "assert mode.shape == (14, 3)\n"
              "assert abs(mode[2, 1] - math.sin(1 + 3 * 2 + 1)) < 1e-15\n");
  const std::string command = "/usr/bin/python3 " + (folder.path() / "check.py").string() + " " +
                              (folder.path() / "modes.vtu").string();
  EXPECT_EQ(std::system(command.c_str()), 0);
}

/// Linear and quadratic meshes of all solids together, straight.
mesh::Mesh all_solids(int order) {
  return test::straight_mixed_box_mesh(
      order, {.size = {0.4, 0.2, 0.1}, .cells = {4, 1, 1}, .map = [](const Eigen::Vector3d& x) {
                return Eigen::Vector3d(x[0] + 0.1 * x[1], x[1], x[2] + 0.2 * x[0]);
              }});
}

// The volume meshio's corners enclose, signed, and every edge node in the middle of the edge it
// belongs to.
TEST(WriteVtk, AllSolidsReadBackWithMeshioInTheirOrderAndVolume) {
  const synthetic::Folder folder("solids_meshio");
  write_whole(folder.path() / "check.py", R"(import sys, meshio, numpy
tets = {'tetra': [(0, 1, 2, 3)], 'pyramid': [(0, 1, 2, 4), (0, 2, 3, 4)],
        'wedge': [(0, 1, 2, 5), (0, 1, 5, 4), (0, 4, 5, 3)],
        'hexahedron': [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]}
base = {'tetra10': 'tetra', 'pyramid13': 'pyramid', 'wedge15': 'wedge', 'hexahedron20': 'hexahedron'}
edges = {'tetra': '01 12 02 03 13 23', 'pyramid': '01 12 23 30 04 14 24 34',
         'wedge': '01 12 20 34 45 53 03 14 25', 'hexahedron': '01 12 23 30 45 56 67 74 04 15 26 37'}
for kind in ('wedge15', 'pyramid13'):  # meshio 5.0.0 has their nodes, but forgot their dimension
    meshio._mesh.topological_dimension.setdefault(kind, 3)
mesh = meshio.read(sys.argv[1])
volume, found = 0.0, set()
for block in mesh.cells:
    kind = base.get(block.type, block.type)
    found.add(kind)
    x = mesh.points[block.data]
    for a, b, c, d in tets[kind]:
        part = numpy.einsum('ij,ij->i', x[:, d] - x[:, a], numpy.cross(x[:, b] - x[:, a], x[:, c] - x[:, a])) / 6
        assert (part > 0).all(), (block.type, part)
        volume += part.sum()
    if block.type in base:
        first = x.shape[1] - len(edges[kind].split())
        for i, (a, b) in enumerate(edges[kind].split()):
            assert abs(x[:, first + i] - (x[:, int(a)] + x[:, int(b)]) / 2).max() < 1e-15, (block.type, i)
assert found == set(tets), found
assert abs(volume / float(sys.argv[2]) - 1) < 1e-13, volume
)");
  for (const int order : {1, 2}) {
    const mesh::Mesh mesh = all_solids(order);
    write_modes_vtu(folder.path() / "modes.vtu", mesh, basis_for(mesh));
    const std::string command = "/usr/bin/python3 " + (folder.path() / "check.py").string() + " " +
                                (folder.path() / "modes.vtu").string() + " 0.008";
    EXPECT_EQ(std::system(command.c_str()), 0) << order;
  }
}

TEST(WriteVtk, AllSolidsAreCellsOfVtk) {
  const synthetic::Folder folder("solids_vtu");
  const std::array<std::vector<int>, 2> expected{
      std::vector<int>{VTK_TETRA, VTK_HEXAHEDRON, VTK_WEDGE, VTK_PYRAMID},
      std::vector<int>{VTK_QUADRATIC_TETRA, VTK_QUADRATIC_HEXAHEDRON, VTK_QUADRATIC_WEDGE,
                       VTK_QUADRATIC_PYRAMID}};
  for (const int order : {1, 2}) {
    const mesh::Mesh mesh = all_solids(order);
    write_modes_vtu(folder.path() / "modes.vtu", mesh, basis_for(mesh));
    const auto grid = read_vtu(folder.path() / "modes.vtu");
    std::vector<int> found;
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
      if (found.empty() || found.back() != grid->GetCellType(cell))
        found.push_back(grid->GetCellType(cell));
    }
    EXPECT_EQ(found, expected[static_cast<std::size_t>(order - 1)]);
  }
}

// ⅓ Σ x·n A over the polygons drawn: outward all around, of both kinds.
TEST(WriteVtk, SkinOfAllSolidsEnclosesTheirVolume) {
  const synthetic::Folder folder("skin");
  for (const int order : {1, 2}) {
    const mesh::Mesh mesh = all_solids(order);
    write_motion(folder.path() / "motion", "peak", mesh, basis_for(mesh), contact::Harmonics(1, 2),
                 100.0, 4);
    const auto skin = read_vtp(folder.path() / "motion" / "peak_000.vtp");
    double volume = 0.0;
    for (vtkIdType face = 0; face < skin->GetNumberOfCells(); ++face) {
      const auto corner = [&](int i) {
        return Eigen::Vector3d(skin->GetPoint(skin->GetCell(face)->GetPointId(i)));
      };
      for (int i = 2; i < skin->GetCell(face)->GetNumberOfPoints(); ++i)
        volume += corner(0).dot(corner(i - 1).cross(corner(i))) / 6.0;
    }
    EXPECT_NEAR(volume, mesh.volume(), 1e-6 * mesh.volume()) << "positions in single precision";
  }
}

/// What ParaView colours by and warps with as it opens the file.
void expect_shown(vtkPointData& data, const char* name) {
  ASSERT_NE(data.GetScalars(), nullptr);
  ASSERT_NE(data.GetVectors(), nullptr);
  EXPECT_STREQ(data.GetScalars()->GetName(), name);
  EXPECT_STREQ(data.GetVectors()->GetName(), name);
}

TEST(WriteVtk, MotionAndModesOpenInColour) {
  const synthetic::Folder folder("shown");
  const mesh::Mesh mesh = two_tets();
  write_modes_vtu(folder.path() / "modes.vtu", mesh, basis_for(mesh));
  expect_shown(*read_vtu(folder.path() / "modes.vtu")->GetPointData(), "mode_1");
  write_motion(folder.path(), "peak", mesh, basis_for(mesh), contact::Harmonics(1, 2), 296.5, 4);
  expect_shown(*read_vtp(folder.path() / "peak_000.vtp")->GetPointData(), "displacement_m");
}

TEST(WriteVtk, MotionIsDrawnOnTheOuterFacesOverOnePeriod) {
  const synthetic::Folder folder("motion");
  const mesh::Mesh mesh = two_tets();
  const fem::ModalBasis basis = basis_for(mesh);
  contact::Harmonics q(1, 2);
  q.vector() << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;
  q.vector() *= 1e-6;
  write_motion(folder.path() / "motion", "peak", mesh, basis, q, 296.5, 8);
  const auto steps = pvd_steps(folder.path() / "motion" / "peak.pvd");
  ASSERT_EQ(steps.size(), 9U);
  EXPECT_EQ(steps[2].first, 90.0);
  const auto frame = read_vtp(folder.path() / "motion" / steps[2].second);
  EXPECT_EQ(frame->GetNumberOfPolys(), 6) << "two tetrahedra less the face they share";
  ASSERT_EQ(frame->GetNumberOfPoints(), 5) << "corners only";
  const Eigen::MatrixXd displacement = values(*frame->GetPointData(), "displacement_m");
  const Eigen::VectorXd expected = basis.shapes * q.at(std::numbers::pi / 2);
  for (vtkIdType i = 0; i < 5; ++i) {
    const Eigen::RowVector3d x(frame->GetPoint(i));
    Eigen::Index node = 0;
    // Single precision: 1e-6 of the displacement, 1e-7 of the position.
    ASSERT_LT((mesh.nodes().rowwise() - x).rowwise().norm().minCoeff(&node), 1e-8);
    EXPECT_LT((displacement.row(i).transpose() - expected.segment<3>(3 * node)).norm(),
              1e-6 * expected.norm());
  }
}

}  // namespace
}  // namespace microslip::pipelines::test_write_vtk
