/// @file
/// A face of a STEP file by what a person sees of it → its number.
#pragma once

#include <string>
#include <vector>

#include "mesh/step_geometry.hpp"
#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

/// The number of the face a choice means.
/// A point means the nearest face, and must be on it to 0.5 % of the body; a normal the face that
/// has it to 2 degrees and, with `near`, is the nearest of those. Of two faces nearer to each other
/// than 0.1 % of the body none is meant.
/// @param place  "file:line: key", for messages.
/// @throws SceneError  no face or several; with those that come near.
[[nodiscard]] int chosen_face(const mesh::StepGeometry& geometry, const FaceChoice& choice,
                              const std::string& place);

/// Of every choice. @throws SceneError  as above; a face twice.
[[nodiscard]] std::vector<int> chosen_faces(const mesh::StepGeometry& geometry,
                                            const FaceDescription& face);

/// Distance of a point from each face, in their order [m].
[[nodiscard]] std::vector<double> distances(const mesh::StepGeometry& geometry,
                                            const Eigen::Vector3d& point);

/// Longest side of the bounding box [m].
[[nodiscard]] double longest_side(const mesh::StepGeometry& geometry);

}  // namespace microslip::pipelines
