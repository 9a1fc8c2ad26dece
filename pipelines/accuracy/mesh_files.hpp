/// @file
/// Several meshes of one body as a ladder: `converge --meshes`.
///
///   h = (V/n)^(1/3)                                                                            (1)
///
/// is the size of n elements in a volume V: halved where each is split once.
#pragma once

#include <string>
#include <vector>

#include "pipelines/accuracy/ladders.hpp"

namespace microslip::pipelines {

/// Reads every file before anything is solved on one of them. Surfaces, supports and points are
/// those that the scene names, in each.
/// @param scene  of kind "mesh"; its length_unit holds for every file.
/// @param files  from coarse to fine, relative to the working folder.
/// @return knob `mesh_file`. Where elements are not of the same types everywhere, their sizes do
///         not compare: no rung has one, and no order is told.
/// @throws SceneError  another kind, one file alone, a file that cannot be used or lacks a name,
///         one that is not finer than the file before, or no mesh of the same body.
[[nodiscard]] Ladder ladder_of_files(const SceneDescription& scene,
                                     const std::vector<std::string>& files);

}  // namespace microslip::pipelines
