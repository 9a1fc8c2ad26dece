/// @file
/// The whole flow, stage by stage: the page to read first. Each function is one command of the program
/// and returns its exit code; errors are thrown (exit_code.hpp).
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/progress.hpp"
#include "pipelines/scene_description.hpp"
#include "pipelines/write_summary.hpp"

namespace microslip::pipelines {

struct RunOptions {
  std::filesystem::path output;  ///< run folder; for `mesh` the file
  int jobs = 1;                  ///< curves traced at the same time, ≥ 1
  Verbosity verbosity = Verbosity::normal;
  int rank = 0;                  ///< MPI rank: rank 0 alone writes
};

/// `run`: geometry → modes → curves → maps → best preload → plots.
int run_study(const SceneDescription& scene, const RunOptions& options);
/// `modes`: geometry → modes → contact model.
int modes_study(const SceneDescription& scene, const RunOptions& options);
/// `mesh`: geometry → mesh file.
int mesh_study(const SceneDescription& scene, const RunOptions& options);
/// What a study is expected to cost, on two cores.
struct Forecast {
  double degrees_of_freedom = 0.0;  ///< 0: the scene gives its modes
  double modes_seconds = 0.0;
  double curves_seconds = 0.0;
  std::optional<double> curves_seconds_along_r;  ///< where it is not known yet whether friction along r is called for
  double memory_gb = 0.0;
};

/// What `check` found, for scripts.
struct CheckResult {
  Forecast forecast;
  std::vector<EffectRecord> effects;
  std::vector<std::string> warnings;
};

/// `check`: what would be simulated and what it would cost; solves nothing.
CheckResult check_study(const SceneDescription& scene, std::ostream& out);
/// `report`: plots and report from a run folder.
int report_study(const std::filesystem::path& folder);

}  // namespace microslip::pipelines
