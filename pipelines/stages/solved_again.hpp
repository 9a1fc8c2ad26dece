/// @file
/// A scene solved again with other settings, beside what the record has of it,
/// and put in its place.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/accuracy/refinement.hpp"
#include "pipelines/record/run_record.hpp"
#include "pipelines/stages/solution.hpp"
#include "pipelines/system/temporary_folder.hpp"

namespace microslip::pipelines {

struct SolvedAgain {
  Solution solution;
  std::vector<std::string> warnings;
  /// Where the mesher writes a mesh that may not be kept.
  std::unique_ptr<TemporaryFolder> folder = std::make_unique<TemporaryFolder>();
  [[nodiscard]] std::filesystem::path mesh_file() const { return folder->path() / "mesh.msh"; }
};

/// The scene of a step as far as its error budgets. On the same modes its curves begin near those
/// of `before`.
/// @param obstacle  why there is none; "" where time was over.
/// @return empty: not done, or a curve is not complete that was.
/// @throws InterruptedError
[[nodiscard]] std::optional<SolvedAgain> solved_again(const Solution& before,
                                                      const Refinement& step, int jobs,
                                                      Progress& progress, std::string& obstacle);

/// In the place of what the record has.
void keep_solved_again(const SolvedAgain& round, bool new_mesh, RunRecord& record);

/// Keeps curves that are there and what their errors are.
void keep_budgets(const Solution& solution, RunRecord& record);

/// The table of effects of a solution, with what a run has put back.
[[nodiscard]] std::vector<EffectRecord> effects_of(const Solution& solution);

/// From which change of a highest peak on an effect that is left out matters.
[[nodiscard]] double tolerance_of_effects(const SceneDescription& scene);

}  // namespace microslip::pipelines
