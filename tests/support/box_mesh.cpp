#include "tests/support/box_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "mesh/shape_functions.hpp"

namespace microslip::test {
namespace {

using mesh::ElementType;
using mesh::FaceType;
using mesh::Solid;

using Nodes = std::vector<Eigen::Index>;
using Edges = std::vector<std::array<std::size_t, 2>>;

constexpr int hex_corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                  {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
// Six tetrahedra around the diagonal 0–6 (Kuhn), all positively oriented; neighbours match.
constexpr std::size_t kuhn[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6},
                                    {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
constexpr std::size_t halves[2][6] = {{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}};
// Outward faces; the first two begin where Kuhn's diagonals of theirs do.
constexpr std::size_t hex_faces[6][4] = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                         {2, 3, 7, 6}, {0, 3, 2, 1}, {4, 5, 6, 7}};

/// In the project's order, written down anew.
Edges edges_of(Solid solid) {
  switch (solid) {
    case Solid::tetrahedron:
      return {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
    case Solid::hexahedron:
      return {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
              {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
    case Solid::wedge:
      return {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
    case Solid::pyramid:
      return {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}};
  }
  return {};
}

ElementType element_type(Solid solid, int order) {
  for (const ElementType type : mesh::all_element_types) {
    if (mesh::solid(type) == solid && is_quadratic(type) == (order == 2)) return type;
  }
  return {};
}

/// What the cells of a box become: pyramids stand on the faces of a cell, tetrahedra where a
/// neighbour has two triangles, their apex in its middle.
using Cut = std::function<Solid(int)>;  // of the place of a cell along x

class Builder {
 public:
  Builder(Cut cut, int order, const BoxGrid& grid)
      : cut_(std::move(cut)), order_(order), grid_(grid) {}

  mesh::Mesh build(bool straight) {
    make_corners();
    make_cells();
    const std::vector<Eigen::Vector3d> on_box = points_;  // before the map: tells the sides
    if (straight) move();
    if (order_ == 2) add_edge_nodes();
    if (!straight) move();
    return finish(on_box);
  }

 private:
  [[nodiscard]] Eigen::Index corner(int i, int j, int k) const {
    return (static_cast<Eigen::Index>(k) * (grid_.cells[1] + 1) + j) * (grid_.cells[0] + 1) + i;
  }

  void make_corners() {
    for (int k = 0; k <= grid_.cells[2]; ++k) {
      for (int j = 0; j <= grid_.cells[1]; ++j) {
        for (int i = 0; i <= grid_.cells[0]; ++i) {
          points_.emplace_back(grid_.size[0] * i / grid_.cells[0],
                               grid_.size[1] * j / grid_.cells[1],
                               grid_.size[2] * k / grid_.cells[2]);
        }
      }
    }
  }

  void make_cells() {
    for (int k = 0; k < grid_.cells[2]; ++k) {
      for (int j = 0; j < grid_.cells[1]; ++j) {
        for (int i = 0; i < grid_.cells[0]; ++i) {
          Nodes hex;
          for (const auto& c : hex_corner) hex.push_back(corner(i + c[0], j + c[1], k + c[2]));
          add_cell(i, hex);
        }
      }
    }
  }

  void add_cell(int i, const Nodes& hex) {
    switch (cut_(i)) {
      case Solid::hexahedron:
        cells_[Solid::hexahedron].push_back(hex);
        break;
      case Solid::tetrahedron:
        for (const auto& local : kuhn) add(Solid::tetrahedron, hex, local);
        break;
      case Solid::wedge:
        for (const auto& local : halves) add(Solid::wedge, hex, local);
        break;
      case Solid::pyramid:
        add_around_middle(i, hex);
        break;
    }
  }

  template <std::size_t n>
  void add(Solid solid, const Nodes& of, const std::size_t (&local)[n]) {
    Nodes cell;
    for (const std::size_t node : local) cell.push_back(of[node]);
    cells_[solid].push_back(std::move(cell));
  }

  void add_around_middle(int i, Nodes hex) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const Eigen::Index node : hex) middle += points_[std::size_t(node)] / 8.0;
    hex.push_back(std::ssize(points_));
    points_.push_back(middle);
    for (std::size_t f = 0; f < 6; ++f) {
      const auto& [a, b, c, d] = hex_faces[f];
      const int neighbour = f == 0 ? i - 1 : f == 1 ? i + 1 : -1;
      const bool split =
          neighbour >= 0 && neighbour < grid_.cells[0] && cut_(neighbour) == Solid::tetrahedron;
      if (split) {
        add(Solid::tetrahedron, hex, {a, c, b, 8});
        add(Solid::tetrahedron, hex, {a, d, c, 8});
      } else {
        add(Solid::pyramid, hex, {a, d, c, b, 8});
      }
    }
  }

  Eigen::Index edge_node(Eigen::Index a, Eigen::Index b) {
    const auto key = std::minmax(a, b);
    const auto [it, is_new] = edges_.try_emplace({key.first, key.second}, std::ssize(points_));
    if (is_new) points_.push_back(0.5 * (points_[std::size_t(a)] + points_[std::size_t(b)]));
    return it->second;
  }

  void add_edge_nodes() {
    for (auto& [solid, cells] : cells_) {
      for (Nodes& cell : cells) {
        for (const auto& [a, b] : edges_of(solid)) cell.push_back(edge_node(cell[a], cell[b]));
      }
    }
  }

  void move() {
    if (!grid_.map) return;
    for (Eigen::Vector3d& x : points_) x = grid_.map(x);
  }

  [[nodiscard]] mesh::Mesh finish(const std::vector<Eigen::Vector3d>& on_box) const {
    std::vector<mesh::ElementBlock> blocks;
    std::int64_t tag = 0;
    for (const auto& [solid, cells] : cells_) {
      mesh::ElementBlock block{element_type(solid, order_), table(cells), {}};
      for (std::size_t e = 0; e < cells.size(); ++e) block.tags.push_back(++tag);
      blocks.push_back(std::move(block));
    }
    std::map<std::string, std::vector<mesh::FaceBlock>> surfaces;
    for (int d = 0; d < 3; ++d) {
      for (int end = 0; end < 2; ++end)
        surfaces[std::string(1, "xyz"[d]) + "01"[end]] = side(blocks, on_box, d, end);
    }
    Eigen::MatrixX3d nodes(std::ssize(points_), 3);
    for (Eigen::Index i = 0; i < nodes.rows(); ++i) nodes.row(i) = points_[std::size_t(i)];
    const Eigen::Index last = corner(grid_.cells[0], grid_.cells[1], grid_.cells[2]);
    return {std::move(nodes), std::move(blocks), surfaces, {{"corner", {last}}}};
  }

  /// Faces on one side of the box by their corners: the mesh finds the elements they belong to.
  [[nodiscard]] std::vector<mesh::FaceBlock> side(const std::vector<mesh::ElementBlock>& blocks,
                                                  const std::vector<Eigen::Vector3d>& on_box, int d,
                                                  int end) const {
    const double at = end == 0 ? 0.0 : grid_.size[d];
    std::map<std::size_t, std::vector<Nodes>> found;  // by number of corners
    for (const mesh::ElementBlock& block : blocks) {
      for (const auto& local : mesh::faces(mesh::linear(block.type))) {
        for (Eigen::Index e = 0; e < block.connectivity.rows(); ++e) {
          Nodes face;
          for (const int node : local) face.push_back(block.connectivity(e, node));
          const bool inside = std::ranges::all_of(face, [&](Eigen::Index node) {
            return std::abs(on_box[std::size_t(node)][d] - at) < 1e-9 * grid_.size[d];
          });
          if (inside) found[face.size()].push_back(std::move(face));
        }
      }
    }
    std::vector<mesh::FaceBlock> faces;
    for (const auto& [corners, list] : found)
      faces.push_back({corners == 3 ? FaceType::tri3 : FaceType::quad4, table(list)});
    return faces;
  }

  static mesh::Connectivity table(const std::vector<Nodes>& rows) {
    mesh::Connectivity result(std::ssize(rows), rows.empty() ? 0 : std::ssize(rows.front()));
    for (Eigen::Index i = 0; i < result.rows(); ++i) {
      for (Eigen::Index j = 0; j < result.cols(); ++j)
        result(i, j) = rows[std::size_t(i)][std::size_t(j)];
    }
    return result;
  }

  Cut cut_;
  int order_;
  BoxGrid grid_;
  std::vector<Eigen::Vector3d> points_;  // corners, middles of cells, then edge nodes
  std::map<Solid, std::vector<Nodes>> cells_;
  std::map<std::pair<Eigen::Index, Eigen::Index>, Eigen::Index> edges_;
};

Builder of_one_type(ElementType type, const BoxGrid& grid) {
  return {[solid = mesh::solid(type)](int) { return solid; }, is_quadratic(type) ? 2 : 1, grid};
}

Builder mixed(int order, const BoxGrid& grid) {
  constexpr std::array turns{Solid::hexahedron,  Solid::wedge,   Solid::pyramid,
                             Solid::tetrahedron, Solid::pyramid, Solid::wedge};
  return {[turns](int i) { return turns[static_cast<std::size_t>(i) % turns.size()]; }, order,
          grid};
}

}  // namespace

Eigen::Vector3d distorted(const Eigen::Vector3d& x) {
  return x + 0.05 * Eigen::Vector3d(std::sin(7.0 * x[1] + 3.0 * x[2]),
                                    std::sin(5.0 * x[0] - 4.0 * x[2]),
                                    std::cos(6.0 * x[0] + 2.0 * x[1]));
}

mesh::Mesh box_mesh(ElementType type, const BoxGrid& grid) {
  return of_one_type(type, grid).build(false);
}
mesh::Mesh straight_box_mesh(ElementType type, const BoxGrid& grid) {
  return of_one_type(type, grid).build(true);
}
mesh::Mesh mixed_box_mesh(int order, const BoxGrid& grid) {
  return mixed(order, grid).build(false);
}
mesh::Mesh straight_mixed_box_mesh(int order, const BoxGrid& grid) {
  return mixed(order, grid).build(true);
}

}  // namespace microslip::test
