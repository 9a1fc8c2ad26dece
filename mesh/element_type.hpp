/// @file
/// Element and face types with one node order for the whole project: that of Abaqus, which for
/// these types is also that of VTK, but for wedge6, whose triangles VTK runs the other way round.
/// Foreign orders are permuted where files are read and written, nowhere else.
///
///   tet10:     corners 0–3, then edges 01 12 02 03 13 23
///   hex20:     corners 0–7, then edges 01 12 23 30, 45 56 67 74, 04 15 26 37
///   wedge15:   triangle 0 1 2, opposite triangle 3 4 5, then edges 01 12 20, 34 45 53, 03 14 25
///   pyramid13: base 0–3, apex 4, then edges 01 12 23 30, 04 14 24 34
///   tri6:      corners 0–2, then edges 01 12 02        quad8: corners 0–3, then edges 01 12 23 30
#pragma once

#include <array>
#include <cstdint>

namespace microslip::mesh {

enum class ElementType : std::uint8_t {
  tet4,
  tet10,
  hex8,
  hex20,
  wedge6,
  wedge15,
  pyramid5,
  pyramid13
};
enum class FaceType : std::uint8_t { tri3, tri6, quad4, quad8 };

/// What an element is of, whatever its order.
enum class Solid : std::uint8_t { tetrahedron, hexahedron, wedge, pyramid };

inline constexpr std::array all_element_types{
    ElementType::tet4,   ElementType::tet10,   ElementType::hex8,     ElementType::hex20,
    ElementType::wedge6, ElementType::wedge15, ElementType::pyramid5, ElementType::pyramid13};

inline constexpr std::array all_face_types{FaceType::tri3, FaceType::tri6, FaceType::quad4,
                                           FaceType::quad8};

/// Of any type: what storage of one element or face holds without allocation.
inline constexpr int most_element_nodes = 20;
inline constexpr int most_face_nodes = 8;

[[nodiscard]] int n_nodes(ElementType type);
[[nodiscard]] int n_nodes(FaceType type);
[[nodiscard]] int n_corners(ElementType type);
[[nodiscard]] int n_corners(FaceType type);
[[nodiscard]] Solid solid(ElementType type);
[[nodiscard]] bool is_quadratic(ElementType type);
/// The element of the same solid with corners only.
[[nodiscard]] ElementType linear(ElementType type);
[[nodiscard]] const char* name(ElementType type);

}  // namespace microslip::mesh
