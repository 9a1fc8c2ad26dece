#include "pipelines/run/best_value.hpp"

#include <cmath>
#include <exception>
#include <optional>
#include <utility>

#include "pipelines/accuracy/optimum_budget.hpp"
#include "pipelines/response/optimum_stage.hpp"
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

void find_best_value(const Solution& solution, const RunOptions& options, RunRecord& record) {
  record.stage("optimum");
  const SceneDescription& scene = solution.scene;
  OptimumSearch search(solution.model, scene, solution.structure, options.jobs);
  if (const std::string text = search.warning(); !text.empty()) record.progress().warning(text);
  solver::Optimum best;
  std::optional<OptimumBracket> bracket;
  // The search itself keeps little more than one core busy. Where time may run out it comes first;
  // another number than the preload may need other modes, which one thread alone may ask for.
  const bool beside = options.bracket && options.jobs > 1 && !std::isfinite(seconds_left()) &&
                      scene.response->optimum->of_preload() && search.bracket_by_few();
  std::exception_ptr failure;  // of the bracket: what the search has found is kept all the same
  in_parallel(beside ? 2 : 1, 2, [&](std::size_t task) {
    if (task == 0) best = search.best();
    if (task == 0) return;
    try {
      bracket = search.bracket(options.jobs - 1);
    } catch (...) {
      failure = std::current_exception();
    }
  });
  record.keep_optimum(solution.model, *scene.response->optimum, best,
                      budget_of(solution, best, options.jobs));
  if (failure) std::rethrow_exception(failure);
  if (!bracket && options.bracket && !cut_short()) bracket = search.bracket(options.jobs);
  if (bracket) record.keep_bracket(std::move(*bracket));
}

}  // namespace microslip::pipelines
