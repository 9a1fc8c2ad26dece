#include "mesh/blade_geometry.hpp"

#include <array>
#include <cmath>
#include <sstream>

#include "mesh/mesh_error.hpp"

namespace microslip::mesh {
namespace {

struct Range {
  const char* name;
  double value;
  double low;
  double high;
};

void require(const Range& range) {
  if (range.value > range.low && range.value < range.high) return;  // false for NaN
  std::ostringstream text;
  text << "model." << range.name << " = " << range.value << "; must lie between " << range.low
       << " and " << range.high;
  throw MeshError(text.str());
}

}  // namespace

void check_geometry(const BladeGeometry& g, const ElementSizes& sizes) {
  constexpr double largest = 10.0;     // m
  constexpr double finest = 0.01;      // of the elements elsewhere
  constexpr double same = 1.0 + 1e-9;  // likewise
  for (const Range& range : std::array<Range, 17>{{
           {"element_size", sizes.element_size, 0.0, largest},
           {"edge_size", sizes.edge_size.value_or(sizes.element_size), finest * sizes.element_size,
            same * sizes.element_size},
           {"root_width", g.root_width, 0.0, largest},
           {"root_height", g.root_height, 0.0, largest},
           {"root_length", g.root_length, 0.0, largest},
           {"platform_width", g.platform_width, g.root_width, largest},
           {"platform_height", g.platform_height, 0.0, largest},
           {"platform_length", g.platform_length, 0.0, largest},
           {"span", g.span, 0.0, largest},
           {"root_chord", g.root_chord, 0.0, g.platform_length},
           {"tip_chord", g.tip_chord, 0.0, largest},
           {"root_thickness", g.root_thickness, 0.0, g.root_chord},
           {"tip_thickness", g.tip_thickness, 0.0, g.tip_chord},
           {"root_stagger", g.root_stagger, -1.6, 1.6},
           {"tip_stagger", g.tip_stagger, -1.6, 1.6},
           {"camber", g.camber, -0.5, 0.5},
           {"lean", g.lean, -largest, largest},
       }}) {
    require(range);
  }
  // The section at the platform must stand on it.
  const double reach = 0.5 * g.root_chord * std::abs(std::sin(g.root_stagger)) + g.root_thickness +
                       g.root_chord * std::abs(g.camber);
  require({"platform_width", g.platform_width, 2.0 * reach, largest});
}

SectionPoint section_point(const BladeGeometry& g, double height, double chord_share, double side) {
  const auto between = [height](double root, double tip) {
    return (1.0 - height) * root + height * tip;
  };
  const double chord = between(g.root_chord, g.tip_chord);
  const double thickness = between(g.root_thickness, g.tip_thickness);
  const double stagger = between(g.root_stagger, g.tip_stagger);
  const double bow = chord_share * (1.0 - chord_share);
  const double camber = 4.0 * g.camber * chord * bow;
  const double half = thickness * std::sqrt(std::max(bow, 0.0));
  // The mean of a parabola is 2/3 of its height: the section sits on the stacking axis.
  const double x = camber + side * half - 2.0 / 3.0 * g.camber * chord;
  const double z = chord * (chord_share - 0.5);
  return {x * std::cos(stagger) + z * std::sin(stagger) + g.lean * height,
          g.root_height + g.platform_height + g.span * height,
          -x * std::sin(stagger) + z * std::cos(stagger)};
}

}  // namespace microslip::mesh
