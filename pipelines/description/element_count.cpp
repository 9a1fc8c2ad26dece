#include "pipelines/description/element_count.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace microslip::pipelines {

double blade_volume(const mesh::BladeGeometry& g) {
  const double root = g.root_width * g.root_height * g.root_length;
  const double platform = g.platform_width * g.platform_height * g.platform_length;
  // Chord c and thickness t are linear over the span: ∫ c t is Simpson's rule.
  const double middle = 0.25 * (g.root_chord + g.tip_chord) * (g.root_thickness + g.tip_thickness);
  const double mean =
      (g.root_chord * g.root_thickness + 4.0 * middle + g.tip_chord * g.tip_thickness) / 6.0;
  return root + platform + 0.25 * std::numbers::pi * mean * g.span;
}

std::string usual_element_sizes(double height) {
  return fmt::format("{:.2g} to {:.2g} m", smallest_usual_element * height,
                     largest_usual_element * height);
}

std::string too_many_elements(double element_size, double volume, double height) {
  constexpr double per_cube = 8.5;
  constexpr double most = 5e6;
  const double n = per_cube * volume / std::pow(element_size, 3);
  if (n <= most) return {};
  return fmt::format(
      "{:g} m would make some {:.1g} elements of a body of {:.3g} m^3; at most {:.0g} are meshed, "
      "and usual is {}: a larger size",
      element_size, n, volume, most, usual_element_sizes(height));
}

}  // namespace microslip::pipelines
