#include "mesh/refined_mesh.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>
#include <utility>

#include "mesh/elements/element_split.hpp"
#include "mesh/elements/face_map.hpp"
#include "mesh/shape_functions.hpp"

namespace microslip::mesh {
namespace {

/// Corners of the given mesh that a node lies between, with their shares; −1 where there are fewer.
using NodeKey = std::array<std::int64_t, 8>;

struct NodeKeyHash {
  std::size_t operator()(const NodeKey& key) const {
    std::size_t hash = 0;
    for (const std::int64_t part : key) {
      hash = (hash ^ static_cast<std::size_t>(part + 1)) * 0x9E3779B97F4A7C15ULL;
      hash ^= hash >> 29U;
    }
    return hash;
  }
};

template <typename Nodes>
NodeKey key_of(const CornerShares& shares, const Nodes& nodes) {
  NodeKey key;
  key.fill(-1);
  std::size_t n = 0;
  for (const auto& [corner, share] : shares) {
    key[n++] = static_cast<std::int64_t>(nodes[corner]) * (2 * whole_corner) + share;
  }
  std::sort(key.begin(), key.begin() + static_cast<std::ptrdiff_t>(n));
  return key;
}

/// Of an octahedron between corners: the shortest.
int diagonal_of(ElementType type, const Eigen::MatrixX3d& nodes) {
  if (solid(type) != Solid::tetrahedron) return 0;
  const auto length = [&](int a, int b, int c) {
    return (nodes.row(0) + nodes.row(a) - nodes.row(b) - nodes.row(c)).squaredNorm();
  };
  const std::array lengths{length(1, 2, 3), length(2, 3, 1), length(3, 1, 2)};
  return static_cast<int>(std::ranges::min_element(lengths) - lengths.begin());
}

enum class Into { smaller, quadratic };

class OtherElements {
 public:
  OtherElements(const Mesh& mesh, Into into) : mesh_(mesh), into_(into) {
    for (Eigen::Index i = 0; i < mesh.n_nodes(); ++i) nodes_.emplace_back(mesh.nodes().row(i));
    for (const ElementBlock& block : mesh.elements()) keep_nodes(block);
    for (const ElementBlock& block : mesh.elements()) cut(block);
  }

  [[nodiscard]] Eigen::MatrixX3d nodes() const {
    Eigen::MatrixX3d all(std::ssize(nodes_), 3);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      all.row(static_cast<Eigen::Index>(i)) = nodes_[i];
    }
    return all;
  }

  [[nodiscard]] std::vector<ElementBlock> elements() const {
    std::vector<ElementBlock> blocks;
    for (const auto& [type, list] : lists_) {
      const auto n = static_cast<Eigen::Index>(list.tags.size());
      blocks.push_back(
          {type, Eigen::Map<const Connectivity>(list.nodes.data(), n, n_nodes(type)), list.tags});
    }
    return blocks;
  }

  [[nodiscard]] std::map<std::string, std::vector<FaceBlock>> surfaces() const {
    std::map<std::string, std::vector<FaceBlock>> all;
    for (const std::string& name : mesh_.surface_names()) {
      std::vector<FaceBlock>& blocks = all[name];
      if (!mesh_.has_faces(name)) continue;
      for (const FaceBlock& block : mesh_.surface(name).faces) {
        blocks.push_back(into_ == Into::smaller ? cut(block) : block);
      }
    }
    return all;
  }

  [[nodiscard]] Mesh::NodeSets node_sets() const {
    Mesh::NodeSets sets = mesh_.node_sets();
    std::map<std::string, std::vector<char>> members;
    for (auto& [name, set] : sets) {
      if (set.size() < 2) continue;
      std::vector<char>& in_set = members[name];
      in_set.assign(static_cast<std::size_t>(mesh_.n_nodes()), 0);
      for (const Eigen::Index node : set) in_set[static_cast<std::size_t>(node)] = 1;
    }
    for (const FaceUse& use : outer_faces(map_faces(mesh_.elements()))) {
      const FaceType type = face_type(mesh_.elements()[use.block].type, use.face);
      const std::vector<Eigen::Index> nodes = face_nodes(mesh_.elements(), use);
      for (const auto& [name, in_set] : members) add_to_set(type, nodes, in_set, sets[name]);
    }
    return sets;
  }

 private:
  struct ElementList {
    std::vector<Eigen::Index> nodes;
    std::vector<std::int64_t> tags;
  };

  const ElementSplit& split_of(ElementType type, int diagonal) {
    const auto found = splits_.find({type, diagonal});
    if (found != splits_.end()) return found->second;
    ElementSplit split =
        into_ == Into::smaller ? element_split(type, diagonal) : midside_split(type);
    return splits_.emplace(std::pair{type, diagonal}, std::move(split)).first->second;
  }

  /// Before any element is cut: the middle of an edge is the node there, where one element has it.
  void keep_nodes(const ElementBlock& block) {
    const ElementSplit& split = split_of(block.type, 0);
    for (Eigen::Index e = 0; e < block.connectivity.rows(); ++e) {
      for (Eigen::Index a = 0; a < block.connectivity.cols(); ++a) {
        numbers_.emplace(
            key_of(split.shares[static_cast<std::size_t>(a)], block.connectivity.row(e)),
            block.connectivity(e, a));
      }
    }
  }

