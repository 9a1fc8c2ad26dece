#include "fem/modal_mass.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/support/box_mesh.hpp"

namespace microslip::fem::test_modal_mass {
namespace {

constexpr double density = 7800.0;
const test::BoxGrid grid{.size = {0.3, 0.2, 0.1}, .cells = {4, 1, 1}, .map = {}};

TEST(ModalMass, OfTranslationsIsTheMassOfTheMesh) {
  for (const int order : {1, 2}) {
    const mesh::Mesh mesh = test::mixed_box_mesh(order, grid);
    const Eigen::MatrixXd translations =
        Eigen::MatrixXd::Identity(3, 3).replicate(mesh.n_nodes(), 1);
    const Eigen::MatrixXd expected = density * 0.3 * 0.2 * 0.1 * Eigen::MatrixXd::Identity(3, 3);
    EXPECT_LT((modal_mass(mesh, density, translations) - expected).norm(), 1e-13 * expected.norm())
        << order;
  }
}

TEST(ModalMass, OfAQuadraticMotionIsItsIntegral) {
  const mesh::Mesh mesh = test::box_mesh(mesh::ElementType::hex20, grid);
  Eigen::MatrixXd shape = Eigen::MatrixXd::Zero(3 * mesh.n_nodes(), 1);
  for (Eigen::Index i = 0; i < mesh.n_nodes(); ++i) {
    const double x = mesh.nodes()(i, 0);
    shape(3 * i + 1) = x * x;  // hex20 carries it exactly: ∫ ρ x⁴ dV = ρ A L⁵/5
  }
  const double expected = density * 0.2 * 0.1 * 0.3 * 0.3 * 0.3 * 0.3 * 0.3 / 5.0;
  EXPECT_NEAR(modal_mass(mesh, density, shape)(0, 0), expected, 1e-13 * expected);
}

TEST(ModalStiffness, OfAShearIsItsStrainEnergyAndOfARotationNone) {
  for (const int order : {1, 2}) {
    const mesh::Mesh mesh = test::mixed_box_mesh(order, grid);
    Eigen::MatrixXd shapes = Eigen::MatrixXd::Zero(3 * mesh.n_nodes(), 2);
    for (Eigen::Index i = 0; i < mesh.n_nodes(); ++i) {
      const double x = mesh.nodes()(i, 0);
      shapes(3 * i + 1, 0) = shapes(3 * i + 1, 1) = x;
      shapes(3 * i, 1) = -mesh.nodes()(i, 1);
    }
    const Eigen::VectorXd found = modal_stiffness(mesh, {2.6, 0.3, density}, shapes);  // G = 1
    EXPECT_NEAR(found[0], 0.3 * 0.2 * 0.1, 1e-14) << order;
    EXPECT_NEAR(found[1], 0.0, 1e-14) << order;
  }
}

TEST(ModalMass, RefusesOtherMeshesAndDensities) {
  const mesh::Mesh mesh = test::box_mesh(mesh::ElementType::hex8, grid);
  EXPECT_THROW(static_cast<void>(modal_mass(mesh, density, Eigen::MatrixXd::Ones(3, 1))),
               std::invalid_argument);
  EXPECT_THROW(
      static_cast<void>(modal_mass(mesh, 0.0, Eigen::MatrixXd::Ones(3 * mesh.n_nodes(), 1))),
      std::invalid_argument);
}

}  // namespace
}  // namespace microslip::fem::test_modal_mass
