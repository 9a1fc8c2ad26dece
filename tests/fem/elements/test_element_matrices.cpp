#include "fem/elements/element_matrices.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "fem/elements/quadrature.hpp"
#include "mesh/shape_functions.hpp"
#include "tests/fem/elements/bent_box.hpp"
#include "tests/support/box_mesh.hpp"

namespace microslip::fem::test_element_matrices {
namespace {

using mesh::ElementType;

using test::bend;
using test::titanium;

class ElementMatricesOf : public testing::TestWithParam<ElementType> {
 protected:
  [[nodiscard]] static Eigen::MatrixX3d nodes_of_one(const mesh::Mesh& mesh) {
    const mesh::ElementBlock& block = mesh.elements().front();
    return mesh.nodes()(block.connectivity.row(0).transpose(), Eigen::all);
  }
  [[nodiscard]] static mesh::Mesh bent() {
    return test::box_mesh(GetParam(), {.size = {1.0, 0.8, 1.2}, .cells = {1, 1, 1}, .map = bend});
  }
  [[nodiscard]] static ElementMatrices matrices(const Eigen::MatrixX3d& nodes) {
    ElementMatrices result;
    element_matrices(GetParam(), nodes, titanium, Tet10Rule::accurate, result);
    return result;
  }
};

// Node after node, as the rows of K.
Eigen::VectorXd as_vector(const Eigen::MatrixX3d& displacement) {
  return displacement.transpose().reshaped();
}

Eigen::MatrixX3d rigid_motion(const Eigen::MatrixX3d& nodes, int which) {
  Eigen::MatrixX3d motion = Eigen::MatrixX3d::Zero(nodes.rows(), 3);
  if (which < 3) {
    motion.col(which).setOnes();
    return motion;
  }
  for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
    motion.row(i) = Eigen::Vector3d::Unit(which - 3).cross(nodes.row(i).transpose()).transpose();
  }
  return motion;
}

TEST_P(ElementMatricesOf, RigidMotionsStrainNothing) {
  const Eigen::MatrixX3d nodes = nodes_of_one(bent());
  const ElementMatrices element = matrices(nodes);
  for (int which = 0; which < 6; ++which) {
    const Eigen::VectorXd u = as_vector(rigid_motion(nodes, which));
    // A few hundred products of order ‖K‖‖u‖ cancel in every row.
    const double scale = element.stiffness.cwiseAbs().maxCoeff() * u.cwiseAbs().maxCoeff();
    EXPECT_LT((element.stiffness * u).cwiseAbs().maxCoeff(), 1e-13 * scale) << which;
  }
}

TEST_P(ElementMatricesOf, NothingElseStrainsNothing) {
  const ElementMatrices element = matrices(nodes_of_one(bent()));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(element.stiffness);
  const double largest = eigen.eigenvalues().maxCoeff();
  // No hourglass: the seventh is a strain of the element, not rounding.
  EXPECT_LT(eigen.eigenvalues()[5], 1e-13 * largest);
  EXPECT_GT(eigen.eigenvalues()[6], 1e-4 * largest);
}

TEST_P(ElementMatricesOf, BothAreSymmetricToTheLastBit) {
  const ElementMatrices element = matrices(nodes_of_one(bent()));
  EXPECT_EQ(element.stiffness, element.stiffness.transpose());
  EXPECT_EQ(element.mass, element.mass.transpose());
}

QuadratureRule fine_rule(mesh::Solid solid) {
  switch (solid) {
    case mesh::Solid::tetrahedron:
      return tetrahedron_rule(13);
    case mesh::Solid::hexahedron:
      return hexahedron_rule(8);
    case mesh::Solid::wedge:
      return wedge_rule(13, 8);
    case mesh::Solid::pyramid:
      return pyramid_rule(8);
  }
  return {};
}

TEST_P(ElementMatricesOf, MassIsThatOfEveryPolynomialMotion) {
  const Eigen::MatrixX3d nodes = nodes_of_one(bent());
  const ElementMatrices element = matrices(nodes);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(element.mass).eigenvalues().minCoeff(),
            0.0);
  // ρ ∫ x_a x_b dV of the map itself by a rule of much higher degree: the mass is exact, curved or
  // not.
  const QuadratureRule rule = fine_rule(mesh::solid(GetParam()));
  Eigen::Matrix4d exact = Eigen::Matrix4d::Zero();
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    const Eigen::Vector3d xi = rule.points.row(q).transpose();
    const mesh::ElementShapes shapes = mesh::shapes(GetParam(), xi);
    const Eigen::Matrix3d jacobian = shapes.gradients.transpose() * nodes;
    Eigen::Vector4d field;
    field << 1.0, nodes.transpose() * shapes.values;
    exact +=
        titanium.density * rule.weights[q] * jacobian.determinant() * field * field.transpose();
  }
  Eigen::MatrixXd fields(nodes.rows(), 4);
  fields << Eigen::VectorXd::Ones(nodes.rows()), nodes;
  const Eigen::Matrix4d computed = fields.transpose() * element.mass * fields;
  EXPECT_LT((computed - exact).cwiseAbs().maxCoeff(), 1e-13 * exact.cwiseAbs().maxCoeff());
}

