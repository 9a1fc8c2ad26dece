#include "mesh/shape_functions.hpp"

#include <array>

#include <gtest/gtest.h>

namespace microslip::mesh::test_shape_functions {
namespace {

const Eigen::Vector3d inside(0.21, 0.17, 0.33);  // of all reference shapes, on no symmetry

TEST(ShapeFunctions, AreOneAtTheirNodeAndZeroAtTheOthers) {
  for (const ElementType type : all_element_types) {
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
  for (const ElementType type : all_element_types) {
    const auto s = shapes(type, inside);
    EXPECT_NEAR(s.values.sum(), 1.0, 1e-15) << name(type);
    EXPECT_LT(s.gradients.colwise().sum().cwiseAbs().maxCoeff(), 1e-14) << name(type);
  }
}

TEST(ShapeFunctions, GradientsAreTheDifferences) {
  // The central difference errs by ε/h = 1e-10; by h² = 1e-12 where pyramids are rational, nothing
  // elsewhere.
  constexpr double h = 1e-6;
  for (const ElementType type : all_element_types) {
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
  for (const ElementType type : all_element_types) {
    const Eigen::MatrixX3d nodes = reference_nodes(type);
    const Eigen::RowVector3d centre = nodes.topRows(n_corners(type)).colwise().mean();
    for (std::size_t f = 0; f < faces(type).size(); ++f) {
      const std::vector<int>& face = faces(type)[f];
      ASSERT_EQ(static_cast<int>(face.size()), n_nodes(face_type(type, f)));
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
  for (const ElementType type : all_element_types) {
    if (!is_quadratic(type)) continue;
    const Eigen::MatrixX3d nodes = reference_nodes(type);
    for (std::size_t f = 0; f < faces(type).size(); ++f) {
      const std::vector<int>& face = faces(type)[f];
      const auto corners = static_cast<std::size_t>(n_corners(face_type(type, f)));
      for (std::size_t i = 0; i < corners; ++i) {
        const Eigen::RowVector3d middle =
            0.5 * (nodes.row(face[i]) + nodes.row(face[(i + 1) % corners]));
        EXPECT_EQ(nodes.row(face[corners + i]), middle) << name(type);
      }
    }
  }
}

// What makes neighbours of different solids fit together.
TEST(ShapeFunctions, OnAFaceAreThoseOfTheFace) {
  for (const ElementType type : all_element_types) {
    const Eigen::MatrixX3d nodes = reference_nodes(type);
    for (std::size_t f = 0; f < faces(type).size(); ++f) {
      const std::vector<int>& face = faces(type)[f];
      for (const Eigen::Vector2d& eta : {Eigen::Vector2d(0.21, 0.34), Eigen::Vector2d(0.6, 0.1)}) {
        const Eigen::VectorXd on_face = shapes(face_type(type, f), eta).values;
        Eigen::VectorXd expected = Eigen::VectorXd::Zero(n_nodes(type));
        expected(face) = on_face;
        const Eigen::Vector3d xi = nodes(face, Eigen::all).transpose() * on_face;
        EXPECT_LT((shapes(type, xi).values - expected).cwiseAbs().maxCoeff(), 1e-15)
            << name(type) << " face " << f;
      }
    }
  }
}

TEST(ShapeFunctions, InterpolatePolynomialsOfTheirOrder) {
  const auto monomials = [](const Eigen::Vector3d& x) {
    Eigen::Vector<double, 10> p;
    p << 1.0, x, x.cwiseAbs2(), x[0] * x[1], x[1] * x[2], x[2] * x[0];
    return p;
  };
  for (const ElementType type : all_element_types) {
    const Eigen::MatrixX3d nodes = reference_nodes(type);
    const auto N = shapes(type, inside).values;
    Eigen::Vector<double, 10> sum = Eigen::Vector<double, 10>::Zero();
    for (Eigen::Index a = 0; a < N.size(); ++a) sum += N[a] * monomials(nodes.row(a).transpose());
    const Eigen::Index n = is_quadratic(type) ? 10 : 4;
    EXPECT_LT((sum - monomials(inside)).head(n).cwiseAbs().maxCoeff(), 1e-15) << name(type);
  }
}

// All directions lead to the same gradient where the field is linear, and none divides by zero.
TEST(ShapeFunctions, OfPyramidsHaveGradientsAtTheApex) {
  const Eigen::Vector3d apex = Eigen::Vector3d::UnitZ();
  for (const ElementType type : {ElementType::pyramid5, ElementType::pyramid13}) {
    const Eigen::MatrixX3d nodes = reference_nodes(type);
    for (const double off : {0.0, 1e-300, 1e-16, 1e-8}) {
      const auto s = shapes(type, apex + off * Eigen::Vector3d(0.7, -0.9, -1.0));
      const Eigen::Matrix3d of_position = nodes.transpose() * s.gradients;
      EXPECT_LT((of_position - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-14)
          << name(type) << off;
      EXPECT_LT(s.gradients.cwiseAbs().maxCoeff(), 4.0) << name(type) << off;
    }
  }
}

}  // namespace
}  // namespace microslip::mesh::test_shape_functions
