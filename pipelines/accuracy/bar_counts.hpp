/// @file
/// The contact points and modes of kind `bar`, which has both by formulas: with more of either it
/// is another scene.
#pragma once

#include <optional>

#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

struct BarCounts {
  int points = 0;  ///< contact.points
  int modes = 0;   ///< modes.count
};

/// Empty: of another kind.
[[nodiscard]] std::optional<BarCounts> bar_counts(const SceneDescription& scene);

/// The bar with so many; all else as in the scene, its search for a best value too.
/// @throws SceneError, RefusedError  it cannot have as many.
[[nodiscard]] SceneDescription with_bar_counts(SceneDescription scene, const BarCounts& counts);

/// What is left of an error with so many times the points: it falls as their number grows, or
/// faster, but not evenly, as places where slip ends lie between them.
[[nodiscard]] double left_with_points(double times);

/// The same of modes, whose error falls as their number grows, beside a residual as its third
/// power.
[[nodiscard]] double left_with_modes(const SceneDescription& scene, double times);

}  // namespace microslip::pipelines
