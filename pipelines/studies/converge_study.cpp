#include "pipelines/studies/converge_study.hpp"

#include <iostream>

#include <fmt/format.h>

#include "fem/blas_threads.hpp"
#include "pipelines/accuracy/convergence.hpp"
#include "pipelines/files/plot_script.hpp"
#include "pipelines/files/write_ladder.hpp"
#include "pipelines/response/curve_requirements.hpp"
#include "pipelines/system/exit_code.hpp"
#include "pipelines/system/output_file.hpp"

namespace microslip::pipelines {

int converge_study(const SceneDescription& scene, const RunOptions& options) {
  require_response(scene);
  const std::filesystem::path folder = options.output / "converge";
  const FolderToFill to_fill(folder);
  const auto say = [&](const std::string& sentence) {
    if (options.verbosity != Verbosity::quiet) std::cout << sentence << std::endl;
  };
  fem::use_one_blas_thread();  // every rung takes what it takes on one core
  // What [accuracy] says of a run has no part in it: nothing is refined, and no budget ends it.
  Repetitions again(options.repeat_seconds);
  const TimedStructure base = timed_structure(scene, again);
  say(fmt::format("mesh and modes: {:.1f} s, median of {}", base.seconds, base.runs));
  for (const Ladder& ladder : ladders(scene)) {
    const std::vector<RungResult> rungs = climb(ladder, base, again, say);
    write_ladder_csv(folder / (ladder.knob + ".csv"), rungs);
    say(ladder_text(ladder.knob, rungs));
  }
  const std::string failure =
      run_plot_script("plot_converge.py", {folder.string()}, std::chrono::seconds(120));
  if (!failure.empty()) std::cerr << "warning: " << failure << '\n';
  say("written: " + folder.string());
  return static_cast<int>(ExitCode::complete);
}

}  // namespace microslip::pipelines
