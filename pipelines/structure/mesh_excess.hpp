/// @file
/// What the elements of a mesh that is given do to its frequencies: there is no coarser mesh that
/// an error budget could tell it by.
#pragma once

#include <string>

#include "mesh/mesh.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/structure/structure_task.hpp"

namespace microslip::pipelines {

struct MeshExcess {
  std::string
      text;  ///< of the modes up to the end of the frequency range, or the first; "": not told
  std::string warning;  ///< where it is more than is asked for, or than 2 %
};

/// By fem/stress_jumps.hpp. Not told of meshes made here, of modes and matrices of another code,
/// nor of a body that rotates, whose stiffness is not that of its elements alone.
/// @param modes  of the mesh as it is.
[[nodiscard]] MeshExcess mesh_excess(const mesh::Mesh& mesh, const StructureModes& modes,
                                     const SceneDescription& scene);

}  // namespace microslip::pipelines