  void cut(const ElementBlock& block) {
    Eigen::MatrixX3d own(block.connectivity.cols(), 3);
    for (Eigen::Index e = 0; e < block.connectivity.rows(); ++e) {
      for (Eigen::Index a = 0; a < own.rows(); ++a) {
        own.row(a) = mesh_.nodes().row(block.connectivity(e, a));
      }
      const ElementSplit& split = split_of(block.type, diagonal_of(block.type, own));
      const std::vector<Eigen::Index> numbers = numbered(split, block.connectivity.row(e), own);
      for (const ElementSplit::Child& child : split.children) {
        ElementList& list = lists_[child.type];
        for (const int point : child.points) {
          list.nodes.push_back(numbers[static_cast<std::size_t>(point)]);
        }
        list.tags.push_back(block.tags.empty() ? e + 1 : block.tags[static_cast<std::size_t>(e)]);
      }
    }
  }

  /// Nodes at the points of an element, made where there is none yet.
  template <typename Row>
  std::vector<Eigen::Index> numbered(const ElementSplit& split, const Row& corners,
                                     const Eigen::MatrixX3d& own) {
    std::vector<Eigen::Index> numbers;
    for (std::size_t i = 0; i < split.shares.size(); ++i) {
      const auto [entry, is_new] =
          numbers_.emplace(key_of(split.shares[i], corners), std::ssize(nodes_));
      if (is_new) nodes_.emplace_back(split.shapes.row(static_cast<Eigen::Index>(i)) * own);
      numbers.push_back(entry->second);
    }
    return numbers;
  }

  /// Its corners are enough: Mesh finds the faces of the elements by them.
  [[nodiscard]] FaceBlock cut(const FaceBlock& block) const {
    const FaceSplit split = face_split(block.type);
    const int n = n_corners(block.type);
    const auto n_children = std::ssize(split.children);
    FaceBlock all{n == 3 ? FaceType::tri3 : FaceType::quad4,
                  Connectivity(n_children * block.connectivity.rows(), n)};
    Eigen::Index row = 0;
    for (Eigen::Index f = 0; f < block.connectivity.rows(); ++f) {
      for (const std::vector<int>& child : split.children) {
        for (int i = 0; i < n; ++i) {
          const CornerShares& shares =
              split.shares[static_cast<std::size_t>(child[static_cast<std::size_t>(i)])];
          all.connectivity(row, i) = numbers_.at(key_of(shares, block.connectivity.row(f)));
        }
        ++row;
      }
    }
    return all;
  }

  /// Of a face, what lies on edges and on the whole if all their nodes are in the set.
  void add_to_set(FaceType type, const std::vector<Eigen::Index>& nodes,
                  const std::vector<char>& in_set, std::vector<Eigen::Index>& set) const {
    const auto is_in = [&](std::size_t i) {
      return in_set[static_cast<std::size_t>(nodes[i])] != 0;
    };
    const auto n = static_cast<std::size_t>(n_corners(type));
    const bool has_middles = nodes.size() > n;
    bool whole = true;
    for (std::size_t i = 0; i < nodes.size(); ++i) whole = whole && is_in(i);
    const auto has_edge = [&](const CornerShares& shares) {
      const auto first = static_cast<std::size_t>(shares.front().first);
      const auto last = static_cast<std::size_t>(shares.back().first);
      const std::size_t edge = last == first + 1 ? first : last;  // the last one closes the face
      return is_in(first) && is_in(last) && (!has_middles || is_in(n + edge));
    };
    static const std::array splits{face_split(FaceType::tri3), face_split(FaceType::tri6),
                                   face_split(FaceType::quad4), face_split(FaceType::quad8)};
    for (const CornerShares& shares : splits[static_cast<std::size_t>(type)].shares) {
      if (shares.size() < 2 || !(whole || (shares.size() == 2 && has_edge(shares)))) continue;
      const auto found = numbers_.find(key_of(shares, nodes));
      if (found != numbers_.end()) set.push_back(found->second);
    }
  }

  const Mesh& mesh_;
  Into into_;
  std::vector<Eigen::RowVector3d> nodes_;
  std::unordered_map<NodeKey, Eigen::Index, NodeKeyHash> numbers_;
  std::map<std::pair<ElementType, int>, ElementSplit> splits_;
  std::map<ElementType, ElementList> lists_;
};

Mesh other(const Mesh& mesh, Into into) {
  const OtherElements finer(mesh, into);
  Mesh result(finer.nodes(), finer.elements(), finer.surfaces(), finer.node_sets(),
              mesh.n_repeated_elements());
  for (const std::string& remark : mesh.remarks()) result.add_remark(remark);
  return result;
}

}  // namespace

Mesh refined(const Mesh& mesh) { return other(mesh, Into::smaller); }

Mesh quadratic(const Mesh& mesh) {
  return has_midside_nodes(mesh) ? mesh : other(mesh, Into::quadratic);
}

bool has_midside_nodes(const Mesh& mesh) {
  return std::ranges::all_of(mesh.elements(),
                             [](const ElementBlock& block) { return is_quadratic(block.type); });
}

}  // namespace microslip::mesh
