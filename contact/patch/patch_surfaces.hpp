/// @file
/// The two surfaces that rub at a place of a patch.
#pragma once

#include "contact/patch.hpp"
#include "contact/surface/surface_law.hpp"

namespace microslip::contact {

/// Surfaces at one place with a rest load of its own. The place for a friction coefficient that
/// depends on something new: its rule is a row of SurfaceRules, this hands it to the SurfaceLaw.
/// @param point  constants, bodies in series included; its rest load is taken as it is.
/// @param row    of the place in the samples.
/// @throws std::invalid_argument  as SurfaceLaw.
[[nodiscard]] SurfaceLaw surface_at(const SurfaceRules& rules, const PatchSamples& samples,
                                    Eigen::Index row, const PointParameters& point);

}  // namespace microslip::contact
