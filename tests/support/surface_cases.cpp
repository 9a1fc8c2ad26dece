#include "support/surface_cases.hpp"

namespace microslip::test {
namespace {

using contact::FrictionLaw;
using contact::RoughSurface;
using contact::SurfaceLaw;

double typical_decay(const MotionCase& c) {
  return c.point.tangential_stiffness / (surface_frequency * friction_scale(c));
}
SurfaceLaw falling(const MotionCase& c) {
  const double mu = c.point.friction_coefficient;
  return {c.point, 0.0, FrictionLaw::exponential(mu, 0.5 * mu, typical_decay(c))};
}
SurfaceLaw rising(const MotionCase& c) {
  const double mu = c.point.friction_coefficient;
  return {c.point, 0.0, FrictionLaw::exponential(mu, 1.5 * mu, typical_decay(c))};
}
SurfaceLaw hyperbolic(const MotionCase& c) {
  return {c.point, 0.0, FrictionLaw::hyperbolic(c.point.friction_coefficient, typical_decay(c))};
}
RoughSurface roughness(const MotionCase& c, bool gaussian) {
  const double height = 0.5 * normal_scale(c) / c.point.normal_stiffness;
  return gaussian ? RoughSurface::matching_gaussian(height) : RoughSurface::cubic(height);
}
SurfaceLaw cubic(const MotionCase& c) {
  return {c.point, 0.0, FrictionLaw::constant(c.point.friction_coefficient), roughness(c, false)};
}
SurfaceLaw gaussian(const MotionCase& c) {
  return {c.point, 0.0, FrictionLaw::constant(c.point.friction_coefficient), roughness(c, true)};
}

}  // namespace

SurfaceLaw smooth_surface(const MotionCase& c) { return {c.point, c.point.tangential_stiffness}; }

const std::vector<SurfaceCase>& surface_cases() {
  static const std::vector<SurfaceCase> all{{"smooth", smooth_surface}, {"falling", falling},
                                            {"rising", rising},         {"hyperbolic", hyperbolic},
                                            {"cubic", cubic},           {"gaussian", gaussian}};
  return all;
}

}  // namespace microslip::test
