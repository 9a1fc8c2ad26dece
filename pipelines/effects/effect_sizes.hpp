/// @file
/// Dimensionless sizes of what a contact is like at rest: roughness, moments. Under the smallest
/// load that presses, of those a scene asks for.
#pragma once

#include "pipelines/description/scene_description.hpp"
#include "pipelines/model/reduced_model.hpp"

namespace microslip::pipelines {

/// Height of the roughness over the compression of the surfaces at rest. Infinite without load.
[[nodiscard]] double roughness_size(const ReducedModel& model, const SceneDescription& scene);

/// Moment of the preload over load times half the size of its area, the larger about p and r.
/// Infinite without load.
[[nodiscard]] double tilt_size(const ReducedModel& model, const SceneDescription& scene);

}  // namespace microslip::pipelines
