/// @file
/// Files that a scene names: one that is not there is told with the place that names it.
#pragma once

#include <filesystem>
#include <string>

namespace microslip::pipelines {

/// @param place  "file:line: key" that names it.
/// @throws SceneError  there is no such file: place, path, and a similar name beside it.
void require_file(const std::filesystem::path& file, const std::string& place);

}  // namespace microslip::pipelines
