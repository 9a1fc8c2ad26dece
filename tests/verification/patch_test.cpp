// Patch test: a body of distorted elements whose boundary is moved linearly, u = A x + b, moves
// linearly inside, with the uniform stress of A.
//
// Source: Irons & Razzaque, in Aziz (ed.), Mathematical Foundations of the FEM, Academic Press
// 1972; Hughes, The Finite Element Method (1987), section 4.6. The fields are in the space of every
// element and the quadrature is exact for them on straight edges: what is left is rounding of a
// direct solution, condition of K (1e4) times 1e-16, and 1e-11 is asked.
#include <cmath>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include "tests/support/box_mesh.hpp"
#include "tests/support/dense_system.hpp"

namespace microslip::patch_test {
namespace {

using mesh::ElementType;

const fem::Material titanium{1.14e11, 0.32, 4430.0};

struct Split {
  std::vector<Eigen::Index> inner;  // degrees of freedom
  std::vector<Eigen::Index> outer;
};

Split split(const mesh::Mesh& mesh) {
  std::vector<bool> is_outer(static_cast<std::size_t>(mesh.n_nodes()), false);
  for (const std::string& name : mesh.surface_names()) {
    for (const Eigen::Index node : mesh.node_set(name))
      is_outer[static_cast<std::size_t>(node)] = true;
  }
  Split result;
  for (Eigen::Index dof = 0; dof < 3 * mesh.n_nodes(); ++dof) {
    (is_outer[static_cast<std::size_t>(dof / 3)] ? result.outer : result.inner).push_back(dof);
  }
  return result;
}

void expect_linear_motion_inside(const mesh::Mesh& mesh, const char* name) {
  const Eigen::MatrixXd K = test::dense_system(mesh, titanium, {}).K;
  Eigen::Matrix3d A;
  A << 1.0, 0.3, -0.5, 0.2, -0.7, 0.4, 0.6, -0.1, 0.9;
  const Eigen::MatrixX3d exact =
      (mesh.nodes() * A.transpose()).rowwise() + Eigen::RowVector3d(0.3, -0.2, 0.1);
  const Eigen::VectorXd u = exact.transpose().reshaped();
  const Split dofs = split(mesh);
  ASSERT_FALSE(dofs.inner.empty());
  const Eigen::VectorXd load = -K(dofs.inner, dofs.outer) * u(dofs.outer);
  const Eigen::VectorXd inner = K(dofs.inner, dofs.inner).eval().llt().solve(load);
  const double error = (inner - u(dofs.inner)).norm() / u.norm();
  std::printf("%-15s %5td inner degrees of freedom, error %.1e\n", name, std::ssize(dofs.inner),
              error);
  EXPECT_LT(error, 1e-11);
}

class PatchTest : public testing::TestWithParam<ElementType> {};

TEST_P(PatchTest, LinearMotionOfTheBoundaryMovesTheInsideLinearly) {
  expect_linear_motion_inside(
      test::straight_box_mesh(
          GetParam(), {.size = {1.0, 1.0, 1.0}, .cells = {3, 3, 3}, .map = test::distorted}),
      mesh::name(GetParam()));
}

TEST(PatchTestOfAllTypes, LinearMotionOfTheBoundaryMovesTheInsideLinearly) {
  const test::BoxGrid grid{.size = {1.0, 1.0, 1.0}, .cells = {4, 3, 3}, .map = test::distorted};
  for (const int order : {1, 2}) {
    const mesh::Mesh mesh = test::straight_mixed_box_mesh(order, grid);
    ASSERT_EQ(mesh.elements().size(), 4U) << "one block for each solid";
    expect_linear_motion_inside(mesh, order == 1 ? "mixed linear" : "mixed quadratic");
  }
}

INSTANTIATE_TEST_SUITE_P(Types, PatchTest, testing::ValuesIn(mesh::all_element_types),
                         [](const auto& type) { return std::string(mesh::name(type.param)); });

}  // namespace
}  // namespace microslip::patch_test
