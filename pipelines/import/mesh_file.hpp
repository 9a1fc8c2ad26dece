/// @file
/// Mesh files of any format → Mesh. gmsh's are read as they are; those of other codes are converted
/// first, by share/scripts/convert_mesh.py: a child process with limits,
/// whose crash or hang is an error and no more.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/import/conversion.hpp"

namespace microslip::pipelines {

/// What holds the structure together and is no part of the mesh: ties, equations, beams, masses.
struct LeftOut {
  std::string place;  ///< file and line of the first
  std::string what;   ///< e.g. "*TIE"
  std::string remedy;
  int count = 1;
};

struct MeshOfFile {
  mesh::Mesh mesh;
  std::optional<double>
      length_unit;  ///< metres per unit; none: nobody says, the mesh is in the unit of the file
  std::vector<LeftOut> left_out = {};   ///< one of each kind
  std::optional<double> own_unit = {};  ///< metres per unit, as the file says
};

/// @param length_unit  metres per unit of the file; none: what the file says.
/// @throws SceneError, mesh::MeshError  a file that is not there, not of its format or damaged;
///         a converter that
///         crashed or went beyond its limits.  @throws InterruptedError
[[nodiscard]] MeshOfFile read_mesh(const std::filesystem::path& file,
                                   std::optional<double> length_unit,
                                   const ConverterLimits& limits = {});

/// @throws SceneError  without what is left out the mesh alone is another structure:
///         the first of it.
void require_whole(const MeshOfFile& read);
/// The same as sentences, where modes or matrices of the whole are given.
[[nodiscard]] std::vector<std::string> left_out_remarks(const MeshOfFile& read);

/// A question: the scene has another unit than the file says.
/// "": it has not, or the file does not say; or the file is a .unv in metres, as Salome writes
/// whatever it draws in, and no blade is as long in metres.
/// @param longest  side of the mesh, in the unit of the file.
[[nodiscard]] std::string unit_question(const std::filesystem::path& file,
                                        std::optional<double> of_scene,
                                        std::optional<double> of_file, double longest);

/// The mesh of a scene; its remarks tell what is left out, and where scene and file have another
/// unit.
/// @throws SceneError  as above; neither scene nor file tells the unit: what the size would be.
[[nodiscard]] mesh::Mesh read_mesh(const MeshFileModel& model);

/// "60 x 149 x 60 m, 60 x 149 x 60 mm or 1.52 x 3.79 x 1.52 m (inches)": a size without a unit.
[[nodiscard]] std::string size_readings(const mesh::Mesh& mesh);

}  // namespace microslip::pipelines
