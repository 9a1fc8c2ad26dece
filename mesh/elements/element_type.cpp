#include "mesh/element_type.hpp"

#include <cstddef>

namespace microslip::mesh {
namespace {

struct Facts {
  const char* name;
  Solid solid;
  int n_corners;
  int n_nodes;
  ElementType linear;
};

const Facts& facts(ElementType type) {
  static constexpr std::array<Facts, all_element_types.size()> table{{
      {"tet4", Solid::tetrahedron, 4, 4, ElementType::tet4},
      {"tet10", Solid::tetrahedron, 4, 10, ElementType::tet4},
      {"hex8", Solid::hexahedron, 8, 8, ElementType::hex8},
      {"hex20", Solid::hexahedron, 8, 20, ElementType::hex8},
      {"wedge6", Solid::wedge, 6, 6, ElementType::wedge6},
      {"wedge15", Solid::wedge, 6, 15, ElementType::wedge6},
      {"pyramid5", Solid::pyramid, 5, 5, ElementType::pyramid5},
      {"pyramid13", Solid::pyramid, 5, 13, ElementType::pyramid5},
  }};
  return table[static_cast<std::size_t>(type)];
}

}  // namespace

int n_nodes(ElementType type) { return facts(type).n_nodes; }
int n_corners(ElementType type) { return facts(type).n_corners; }
Solid solid(ElementType type) { return facts(type).solid; }
bool is_quadratic(ElementType type) { return n_nodes(type) > n_corners(type); }
ElementType linear(ElementType type) { return facts(type).linear; }
const char* name(ElementType type) { return facts(type).name; }

int n_nodes(FaceType type) {
  constexpr std::array counts{3, 6, 4, 8};
  return counts[static_cast<std::size_t>(type)];
}

int n_corners(FaceType type) { return type == FaceType::tri3 || type == FaceType::tri6 ? 3 : 4; }

}  // namespace microslip::mesh
