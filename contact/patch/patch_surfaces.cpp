#include "contact/patch/patch_surfaces.hpp"

namespace microslip::contact {

SurfaceLaw surface_at(const SurfaceRules& rules, const PatchSamples& samples, Eigen::Index row,
                      const PointParameters& point) {
  const FrictionLaw friction = point.has_friction() && rules.friction
                                   ? *rules.friction
                                   : FrictionLaw::constant(point.friction_coefficient);
  if (!rules.roughness || !rules.local_normal_stiffness) {
    return {point, samples.stiffness(row, 2), friction, rules.roughness};
  }
  // Constants of a point have its bodies in series; rough surfaces change their part alone.
  PointParameters local = point;
  local.tangential_stiffness = *rules.local_tangential_stiffness;
  local.normal_stiffness = *rules.local_normal_stiffness;
  SeriesCompliance bodies;
  if (samples.compliance.rows() > 0) {
    bodies = {samples.compliance(row, 0), samples.compliance(row, 1), samples.compliance(row, 2)};
  }
  return {local, local.tangential_stiffness, friction, rules.roughness, bodies};
}

}  // namespace microslip::contact
