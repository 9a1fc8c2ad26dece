#include "pipelines/stages/accurate_curves.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mesh/refined_mesh.hpp"
#include "pipelines/accuracy/refinement.hpp"
#include "pipelines/effects/picture_cost.hpp"
#include "pipelines/stages/missed_effects.hpp"
#include "pipelines/stages/solved_again.hpp"
#include "pipelines/stages/stage_seconds.hpp"
#include "pipelines/structure/solver_memory.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/machine_speed.hpp"
#include "pipelines/text/rounded.hpp"

namespace microslip::pipelines {
namespace {

constexpr int most_rounds = 6;

double seconds_of_errors(const CurveBudget& budget) {
  double seconds = 0.0;
  for (const ErrorRow& row : budget.rows) {
    if (row.goal == peak_amplitude_goal) seconds += row.seconds;
  }
  return seconds;
}

/// Maps, and the search for a best value, as the curves are now.
double seconds_after(const Solution& solution, const RunOptions& options) {
  const SceneDescription& scene = solution.scene;
  const double maps = options.maps ? picture_seconds(scene).maps / options.jobs : 0.0;
  if (!scene.response->optimum) return maps;
  return maps + optimum_seconds(solution.model, scene, solution.curves, options.bracket);
}

SpentSeconds spent_on(const Solution& solution, const RunOptions& options) {
  const SceneDescription& scene = solution.scene;
  SpentSeconds spent;
  spent.available = seconds_to_work();
  spent.jobs = options.jobs;
  spent.after = seconds_after(solution, options);
  if (solution.structure) {
    spent.structure = seconds_of_structure(solution.structure->modes);
    spent.extrapolated = solution.structure->coarser != nullptr;
    spent.linear_elements = !mesh::has_midside_nodes(solution.structure->mesh);
    spent.cuts_in_memory =
        cuts_in_memory(solution.structure->mesh, scene.settings.basis.solver, most_cuts);
  }
  double inexact_curves = 0.0;
  double inexact_errors = 0.0;
  for (std::size_t i = 0; i < solution.curves.size(); ++i) {
    const double curve = solution.curves[i].curve.seconds;
    const double errors = seconds_of_errors(solution.budgets[i]);
    spent.curves += curve;
    spent.errors += errors;
    if (is_exact(solution.budgets[i], solution.scene.accuracy)) continue;
    inexact_curves += curve;
    inexact_errors += errors;
  }
  spent.inexact_curves = inexact_curves;
  spent.inexact_errors = inexact_errors;
  return spent;
}

double bar_of(const Solution& solution) {
  return largest_bar(solution.budgets, solution.scene.accuracy.goals);
}

/// The round of a step. @return empty: not done, and `obstacle` says why; "" where time was over.
std::optional<SolvedAgain> refined(const Solution& before, const Refinement& step, int jobs,
                                   Progress& progress, std::string& obstacle) {
  std::optional<SolvedAgain> round = solved_again(before, step, jobs, progress, obstacle);
  // A coarse mesh tells too small an error where elements twice as large miss a part of the body:
  // that of a finer one is told better, though it may be the larger one.
  // Where time may be over before the next round, what is told counts.
  constexpr double of_coarse_mesh = 1.5;
  const bool has_time = !std::isfinite(before.scene.accuracy.budget);
  const double most = (step.new_mesh && has_time ? of_coarse_mesh : 1.0) * bar_of(before);
  const bool told_less = has_mesh_to_tell(before.scene, before.budgets);
  if (round && !told_less && bar_of(round->solution) > most) {
    obstacle = "the errors are larger then";
    return std::nullopt;
  }
  return round;
}

/// To two digits.
std::string seconds_text(double seconds) {
  if (seconds < 100.0) return fmt::format("{:.2g} s", seconds);
  const double unit = std::pow(10.0, std::floor(std::log10(seconds)) - 1.0);
  return fmt::format("{:.0f} s", unit * std::round(seconds / unit));
}

/// With more digits where two would say that what was asked for is reached, and it is not.
std::string reached_percent(const AccuracySummary& accuracy) {
  std::string text = percent_text(accuracy.reached);
  const bool hides = accuracy.reached > accuracy.asked && text == percent_text(accuracy.asked);
  return hides ? fmt::format("{:.4g} %", 100.0 * accuracy.reached) : text;
}

std::string reached_text(const AccuracySummary& accuracy) {
  if (!std::isfinite(accuracy.reached)) {
    std::string text =
        fmt::format("asked for {}; what is reached is not known", percent_text(accuracy.asked));
    if (accuracy.not_known.empty()) return text;
    return fmt::format("{}: errors of {} could not be told", text,
                       fmt::join(accuracy.not_known, ", "));
  }
  std::string text = fmt::format("asked for {}, reached {}", percent_text(accuracy.asked),
                                 reached_percent(accuracy));
  if (!accuracy.not_known.empty()) {
    text += fmt::format(", not counting {}", fmt::join(accuracy.not_known, ", "));
  }
  return text + after_bar(accuracy.left_out);
}

void look_at(const Solution& solution, RunRecord& record, AccuracySummary& accuracy) {
  accuracy.reached = bar_of(solution);
  accuracy.not_known = not_in_bars(solution.budgets);
  accuracy.left_out = record.left_out();
}

/// A curve that closer harmonics gave no bar once is not cured by closer ones: the others are what
/// is refined.
std::vector<CurveBudget> to_refine(const Solution& solution, bool was_lost) {
  std::vector<CurveBudget> budgets = solution.budgets;
  if (was_lost) {
    std::erase_if(budgets,
                  [](const CurveBudget& one) { return !one.unknown.empty() && !one.has_bar(); });
  }
  return budgets;
}

/// Else nothing has an error that is told: limits of modes that are given.
bool has_budgets(const Solution& solution) {
  return std::ranges::any_of(solution.budgets, [](const CurveBudget& one) {
    return !one.rows.empty() || !one.unknown.empty();
  });
}

}  // namespace

double seconds_of_structure(const StructureModes& modes) {
  constexpr double all = 2.5;  // times the eigensolver's: the default blade of 3 and of 2.55 mm
  constexpr double per_freedom = 1.5e-4;
  const fem::ModalTimings& of = modes.timings;
  const double measured = of.assembly + of.ordering + of.factorisation + of.eigensolve + of.inertia;
  if (measured > 0.0) return all * measured;
  return machine_slowness() * per_freedom * static_cast<double>(modes.n_dofs);  // from the cache
}

void refine_to_tolerance(Solution& solution, const RunOptions& options, RunRecord& record) {
  AccuracySummary accuracy;
  accuracy.asked = solution.scene.accuracy.tolerance;
  if (accuracy.asked == 0.0) return;
  look_at(solution, record, accuracy);
  bool puts_back = true;
  bool was_lost = false;  // a bar, with chosen harmonics
  std::string missing = "more rounds of refinement would be needed";
  for (int i = 0; i < most_rounds && has_budgets(solution); ++i) {
    const bool lacks_mesh = has_mesh_to_tell(solution.scene, solution.budgets);
    if (accuracy.reached <= accuracy.asked && !lacks_mesh) break;
    std::string left;
    const SpentSeconds spent = spent_on(solution, options);
    const auto next =
        refinement(solution.scene, to_refine(solution, was_lost), accuracy.asked, spent, left);
    missing =
        next ? fmt::format("next: {}, some {} or more", next->text, seconds_text(next->seconds))
             : fmt::format("this program cannot refine what is left{}{}", left.empty() ? "" : ": ",
                           left);
    // A mesh that is begun cannot be stopped, and a best value that is not found to its end is
    // none; what curves take is told less well. Time that a round would only use up is left to
    // those.
    const double unsure = next && (next->new_mesh || solution.scene.response->optimum) ? 1.0 : 2.0;
    const bool too_long = next && next->until_end > unsure * spent.available;
    if (!next || cut_short() || (too_long && leave_out())) break;
    record.progress().info(fmt::format("{}; now with {}, some {} of one core",
                                       reached_text(accuracy), next->text,
                                       seconds_text(next->seconds)));
    const double begin = seconds_spent();
    std::string obstacle;
    std::optional<SolvedAgain> round =
        refined(solution, *next, options.jobs, record.progress(), obstacle);
    if (!round) {
      missing =
          fmt::format("next: {}, more than {}", next->text, seconds_text(seconds_spent() - begin));
      if (!obstacle.empty()) missing = fmt::format("{} cannot be kept: {}", next->text, obstacle);
      break;
    }
    keep_solved_again(*round, next->new_mesh, record);
    solution = std::move(round->solution);
    accuracy.refined.push_back(next->text);
    // What was rightly left out of the coarser model need not be so of this one.
    if (puts_back) puts_back = put_back_missed_effects(solution, options.jobs, record);
    look_at(solution, record, accuracy);
    was_lost = !std::isfinite(accuracy.reached);
  }
  const bool met = accuracy.reached <= accuracy.asked;
  accuracy.out_of_time = !met && was_cut_short();
  const bool lacks_basis =
      std::ranges::find(accuracy.not_known, "basis") != accuracy.not_known.end();
  if (met && has_mesh_to_tell(solution.scene, solution.budgets)) {
    record.progress().warning(fmt::format("{}; {}", reached_text(accuracy), missing));
  } else if (met && lacks_basis) {
    record.progress().warning(
        fmt::format("{}; what more modes do is not known{}", reached_text(accuracy),
                    solution.scene.settings.basis.residual == ResidualKind::attachment
                        ? ""
                        : ": modes.residual = \"attachment\" has shapes that tell it"));
  } else if (met) {
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
