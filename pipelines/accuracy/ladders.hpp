/// @file
/// One choice of the discretisation after the other, from coarse to fine,
/// all others as the scene has them.
#pragma once

#include <string>
#include <vector>

#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

struct Rung {
  std::string value;  ///< as the CSV has it
  double size = 0.0;  ///< of what the error is a power of; 0: it has no size
  SceneDescription scene;
  bool same_basis = true;  ///< the modes of the scene at hand serve
  bool same_mesh = true;   ///< its mesh does
};

struct Ladder {
  std::string
      knob;  ///< element_size, modes, attachment_degree, cells, fit, harmonics, second_direction
  std::string source;  ///< of error that it refines, as in ErrorRow
  std::vector<Rung> rungs;
};

/// Those that the scene has: of kinds without a mesh the harmonics alone.
[[nodiscard]] std::vector<Ladder> ladders(const SceneDescription& scene);

}  // namespace microslip::pipelines
