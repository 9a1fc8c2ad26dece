/// @file
/// The command `check`: what would be simulated and what it would cost.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/effects/curve_cost.hpp"
#include "pipelines/effects/effect_record.hpp"
#include "pipelines/effects/picture_cost.hpp"
#include "pipelines/record/run_options.hpp"
#include "pipelines/stages/stage_seconds.hpp"
#include "pipelines/structure/solver_memory.hpp"

namespace microslip::pipelines {

/// What a study is expected to cost, in seconds of one core.
struct Forecast {
  double degrees_of_freedom = 0.0;  ///< 0: the scene gives its modes
  double modes_seconds = 0.0;       ///< of mesh and modes
  ResponseSeconds response;         ///< of the curves, their errors, a best value
  std::optional<ResponseSeconds>
      response_along_r;  ///< where it is not known yet whether friction along r is called for
  PictureSeconds pictures;
  double memory_gb = 0.0;
  std::optional<SolverMemory> solver_memory;  ///< where modes are solved for
};

/// What `check` found, for scripts.
struct CheckResult {
  Forecast forecast;
  std::vector<EffectRecord> effects;
  std::vector<std::string> warnings;
};

/// `check`: what would be simulated and what it would cost, what of the mesh is used, and what is
/// unusual. Modes are asked where they are given, kept by an earlier run, or solved for in seconds;
/// where they are, curves are begun for a second.
/// @param picture  of the blade with its places marked is drawn into this file; empty: none.
/// @param options  of the run that is forecast: which parts it leaves out.
/// @throws SceneError  the scene cannot be used, or has no mesh to draw.
/// @throws fem::MemoryError  as require_memory_before_mesh(): nothing is meshed, so that names and
///         places are not checked.
/// @throws as solve_structure(), require_held() and require_curves(), where modes are known.
CheckResult check_study(const SceneDescription& scene, const std::filesystem::path& picture,
                        std::ostream& out, const RunOptions& options = {});

}  // namespace microslip::pipelines
