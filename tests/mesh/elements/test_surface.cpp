#include "mesh/surface.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "mesh/mesh.hpp"
#include "mesh/shape_functions.hpp"

namespace microslip::mesh::test_surface {
namespace {

/// One face of reference shape in the plane z = 0, mid-nodes moved inside the plane.
struct PlaneFace {
  Eigen::MatrixX3d nodes;
  Surface surface;
};

PlaneFace plane_face(FaceType type, double bulge) {
  const int n = n_nodes(type);
  PlaneFace face{Eigen::MatrixX3d::Zero(n, 3), {}};
  FaceBlock block{type, Connectivity(1, n)};
  const ElementType owner = type == FaceType::tri6 ? ElementType::tet10 : ElementType::hex20;
  const auto& table = faces(owner)[type == FaceType::tri6 ? 0 : 1];  // tet: z = 0, hex: z = 1
  for (int a = 0; a < n; ++a) {
    face.nodes.row(a).head(2) =
        reference_nodes(owner).row(table[static_cast<std::size_t>(a)]).head(2);
    block.connectivity(0, a) = a;
    face.surface.nodes.push_back(a);
  }
  face.nodes(n_corners(type), 1) -= bulge;  // the first edge bows out or in
  face.surface.faces.push_back(block);
  face.surface.area = 1.0;
  return face;
}

double bulged_area(FaceType type, double bulge) {
  // A parabola of height h over an edge of length l adds 2/3 h l; tri6 edge of length 1, quad8
  // of 2. The triangle's first edge runs along y there, so the bulge slides along it and adds
  // nothing.
  return type == FaceType::tri6 ? 0.5 : 4.0 + 2.0 / 3.0 * bulge * 2.0;
}

TEST(Surface, SampledWeightsSumToTheAreaOfCurvedPlaneFaces) {
  for (const FaceType type : {FaceType::tri6, FaceType::quad8}) {
    for (const Eigen::Index n_cells : {1, 7, 100}) {
      const PlaneFace face = plane_face(type, 0.1);
      const SurfaceSampling sampling = sample_surface(face.nodes, face.surface, n_cells);
      EXPECT_GE(sampling.weights.size(), n_cells);
      EXPECT_NEAR(sampling.weights.sum(), bulged_area(type, 0.1), 1e-14);
      EXPECT_GT(sampling.weights.minCoeff(), 0.0);
    }
  }
}

TEST(Surface, InterpolatesQuadraticFieldsExactly) {
  for (const FaceType type : {FaceType::tri6, FaceType::quad8}) {
    const PlaneFace face = plane_face(type, 0.0);
    const SurfaceSampling sampling = sample_surface(face.nodes, face.surface, 40);
    const auto field = [](const auto& x) {
      return (1.0 + x.col(0).array() - 2.0 * x.col(1).array() +
              x.col(0).array() * x.col(1).array() + 3.0 * x.col(0).array().square())
          .matrix()
          .eval();
    };
    const Eigen::VectorXd nodal = field(face.nodes);
    EXPECT_LT((sampling.to_centres * nodal - field(sampling.centres)).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_LT((sampling.to_vertices * nodal - field(sampling.vertices)).cwiseAbs().maxCoeff(),
              1e-14);
  }
}

TEST(Surface, NeighbouringCellsShareTheirVertices) {
  const PlaneFace face = plane_face(FaceType::quad8, 0.0);
  const SurfaceSampling sampling = sample_surface(face.nodes, face.surface, 16);
  EXPECT_EQ(sampling.weights.size(), 16);
  EXPECT_EQ(sampling.vertices.rows(), 25);
}

/// A square [−1, 1]² of a quadrilateral with a triangle on one side, and what is known of it.
Surface house(Eigen::MatrixX3d& nodes) {
  nodes.resize(5, 3);
  nodes << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, 0, 2, 0;
  Surface surface{"house", {}, {0, 1, 2, 3, 4}, 0.0};
  FaceBlock triangle{FaceType::tri3, Connectivity(1, 3)};
  triangle.connectivity << 3, 2, 4;
  FaceBlock square{FaceType::quad4, Connectivity(1, 4)};
  square.connectivity << 0, 1, 2, 3;
  surface.faces = {triangle, square};
  return surface;
}

TEST(Surface, SamplesTrianglesBesideQuadrilaterals) {
  Eigen::MatrixX3d nodes;
  const Surface surface = house(nodes);
  const SurfaceSampling sampling = sample_surface(nodes, surface, 18);  // nine cells of each face
  EXPECT_EQ(sampling.weights.size(), 9 + 2 * 9) << "squares are halved";
  EXPECT_NEAR(sampling.weights.sum(), 4.0 + 1.0, 1e-14);
  EXPECT_EQ(sampling.vertices.rows(), 16 + 6) << "the common edge has its four vertices once";
  EXPECT_LT((sampling.to_centres * nodes - sampling.centres).norm(), 1e-14);
  const SurfacePlane plane = fit_plane(nodes, surface);
  EXPECT_LT((plane.normal - Eigen::Vector3d::UnitZ()).norm(), 1e-15);
  EXPECT_NEAR(plane.centroid[1], (1.0 + 1.0 / 3.0) / 5.0, 1e-15);
}

TEST(Surface, NormalsOfASamplingAreThoseOfTheFaces) {
  const PlaneFace flat = plane_face(FaceType::quad8, 0.1);
  const SurfaceSampling plane = sample_surface(flat.nodes, flat.surface, 20);
  EXPECT_LT((plane.centre_normals.rowwise() - Eigen::RowVector3d::UnitZ()).cwiseAbs().maxCoeff(),
            1e-15);
  PlaneFace face = plane_face(FaceType::quad8, 0.0);  // a trough z = x²/2 over [−1, 1]²
  for (auto node : face.nodes.rowwise()) node[2] = 0.5 * node[0] * node[0];
  const SurfaceSampling curved = sample_surface(face.nodes, face.surface, 20);
  for (const auto& [places, normals] : {std::pair{&curved.centres, &curved.centre_normals},
                                        std::pair{&curved.vertices, &curved.vertex_normals}}) {
    ASSERT_EQ(places->rows(), normals->rows());
    for (Eigen::Index i = 0; i < places->rows(); ++i) {
      const Eigen::RowVector3d expected(-(*places)(i, 0), 0.0, 1.0);
      EXPECT_LT((normals->row(i) - expected.normalized()).norm(), 1e-14);
    }
  }
}

TEST(Surface, WhereFacesMeetTheNormalIsTheirMean) {
  Eigen::MatrixX3d nodes;
  const Surface surface = house(nodes);
  for (auto node : nodes.rowwise())
    node[2] = -std::max(0.0, node[1] - 1.0);  // the roof hangs at 45°
  const SurfaceSampling sampling = sample_surface(nodes, surface, 2);
  const Eigen::RowVector3d roof = Eigen::RowVector3d(0.0, 1.0, 1.0).normalized();
  const Eigen::RowVector3d mean = (roof + Eigen::RowVector3d::UnitZ()).normalized();
  for (Eigen::Index i = 0; i < sampling.vertices.rows(); ++i) {
    const double y = sampling.vertices(i, 1);
    const Eigen::RowVector3d expected = y > 1.0 + 1e-9   ? roof
                                        : y > 1.0 - 1e-9 ? mean
                                                         : Eigen::RowVector3d::UnitZ();
    EXPECT_LT((sampling.vertex_normals.row(i) - expected).norm(), 1e-14) << y;
  }
}

TEST(Surface, PlaneTellsHowFarAFaceIsFromPlane) {
  PlaneFace face = plane_face(FaceType::quad8, 0.0);
  EXPECT_LT(fit_plane(face.nodes, face.surface).flatness, 1e-15);
  EXPECT_NEAR(fit_plane(face.nodes, face.surface).diameter, 2.0 * std::sqrt(2.0), 1e-14);
  face.nodes(0, 2) = 0.3;
  EXPECT_GT(fit_plane(face.nodes, face.surface).flatness, 0.1);
}

}  // namespace
}  // namespace microslip::mesh::test_surface
