/// @file
/// Mesh files of any format → Mesh. gmsh's are read as they are; those of other codes are converted first, by
/// share/scripts/convert_mesh.py: a child process with limits, whose crash or hang is an error and no more.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "mesh/mesh.hpp"
#include "pipelines/import/conversion.hpp"
#include "pipelines/scene/scene_description.hpp"

namespace microslip::pipelines {

struct MeshOfFile {
  mesh::Mesh mesh;
  std::optional<double>
      length_unit;  ///< metres per unit; none: nobody says, the mesh is in the unit of the file
};

/// @param length_unit  metres per unit of the file; none: what the file says.
/// @throws SceneError, mesh::MeshError  a file that is not there, not of its format or damaged; a converter that
///         crashed or went beyond its limits.  @throws InterruptedError
[[nodiscard]] MeshOfFile read_mesh(const std::filesystem::path& file,
                                   std::optional<double> length_unit,
                                   const ConverterLimits& limits = {});

/// The mesh of a scene. @throws SceneError  as above; neither scene nor file tells the unit: what the size would be.
[[nodiscard]] mesh::Mesh read_mesh(const MeshFileModel& model);

/// "60 x 149 x 60 m, 60 x 149 x 60 mm or 1.52 x 3.79 x 1.52 m (inches)": a size without a unit.
[[nodiscard]] std::string size_readings(const mesh::Mesh& mesh);

}  // namespace microslip::pipelines
