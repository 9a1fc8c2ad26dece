#include "mesh/interpolation.hpp"

#include <random>

#include <gtest/gtest.h>

#include "mesh/mesh_error.hpp"
#include "tests/support/box_mesh.hpp"

namespace microslip::mesh::test_interpolation {
namespace {

/// A field that quadratic elements of straight sides hold exactly.
Eigen::VectorXd quadratic(const Eigen::MatrixX3d& at) {
  const auto x = at.col(0).array();
  const auto y = at.col(1).array();
  const auto z = at.col(2).array();
  return (1.0 + 2.0 * x - y + 3.0 * x * y + z * z - 4.0 * y * z).matrix();
}

Eigen::MatrixX3d inside(const Mesh& mesh, int n) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  Eigen::MatrixX3d places(n, 3);
  for (int i = 0; i < n; ++i) {
    for (int d = 0; d < 3; ++d) {
      places(i, d) = mesh.lower()[d] + share(random) * (mesh.upper()[d] - mesh.lower()[d]);
    }
  }
  return places;
}

/// Tetrahedra of straight edges, none of them alike.
Mesh box() {
  return test::straight_box_mesh(ElementType::tet10, {.cells = {3, 2, 2}, .map = test::distorted});
}

TEST(Interpolation, GivesQuadraticFieldsExactly) {
  const Mesh mesh = box();
  const Eigen::MatrixX3d places = inside(mesh, 500);
  const Eigen::VectorXd values = interpolation(mesh, places) * quadratic(mesh.nodes());
  const double scale = quadratic(places).cwiseAbs().maxCoeff();
  EXPECT_LT((values - quadratic(places)).cwiseAbs().maxCoeff(), 1e-12 * scale);
}

TEST(Interpolation, GoesOnBeyondTheBoundaryAndRefusesWhatIsFarAway) {
  const Mesh mesh = box();
  const Eigen::Vector3d extent = mesh.upper() - mesh.lower();
  Eigen::MatrixX3d beside(1, 3);
  beside.row(0) = (mesh.upper() + 1e-3 * extent).transpose();
  const double value = (interpolation(mesh, beside) * quadratic(mesh.nodes()))[0];
  EXPECT_NEAR(value, quadratic(beside)[0], 1e-10);
  Eigen::MatrixX3d far(1, 3);
  far.row(0) = (mesh.upper() + 10.0 * extent).transpose();
  EXPECT_THROW(static_cast<void>(interpolation(mesh, far)), MeshError);
}

}  // namespace
}  // namespace microslip::mesh::test_interpolation
