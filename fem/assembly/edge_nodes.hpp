#pragma once

#include "mesh/mesh.hpp"

namespace microslip::fem {

/// Whether any element has nodes beside its corners.
[[nodiscard]] bool has_edge_nodes(const mesh::Mesh& mesh);

}  // namespace microslip::fem
