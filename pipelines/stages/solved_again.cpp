#include "pipelines/stages/solved_again.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "pipelines/accuracy/amplitude_band.hpp"
#include "pipelines/accuracy/effect_bounds.hpp"
#include "pipelines/accuracy/models_left_out.hpp"
#include "pipelines/description/curve_request.hpp"
#include "pipelines/description/damping_ratios.hpp"
#include "pipelines/effects/effects.hpp"
#include "pipelines/effects/motion_along_r.hpp"
#include "pipelines/response/highest_peak.hpp"
#include "pipelines/stages/curve_family.hpp"
#include "pipelines/stages/stage_seconds.hpp"
#include "pipelines/structure/extrapolated_modes.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/effect_table.hpp"

namespace microslip::pipelines {
namespace {

StructurePointer structure_of(const Solution& before, const Refinement& step,
                              const SolvedAgain& round, int jobs, Progress& progress) {
  if (!before.structure || !step.new_mesh) return before.structure;
  const Progress::Part part = progress.part("finer mesh and its modes");
  // Two cores save little of a mesh; what its modes are extrapolated from is solved beside them.
  constexpr double without_larger = 0.7;
  const bool beside = jobs > 1 && is_extrapolated(step.scene) && std::isinf(seconds_left());
  progress.expect((beside ? without_larger : 1.0) * step.structure_seconds);
  return std::make_shared<const SolvedStructure>(
      solved_structure(step.scene, round.mesh_file(), jobs));
}

/// Those that are exact enough stay, where the others get other harmonics alone.
std::vector<std::size_t> curves_to_solve(const Solution& before, const Refinement& step) {
  std::vector<std::size_t> again;
  for (std::size_t i = 0; i < before.curves.size(); ++i) {
    const bool stays = step.only_harmonics && before.curves[i].curve.complete &&
                       is_exact(before.budgets[i], before.scene.accuracy);
    if (!stays) again.push_back(i);
  }
  return again;
}

/// Solved to its end with the harmonics of a step, though the time was over before others were.
bool is_finished(const solver::ResponseCurve& curve) {
  return curve.complete && !is_unsettled(curve);
}

/// Where other harmonics alone are asked for within a budget of time: curves that are not finished
/// stay as they were, and if time was over before all errors were told again, so do the other
/// errors.
/// @param budgets  empty: there was no time for them.
/// @return false: no curve is finished.
bool keep_finished(const Solution& before, const std::vector<std::size_t>& again,
                   std::vector<CurveResult>& curves, std::vector<CurveBudget> budgets,
                   Solution& now) {
  const bool has_limit = std::isfinite(now.scene.accuracy.budget);
  const bool is_late = cut_short();
  bool any = false;
  for (std::size_t i = 0; i < again.size(); ++i) {
    const bool was_finished = before.curves[again[i]].curve.complete;
    if (has_limit && was_finished && !is_finished(curves[i].curve)) continue;
    CurveBudget& budget = now.budgets[again[i]];
    budget = is_late ? with_harmonics_of(std::move(budget),
                                         error_budget(now.model, now.scene, {}, curves[i]))
                     : std::move(budgets[i]);
    if (budget.has_bar()) {
      curves[i].band = amplitude_band(curves[i], budget);
    }
    now.curves[again[i]] = std::move(curves[i]);
    any = true;
  }
  return any;
}

/// @return false: the time was over before its end.
bool solve(const Solution& before, const Refinement& step, int jobs, Progress& progress,
           SolvedAgain& round) {
  Solution& now = round.solution;
  now.scene = step.scene;
  now.switched_on = before.switched_on;
  now.structure = structure_of(before, step, round, jobs, progress);
  if (cut_short()) return false;
  now.model = model_of(now.scene, now.structure.get(), round.warnings);
  const std::vector<std::size_t> again = curves_to_solve(before, step);
  const bool same_modes = now.structure == before.structure &&
                          now.model.frequency.size() == before.model.frequency.size();
  const std::vector<CurveRequest> all = curve_requests(now.scene);
  std::vector<CurveRequest> requests;
  std::vector<const solver::ResponseCurve*> near;
  for (const std::size_t i : again) {
    requests.push_back(all[i]);
    if (same_modes) near.push_back(&before.curves[i].curve);
  }
  progress.expect(step.curve_seconds / jobs);
  std::vector<CurveResult> curves =
      trace_again(now.model, now.scene, requests, near, jobs, progress);
  if (cut_short() && !step.only_harmonics) return false;
  now.curves = before.curves;
  now.budgets = before.budgets;
  std::vector<CurveBudget> budgets;
  if (!cut_short()) {
    const Progress::Part part = progress.part("errors of the curves");
    progress.expect(accuracy_seconds(now.model, now.scene, curves, now.degrees_of_freedom(), jobs));
    budgets = budgets_of(now.model, now.scene, now.structure.get(), jobs, curves, progress);
  }
  if (step.only_harmonics) return keep_finished(before, again, curves, std::move(budgets), now);
  for (std::size_t i = 0; i < again.size(); ++i) {
    now.curves[again[i]] = std::move(curves[i]);
    now.budgets[again[i]] = std::move(budgets[i]);
  }
  return !cut_short();
}

/// Where nothing else is the reason.
std::string why_not_compared(const std::vector<CurveResult>& curves) {
  if (std::ranges::none_of(curves, [](const auto& one) { return one.curve.complete; })) {
    return "no curve is complete";
  }
  const bool any_peak = std::ranges::any_of(curves, [](const CurveResult& one) {
    const solver::ResponsePoint* peak = highest_peak(one.curve);
    return peak != nullptr && peak->mark == solver::PointMark::peak;
  });
  return any_peak ? "the model with it was not solved" : "no curve has a peak to compare";
}

/// Effects that are left out and may have no bound, with the reason it would have.
std::vector<NoBound> without_bound(const Solution& solution) {
  std::vector<NoBound> none;
  for (const CurveBudget& budget : solution.budgets) {
    none.insert(none.end(), budget.no_bound.begin(), budget.no_bound.end());
  }
  std::string why = why_not_compared(solution.curves);
  if (was_cut_short()) why = "the time was over";
  if (!solution.scene.accuracy.error_budget) why = "accuracy.error_budget = \"off\"";
  for (std::string& name : effects_left_out(solution.model, solution.scene)) {
    none.push_back({std::move(name), why});
  }
  if (can_rub_along_r(solution.model)) {
    none.push_back({"second_direction", why});
  }
  if (only_limits(solution.scene)) why = "no curve under a load is asked for";
  if (!solution.model.patches.empty()) {
    none.push_back({"nonlinearity", why});
    none.push_back({"higher_harmonics", why});
  }
  for (const char* part : {"separation", "mean_coupling"}) {
    if (!solution.model.effects.normal_motion) {
      none.push_back({part, "it comes with normal_motion, and is part of what that changes"});
    }
  }
  return none;
}

bool is_complete(const std::vector<CurveResult>& curves) {
  return std::ranges::all_of(curves, [](const CurveResult& one) { return one.curve.complete; });
}

}  // namespace

std::optional<SolvedAgain> solved_again(const Solution& before, const Refinement& step, int jobs,
                                        Progress& progress, std::string& obstacle) {
  try {
    std::optional<SolvedAgain> round(std::in_place);
    if (!solve(before, step, jobs, progress, *round)) return std::nullopt;
    if (is_complete(before.curves) && !is_complete(round->solution.curves)) {
      obstacle = "a curve is not complete then";
      return std::nullopt;
    }
    return round;
  } catch (const InterruptedError&) {
    throw;
  } catch (const std::exception& error) {  // what is there stays
    obstacle = error.what();
    return std::nullopt;
  }
}

void keep_solved_again(const SolvedAgain& round, bool new_mesh, RunRecord& record) {
  const Solution& now = round.solution;
  record.begin_again();
  if (new_mesh) {
    if (element_size_of(now.scene)) {
      std::filesystem::copy_file(round.mesh_file(), record.mesh_file(),
                                 std::filesystem::copy_options::overwrite_existing);
    }
    record.keep_mesh(now.structure->mesh, now.scene.material.density);
    const StructureModes& modes = now.structure->modes;
    record.keep_modes(
        now.structure->mesh, modes,
        damping_ratios(now.scene.modes, modes.basis.frequency, modes.basis.n_attachment));
    if (now.structure->coarser) record.progress().info(now.structure->coarser->text);
    record.keep_structure(now.structure->mesh, modes.basis);
  }
  for (const std::string& warning : round.warnings) record.progress().warning(warning);
  record.keep_effects(effects_of(now));
  record.keep_model(now.model);
  for (const CurveResult& curve : now.curves) record.keep_curve(curve, now.model);
  record.keep_choices(now.scene);
  keep_budgets(now, record);
}

void keep_budgets(const Solution& solution, RunRecord& record) {
  const std::vector<std::string> names = effects_left_out(solution.model, solution.scene);
  for (std::size_t i = 0; i < solution.budgets.size(); ++i) {
    const CurveBudget& budget = solution.budgets[i];
    BesideBar left_out = budget.rows.empty() ? BesideBar() : beside_bar(budget.left_out, names);
    record.keep_budget(budget, std::move(left_out), solution.curves[i], solution.model);
  }
  record.keep_bounds(tolerance_of_effects(solution.scene), without_bound(solution));
}

std::vector<EffectRecord> effects_of(const Solution& solution) {
  std::vector<EffectRecord> effects = effects_of(
      solution.scene, &solution.model, solution.structure ? &solution.structure->mesh : nullptr);
  if (solution.structure) tell_moments_left_out(solution.scene, *solution.structure, effects);
  tell_switched_on(solution.switched_on, effects);
  return effects;
}

double tolerance_of_effects(const SceneDescription& scene) {
  return scene.accuracy.tolerance > 0.0 ? scene.accuracy.tolerance : worth_a_warning;
}

}  // namespace microslip::pipelines
