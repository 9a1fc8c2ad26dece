#include "pipelines/run/best_value.hpp"

#include <cmath>
#include <cstddef>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pipelines/accuracy/optimum_budget.hpp"
#include "pipelines/response/optimum_stage.hpp"
#include "pipelines/run/solution_maps.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/in_parallel.hpp"

namespace microslip::pipelines {
namespace {

CurveBudget budget_of(const Solution& solution, const solver::Optimum& best, int jobs) {
  if (!solution.scene.accuracy.error_budget || cut_short()) return {};
  return optimum_budget(solution.model, solution.scene,
                        richer_models(solution.model, solution.scene, solution.structure.get()),
                        best, jobs);
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
  if (options.maps && !beside) {
    record.stage("maps");
    draw_maps(solution, options.jobs, record);
  }
  record.stage("optimum");
  OptimumSearch search(solution.model, scene, solution.structure, options.jobs);
  if (const std::string text = search.warning(); !text.empty()) record.progress().warning(text);
  solver::Optimum best;
  std::optional<OptimumBracket> bracket;
  std::vector<std::function<void()>> tasks{[&] { best = search.best(); }};
  if (beside && options.maps) {
    tasks.emplace_back([&] {
      draw_maps(solution, options.jobs - 1, record);
      record.maps_are_drawn();
    });
  }
  if (beside && options.bracket && search.bracket_by_few()) {
    tasks.emplace_back([&] { bracket = search.bracket(options.jobs - 1); });
  }
  std::vector<std::exception_ptr> failures(tasks.size());
  in_parallel(tasks.size(), 2, [&](std::size_t i) {
    try {
      tasks[i]();
    } catch (...) {
      failures[i] = std::current_exception();
    }
  });
  if (failures[0]) std::rethrow_exception(failures[0]);
  // What the search has found is kept though maps or bracket have failed.
  CurveBudget budget;
  record.note_optimum(solution.model, *scene.response->optimum, best, budget);
  std::string left_out;
  in_parallel(2, beside ? 2 : 1, [&](std::size_t i) {
    if (i == 0) budget = budget_of(solution, best, options.jobs);
    if (i == 1 && !cut_short()) left_out = search.left_out(best);
  });
  if (!left_out.empty()) best.warnings.push_back(std::move(left_out));
  record.keep_optimum(solution.model, *scene.response->optimum, best, budget);
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
  if (!bracket && options.bracket && !cut_short()) bracket = search.bracket(options.jobs);
  if (bracket) record.keep_bracket(std::move(*bracket));
}

}  // namespace microslip::pipelines
