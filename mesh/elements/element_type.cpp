#include "mesh/element_type.hpp"

#include <algorithm>
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

constexpr std::array<Facts, all_element_types.size()> element_facts{{
    {"tet4", Solid::tetrahedron, 4, 4, ElementType::tet4},
    {"tet10", Solid::tetrahedron, 4, 10, ElementType::tet4},
    {"hex8", Solid::hexahedron, 8, 8, ElementType::hex8},
    {"hex20", Solid::hexahedron, 8, 20, ElementType::hex8},
    {"wedge6", Solid::wedge, 6, 6, ElementType::wedge6},
    {"wedge15", Solid::wedge, 6, 15, ElementType::wedge6},
    {"pyramid5", Solid::pyramid, 5, 5, ElementType::pyramid5},
    {"pyramid13", Solid::pyramid, 5, 13, ElementType::pyramid5},
}};

struct FaceFacts {
  int n_corners;
  int n_nodes;
};

constexpr std::array<FaceFacts, all_face_types.size()> face_facts{{{3, 3}, {3, 6}, {4, 4}, {4, 8}}};

static_assert(std::ranges::max(element_facts, {}, &Facts::n_nodes).n_nodes == most_element_nodes);
static_assert(std::ranges::max(face_facts, {}, &FaceFacts::n_nodes).n_nodes == most_face_nodes);

const Facts& facts(ElementType type) { return element_facts[static_cast<std::size_t>(type)]; }
const FaceFacts& facts(FaceType type) { return face_facts[static_cast<std::size_t>(type)]; }

}  // namespace

int n_nodes(ElementType type) { return facts(type).n_nodes; }
int n_corners(ElementType type) { return facts(type).n_corners; }
Solid solid(ElementType type) { return facts(type).solid; }
bool is_quadratic(ElementType type) { return n_nodes(type) > n_corners(type); }
ElementType linear(ElementType type) { return facts(type).linear; }
const char* name(ElementType type) { return facts(type).name; }
int n_nodes(FaceType type) { return facts(type).n_nodes; }
int n_corners(FaceType type) { return facts(type).n_corners; }

}  // namespace microslip::mesh
