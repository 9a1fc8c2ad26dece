#include "mesh/surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "mesh/mesh_error.hpp"
#include "mesh/shape_functions.hpp"

namespace microslip::mesh {
namespace {

bool is_triangle(FaceType type) { return n_corners(type) == 3; }

struct FacePoint {
  Eigen::Vector3d position;
  Eigen::Vector3d area_vector;  ///< x_ξ × x_η: outward, length is the area density
};

FacePoint face_point(const Eigen::MatrixX3d& nodes, const FaceBlock& block, Eigen::Index face,
                     const FaceShapes& shapes) {
  FacePoint point{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  Eigen::Matrix<double, 3, 2> tangents = Eigen::Matrix<double, 3, 2>::Zero();
  for (Eigen::Index a = 0; a < block.connectivity.cols(); ++a) {
    const auto node = nodes.row(block.connectivity(face, a)).transpose();
    point.position += shapes.values[a] * node;
    tangents += node * shapes.gradients.row(a);
  }
  point.area_vector = tangents.col(0).cross(tangents.col(1));
  return point;
}

/// A small cell in reference coordinates: 3 or 4 corners.
struct Cell {
  std::vector<Eigen::Vector2d> corners;
};

std::vector<Cell> triangle_cells(int n) {
  std::vector<Cell> cells;
  const auto at = [n](int i, int j) {
    return Eigen::Vector2d(static_cast<double>(i) / n, static_cast<double>(j) / n);
  };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i + j < n; ++i) {
      cells.push_back({{at(i, j), at(i + 1, j), at(i, j + 1)}});
      if (i + j + 1 < n) cells.push_back({{at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}});
    }
  }
  return cells;
}

std::vector<Cell> square_cells(int n, bool in_triangles) {
  std::vector<Cell> cells;
  const auto at = [n](int i, int j) {
    return Eigen::Vector2d(2.0 * i / n - 1.0, 2.0 * j / n - 1.0);
  };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const std::array<Eigen::Vector2d, 4> c{at(i, j), at(i + 1, j), at(i + 1, j + 1),
                                             at(i, j + 1)};
      if (in_triangles) {
        cells.push_back({{c[0], c[1], c[2]}});
        cells.push_back({{c[0], c[2], c[3]}});
      } else {
        cells.push_back({{c[0], c[1], c[2], c[3]}});
      }
    }
  }
  return cells;
}

Eigen::Vector2d centre_of(const Cell& cell) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : cell.corners) sum += corner;
  return sum / static_cast<double>(cell.corners.size());
}

/// ∫ |x_ξ × x_η| over a cell: 6-point rule of degree 4 on triangles, cells of four split in two.
double area_of(const Eigen::MatrixX3d& nodes, const FaceBlock& block, Eigen::Index face,
               const Cell& cell) {
  constexpr std::array<double, 2> a{0.44594849091596488632, 0.091576213509770743460};
  constexpr std::array<double, 2> w{0.22338158967801146570, 0.10995174365532186764};
  double area = 0.0;
  for (std::size_t t = 0; t + 2 < cell.corners.size(); ++t) {
    const Eigen::Vector2d& o = cell.corners[0];
    Eigen::Matrix2d edges;
    edges.col(0) = cell.corners[t + 1] - o;
    edges.col(1) = cell.corners[t + 2] - o;
    const double size = 0.5 * std::abs(edges.determinant());
    for (std::size_t k = 0; k < 2; ++k) {
      const double b = 1.0 - 2.0 * a[k];
      for (const Eigen::Vector2d& l :
           {Eigen::Vector2d(a[k], a[k]), Eigen::Vector2d(b, a[k]), Eigen::Vector2d(a[k], b)}) {
        const FaceShapes s = shapes(block.type, Eigen::Vector2d(o + edges * l));
        area += size * w[k] * face_point(nodes, block, face, s).area_vector.norm();
      }
    }
  }
  return area;
}

/// Vertices on faces' common edges are made once: told by their position to 1e-7 of a cell.
class VertexMerger {
 public:
  explicit VertexMerger(double spacing) : grid_(1e-7 * spacing) {}

