/// @file
/// How many elements a size makes of a body: what would keep the mesher busy for nothing is told
/// before it starts.
#pragma once

#include <string>

#include "mesh/blade_geometry.hpp"

namespace microslip::pipelines {

/// Of the longest side of a body.
constexpr double smallest_usual_element = 1e-3;
constexpr double largest_usual_element = 0.25;

/// Of the three parts of a blade [m³]: two blocks, and an aerofoil whose sections are ellipses.
[[nodiscard]] double blade_volume(const mesh::BladeGeometry& geometry);

/// What is said of a size that makes more elements than are meshed; "": it does not.
/// @param volume  of the body [m³].
/// @param height  its longest side [m]: a part of it is what is usual.
/// @note Regular tetrahedra of edge h: 8.5 in h³.
[[nodiscard]] std::string too_many_elements(double element_size, double volume, double height);

/// The sizes that are usual of a body of that height, "1.5e-04 to 0.037 m".
[[nodiscard]] std::string usual_element_sizes(double height);

}  // namespace microslip::pipelines
