/// @file
/// Whether the text of a STEP file holds together, before OpenCASCADE reads it, which may search
/// for hours for what is not there: statements are written as ISO 10303-21 has them, and what they
/// refer to is defined, once.
#pragma once

#include <filesystem>
#include <string_view>

namespace microslip::mesh {

/// @throws MeshError  with file, line and statement: a reference to nothing, a number given twice,
///                    parentheses that do not close, what is no value.
void require_sound_statements(std::string_view text, const std::filesystem::path& file);

}  // namespace microslip::mesh
