// Displacements of corners at the nodes between them: what is linear in x, y, z is kept.
#include "fem/assembly/corner_interpolation.hpp"

#include <gtest/gtest.h>
#include <slepceps.h>

#include "fem/assembly/edge_nodes.hpp"
#include "fem/petsc/columns.hpp"
#include "fem/petsc/petsc_check.hpp"
#include "tests/support/box_mesh.hpp"

namespace microslip::fem::test_corner_interpolation {
namespace {

using mesh::ElementType;

mesh::Mesh box(ElementType type) {
  return test::box_mesh(type, {.size = {1, 2, 3}, .cells = {3, 2, 4}, .map = {}});
}

DofMap dofs_of(const mesh::Mesh& mesh, const std::vector<std::string>& clamped) {
  int rank = 0;
  int n_ranks = 1;
  check(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  check(MPI_Comm_size(PETSC_COMM_WORLD, &n_ranks));
  return {mesh, clamped, rank, n_ranks};
}

/// Solver nodes of this rank that are corners of an element.
std::vector<Eigen::Index> own_corners(const mesh::Mesh& mesh, const DofMap& dofs) {
  std::vector<bool> is_corner(static_cast<std::size_t>(mesh.n_nodes()), false);
  for (const mesh::ElementBlock& block : mesh.elements()) {
    for (const auto node : block.connectivity.leftCols(mesh::n_corners(block.type)).reshaped()) {
      is_corner[static_cast<std::size_t>(node)] = true;
    }
  }
  std::vector<Eigen::Index> corners;
  for (Eigen::Index i = dofs.first(); i < dofs.last(); ++i) {
    if (is_corner[static_cast<std::size_t>(dofs.mesh_node(i))]) corners.push_back(i);
  }
  return corners;
}

/// A displacement that grows along x.
Eigen::VectorXd at_nodes(const mesh::Mesh& mesh, const DofMap& dofs,
                         const std::vector<Eigen::Index>& solver_nodes) {
  const Eigen::Vector3d a{0.3, 0.7, -0.6};
  Eigen::VectorXd u(3 * std::ssize(solver_nodes));
  for (Eigen::Index i = 0; i < std::ssize(solver_nodes); ++i) {
    const Eigen::Index node = dofs.mesh_node(solver_nodes[static_cast<std::size_t>(i)]);
    // 0 where x = 0, so that it is right with these nodes held as well.
    u.segment<3>(3 * i) = mesh.nodes()(node, 0) * a;
  }
  return u;
}

Eigen::VectorXd product(Mat P, Eigen::VectorXd u, Eigen::Index n_rows) {
  Eigen::VectorXd result(n_rows);
  const VecHandle x = view_column(u);
  const VecHandle y = view_column(result);
  check(MatMult(P, x.get(), y.get()));
  return result;
}

class Types : public testing::TestWithParam<ElementType> {};

TEST_P(Types, KeepLinearDisplacementsOfFreeAndOfHeldBodies) {
  const mesh::Mesh mesh = box(GetParam());
  for (const std::vector<std::string>& clamped : {std::vector<std::string>{}, {"x0"}}) {
    const DofMap dofs = dofs_of(mesh, clamped);
    const MatHandle P = corner_interpolation(mesh, dofs);
    std::vector<Eigen::Index> all;
    for (Eigen::Index i = dofs.first(); i < dofs.last(); ++i) all.push_back(i);
    const Eigen::VectorXd exact = at_nodes(mesh, dofs, all);
    const Eigen::VectorXd found =
        product(P.get(), at_nodes(mesh, dofs, own_corners(mesh, dofs)), dofs.n_local_dofs());
    EXPECT_LT((found - exact).lpNorm<Eigen::Infinity>(), 1e-14);  // rounding of a mean
  }
}

INSTANTIATE_TEST_SUITE_P(Quadratic, Types,
                         testing::Values(ElementType::tet10, ElementType::hex20,
                                         ElementType::wedge15, ElementType::pyramid13));

TEST(CornerInterpolation, OfElementsWithCornersAloneIsNone) {
  const mesh::Mesh mesh = box(ElementType::hex8);
  EXPECT_FALSE(has_edge_nodes(mesh));
  EXPECT_FALSE(corner_interpolation(mesh, dofs_of(mesh, {})));
}

}  // namespace
}  // namespace microslip::fem::test_corner_interpolation
