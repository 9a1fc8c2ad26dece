#include "contact/point/scaled_point.hpp"

#include <algorithm>
#include <cmath>

namespace microslip::contact {
namespace {

/// Of two of the largest force.
int exponent_of(const SurfaceLaw& surface, const Harmonics& x) {
  const Eigen::Index moving = x.rows().rows() - 1;
  const auto amplitude = [&](Eigen::Index i) {
    return x.rows().col(i).tail(moving).cwiseAbs().maxCoeff();
  };
  const PointParameters& point = surface.point();
  const double load = std::max(std::abs(point.preload),
                               point.normal_stiffness * x.rows().col(1).cwiseAbs().maxCoeff());
  const double force =
      std::max({surface.first_stiffness() * amplitude(0), surface.second_stiffness() * amplitude(2),
                point.friction_coefficient * load});
  constexpr int largest = 1000;  // both the factor and its inverse are normal numbers
  if (!(force > 0.0) || !std::isfinite(force)) return 0;
  return std::clamp(std::ilogb(force), -largest, largest);
}

}  // namespace

ScaledPoint::ScaledPoint(const SurfaceLaw& surface, const Harmonics& x, double omega)
    : law(surface), motion(x), frequency(omega) {
  if (!surface.is_smooth()) return;
  const int exponent = exponent_of(surface, x);
  if (exponent == 0) return;
  const double factor = std::ldexp(1.0, -exponent);
  unit = std::ldexp(1.0, exponent);
  law = surface.in_units(factor);
  motion.rows() *= factor;
  frequency *= unit;
}

void ScaledPoint::count_back(PointHistory& history) const {
  history.force.rows() *= unit;
  history.defect *= unit;
  history.slip_distance *= unit;
  history.dissipated_energy = history.dissipated_energy * unit * unit;
  history.normal_slip = history.normal_slip * unit * unit;
  for (PointInstant& instant : history.instants) {
    instant.motion *= unit;
    instant.traction *= unit;
    instant.slider *= unit;
  }
}

}  // namespace microslip::contact
