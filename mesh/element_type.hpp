/// @file
/// Element and face types with one node order for the whole project: that of VTK, which for these
/// types is also that of Abaqus. Foreign orders (gmsh) are permuted by the reader, nowhere else.
///
///   tet10: corners 0–3, then edges 01 12 02 03 13 23
///   hex20: corners 0–7, then edges 01 12 23 30, 45 56 67 74, 04 15 26 37
///   tri6:  corners 0–2, then edges 01 12 02        quad8: corners 0–3, then edges 01 12 23 30
#pragma once

#include <cstdint>

namespace microslip::mesh {

enum class ElementType : std::uint8_t { tet4, tet10, hex8, hex20 };
enum class FaceType : std::uint8_t { tri3, tri6, quad4, quad8 };

[[nodiscard]] int n_nodes(ElementType type);
[[nodiscard]] int n_nodes(FaceType type);
[[nodiscard]] const char* name(ElementType type);

}  // namespace microslip::mesh
