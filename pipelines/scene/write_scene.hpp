/// @file
/// The completed scene as TOML: sections and keys in the order of the templates, numbers with the
/// fewest digits that read back to the same double.
#pragma once

#include <string>
#include <string_view>

#include <toml++/toml.h>

namespace microslip::pipelines {

/// @param scene  title and sections, every default filled in.
/// @param kind   of the model: decides the order.
[[nodiscard]] std::string scene_as_toml(const toml::table& scene, std::string_view kind);

}  // namespace microslip::pipelines
