#include "contact/surface_law.hpp"

#include <algorithm>

namespace microslip::contact {

SurfaceState SurfaceLaw::at(double approach, double /*rate*/) const {
  SurfaceState state;
  state.gap_load = point_.preload + point_.normal_stiffness * approach;
  state.load = std::max(state.gap_load, 0.0);
  state.load_by_approach = state.gap_load > 0.0 ? point_.normal_stiffness : 0.0;
  state.friction_coefficient = point_.friction_coefficient;
  return state;
}

double SurfaceLaw::load_at_rest() const { return std::max(point_.preload, 0.0); }

std::vector<double> SurfaceLaw::kinks() const {
  if (point_.normal_stiffness == 0.0) return {};
  return {-point_.preload / point_.normal_stiffness};
}

}  // namespace microslip::contact
