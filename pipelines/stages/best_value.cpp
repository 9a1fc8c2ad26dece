#include "pipelines/stages/best_value.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipelines/accuracy/optimum_budget.hpp"
#include "pipelines/response/optimum_stage.hpp"
#include "pipelines/stages/kept_results.hpp"
#include "pipelines/stages/solution_maps.hpp"
#include "pipelines/stages/stage_seconds.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/in_parallel.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

std::string untold(const std::exception& error) {
  return fmt::format("how wrong the best value is is not known, as beside it: {}", error.what());
}

/// Errors about the best value of another number than the preload: each of the three scenes has
/// models of its own. No rows where a neighbour cannot be simulated, which is noted.
CurveBudget budget_of_other(OptimumSearch& search, const OptimumRequest& request,
                            solver::Optimum& best, int jobs) {
  const auto values = values_about(best.best.parameter, request.range);
  if (!best.found || !values) return {};
  std::vector<SearchedScene> scenes;
  std::vector<RicherModels> richer;
  try {
    for (const double value : *values) {
      const SearchedScene& one = scenes.emplace_back(search.at(value));
      richer.push_back(richer_models(one.model, one.scene, one.structure.get()));
      if (cut_short()) return {};
    }
  } catch (const RefusedError& error) {
    best.notes.push_back(untold(error));
    return {};
  } catch (const SceneError& error) {
    best.notes.push_back(untold(error));
    return {};
  }
  ScenesAboutBest about{};
  for (std::size_t i = 0; i < about.size(); ++i) {
    about[i] = {scenes[i].value, scenes[i].load, &scenes[i].scene, &scenes[i].model, &richer[i]};
  }
  return optimum_budget(about, best, jobs);
}

CurveBudget budget_of(const Solution& solution, OptimumSearch& search, solver::Optimum& best,
                      int jobs) {
  const SceneDescription& scene = solution.scene;
  if (!scene.accuracy.error_budget || cut_short()) return {};
  const OptimumRequest& request = *scene.response->optimum;
  if (!request.of_preload()) return budget_of_other(search, request, best, jobs);
  return optimum_budget(solution.model, scene,
                        richer_models(solution.model, scene, solution.structure.get()), best, jobs);
}

/// All of them, two at a time. @return  what each has thrown
std::vector<std::exception_ptr> run_all(const std::vector<std::function<void()>>& tasks) {
  std::vector<std::exception_ptr> failures(tasks.size());
  in_parallel(tasks.size(), 2, [&](std::size_t i) {
    try {
      tasks[i]();
    } catch (...) {
      failures[i] = std::current_exception();
    }
  });
  return failures;
}

void rethrow_first(const std::vector<std::exception_ptr>& failures) {
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

/// Its error, and a warning of what more harmonics say.
void tell_trust(const Solution& solution, OptimumSearch& search, int jobs, bool beside,
                BestValue& found) {
  std::string left_out;
  in_parallel(2, beside ? 2 : 1, [&](std::size_t i) {
    if (i == 0) found.budget = budget_of(solution, search, found.optimum, jobs);
    if (i == 1 && !cut_short()) left_out = search.left_out(found.optimum);
  });
  if (!left_out.empty()) found.optimum.warnings.push_back(std::move(left_out));
}

}  // namespace

void draw_maps_and_find_best_value(const Solution& solution, const RunOptions& options,
                                   RunRecord& record) {
  const SceneDescription& scene = solution.scene;
  // The search itself keeps little more than one core busy. Where time may run out it comes before
  // its bracket; another number than the preload may need other modes, which one thread alone may
  // ask for.
  const bool beside =
      options.jobs > 1 && !std::isfinite(seconds_left()) && scene.response->optimum->of_preload();
  const bool has_maps = draws_maps(scene, options);
  if (has_maps && !beside) {
    record.stage("maps");
    draw_maps(solution, options.jobs, record);
  }
  record.stage("optimum");
  record.progress().expect(
      optimum_seconds(solution.model, scene, solution.curves, options.bracket));
  OptimumSearch search(solution.model, scene, solution.structure, options.jobs);
  if (const std::string text = search.warning(); !text.empty()) record.progress().warning(text);
  const KeptResults kept(solution.model, scene);
  std::optional<BestValue> earlier = kept.best_value();
  const bool is_new = !earlier;
  BestValue found = is_new ? BestValue() : std::move(*earlier);
  const bool lacks_bracket = options.bracket && !found.bracket;
  std::vector<std::function<void()>> tasks;
  if (beside && has_maps) {
    tasks.emplace_back([&] {
      draw_maps(solution, is_new ? options.jobs - 1 : options.jobs, record);
      record.maps_are_drawn();
    });
  }
  if (beside && lacks_bracket && search.bracket_by_few()) {
    tasks.emplace_back([&] { found.bracket = search.bracket(options.jobs - 1); });
  }
  const auto find_best = [&] {
    found.optimum = search.best();
    // What the search has found is kept though maps or bracket have failed.
    record.note_optimum(solution.model, *scene.response->optimum, found.optimum, found.budget);
    tell_trust(solution, search, options.jobs, beside, found);
  };
  if (is_new) tasks.insert(tasks.begin(), find_best);
  const std::vector<std::exception_ptr> failures = run_all(tasks);
  if (is_new && failures.front()) std::rethrow_exception(failures.front());
  record.keep_optimum(solution.model, *scene.response->optimum, found.optimum, found.budget);
  if (std::ranges::count(scene.accuracy.goals, optimum_goal) > 0) {
    record.judge_optimum(found.budget.has_bar()
                             ? bar_of(found.budget.rows, optimum_name, optimum_goal)
                             : std::numeric_limits<double>::infinity());
  }
  rethrow_first(failures);
  if (options.bracket && !found.bracket && !cut_short()) {
    found.bracket = search.bracket(options.jobs);
  }
  if (lacks_bracket && found.bracket) search.complete(*found.bracket);
  if (is_new || lacks_bracket) kept.keep(found);
  if (options.bracket && found.bracket) record.keep_bracket(std::move(*found.bracket));
}

}  // namespace microslip::pipelines
