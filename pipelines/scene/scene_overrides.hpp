/// @file
/// "--set key.path=value": puts a value into a scene before it is checked;
/// without a value the key is taken away.
#pragma once

#include <string>

#include <toml++/toml.h>

namespace microslip::pipelines {

/// @param assignment  "response.preload=[100, 200]", "excitation.forces[0].amplitude=2 N"; the
///                    value is TOML, or else taken as a text. "response.optimum=":
///                    that key is removed.
/// @throws SceneError  no "=", an empty key, a key to remove that is not there, or a path through
///         something that is no table or list.
void apply_override(toml::table& scene, const std::string& assignment);

}  // namespace microslip::pipelines
