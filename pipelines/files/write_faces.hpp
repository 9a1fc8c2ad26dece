/// @file
/// The faces of a STEP file for ParaView, and as a picture.
#pragma once

#include <filesystem>
#include <string>

#include "mesh/step_geometry.hpp"

namespace microslip::pipelines {

/// Triangles of the faces (.vtp) with cell arrays `face` (number) and `normal`.
/// @throws ExhaustedError  cannot be written.
void write_faces_vtp(const std::filesystem::path& file, const mesh::StepGeometry& geometry);

/// The body from two sides, coloured and numbered by face (share/scripts/plot_faces.py).
/// @param picture  .png, .svg or .pdf; its folder must exist.
/// @return  empty, or why there is no picture.
[[nodiscard]] std::string draw_faces(const std::filesystem::path& picture, const std::string& title,
                                     const mesh::StepGeometry& geometry);

}  // namespace microslip::pipelines
