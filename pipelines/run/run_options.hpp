/// @file
/// How a study is run.
#pragma once

#include <filesystem>

#include "pipelines/run/progress.hpp"
#include "pipelines/run/run_folder.hpp"

namespace microslip::pipelines {

struct RunOptions {
  std::filesystem::path output;  ///< run folder; for `mesh` the file
  int jobs = 1;                  ///< curves traced at the same time, ≥ 1
  Verbosity verbosity = Verbosity::normal;
  RunStart start = RunStart::anew;
  int rank = 0;  ///< MPI rank: rank 0 alone writes
};

}  // namespace microslip::pipelines
