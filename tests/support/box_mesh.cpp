#include "tests/support/box_mesh.hpp"

#include <map>
#include <utility>
#include <vector>

namespace microslip::test {
namespace {

using mesh::ElementType;
using mesh::FaceType;

bool is_tetrahedron(ElementType type) {
  return type == ElementType::tet4 || type == ElementType::tet10;
}
bool is_quadratic(ElementType type) {
  return type == ElementType::tet10 || type == ElementType::hex20;
}

constexpr int hex_corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                  {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
// Six tetrahedra around the diagonal 0–6 (Kuhn), all positively oriented; neighbours match.
constexpr int kuhn[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6},
                            {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
constexpr int tet_edges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
constexpr int hex_edges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                  {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
// Outward faces.
constexpr int tet_faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
constexpr int hex_faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                 {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

using Cells = std::vector<std::vector<Eigen::Index>>;

class Builder {
 public:
  Builder(ElementType type, const BoxGrid& grid) : type_(type), grid_(grid) {}

  mesh::Mesh build(bool straight) {
    make_corners();
    make_cells();
    Eigen::MatrixX3d on_box = coordinates();  // before the map: tells the sides of the box
    if (straight) move(corners_);
    if (is_quadratic(type_)) add_edge_nodes();
    if (is_quadratic(type_) && straight) on_box = unmoved_with_edges(on_box);
    if (!straight) {
      on_box = coordinates();
      move(corners_);
    }
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
          corners_.emplace_back(grid_.size[0] * i / grid_.cells[0],
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
          std::vector<Eigen::Index> hex;
          for (const auto& c : hex_corner) hex.push_back(corner(i + c[0], j + c[1], k + c[2]));
          if (!is_tetrahedron(type_)) {
            cells_.push_back(hex);
            continue;
          }
          for (const auto& t : kuhn) {
            cells_.push_back({hex[std::size_t(t[0])], hex[std::size_t(t[1])],
                              hex[std::size_t(t[2])], hex[std::size_t(t[3])]});
          }
        }
      }
    }
  }

  Eigen::Index edge_node(Eigen::Index a, Eigen::Index b) {
    const auto key = std::minmax(a, b);
    const auto [it, is_new] = edges_.try_emplace({key.first, key.second}, std::ssize(corners_));
    if (is_new) corners_.push_back(0.5 * (corners_[std::size_t(a)] + corners_[std::size_t(b)]));
    return it->second;
  }

  void add_edge_nodes() {
    for (auto& cell : cells_) {
      if (is_tetrahedron(type_)) {
        for (const auto& e : tet_edges)
          cell.push_back(edge_node(cell[std::size_t(e[0])], cell[std::size_t(e[1])]));
      } else {
        for (const auto& e : hex_edges)
          cell.push_back(edge_node(cell[std::size_t(e[0])], cell[std::size_t(e[1])]));
      }
    }
  }

  [[nodiscard]] Eigen::MatrixX3d unmoved_with_edges(const Eigen::MatrixX3d& corners) const {
    Eigen::MatrixX3d all(std::ssize(corners_), 3);
    all.topRows(corners.rows()) = corners;
    for (const auto& [ends, node] : edges_)
      all.row(node) = 0.5 * (corners.row(ends.first) + corners.row(ends.second));
    return all;
  }

  [[nodiscard]] Eigen::MatrixX3d coordinates() const {
    Eigen::MatrixX3d x(std::ssize(corners_), 3);
    for (Eigen::Index i = 0; i < x.rows(); ++i) x.row(i) = corners_[std::size_t(i)].transpose();
    return x;
  }

  void move(std::vector<Eigen::Vector3d>& points) const {
    if (!grid_.map) return;
    for (Eigen::Vector3d& x : points) x = grid_.map(x);
  }

  [[nodiscard]] std::vector<std::vector<Eigen::Index>> faces_of(
      const std::vector<Eigen::Index>& cell) {
    std::vector<std::vector<Eigen::Index>> faces;
    const auto add = [&](const int* local, int n) {
      std::vector<Eigen::Index> face;
      for (int i = 0; i < n; ++i) face.push_back(cell[std::size_t(local[i])]);
      if (is_quadratic(type_)) {
        for (int i = 0; i < n; ++i) {
          // tri6 stores edges 01 12 02, quad8 01 12 23 30: both are "i to the next".
          face.push_back(edge_node(face[std::size_t(i)], face[std::size_t((i + 1) % n)]));
        }
      }
      faces.push_back(face);
    };
    if (is_tetrahedron(type_)) {
      for (const auto& f : tet_faces) add(f, 3);
    } else {
      for (const auto& f : hex_faces) add(f, 4);
    }
    return faces;
  }

  mesh::Mesh finish(const Eigen::MatrixX3d& on_box) {
    std::map<std::string, std::vector<mesh::FaceBlock>> surfaces;
    for (int d = 0; d < 3; ++d) {
      for (int end = 0; end < 2; ++end)
        surfaces[std::string(1, "xyz"[d]) + "01"[end]] = {side(on_box, d, end)};
    }
    mesh::ElementBlock block;
    block.type = type_;
    block.connectivity = table(cells_);
    for (std::size_t e = 0; e < cells_.size(); ++e)
      block.tags.push_back(static_cast<std::int64_t>(e) + 1);
    const Eigen::Index last = corner(grid_.cells[0], grid_.cells[1], grid_.cells[2]);
    return {coordinates(), {block}, surfaces, {{"corner", {last}}}};
  }

  mesh::FaceBlock side(const Eigen::MatrixX3d& on_box, int d, int end) {
    const double at = end == 0 ? 0.0 : grid_.size[d];
    std::vector<std::vector<Eigen::Index>> found;
    for (const auto& cell : cells_) {
      for (const auto& face : faces_of(cell)) {
        bool inside = true;
        for (const Eigen::Index node : face)
          inside = inside && std::abs(on_box(node, d) - at) < 1e-9 * grid_.size[d];
        if (inside) found.push_back(face);
      }
    }
    const bool quadratic = is_quadratic(type_);
    const FaceType type = is_tetrahedron(type_) ? (quadratic ? FaceType::tri6 : FaceType::tri3)
                                                : (quadratic ? FaceType::quad8 : FaceType::quad4);
    return {type, table(found)};
  }

  static mesh::Connectivity table(const Cells& rows) {
    mesh::Connectivity result(std::ssize(rows), rows.empty() ? 0 : std::ssize(rows.front()));
    for (Eigen::Index i = 0; i < result.rows(); ++i) {
      for (Eigen::Index j = 0; j < result.cols(); ++j)
        result(i, j) = rows[std::size_t(i)][std::size_t(j)];
    }
    return result;
  }

  ElementType type_;
  BoxGrid grid_;
  std::vector<Eigen::Vector3d> corners_;  // edge nodes follow
  Cells cells_;
  std::map<std::pair<Eigen::Index, Eigen::Index>, Eigen::Index> edges_;
};

}  // namespace

mesh::Mesh box_mesh(ElementType type, const BoxGrid& grid) {
  return Builder(type, grid).build(false);
}
mesh::Mesh straight_box_mesh(ElementType type, const BoxGrid& grid) {
  return Builder(type, grid).build(true);
}

}  // namespace microslip::test
