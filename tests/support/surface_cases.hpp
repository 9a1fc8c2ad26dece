/// @file
/// The laws of two surfaces that have no closed form, made to matter for a given motion.
#pragma once

#include <string>
#include <vector>

#include "contact/surface/surface_law.hpp"
#include "support/motion_cases.hpp"

namespace microslip::test {

/// ω [rad/s] at which the coefficient changes by its half within the speeds that occur.
inline constexpr double surface_frequency = 40.0;

struct SurfaceCase {
  std::string name;
  contact::SurfaceLaw (*make)(const MotionCase&);
};

/// Smooth surfaces with a constant coefficient.
[[nodiscard]] contact::SurfaceLaw smooth_surface(const MotionCase& c);
/// Smooth surfaces; a coefficient that falls or rises with the rate; cubic and Gaussian heights.
/// Heights need a normal stiffness.
[[nodiscard]] const std::vector<SurfaceCase>& surface_cases();

}  // namespace microslip::test
