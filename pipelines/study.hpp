/// @file
/// The whole flow, stage by stage: the page to read first. Each function is one command of the program
/// and returns its exit code; errors are thrown (exit_code.hpp).
#pragma once

#include <filesystem>
#include <iosfwd>

#include "pipelines/progress.hpp"
#include "pipelines/scene_description.hpp"

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
/// `check`: what would be simulated and what it would cost; solves nothing.
int check_study(const SceneDescription& scene, std::ostream& out);
/// `report`: plots and report from a run folder.
int report_study(const std::filesystem::path& folder);

}  // namespace microslip::pipelines
