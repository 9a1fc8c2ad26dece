/// @file
/// The faces of all volume elements, each with the elements that have it.
///
/// In a mesh whose elements fill a body once, a face has one element (it is on the boundary) or
/// two, one on each side, that see it in opposite directions and share all its nodes.
#pragma once

#include <array>
#include <compare>
#include <unordered_map>
#include <vector>

#include "mesh/element_block.hpp"

namespace microslip::mesh {

/// A face told by its corner nodes in ascending order; a triangle has −1 in the first place.
using FaceKey = std::array<Eigen::Index, 4>;

struct FaceKeyHash {
  std::size_t operator()(const FaceKey& key) const {
    std::size_t hash = 0;
    for (const Eigen::Index node : key) {
      hash = hash * 1099511628211ULL + static_cast<std::size_t>(node + 1);
    }
    return hash;
  }
};

/// Face `face` of element `element` of block `block`.
struct FaceUse {
  std::size_t block = 0;
  Eigen::Index element = 0;
  std::size_t face = 0;
  // clang-tidy takes the 0 that an ordering is compared with for a pointer.
  // NOLINTNEXTLINE(modernize-use-nullptr)
  [[nodiscard]] auto operator<=>(const FaceUse&) const = default;
};

struct FaceOwners {
  std::array<FaceUse, 3> uses;  ///< the first three
  int count = 0;                ///< elements that have this face
};

using FaceMap = std::unordered_map<FaceKey, FaceOwners, FaceKeyHash>;

/// @param nodes  corner nodes in any order, the first `n_corners` count.
[[nodiscard]] FaceKey face_key(const std::array<Eigen::Index, 4>& nodes, int n_corners);

[[nodiscard]] FaceMap map_faces(const std::vector<ElementBlock>& elements);

/// Mesh nodes of a face as its element has them: outward, corners, then edges.
[[nodiscard]] std::vector<Eigen::Index> face_nodes(const std::vector<ElementBlock>& elements,
                                                   const FaceUse& use);

/// Faces that one element has, in the order of the elements.
[[nodiscard]] std::vector<FaceUse> outer_faces(const FaceMap& faces);

/// @throws MeshError  faces with three or more elements, two elements on one side of a face, or
///         neighbours that share the corners of a face but not the nodes on its edges;
///         with element numbers.
void check_faces(const std::vector<ElementBlock>& elements, const FaceMap& faces);

}  // namespace microslip::mesh
