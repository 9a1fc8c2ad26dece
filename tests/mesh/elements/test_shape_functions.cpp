#include "mesh/shape_functions.hpp"

#include <array>

#include <gtest/gtest.h>

namespace microslip::mesh {
namespace {

constexpr std::array all_types{ElementType::tet4, ElementType::tet10, ElementType::hex8,
                               ElementType::hex20};
const Eigen::Vector3d inside(0.21, 0.17, 0.33);  // of both reference shapes, on no symmetry

TEST(ShapeFunctions, AreOneAtTheirNodeAndZeroAtTheOthers) {
  for (const ElementType type : all_types) {
    const Eigen::MatrixX3d nodes = reference_nodes(type);
    for (Eigen::Index b = 0; b < nodes.rows(); ++b) {
      const auto N = shapes(type, nodes.row(b).transpose()).values;
      for (Eigen::Index a = 0; a < nodes.rows(); ++a) {
        EXPECT_NEAR(N[a], a == b ? 1.0 : 0.0, 1e-15) << name(type) << " " << a << " " << b;
      }
    }
  }
}

TEST(ShapeFunctions, SumToOneAndTheirGradientsToZero) {
  for (const ElementType type : all_types) {
    const auto s = shapes(type, inside);
    EXPECT_NEAR(s.values.sum(), 1.0, 1e-15) << name(type);
    EXPECT_LT(s.gradients.colwise().sum().cwiseAbs().maxCoeff(), 1e-14) << name(type);
  }
}

TEST(ShapeFunctions, GradientsAreTheDifferences) {
  constexpr double h =
      1e-6;  // quadratics: the central difference errs by rounding only, ε/h = 1e-10
  for (const ElementType type : all_types) {
    const auto s = shapes(type, inside);
    for (Eigen::Index d = 0; d < 3; ++d) {
      const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(d);
      const auto difference =
          ((shapes(type, inside + step).values - shapes(type, inside - step).values) / (2 * h))
              .eval();
      EXPECT_LT((s.gradients.col(d) - difference).cwiseAbs().maxCoeff(), 1e-9) << name(type);
    }
  }
}

TEST(ShapeFunctions, FaceTablesPointOutward) {
  for (const ElementType type : all_types) {
    const Eigen::MatrixX3d nodes = reference_nodes(type);
    const Eigen::RowVector3d centre = nodes.topRows(n_corners(type)).colwise().mean();
    for (const auto& face : faces(type)) {
      ASSERT_EQ(static_cast<int>(face.size()), n_nodes(face_type(type)));
      const Eigen::RowVector3d a = nodes.row(face[0]);
      const Eigen::Vector3d u = (nodes.row(face[1]) - a).transpose();
      const Eigen::Vector3d v = (nodes.row(face[2]) - a).transpose();
      const Eigen::Vector3d normal(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                   u[0] * v[1] - u[1] * v[0]);
      EXPECT_GT(normal.dot((a - centre).transpose()), 0.0) << name(type);
    }
  }
}

TEST(ShapeFunctions, EdgeNodesOfFacesLieBetweenTheirCorners) {
  for (const ElementType type : {ElementType::tet10, ElementType::hex20}) {
    const Eigen::MatrixX3d nodes = reference_nodes(type);
    const auto corners = static_cast<std::size_t>(n_corners(face_type(type)));
    for (const auto& face : faces(type)) {
      for (std::size_t i = 0; i < corners; ++i) {
        const Eigen::RowVector3d middle =
            0.5 * (nodes.row(face[i]) + nodes.row(face[(i + 1) % corners]));
        EXPECT_EQ(nodes.row(face[corners + i]), middle) << name(type);
      }
    }
  }
}

}  // namespace
}  // namespace microslip::mesh
