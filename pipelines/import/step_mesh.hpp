/// @file
/// STEP files: opened, their faces named as the scene says, meshed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesh/mesher_process.hpp"
#include "mesh/step_geometry.hpp"
#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

struct StepBody {
  mesh::StepSource source;
  mesh::StepGeometry geometry;
  std::vector<mesh::StepUnit> units;  ///< the file says; empty: none, lengths are as they stand
};

/// @param length_unit  metres per unit, in place of what the file says.
/// @throws mesh::MeshError  see step_length_units() and read_step().  @throws InterruptedError
[[nodiscard]] StepBody open_step(const std::filesystem::path& file,
                                 std::optional<double> length_unit);

/// "blade.step: lengths in millimetre".
[[nodiscard]] std::string unit_text(const StepBody& body);
[[nodiscard]] std::string unit_text(const StepModel& model);
/// Metres per unit, where the file says one.
[[nodiscard]] std::optional<double> unit_of_file(const StepModel& model);

/// Why the body is not of a blade's size, with what to do; empty: it is.
[[nodiscard]] std::string size_doubt(const StepBody& body);

/// Meshes the body of a scene into `file`.
/// @throws SceneError  no unit, a size that no blade has, elements too large or too many,
///         a face that is not there;
///         the key.  @throws mesh::MeshError, InterruptedError  as above.
void mesh_step_model(const StepModel& model, const std::filesystem::path& file);

}  // namespace microslip::pipelines
