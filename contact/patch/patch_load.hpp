/// @file
/// What the load of a curve is at every place of a patch, and the constants of the points under it.
///
///   load ≥ 0   presses: shared by the patches, each spread as its preload field
///   load < 0   one uniform gap −load/Σ∬k_v dA for all patches (interfaces: [response] preload)
///
/// Loads measured as a scale multiply the rest loads that are given, gaps included.
///
/// Where moments act beside the load two stiff bodies tilt against each other until the points,
/// which cannot pull, carry it (theory section 12, "Preload"): points that lift off have a gap,
/// −k_v times the opening. Where no point has normal stiffness (constant loads) the load spreads as
/// over an elastic foundation that is the same everywhere.
#pragma once

#include <vector>

#include "contact/contact_effects.hpp"
#include "contact/patch.hpp"

namespace microslip::contact {

/// Of one patch.
struct PatchLoad {
  double load = 0.0;  ///< that presses: its share [N], or the scale; a gap: the load of the curve
  double total_stiffness = 0.0;  ///< Σ∬k_v dA of all patches [N/m]
};

/// @return one per patch: in proportion to Patch::load_share.
/// @throws LoadError  a gap where no patch has normal stiffness.
[[nodiscard]] std::vector<PatchLoad> shared_load(const std::vector<Patch>& patches, double load);

/// Pressure at rest [Pa] of the points of a tilted area, in order; rough surfaces and bodies in
/// series with them included.
/// @param samples  patch.cells; or patch.vertices, all of them: meshes have one area.
/// @throws LoadError  no equilibrium; stiffness here and none there.
[[nodiscard]] Eigen::VectorXd tilted_pressures(const Patch& patch, const TiltedArea& area,
                                               const PatchSamples& samples, double load);

/// Constants of the points. @param samples  cells or vertices of the patch.
/// @throws LoadError  as tilted_pressures().
[[nodiscard]] std::vector<PointParameters> point_parameters(const Patch& patch,
                                                            const PatchSamples& samples,
                                                            const ContactEffects& effects,
                                                            const PatchLoad& load);

}  // namespace microslip::contact
