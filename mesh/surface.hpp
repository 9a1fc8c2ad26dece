/// @file
/// A named surface of a mesh: faces of its volume elements, oriented outward.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "mesh/element_type.hpp"

namespace microslip::mesh {

using Connectivity = Eigen::Matrix<Eigen::Index, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct FaceBlock {
  FaceType type = FaceType::tri3;
  Connectivity connectivity;  ///< n_faces × nodes per face, mesh node indices, outward orientation
};

struct Surface {
  std::string name;
  std::vector<FaceBlock> faces;
  std::vector<Eigen::Index> nodes;  ///< mesh node indices, ascending, each once
  double area = 0.0;                ///< [m²]
};

/// A surface cut into small cells for quadrature and pictures: every face is refined in its own
/// reference coordinates until there are at least `n_cells` cells in all.
struct SurfaceSampling {
  Eigen::MatrixX3d vertices;        ///< corners of the cells [m], n_vertices × 3
  Connectivity cells;               ///< n_cells × 3 or 4 vertex indices
  Eigen::MatrixX3d centres;         ///< one point inside each cell [m], n_cells × 3
  Eigen::VectorXd weights;          ///< area of each cell [m²]; the sum is the surface's area
  Eigen::MatrixX3d centre_normals;  ///< outward unit normals of the faces, n_cells × 3
  Eigen::MatrixX3d vertex_normals;  ///< of faces that meet there the mean, n_vertices × 3
  Eigen::SparseMatrix<double>
      to_vertices;  ///< n_vertices × surface.nodes: interpolates nodal values
  Eigen::SparseMatrix<double> to_centres;  ///< n_cells × surface.nodes
};

/// The plane of a surface: area-weighted mean normal and centroid, and how far it is from plane.
struct SurfacePlane {
  Eigen::Vector3d centroid;
  Eigen::Vector3d normal;      ///< outward, unit
  double flatness = 0.0;       ///< largest distance of a node from the plane [m]
  double diameter = 0.0;       ///< size of the surface's bounding box diagonal [m]
  double largest_angle = 0.0;  ///< largest angle between a face normal and the mean [rad]
};

/// @param nodes  all mesh nodes [m].  @param n_cells  lower bound of the number of cells, ≥ 1.
[[nodiscard]] SurfaceSampling sample_surface(const Eigen::MatrixX3d& nodes, const Surface& surface,
                                             Eigen::Index n_cells);

[[nodiscard]] SurfacePlane fit_plane(const Eigen::MatrixX3d& nodes, const Surface& surface);

}  // namespace microslip::mesh
