/// @file
/// Volume elements of one type, as nodes of a mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/element_type.hpp"
#include "mesh/surface.hpp"

namespace microslip::mesh {

struct ElementBlock {
  ElementType type = ElementType::tet10;
  Connectivity connectivity;       ///< n_elements × nodes per element, project order
  std::vector<std::int64_t> tags;  ///< element numbers in the file, for messages
};

}  // namespace microslip::mesh
