/// @file
/// Scene file (TOML) → SceneDescription: SI, every default filled in, everything checked.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

/// @param file       scene file; relative paths inside are relative to it.
/// @param overrides  "key.path=value" as given with --set, applied before anything is checked.
/// @throws SceneError  "file:line: key: what was expected", with the nearest known name.
[[nodiscard]] SceneDescription read_scene(const std::filesystem::path& file,
                                          const std::vector<std::string>& overrides = {});

/// The same from text. @param name    how messages call it.
///                     @param folder  what relative paths are relative to.
[[nodiscard]] SceneDescription parse_scene(const std::string& text, const std::string& name,
                                           const std::filesystem::path& folder,
                                           const std::vector<std::string>& overrides = {});

/// The scene with one number changed, and without its search for a best value. What an accuracy
/// asked for has refined stays.
/// @param key  path as of --set.
/// @throws SceneError  the value is none the key can have.
[[nodiscard]] SceneDescription with_value(const SceneDescription& scene, const std::string& key,
                                          double value);

/// The scene of a kind without mesh with one number of its formulas changed; all settings and the
/// search stay as they are, also where a run has refined them.
/// @param key  path as of --set.
/// @throws SceneError, RefusedError  the value is none the key can have.
[[nodiscard]] SceneDescription with_formula_value(SceneDescription scene, const std::string& key,
                                                  double value);

}  // namespace microslip::pipelines
