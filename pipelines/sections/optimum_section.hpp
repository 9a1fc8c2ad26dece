/// @file
/// `optimum`, `optimum_range` and `optimum_at` of [response]: which number of the scene is searched
/// for its best value, between which bounds, and under which preload.
#pragma once

#include <optional>
#include <string_view>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/text/section_reader.hpp"

namespace microslip::pipelines {

/// @param response  its preloads are read already.
/// @param kind      of the model: decides the units of its keys.
/// @return no value: nothing is searched.
/// @throws SceneError  an unknown key, bounds in another unit or not in order,
///         no preload to search under.
[[nodiscard]] std::optional<OptimumRequest> read_optimum(const SectionReader& s,
                                                         const ResponseDescription& response,
                                                         std::string_view kind);

}  // namespace microslip::pipelines
