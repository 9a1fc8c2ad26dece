/// @file
/// The curves a scene asks for.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

/// What one curve is asked for: a preload, a factor on the rest loads that are given (modal scenes
/// and bars), or a linear limit.
struct CurveRequest {
  std::string name;                        ///< stem of the CSV
  PreloadEntry load;                       ///< of a number [N], or the factor
  std::string place = "response.preload";  ///< of messages
};

/// Else it is a linear limit. What presses or opens may be a number, a gap or static loads.
[[nodiscard]] bool is_loaded(const CurveRequest& request);

/// Curves of a scene in the order they are written: the asked ones,
/// then the limits of a modal scene.
[[nodiscard]] std::vector<CurveRequest> curve_requests(const SceneDescription& scene);

/// The linear limits are all curves that are asked for.
[[nodiscard]] bool only_limits(const SceneDescription& scene);

/// The same, and nothing is searched along others: no contact under a load is solved for.
[[nodiscard]] bool is_linear_study(const SceneDescription& scene);

}  // namespace microslip::pipelines
