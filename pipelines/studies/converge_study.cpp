#include "pipelines/studies/converge_study.hpp"

#include <algorithm>
#include <iostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "fem/blas_threads.hpp"
#include "pipelines/accuracy/convergence.hpp"
#include "pipelines/accuracy/mesh_files.hpp"
#include "pipelines/files/plot_script.hpp"
#include "pipelines/files/write_ladder.hpp"
#include "pipelines/response/curve_requirements.hpp"
#include "pipelines/system/exit_code.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/nearest_name.hpp"

namespace microslip::pipelines {
namespace {

/// In the order in which they are asked for.
/// @throws SceneError  the scene has no such knob.
std::vector<Ladder> only(const std::vector<std::string>& knobs, std::vector<Ladder> all) {
  std::vector<Ladder> asked;
  for (const std::string& knob : knobs) {
    const auto found = std::ranges::find(all, knob, &Ladder::knob);
    if (found == all.end()) {
      std::vector<std::string_view> names;
      for (const Ladder& ladder : all) names.push_back(ladder.knob);
      const std::string near = nearest_name(knob, names);
      throw SceneError(fmt::format(
          "--knobs: \"{}\" is none of this scene, which has {}{}", knob, fmt::join(names, ", "),
          near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near)));
    }
    asked.push_back(*found);
  }
  return asked;
}

/// In place of that of the scene, or at the beginning.
void put(Ladder ladder, const char* in_place_of, std::vector<Ladder>& all) {
  std::erase_if(all, [&](const Ladder& own) { return own.knob == in_place_of; });
  all.insert(all.begin(), std::move(ladder));
}

}  // namespace

std::vector<Ladder> asked_ladders(const SceneDescription& scene, const ConvergeRequest& request) {
  std::vector<Ladder> all = ladders(scene);
  if (!request.meshes.empty()) put(ladder_of_files(scene, request.meshes), refinement_knob, all);
  if (!request.sizes.empty()) put(ladder_of_sizes(scene, request.sizes), element_size_knob, all);
  return request.knobs.empty() ? all : only(request.knobs, std::move(all));
}

int converge_study(const SceneDescription& scene, const ConvergeRequest& request,
                   const RunOptions& options) {
  require_response(scene);
  const std::vector<Ladder> climbed = asked_ladders(scene, request);  // before all else: files
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
  for (const Ladder& ladder : climbed) {
    const std::filesystem::path table = folder / (ladder.knob + ".csv");
    const auto write = [&](const std::vector<RungResult>& known) {
      write_ladder_csv(table, known);  // an interrupt leaves what there is
    };
    const std::vector<RungResult> rungs = climb(ladder, base, again, {say, write});
    if (rungs.empty()) write(rungs);
    say(ladder_text(ladder.knob, rungs));
  }
  const std::string failure =
      run_plot_script("plot_converge.py", {folder.string()}, std::chrono::seconds(120));
  if (!failure.empty()) std::cerr << "warning: " << failure << '\n';
  say("written: " + folder.string());
  return static_cast<int>(ExitCode::complete);
}

}  // namespace microslip::pipelines
