/// @file
/// What curves are expected to cost, by the method of their contact points.
#pragma once

#include "pipelines/scene/scene_description.hpp"

namespace microslip::pipelines {

/// What decides the method of the points.
struct PointMethod {
  bool second_direction = false;
  bool several_harmonics = false;
  bool chosen_harmonics = false;
};

/// What a scene has. @param second_direction  as decided.
[[nodiscard]] PointMethod method_of(const SceneDescription& scene, bool second_direction);

/// All curves of a scene on one core [s], those of a search for a best value included.
[[nodiscard]] double curves_seconds(const SceneDescription& scene, const PointMethod& method);

/// A search for other solutions with every curve [s]. @param n_starts  per frequency.
[[nodiscard]] double search_seconds(const SceneDescription& scene, const PointMethod& method,
                                    int n_starts);

}  // namespace microslip::pipelines
