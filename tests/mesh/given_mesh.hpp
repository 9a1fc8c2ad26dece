/// @file
/// Meshes written out by hand, for the tests of this folder.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace microslip::mesh::tests {

/// Elements by their nodes, numbered from `first_tag`.
inline ElementBlock block_of(ElementType type, const std::vector<std::vector<Eigen::Index>>& rows,
                             std::int64_t first_tag) {
  ElementBlock block{type, Connectivity(std::ssize(rows), n_nodes(type)), {}};
  for (std::size_t e = 0; e < rows.size(); ++e) {
    for (std::size_t a = 0; a < rows[e].size(); ++a) {
      block.connectivity(static_cast<Eigen::Index>(e), static_cast<Eigen::Index>(a)) = rows[e][a];
    }
    block.tags.push_back(first_tag + static_cast<std::int64_t>(e));
  }
  return block;
}

/// What an action says when it refuses.
inline std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const MeshError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace microslip::mesh::tests
