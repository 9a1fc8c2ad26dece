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
  /// Integrated in time at the highest peak of each curve, on from the motion there.
  bool in_time = false;
  std::string refused{};  ///< why the scene cannot be so; empty: it can
};

struct Ladder {
  /// element_size, mesh_file, refinement, modes, residual, attachment_degree, cells, fit,
  /// second_direction, points, harmonics, instants, steps, method.
  std::string knob;
  std::string source;  ///< of error that it refines, as in ErrorRow
  std::vector<Rung> rungs;
};

/// Of a mesh file: from as it is to each element cut once more along each edge than the scene says.
inline constexpr const char* refinement_knob = "refinement";

/// Of a geometry that is meshed here.
inline constexpr const char* element_size_knob = "element_size";

/// The scene as it is, its harmonics not checked: what is timed is the curve.
[[nodiscard]] Rung rung_of(const SceneDescription& scene, std::string value, double size);

/// Element sizes that are asked for. @param sizes  from coarse to fine [m].
/// @throws SceneError  of a kind whose elements are not made here; one size; another order.
[[nodiscard]] Ladder ladder_of_sizes(const SceneDescription& scene,
                                     const std::vector<double>& sizes);

/// Those that the scene has: of kinds without a mesh the harmonics, of bars their points and modes
/// too; integrated in time, the steps in place of harmonics. Without a mesh balance and integration
/// are set against each other.
[[nodiscard]] std::vector<Ladder> ladders(const SceneDescription& scene);

}  // namespace microslip::pipelines