  /// Index of the vertex at x; `fresh` tells whether it is new.
  Eigen::Index index_of(const Eigen::Vector3d& x, bool& fresh) {
    // A position near a grid line may round either way on the two faces: look at the neighbours
    // too.
    const Key key = key_of(x);
    for (long i = -1; i <= 1; ++i) {
      for (long j = -1; j <= 1; ++j) {
        for (long k = -1; k <= 1; ++k) {
          const auto found = vertices_.find({key[0] + i, key[1] + j, key[2] + k});
          if (found != vertices_.end()) {
            fresh = false;
            return found->second;
          }
        }
      }
    }
    fresh = true;
    const auto index = static_cast<Eigen::Index>(vertices_.size());
    vertices_.emplace(key, index);
    return index;
  }

 private:
  using Key = std::array<long, 3>;
  [[nodiscard]] Key key_of(const Eigen::Vector3d& x) const {
    return {std::lround(x[0] / grid_), std::lround(x[1] / grid_), std::lround(x[2] / grid_)};
  }
  double grid_;
  std::map<Key, Eigen::Index> vertices_;
};

Eigen::MatrixX3d rows_of(const std::vector<Eigen::Vector3d>& vectors) {
  Eigen::MatrixX3d rows(std::ssize(vectors), 3);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) rows.row(i) = vectors[static_cast<std::size_t>(i)];
  return rows;
}

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Collects the cells of a sampling face by face.
class Sampler {
 public:
  Sampler(const Eigen::MatrixX3d& nodes, const Surface& surface, double spacing)
      : nodes_(nodes), surface_(surface), merger_(spacing) {}

  void add(const FaceBlock& block, Eigen::Index face, const Cell& cell) {
    const auto row = static_cast<Eigen::Index>(weights_.size());
    const FaceShapes at_centre = shapes(block.type, centre_of(cell));
    const FacePoint centre = face_point(nodes_, block, face, at_centre);
    centres_.push_back(centre.position);
    centre_normals_.push_back(centre.area_vector.normalized());
    weights_.push_back(area_of(nodes_, block, face, cell));
    interpolate(block, face, at_centre, row, to_centres_);
    cells_.emplace_back();
    for (const Eigen::Vector2d& corner : cell.corners) {
      const FaceShapes s = shapes(block.type, corner);
      const FacePoint point = face_point(nodes_, block, face, s);
      bool fresh = false;
      const Eigen::Index vertex = merger_.index_of(point.position, fresh);
      if (fresh) {
        vertices_.push_back(point.position);
        vertex_normals_.emplace_back(Eigen::Vector3d::Zero());
        last_faces_.push_back(nowhere);
        interpolate(block, face, s, vertex, to_vertices_);
      }
      Place& last = last_faces_[static_cast<std::size_t>(vertex)];
      if (last != Place{&block, face}) {  // of each face once, however many cells of it meet
        vertex_normals_[static_cast<std::size_t>(vertex)] += point.area_vector.normalized();
      }
      last = {&block, face};
      cells_.back().push_back(vertex);
    }
  }

  [[nodiscard]] SurfaceSampling result() const {
    SurfaceSampling sampling;
    const auto n = static_cast<Eigen::Index>(cells_.size());
    const auto n_vertices = static_cast<Eigen::Index>(vertices_.size());
    const auto n_nodes = static_cast<Eigen::Index>(surface_.nodes.size());
    sampling.vertices = rows_of(vertices_);
    sampling.vertex_normals = rows_of(vertex_normals_).rowwise().normalized();
    sampling.centres = rows_of(centres_);
    sampling.centre_normals = rows_of(centre_normals_);
    sampling.weights.resize(n);
    sampling.cells.resize(n, static_cast<Eigen::Index>(cells_.front().size()));
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      sampling.weights[i] = weights_[k];
      for (Eigen::Index j = 0; j < sampling.cells.cols(); ++j) {
        sampling.cells(i, j) = cells_[k][static_cast<std::size_t>(j)];
      }
    }
    sampling.to_centres.resize(n, n_nodes);
    sampling.to_centres.setFromTriplets(to_centres_.begin(), to_centres_.end());
    sampling.to_vertices.resize(n_vertices, n_nodes);
    sampling.to_vertices.setFromTriplets(to_vertices_.begin(), to_vertices_.end());
    return sampling;
  }

 private:
  void interpolate(const FaceBlock& block, Eigen::Index face, const FaceShapes& s, Eigen::Index row,
                   Triplets& triplets) const {
    for (Eigen::Index a = 0; a < block.connectivity.cols(); ++a) {
      const auto node = std::lower_bound(surface_.nodes.begin(), surface_.nodes.end(),
                                         block.connectivity(face, a));
      triplets.emplace_back(static_cast<int>(row), static_cast<int>(node - surface_.nodes.begin()),
                            s.values[a]);
    }
  }

  using Place = std::pair<const FaceBlock*, Eigen::Index>;
  static constexpr Place nowhere{nullptr, -1};

  const Eigen::MatrixX3d& nodes_;
  const Surface& surface_;
  VertexMerger merger_;
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Eigen::Vector3d> vertex_normals_;
  std::vector<Place> last_faces_;  // of each vertex the one sampled last
  std::vector<Eigen::Vector3d> centres_;
  std::vector<Eigen::Vector3d> centre_normals_;
  std::vector<double> weights_;
  std::vector<std::vector<Eigen::Index>> cells_;
  Triplets to_centres_;
  Triplets to_vertices_;
};

