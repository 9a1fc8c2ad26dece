/// @file
/// The [contact] section: surface, stiffness, friction and the laws of the two surfaces.
#pragma once

#include <filesystem>

#include "pipelines/scene_description.hpp"
#include "pipelines/section_reader.hpp"

namespace microslip::pipelines {

/// Kinds with a mesh. @param folder  relative files start here.
[[nodiscard]] ContactDescription read_contact(SectionReader section, const std::filesystem::path& folder,
                                              ContactLaws& laws);

/// Modal scenes: laws beside the constants that the points carry.
/// @param wear_coefficient  [m²/N], written.
[[nodiscard]] ContactLaws read_contact_laws(const SectionReader& section, double& wear_coefficient);

}  // namespace microslip::pipelines
