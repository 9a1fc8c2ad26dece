#include "mesh/element_type.hpp"

#include <array>
#include <cstddef>

namespace microslip::mesh {

int n_nodes(ElementType type) {
  constexpr std::array counts{4, 10, 8, 20};
  return counts[static_cast<std::size_t>(type)];
}

int n_nodes(FaceType type) {
  constexpr std::array counts{3, 6, 4, 8};
  return counts[static_cast<std::size_t>(type)];
}

const char* name(ElementType type) {
  constexpr std::array names{"tet4", "tet10", "hex8", "hex20"};
  return names[static_cast<std::size_t>(type)];
}

}  // namespace microslip::mesh
