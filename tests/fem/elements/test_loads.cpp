// Static and harmonic loads, springs, residual flexibility of a Structure.
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "fem/elements/polynomial_tractions.hpp"
#include "fem/modal_analysis.hpp"
#include "fem/petsc_error.hpp"
#include "fem/surface_load.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/dense_system.hpp"

namespace microslip::fem::test_loads {
namespace {

using mesh::ElementType;

const Material titanium{1.14e11, 0.32, 4430.0};
// Condition of K times rounding, with a margin: 1e5 · 1e-16.
constexpr double direct = 1e-10;

Eigen::Vector3d bend(const Eigen::Vector3d& x) { return {x[0], x[1] + 3.0 * x[0] * x[0], x[2]}; }

mesh::Mesh bar() {
  return test::box_mesh(ElementType::tet10,
                        {.size = {0.1, 0.02, 0.015}, .cells = {3, 1, 1}, .map = bend});
}

Eigen::Matrix3d some_frame() {
  return Eigen::AngleAxisd(0.4, Eigen::Vector3d(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
}

Eigen::MatrixXd some_loads(const mesh::Mesh& mesh) {
  return Eigen::MatrixXd::NullaryExpr(3 * mesh.n_nodes(), 4, [](Eigen::Index i, Eigen::Index j) {
    return std::sin(1.0 + 0.37 * static_cast<double>(i) + 1.9 * static_cast<double>(j));
  });
}

double relative(const Eigen::MatrixXd& computed, const Eigen::MatrixXd& exact) {
  return (computed - exact).norm() / exact.norm();
}

TEST(Loads, StaticSolutionIsThatOfTheFullMatrix) {
  const mesh::Mesh mesh = bar();
  Structure structure(mesh, titanium, {"x0"});
  const test::DenseSystem dense = test::dense_system(mesh, titanium, {"x0"});
  const Eigen::MatrixXd F = some_loads(mesh);
  EXPECT_LT(relative(structure.solve_static(F), dense.solve(F)), direct);
}

TEST(Loads, AFreeBodyHasNoStaticSolution) {
  const mesh::Mesh mesh = bar();
  Structure structure(mesh, titanium, {});
  EXPECT_THROW(static_cast<void>(structure.solve_static(some_loads(mesh))), EigenError);
}

// The area vectors of a closed body cancel, and ∫ x·n dA over its surface is three times its
// volume.
TEST(Loads, APressureActsAlongTheNormalOfCurvedFaces) {
  const mesh::Mesh mesh = bar();
  Eigen::VectorXd load = Eigen::VectorXd::Zero(3 * mesh.n_nodes());
  for (const std::string& side : mesh.surface_names()) {
    load += normal_traction(mesh.nodes(), mesh.surface(side));
  }
  const auto per_node = load.reshaped(3, mesh.n_nodes());
  EXPECT_LT(per_node.rowwise().sum().norm(), 1e-14 * per_node.norm());
  const double work = per_node.cwiseProduct(mesh.nodes().transpose()).sum();
  EXPECT_NEAR(work, 3.0 * mesh.volume(), 1e-12 * mesh.volume());
}

TEST(Loads, ForcesOfAnotherSizeAreRefused) {
  Structure structure(bar(), titanium, {"x0"});
  EXPECT_THROW(static_cast<void>(structure.solve_static(Eigen::MatrixXd::Zero(7, 1))),
               std::invalid_argument);
}

TEST(Loads, NodalAreasSumToTheAreaAndItsFirstMoment) {
  const mesh::Mesh mesh =
      test::box_mesh(ElementType::hex20, {.size = {0.1, 0.2, 0.3}, .cells = {1, 2, 2}, .map = {}});
  const Eigen::VectorXd area = nodal_areas(mesh.nodes(), mesh.surface("x1"));
  EXPECT_NEAR(area.sum(), 0.06, 1e-16);
  const Eigen::Vector3d moment = mesh.nodes().transpose() * area;
  EXPECT_LT((moment - 0.06 * Eigen::Vector3d(0.1, 0.1, 0.15)).norm(), 1e-16);
}

// Flexibility from all modes but the first N, summed one by one.
Eigen::MatrixX3d omitted_modes(const test::DenseSystem& dense, const mesh::Mesh& mesh,
                               const mesh::Surface& surface, const Eigen::Matrix3d& frame,
                               Eigen::Index n_kept) {
  const test::PencilPairs eigen = test::pencil_pairs(dense.K, dense.M);
  const Eigen::Index n = dense.K.rows() - n_kept;
  const Eigen::MatrixXd Phi = eigen.vectors.rightCols(n);
  const Eigen::MatrixXd loads = dense.reduce(uniform_tractions(mesh.nodes(), surface, frame));
  const Eigen::MatrixXd u =
      Phi * eigen.values.tail(n).cwiseInverse().asDiagonal() * Phi.transpose() * loads;
  const Eigen::MatrixXd on_mesh = dense.expand(u, 3 * mesh.n_nodes());
  Eigen::MatrixX3d row_sums(std::ssize(surface.nodes), 3);
  for (Eigen::Index i = 0; i < row_sums.rows(); ++i) {
    for (int d = 0; d < 3; ++d) {
      row_sums(i, d) = frame.row(d).dot(
          on_mesh.col(d).segment<3>(3 * surface.nodes[static_cast<std::size_t>(i)]));
    }
  }
  return row_sums;
}

TEST(Loads, ResidualFlexibilityIsTheSumOverTheModesLeftOut) {
  const mesh::Mesh mesh = bar();
  const mesh::Surface& tip = mesh.surface("x1");
  const test::DenseSystem dense = test::dense_system(mesh, titanium, {"x0"});
  Structure structure(mesh, titanium, {"x0"});
  for (const Eigen::Index n : {1, 5, 12}) {
    const ModalBasis basis = structure.solve_modes({.n_modes = n});
    const Eigen::MatrixX3d c = structure.residual_flexibility(basis, tip, some_frame()).row_sums;
    EXPECT_LT(relative(c, omitted_modes(dense, mesh, tip, some_frame(), n)), 1e-8) << n;
  }
}

// Theory section 14: inertia relief. The sum runs over elastic modes only.
TEST(Loads, ResidualFlexibilityOfAFreeBodyLeavesItsRigidMotionsOut) {
  const mesh::Mesh mesh = bar();
  const mesh::Surface& tip = mesh.surface("x1");
  const test::DenseSystem dense = test::dense_system(mesh, titanium, {});
  Structure structure(mesh, titanium, {});
  for (const Eigen::Index n : {6, 9}) {
    const ModalBasis basis = structure.solve_modes({.n_modes = n});
    const Eigen::MatrixX3d c = structure.residual_flexibility(basis, tip, some_frame()).row_sums;
    EXPECT_LT(relative(c, omitted_modes(dense, mesh, tip, some_frame(), n)), 1e-8) << n;
  }
}

// Side y0 has quadrilaterals, and triangles of the tetrahedra, on a curved surface.
TEST(Loads, OfASideWithTrianglesBesideQuadrilateralsHaveTheRightResultants) {
  for (const int order : {1, 2}) {
    const mesh::Mesh mesh = test::mixed_box_mesh(
        order, {.size = {0.4, 0.2, 0.1}, .cells = {4, 2, 2}, .map = [](const Eigen::Vector3d& x) {
                  return Eigen::Vector3d(x[0] + 0.3 * x[0] * x[0], x[1], x[2] + 0.2 * x[0]);
                }});
    const mesh::Surface& side = mesh.surface("y0");
    ASSERT_EQ(side.faces.size(), 2U) << "both kinds";
    const Eigen::VectorXd areas = nodal_areas(mesh.nodes(), side);
    const double length = 0.4 + 0.3 * 0.16;
    const double area = length * 0.1;
    EXPECT_NEAR(areas.sum(), area, 1e-14);
    EXPECT_NEAR(areas.sum(), side.area, 1e-14);
    // Centroid along x: linear fields are in the space of every face. Linear elements map x itself
    // with chords.
    EXPECT_NEAR(areas.dot(mesh.nodes().col(0)) / area, 0.5 * length, 1e-14);
    const Eigen::MatrixXd loads = polynomial_tractions(mesh.nodes(), side, mesh::FaceFrame{}, 1);
    ASSERT_EQ(loads.cols(), 9);
    const Eigen::VectorXd of_x = loads(Eigen::seq(0, Eigen::last, 3), 0);
    EXPECT_LT((of_x / of_x.sum() - areas / area).norm(), 1e-13) << "degree 0 is uniform";
    for (const Eigen::Index higher : {3, 6}) {
      EXPECT_NEAR(loads(Eigen::seq(0, Eigen::last, 3), higher).sum(), 0.0, 1e-13)
          << "degree 1 has no resultant";
    }
  }
}

}  // namespace
}  // namespace microslip::fem::test_loads
