/// @file
/// What the elements of a mesh do to its frequencies, where there is no coarser mesh that could
/// tell it: of a file, or of elements that are larger than the body is thick.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "mesh/mesh.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/structure/structure_task.hpp"

namespace microslip::pipelines {

/// (f − f₀)/f [-] of modes, by fem/stress_jumps.hpp.
struct FrequencyExcess {
  std::vector<Eigen::Index> modes{};  ///< from 0; none: not told
  Eigen::VectorXd excess{};           ///< of each of them
  /// Not of elements of first order, which lock, in bending and as ν nears 1/2: that makes no jump.
  bool is_whole = true;
};

/// Of the modes up to the end of the frequency range, at least one and at most the last four, or
/// the first four without a range. Not told of modes and matrices of another code, nor of a body
/// that rotates, whose stiffness is not that of its elements alone.
/// @param modes  of the mesh as it is.
[[nodiscard]] FrequencyExcess frequency_excess(const mesh::Mesh& mesh, const StructureModes& modes,
                                               const SceneDescription& scene);

/// Whether elements are those of a file, as it has them: of others the error budget tells what they
/// err by.
[[nodiscard]] bool has_elements_of_file(const SceneDescription& scene);

struct MeshExcess {
  std::string
      text;  ///< of the modes up to the end of the frequency range, or the first; "": not told
  std::string warning;  ///< where it is more than 2 %, and no accuracy is asked for that cuts them
};

/// What is said of it, of elements of a file.
[[nodiscard]] MeshExcess mesh_excess(const FrequencyExcess& excess, const SceneDescription& scene);

}  // namespace microslip::pipelines