TEST_P(ElementMatricesOf, EnergyOfUniformStrainIsThatOfHookesLaw) {
  const mesh::Mesh mesh = test::straight_box_mesh(
      GetParam(), {.size = {1.0, 0.8, 1.2}, .cells = {1, 1, 1}, .map = bend});
  const Eigen::MatrixX3d nodes = nodes_of_one(mesh);
  const ElementMatrices element = matrices(nodes);
  Eigen::Matrix3d gradient;
  gradient << 1.0, -2.0, 0.5, 0.7, 0.3, -1.1, 0.2, 0.9, -0.4;
  const Eigen::Matrix3d strain = 0.5 * (gradient + gradient.transpose());
  const double lambda = 1.14e11 * 0.32 / ((1.0 + 0.32) * (1.0 - 0.64));
  const double mu = 0.5 * 1.14e11 / 1.32;
  const double density = lambda * strain.trace() * strain.trace() + 2.0 * mu * strain.squaredNorm();
  const double volume = element.mass.sum() / titanium.density;
  const Eigen::VectorXd u = as_vector(nodes * gradient.transpose());
  // Rounding of a sum over (3n)² products.
  EXPECT_NEAR(u.dot(element.stiffness * u), density * volume, 1e-12 * density * volume);
}

TEST_P(ElementMatricesOf, DoNotDependOnTheirPlaceAndTurnWithTheElement) {
  const Eigen::MatrixX3d nodes = nodes_of_one(bent());
  const Eigen::Matrix3d Q =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
  const Eigen::MatrixX3d moved =
      (nodes * Q.transpose()).rowwise() + Eigen::RowVector3d(3.0, -1.0, 2.0);
  const ElementMatrices here = matrices(nodes);
  const ElementMatrices there = matrices(moved);
  const double scale = here.stiffness.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
    for (Eigen::Index j = 0; j < nodes.rows(); ++j) {
      const Eigen::Matrix3d turned = Q * here.stiffness.block<3, 3>(3 * i, 3 * j) * Q.transpose();
      const Eigen::Matrix3d block = there.stiffness.block<3, 3>(3 * i, 3 * j);
      // Coordinates three times as large lose two bits.
      EXPECT_LT((turned - block).cwiseAbs().maxCoeff(), 1e-13 * scale);
    }
  }
  EXPECT_LT((here.mass - there.mass).cwiseAbs().maxCoeff(),
            1e-13 * here.mass.cwiseAbs().maxCoeff());
}

INSTANTIATE_TEST_SUITE_P(Types, ElementMatricesOf, testing::ValuesIn(mesh::all_element_types),
                         [](const auto& type) { return std::string(mesh::name(type.param)); });

TEST(ElementMatrices, RulesOfTet10DifferOnCurvedElementsOnly) {
  const auto difference = [](const mesh::Mesh& mesh) {
    const Eigen::MatrixX3d nodes =
        mesh.nodes()(mesh.elements().front().connectivity.row(0).transpose(), Eigen::all);
    ElementMatrices accurate;
    ElementMatrices customary;
    element_matrices(ElementType::tet10, nodes, titanium, Tet10Rule::accurate, accurate);
    element_matrices(ElementType::tet10, nodes, titanium, Tet10Rule::four_point, customary);
    return (accurate.stiffness - customary.stiffness).norm() / accurate.stiffness.norm();
  };
  const test::BoxGrid grid{.size = {1.0, 0.8, 1.2}, .cells = {1, 1, 1}, .map = bend};
  EXPECT_LT(difference(test::straight_box_mesh(ElementType::tet10, grid)), 1e-15);
  EXPECT_GT(difference(test::box_mesh(ElementType::tet10, grid)), 1e-4);
}

TEST(ElementMatrices, RefuseAMaterialOutOfRangeByName) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto refusal = [](const Material& material) -> std::string {
    try {
      check_material(material);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  for (const double bad : {0.0, -1.0, nan, infinity}) {
    EXPECT_NE(refusal({bad, 0.3, 1.0}).find("Young's modulus"), std::string::npos) << bad;
    EXPECT_NE(refusal({1.0, 0.3, bad}).find("density"), std::string::npos) << bad;
  }
  for (const double bad : {0.5, -1.0, 0.7, nan}) {
    EXPECT_NE(refusal({1.0, bad, 1.0}).find("Poisson's ratio"), std::string::npos) << bad;
  }
  EXPECT_EQ(refusal({1.0, 0.49, 1.0}), "accepted");
  EXPECT_EQ(refusal({1.0, -0.5, 1.0}), "accepted");
}

}  // namespace
}  // namespace microslip::fem::test_element_matrices
