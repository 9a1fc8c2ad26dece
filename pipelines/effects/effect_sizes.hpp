/// @file
/// Dimensionless sizes of roughness and of moments, under the smallest load that presses, of those
/// a scene asks for.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/model/reduced_model.hpp"

namespace microslip::pipelines {

/// Of the roughness that the scene gives, simulated or not: the largest of all patches [m].
[[nodiscard]] double roughness_height(const SceneDescription& scene);

/// That height over the compression of the
/// surfaces at rest. Infinite without load.
[[nodiscard]] double roughness_size(const ReducedModel& model, const SceneDescription& scene);

/// Moment over load times half the size of its area, the larger about p and r: that of the preload,
/// or of the load that the motion of the stuck limit changes; or as much of a pressure at rest, or
/// of a motion along the face, that is uneven in another way.
/// Infinite without load. None: areas of a mesh are left out, and with them their size.
[[nodiscard]] std::optional<double> tilt_size(const ReducedModel& model,
                                              const SceneDescription& scene);

/// The same of one motion, of the load that turning changes alone.
/// @param load    of a curve, that presses.
/// @param motion  first harmonic of the modal coordinates, sine + i cosine.
[[nodiscard]] double turning_size(const ReducedModel& model, double load,
                                  const Eigen::VectorXcd& motion);

}  // namespace microslip::pipelines
