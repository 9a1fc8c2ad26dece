#include "pipelines/run/accurate_curves.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipelines/accuracy/refinement.hpp"
#include "pipelines/effect_table.hpp"
#include "pipelines/model/effects.hpp"
#include "pipelines/run/curve_family.hpp"
#include "pipelines/scene/curve_request.hpp"
#include "pipelines/scene/damping_ratios.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/temporary_folder.hpp"

namespace microslip::pipelines {
namespace {

constexpr int most_rounds = 6;

/// Where the mesher writes a mesh that may not be kept.
struct Round {
  Solution solution;
  std::vector<std::string> warnings;
  std::unique_ptr<TemporaryFolder> folder = std::make_unique<TemporaryFolder>();
  [[nodiscard]] std::filesystem::path mesh_file() const { return folder->path() / "mesh.msh"; }
};

StructurePointer structure_of(const Solution& before, const Refinement& step, const Round& round) {
  if (!before.structure || !step.new_mesh) return before.structure;
  return std::make_shared<const SolvedStructure>(solved_structure(step.scene, round.mesh_file()));
}

/// Those that are exact enough stay, where the others get other harmonics alone.
std::vector<std::size_t> curves_to_solve(const Solution& before, const Refinement& step) {
  const double tolerance = before.scene.accuracy.tolerance;
  std::vector<std::size_t> again;
  for (std::size_t i = 0; i < before.curves.size(); ++i) {
    const CurveBudget& budget = before.budgets[i];
    const bool is_linear = budget.rows.empty() && budget.unknown.empty();
    const bool stays = step.only_harmonics && before.curves[i].curve.complete &&
                       (is_linear || largest_bar({budget}) <= tolerance);
    if (!stays) again.push_back(i);
  }
  return again;
}

SpentSeconds spent_on(const Solution& solution) {
  // Mesh and modes may come from the cache: what they took is told by their size.
  constexpr double per_freedom = 1.5e-4;
  SpentSeconds spent;
  if (solution.structure) {
    spent.structure = per_freedom * static_cast<double>(solution.structure->modes.n_dofs);
  }
  for (const CurveResult& curve : solution.curves) spent.curves += curve.curve.seconds;
  return spent;
}

/// Solves the scene of a step. @return false: the time was over before its end.
bool solve(const Solution& before, const Refinement& step, int jobs, Progress& progress,
           Round& round) {
  Solution& now = round.solution;
  now.scene = step.scene;
  now.structure = structure_of(before, step, round);
  if (cut_short()) return false;
  now.model = model_of(now.scene, now.structure.get(), round.warnings);
  const std::vector<std::size_t> again = curves_to_solve(before, step);
  std::vector<CurveRequest> requests;
  for (const std::size_t i : again) requests.push_back(curve_requests(now.scene)[i]);
  std::vector<CurveResult> curves = trace_unkept(now.model, now.scene, requests, jobs, progress);
  if (cut_short()) return false;
  std::vector<CurveBudget> budgets =
      budgets_of(now.model, now.scene, now.structure.get(), jobs, curves, progress);
  now.curves = before.curves;
  now.budgets = before.budgets;
  for (std::size_t i = 0; i < again.size(); ++i) {
    now.curves[again[i]] = std::move(curves[i]);
    now.budgets[again[i]] = std::move(budgets[i]);
  }
  return !cut_short();
}

bool is_complete(const std::vector<CurveResult>& curves) {
  return std::ranges::all_of(curves, [](const CurveResult& one) { return one.curve.complete; });
}

/// Refined, and no worse. @return why it is not; empty: it is.
std::string objection(const Solution& before, const Solution& now) {
  if (is_complete(before.curves) && !is_complete(now.curves)) return "a curve is not complete then";
  if (largest_bar(now.budgets) > largest_bar(before.budgets)) return "the errors are larger then";
  return {};
}

/// The round of a step. @return empty: not done, and `obstacle` says why; "" where time was over.
std::optional<Round> refined(const Solution& before, const Refinement& step, int jobs,
                             Progress& progress, std::string& obstacle) {
  try {
    std::optional<Round> round(std::in_place);
    if (!solve(before, step, jobs, progress, *round)) return std::nullopt;
    obstacle = objection(before, round->solution);
    if (!obstacle.empty()) return std::nullopt;
    return round;
  } catch (const InterruptedError&) {
    throw;
  } catch (const std::exception& error) {  // what is there stays
    obstacle = error.what();
    return std::nullopt;
  }
}

/// In the place of what the record has.
void keep(const Round& round, const Refinement& step, RunRecord& record) {
  const Solution& now = round.solution;
  record.begin_again();
  if (step.new_mesh) {
    std::filesystem::copy_file(round.mesh_file(), record.mesh_file(),
                               std::filesystem::copy_options::overwrite_existing);
    record.keep_mesh(now.structure->mesh, now.scene.material.density);
    const StructureModes& modes = now.structure->modes;
    record.keep_modes(
        now.structure->mesh, modes,
        damping_ratios(now.scene.modes, modes.basis.frequency, modes.basis.n_attachment));
    record.keep_structure(now.structure->mesh, modes.basis);
  }
  for (const std::string& warning : round.warnings) record.progress().warning(warning);
  record.keep_effects(effects_of(now.scene, &now.model));
  record.keep_model(now.model);
  for (const CurveResult& curve : now.curves) record.keep_curve(curve, now.model);
  record.keep_choices(now.scene);
  keep_budgets(now, record);
}

std::string percent_text(double share) { return fmt::format("{:.2g} %", 100.0 * share); }

std::string reached_text(const AccuracySummary& accuracy) {
  if (!std::isfinite(accuracy.reached)) {
    const std::string text =
        fmt::format("asked for {}; what is reached is not known", percent_text(accuracy.asked));
    if (accuracy.not_known.empty()) return text;
    return fmt::format("{}: errors of {} could not be told", text,
                       fmt::join(accuracy.not_known, ", "));
  }
  std::string text = fmt::format("asked for {}, reached {}", percent_text(accuracy.asked),
                                 percent_text(accuracy.reached));
  if (!accuracy.not_known.empty()) {
    text += fmt::format(", not counting {}", fmt::join(accuracy.not_known, ", "));
  }
  return text;
}

void look_at(const Solution& solution, AccuracySummary& accuracy) {
  accuracy.reached = largest_bar(solution.budgets);
  accuracy.not_known = not_in_bars(solution.budgets);
}

/// Only limits, or no contact: nothing has an error that is told.
bool has_budgets(const Solution& solution) {
  return std::ranges::any_of(solution.budgets, [](const CurveBudget& one) {
    return !one.rows.empty() || !one.unknown.empty();
  });
}

}  // namespace

void keep_budgets(const Solution& solution, RunRecord& record) {
  for (std::size_t i = 0; i < solution.budgets.size(); ++i) {
    record.keep_budget(solution.budgets[i], solution.curves[i], solution.model);
  }
  const double tolerance = solution.scene.accuracy.tolerance;
  record.keep_bounds(tolerance > 0.0 ? tolerance : worth_a_warning);
}

void refine_to_tolerance(Solution& solution, int jobs, RunRecord& record) {
  AccuracySummary accuracy;
  accuracy.asked = solution.scene.accuracy.tolerance;
  if (accuracy.asked == 0.0) return;
  look_at(solution, accuracy);
  std::string missing = "more rounds of refinement would be needed";
  for (int i = 0; i < most_rounds && has_budgets(solution); ++i) {
    if (accuracy.reached <= accuracy.asked) break;
    std::string left;
    const auto next =
        refinement(solution.scene, solution.budgets, accuracy.asked, spent_on(solution), left);
    missing = next ? fmt::format("next: {}, some {:.2g} s or more", next->text, next->seconds)
                   : fmt::format("this program cannot refine what is left: {}", left);
    // A mesh that is begun cannot be stopped.
    const bool too_long = next && next->new_mesh && next->seconds > seconds_left();
    if (!next || cut_short() || (too_long && leave_out())) break;
    record.progress().info(fmt::format("{}; now with {}", reached_text(accuracy), next->text));
    const double begin = seconds_spent();
    std::string obstacle;
    std::optional<Round> round = refined(solution, *next, jobs, record.progress(), obstacle);
    if (!round) {
      missing = fmt::format("next: {}, more than {:.2g} s", next->text, seconds_spent() - begin);
      if (!obstacle.empty()) missing = fmt::format("{} cannot be kept: {}", next->text, obstacle);
      break;
    }
    keep(*round, *next, record);
    solution = std::move(round->solution);
    accuracy.refined.push_back(next->text);
    look_at(solution, accuracy);
  }
  const bool met = accuracy.reached <= accuracy.asked;
  accuracy.out_of_time = !met && was_cut_short();
  if (met) {
    record.progress().info(reached_text(accuracy));
  } else if (!has_budgets(solution)) {
    accuracy.message = "no curve has an error that this program tells";
    record.progress().warning(accuracy.message);
  } else {
    accuracy.message = fmt::format("{}{}; {}", accuracy.out_of_time ? "out of time: " : "",
                                   reached_text(accuracy), missing);
    record.progress().warning(accuracy.message);
  }
  record.keep_accuracy(std::move(accuracy));
}

}  // namespace microslip::pipelines
