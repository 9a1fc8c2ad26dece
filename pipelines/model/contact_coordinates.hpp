/// @file
/// How few numbers move the patches as all modes do (theory 14.2).
#pragma once

#include "contact/motion_coordinates.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/model/reduced_model.hpp"

namespace microslip::pipelines {

/// The directions in which contact springs and the flexibility of the modes meet: eigenvectors of C
/// K C, K the stuck stiffness of the patches, C² the compliance of every mode, at rest or where a
/// harmonic of the range may meet its resonance. Those whose values add up to less than a tolerance
/// are left out.
/// @param model   with its patches and effects.
/// @return        none: all modes are needed, or there is no contact.
[[nodiscard]] contact::MotionCoordinates contact_coordinates(const ReducedModel& model,
                                                             const SceneDescription& scene);

}  // namespace microslip::pipelines
