/// @file
/// Files of other codes are read by scripts of share/scripts, children with limits: a crash or a
/// hang is an error of the file and no more.
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace microslip::pipelines {

/// Of a converter. Beside these it has a second and 40 MB more for every megabyte of the file.
struct ConverterLimits {
  double seconds = 60.0;      ///< wall time and processor time
  double memory_mb = 4000.0;  ///< address space
};

/// Runs `script` FILE OUTPUT FACTS.json SECONDS MEGABYTES, and DECK where there is one.
/// @param script  e.g. "convert_mesh.py"; MICROSLIP_CONVERTER stands in for it.
/// @param deck    a second file that is needed to understand the first; empty: none.
/// @param output  what the script writes; its facts are written beside it.
/// @return  the facts.
/// @throws mesh::MeshError  no such file.  @throws SceneError  what the script says of the files;
///         that it crashed, left
///         nothing, or went beyond its limits.  @throws InterruptedError
nlohmann::json convert_file(const std::string& script, const std::filesystem::path& file,
                            const std::filesystem::path& output, const ConverterLimits& limits = {},
                            const std::filesystem::path& deck = {});

}  // namespace microslip::pipelines
