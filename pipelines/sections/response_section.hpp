/// @file
/// The [response] section: frequency range, method, harmonics, preloads, search for a best value,
/// maps.
#pragma once

#include <string_view>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/text/section_reader.hpp"

namespace microslip::pipelines {

/// @param response  of the same section.
/// @throws SceneError  no such harmonics, or none to choose.
[[nodiscard]] HarmonicSettings read_harmonics(const SectionReader& s,
                                              const ResponseDescription& response);
/// Of kinds with a mesh: preloads in newtons, and an output by place and direction.
/// @param points  of the scene; coordinates of the output join them.
/// @throws SceneError  a value out of its range, a search without bounds.
[[nodiscard]] ResponseDescription read_response(const SectionReader& s, std::string_view kind,
                                                std::vector<PointDescription>& points);
/// Of kinds without a mesh whose preload is in newtons; their output is read by the kind.
/// @throws SceneError  as above.
[[nodiscard]] ResponseDescription read_loads(const SectionReader& s, std::string_view kind);
/// Of kinds whose preload stands with the points and is scaled.
/// @throws SceneError  as above.
[[nodiscard]] ResponseDescription read_modal_response(const SectionReader& s,
                                                      std::string_view kind);

}  // namespace microslip::pipelines
