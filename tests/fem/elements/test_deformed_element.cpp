#include "fem/elements/deformed_element.hpp"

#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "tests/fem/elements/bent_box.hpp"
#include "tests/support/box_mesh.hpp"

namespace microslip::fem::test_deformed_element {
namespace {

using mesh::ElementType;

using test::bend;
using test::titanium;

class DeformedElementOf : public testing::TestWithParam<ElementType> {
 protected:
  DeformedElementOf() {
    const mesh::Mesh mesh =
        test::box_mesh(GetParam(), {.size = {1.0, 0.8, 1.2}, .cells = {1, 1, 1}, .map = bend});
    nodes = mesh.nodes()(mesh.elements().front().connectivity.row(0).transpose(), Eigen::all);
  }
  [[nodiscard]] DeformedElement at(const Eigen::MatrixX3d& displacement) const {
    DeformedElement result;
    deform_element(GetParam(), nodes, displacement, titanium, Tet10Rule::accurate, result);
    return result;
  }
  /// Strains of some per cent and a turn, smooth: no element is turned inside out.
  [[nodiscard]] Eigen::MatrixX3d large_displacement() const {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-0.03, 0.03);
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
    Eigen::MatrixX3d u = nodes * (turn.transpose() - Eigen::Matrix3d::Identity());
    for (double& value : u.reshaped()) value += number(random);
    return u;
  }
  Eigen::MatrixX3d nodes;
};

TEST_P(DeformedElementOf, IsTheLinearElementWhereNothingMoves) {
  const DeformedElement element = at(Eigen::MatrixX3d::Zero(nodes.rows(), 3));
  ElementMatrices linear;
  element_matrices(GetParam(), nodes, titanium, Tet10Rule::accurate, linear);
  EXPECT_EQ(element.force.norm(), 0.0);
  EXPECT_LT((element.tangent - linear.stiffness).norm(), 1e-13 * linear.stiffness.norm());
}

TEST_P(DeformedElementOf, HasATangentThatIsTheDerivativeOfItsForce) {
  constexpr double step =
      1e-5;  // of lengths of 1: error of central differences 1e-10, rounding 1e-11
  const Eigen::MatrixX3d u = large_displacement();
  const DeformedElement element = at(u);
  EXPECT_LT((element.tangent - element.tangent.transpose()).norm(), 1e-13 * element.tangent.norm());
  for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
    for (Eigen::Index d = 0; d < 3; ++d) {
      Eigen::MatrixX3d moved = u;
      moved(i, d) += step;
      Eigen::Matrix3Xd difference = at(moved).force;
      moved(i, d) -= 2.0 * step;
      difference -= at(moved).force;
      const Eigen::VectorXd column = difference.reshaped() / (2.0 * step);
      EXPECT_LT((column - element.tangent.col(3 * i + d)).norm(), 1e-8 * element.tangent.norm());
    }
  }
}

TEST_P(DeformedElementOf, FeelsNoForceWhenItIsTurned) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.9, Eigen::Vector3d(0.3, -1.0, 0.4).normalized()).toRotationMatrix();
  const DeformedElement turned = at(nodes * (turn.transpose() - Eigen::Matrix3d::Identity()));
  EXPECT_LT(turned.force.norm(), 1e-13 * turned.tangent.norm());
}

INSTANTIATE_TEST_SUITE_P(AllTypes, DeformedElementOf,
                         testing::Values(ElementType::tet4, ElementType::tet10, ElementType::hex8,
                                         ElementType::hex20, ElementType::wedge6,
                                         ElementType::wedge15, ElementType::pyramid5,
                                         ElementType::pyramid13),
                         [](const auto& type) { return std::string(mesh::name(type.param)); });

}  // namespace
}  // namespace microslip::fem::test_deformed_element