/// Diagonal of the bounding box [m].
double extent(const Eigen::MatrixX3d& nodes, const Surface& surface) {
  Eigen::RowVector3d low = nodes.row(surface.nodes.front());
  Eigen::RowVector3d high = low;
  for (const Eigen::Index node : surface.nodes) {
    low = low.cwiseMin(nodes.row(node));
    high = high.cwiseMax(nodes.row(node));
  }
  return (high - low).norm();
}

}  // namespace

SurfaceSampling sample_surface(const Eigen::MatrixX3d& nodes, const Surface& surface,
                               Eigen::Index n_cells) {
  Eigen::Index n_faces = 0;
  bool triangles = false;
  bool quadrilaterals = false;
  for (const FaceBlock& block : surface.faces) {
    n_faces += block.connectivity.rows();
    (is_triangle(block.type) ? triangles : quadrilaterals) |= block.connectivity.rows() > 0;
  }
  if (n_faces == 0) throw MeshError("surface \"" + surface.name + "\" has no faces");
  int n = 1;
  while (n_faces * n * n < n_cells) ++n;  // every face gives n² cells at least
  const double spacing = extent(nodes, surface) / std::sqrt(static_cast<double>(n_faces)) / n;
  Sampler sampler(nodes, surface, spacing);
  for (const FaceBlock& block : surface.faces) {
    const std::vector<Cell> cells =
        is_triangle(block.type) ? triangle_cells(n) : square_cells(n, triangles && quadrilaterals);
    for (Eigen::Index face = 0; face < block.connectivity.rows(); ++face) {
      for (const Cell& cell : cells) sampler.add(block, face, cell);
    }
  }
  return sampler.result();
}

SurfacePlane fit_plane(const Eigen::MatrixX3d& nodes, const Surface& surface) {
  SurfacePlane plane{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  std::vector<Eigen::Vector3d> normals;
  double area = 0.0;
  for (const FaceBlock& block : surface.faces) {
    const Eigen::Vector2d middle =
        is_triangle(block.type) ? Eigen::Vector2d(1.0 / 3.0, 1.0 / 3.0) : Eigen::Vector2d(0.0, 0.0);
    const FaceShapes s = shapes(block.type, middle);
    const double reference = is_triangle(block.type) ? 0.5 : 4.0;
    for (Eigen::Index face = 0; face < block.connectivity.rows(); ++face) {
      const FacePoint point = face_point(nodes, block, face, s);
      const double size = reference * point.area_vector.norm();
      plane.centroid += size * point.position;
      plane.normal += reference * point.area_vector;
      area += size;
      normals.push_back(point.area_vector.normalized());
    }
  }
  if (!(area > 0.0)) throw MeshError("surface \"" + surface.name + "\" has no area");
  plane.centroid /= area;
  // A closed surface has no mean normal: its plane is none, which flatness tells.
  plane.normal = plane.normal.norm() > 1e-6 * area ? Eigen::Vector3d(plane.normal.normalized())
                                                   : Eigen::Vector3d(Eigen::Vector3d::UnitZ());
  for (const Eigen::Vector3d& normal : normals) {
    plane.largest_angle =
        std::max(plane.largest_angle,
                 std::atan2(normal.cross(plane.normal).norm(), normal.dot(plane.normal)));
  }
  Eigen::Vector3d low = nodes.row(surface.nodes.front());
  Eigen::Vector3d high = low;
  for (const Eigen::Index node : surface.nodes) {
    const Eigen::Vector3d x = nodes.row(node);
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
    plane.flatness = std::max(plane.flatness, std::abs((x - plane.centroid).dot(plane.normal)));
  }
  plane.diameter = (high - low).norm();
  return plane;
}

}  // namespace microslip::mesh
