/// @file
/// The friction coefficient as a scene of any kind gives it: a number, an expression or a table
/// over the patch (field.hpp), or a law, one row each in friction_section.cpp. A coefficient that
/// depends on something new is a file that makes a FrictionDescription of the keys beside `law`,
/// and its row there.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "contact/patch.hpp"
#include "pipelines/description/field.hpp"
#include "pipelines/text/section_reader.hpp"

namespace microslip::pipelines {

struct FrictionDescription {
  Field at_rest;                            ///< μ over the patch, ≥ 0
  std::optional<contact::FrictionLaw> law;  ///< of the slip speed; `at_rest` is its value there
};

/// @param folder  relative files start here.
[[nodiscard]] FrictionDescription read_friction(SectionReader& section, std::string_view key,
                                                const std::filesystem::path& folder);

}  // namespace microslip::pipelines
