/// @file
/// How a study is run.
#pragma once

#include <filesystem>

#include "pipelines/record/progress.hpp"
#include "pipelines/record/run_folder.hpp"

namespace microslip::pipelines {

struct RunOptions {
  std::filesystem::path output;  ///< run folder; for `mesh` the file
  int jobs = 1;                  ///< curves traced at the same time, ≥ 1
  Verbosity verbosity = Verbosity::normal;
  RunStart start = RunStart::anew;
  std::filesystem::path
      cache;  ///< of results of earlier runs (system/result_cache.hpp); empty: none
  double repeat_seconds = 0.0;  ///< of converge: for stages timed again, three times at most
  bool plots = true;            ///< pictures and report.html; report.md is always written
  bool maps = true;             ///< contact maps and the motion at the peaks
  bool bracket = true;          ///< the search for a best value again with other contact data
};

}  // namespace microslip::pipelines
