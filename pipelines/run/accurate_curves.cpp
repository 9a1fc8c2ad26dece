#include "pipelines/run/accurate_curves.hpp"

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "pipelines/accuracy/refinement.hpp"
#include "pipelines/model/effects.hpp"
#include "pipelines/run/curve_family.hpp"
#include "pipelines/scene/damping_ratios.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/temporary_folder.hpp"

namespace microslip::pipelines {
namespace {

constexpr int most_rounds = 6;

/// Where the mesher writes a mesh that may not be kept.
struct Round {
  Solution solution;
  TemporaryFolder folder;
  [[nodiscard]] std::filesystem::path mesh_file() const { return folder.path() / "mesh.msh"; }
};

StructurePointer structure_of(const Solution& before, const Refinement& step, const Round& round) {
  if (!before.structure) return nullptr;
  if (step.new_mesh) {
    return std::make_shared<const SolvedStructure>(solved_structure(step.scene, round.mesh_file()));
  }
  if (!step.new_basis) return before.structure;
  return std::make_shared<const SolvedStructure>(
      SolvedStructure{before.structure->mesh, solve_structure(before.structure->mesh, step.scene)});
}

/// Solves the scene of a step. @return false: the time was over before its end.
bool solve(const Solution& before, const Refinement& step, int jobs, Progress& progress,
           Round& round) {
  Solution& now = round.solution;
  now.scene = step.scene;
  now.structure = structure_of(before, step, round);
  if (time_is_short()) return false;
  std::vector<std::string> warnings;  // those of the scene are told already
  now.model = model_of(now.scene, now.structure.get(), warnings);
  now.curves = trace_unkept(now.model, now.scene, jobs, progress);
  if (time_is_short()) return false;
  now.budgets = budgets_of(now.model, now.scene, now.structure.get(), jobs, now.curves, progress);
  return !time_is_short();
}

/// In the place of what the record has.
void keep(const Round& round, const Refinement& step, RunRecord& record) {
  const Solution& now = round.solution;
  record.begin_again();
  if (step.new_mesh) {
    std::filesystem::copy_file(round.mesh_file(), record.mesh_file(),
                               std::filesystem::copy_options::overwrite_existing);
    record.keep_mesh(now.structure->mesh, now.scene.material.density);
  }
  if (step.new_mesh || step.new_basis) {
    const StructureModes& modes = now.structure->modes;
    record.keep_modes(
        now.structure->mesh, modes,
        damping_ratios(now.scene.modes, modes.basis.frequency, modes.basis.n_attachment));
    record.keep_structure(now.structure->mesh, modes.basis);
  }
  record.keep_effects(effects_of(now.scene, &now.model));
  record.keep_model(now.model);
  for (const CurveResult& curve : now.curves) record.keep_curve(curve, now.model);
  record.keep_harmonics(now.scene);
  keep_budgets(now, record);
}

std::string percent(double share) { return fmt::format("{:.2g} %", 100.0 * share); }

std::string reached_text(double asked, double reached) {
  return fmt::format("asked for {}, reached {}", percent(asked),
                     std::isfinite(reached) ? percent(reached) : "no bar for every curve");
}

/// What is still to be done, in one sentence.
std::string missing_text(const std::optional<Refinement>& next, const std::string& left,
                         double seconds) {
  if (!next) return fmt::format("this program cannot refine what is left: {}", left);
  const double price = seconds * std::max(next->factor, 2.0);
  return fmt::format("next: {}, some {:.2g} s or more", next->text, price);
}

}  // namespace

void keep_budgets(const Solution& solution, RunRecord& record) {
  for (std::size_t i = 0; i < solution.budgets.size(); ++i) {
    record.keep_budget(solution.budgets[i], solution.curves[i], solution.model);
  }
  record.keep_bounds();
}

void refine_to_tolerance(Solution& solution, int jobs, RunRecord& record) {
  const double tolerance = solution.scene.accuracy.tolerance;
  AccuracySummary summary{.asked = tolerance,
                          .reached = largest_bar(solution.budgets),
                          .refined = {},
                          .out_of_time = time_is_short(),
                          .message = {}};
  std::optional<Refinement> next;
  std::string left;
  double seconds = seconds_spent();
  for (int i = 0; tolerance > 0.0 && i < most_rounds; ++i) {
    next.reset();
    if (summary.reached <= tolerance) break;
    next = refinement(solution.scene, solution.budgets, tolerance, left);
    if (!next || time_is_short()) break;
    record.progress().info(
        fmt::format("{}; refined: {}", reached_text(tolerance, summary.reached), next->text));
    const double begin = seconds_spent();
    Round round;
    const bool done = solve(solution, *next, jobs, record.progress(), round);
    seconds = std::max(seconds, seconds_spent() - begin);
    if (!done) break;
    keep(round, *next, record);
    solution = std::move(round.solution);
    summary.refined.push_back(next->text);
    summary.reached = largest_bar(solution.budgets);
  }
  const bool met = tolerance == 0.0 || summary.reached <= tolerance;
  summary.out_of_time = time_is_short() && (!met || tolerance == 0.0);
  if (!met) {
    summary.message =
        fmt::format("{}{}; {}", summary.out_of_time ? "out of time: " : "",
                    reached_text(tolerance, summary.reached), missing_text(next, left, seconds));
    record.progress().warning(summary.message);
  } else if (summary.out_of_time) {
    summary.message = "out of time: what was solved until then is there";
    record.progress().warning(summary.message);
  } else if (tolerance > 0.0) {
    record.progress().info(reached_text(tolerance, summary.reached));
  }
  if (tolerance > 0.0 || summary.out_of_time) record.keep_accuracy(std::move(summary));
}

}  // namespace microslip::pipelines
