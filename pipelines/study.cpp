#include "pipelines/study.hpp"

#include "contact/spare_cores.hpp"
#include "fem/blas_threads.hpp"
#include "pipelines/effects/picture_cost.hpp"
#include "pipelines/questions/questions.hpp"
#include "pipelines/record/failed_start.hpp"
#include "pipelines/record/run_record.hpp"
#include "pipelines/response/curve_requirements.hpp"
#include "pipelines/stages/accurate_curves.hpp"
#include "pipelines/stages/best_value.hpp"
#include "pipelines/stages/curve_family.hpp"
#include "pipelines/stages/first_settings.hpp"
#include "pipelines/stages/missed_effects.hpp"
#include "pipelines/stages/model_stages.hpp"
#include "pipelines/stages/solution_maps.hpp"
#include "pipelines/stages/solved_again.hpp"
#include "pipelines/stages/stage_seconds.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/result_cache.hpp"

namespace microslip::pipelines {

int run_study(const SceneDescription& asked, const RunOptions& options) {
  begin_in(options.output, [&] { require_response(asked); });
  begin_deadline(asked.accuracy.budget);
  RunRecord record(asked, options);
  const ResultCache cache(options.cache, [&](const auto& line) { record.progress().info(line); });
  return record.run([&] {
    Solution solution{.scene = first_settings(asked), .structure = {}};
    const SceneDescription& scene = solution.scene;
    solution.structure = solved_structure(scene, options.jobs, record);
    add_model(solution, record);
    require_held(solution.model, scene);
    require_curves(solution.model, scene);
    record.stage("curves");
    record.progress().expect(curves_seconds(solution.model, scene, options.jobs));
    fem::use_one_blas_thread();
    contact::allow_cores(options.jobs);
    solution.curves = trace_family(solution.model, scene, options.jobs, record);
    record.keep_choices(scene);
    record.stage("accuracy");
    record.progress().expect(accuracy_seconds(solution.model, scene, solution.curves,
                                              solution.degrees_of_freedom(), options.jobs));
    solution.budgets = budgets_of(solution.model, scene, solution.structure.get(), options.jobs,
                                  solution.curves, record.progress());
    keep_budgets(solution, record);
    static_cast<void>(put_back_missed_effects(solution, options.jobs, record));
    refine_to_tolerance(solution, options, record);
    record.tell_effects();
    if (solution.structure)
      ask(record.progress(), scene, solution.structure->mesh, solution.curves);
    if (scene.response->optimum) {
      draw_maps_and_find_best_value(solution, options, record);
    } else if (draws_maps(scene, options)) {
      record.stage("maps");
      record.progress().expect(picture_seconds(scene).maps / options.jobs);
      draw_maps(solution, options.jobs, record);
    }
    record.stage("report");
    if (options.plots) record.progress().expect(picture_seconds(scene).plots / options.jobs);
    const Progress::Part part = record.progress().part("plots");
    record.keep_report();
  });
}

int modes_study(const SceneDescription& scene, const RunOptions& options) {
  RunRecord record(scene, options);
  const ResultCache cache(options.cache, [&](const auto& line) { record.progress().info(line); });
  return record.run([&] {
    Solution solution{.scene = scene, .structure = solved_structure(scene, options.jobs, record)};
    add_model(solution, record);
  });
}

}  // namespace microslip::pipelines
