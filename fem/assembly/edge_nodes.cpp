#include "fem/assembly/edge_nodes.hpp"

#include <algorithm>

namespace microslip::fem {

bool has_edge_nodes(const mesh::Mesh& mesh) {
  return std::ranges::any_of(mesh.elements(), [](const mesh::ElementBlock& block) {
    return mesh::is_quadratic(block.type) && block.connectivity.rows() > 0;
  });
}

}  // namespace microslip::fem
