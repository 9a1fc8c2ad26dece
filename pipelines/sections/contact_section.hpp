/// @file
/// The [contact] section: surface, stiffness, friction and the laws of the two surfaces.
#pragma once

#include <filesystem>
#include <optional>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/text/section_reader.hpp"

namespace microslip::pipelines {

/// Kinds with a mesh. @param folder  relative files start here.
[[nodiscard]] ContactDescription read_contact(SectionReader section,
                                              const std::filesystem::path& folder);

/// How it is discretised.
[[nodiscard]] PatchSettings read_patch_settings(const SectionReader& section);

/// Modal scenes: laws beside the constants that the points carry, or in their place.
/// @param model             its points take friction that depends on the place.
/// @param wear_coefficient  [m²/N], written.
[[nodiscard]] contact::SurfaceRules read_surface_rules(SectionReader section,
                                                       const std::filesystem::path& folder,
                                                       ModalModel& model, double& wear_coefficient);

/// `roughness` of one surface, or of two: variances of independent heights add. None: smooth.
[[nodiscard]] std::optional<contact::RoughSurface> read_roughness(const SectionReader& section);

}  // namespace microslip::pipelines
