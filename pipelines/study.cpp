#include "pipelines/study.hpp"

#include <cmath>
#include <cstddef>
#include <exception>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "fem/ranks.hpp"
#include "fem/slepc_session.hpp"
#include "mesh/element_shape.hpp"
#include "pipelines/accuracy/convergence.hpp"
#include "pipelines/accuracy/optimum_budget.hpp"
#include "pipelines/files/plot_script.hpp"
#include "pipelines/files/write_campbell.hpp"
#include "pipelines/files/write_ladder.hpp"
#include "pipelines/files/write_report.hpp"
#include "pipelines/model/campbell.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/model/effects.hpp"
#include "pipelines/model/model_family.hpp"
#include "pipelines/model/scene_places.hpp"
#include "pipelines/model/scene_warnings.hpp"
#include "pipelines/model/static_preload.hpp"
#include "pipelines/model/structure_stage.hpp"
#include "pipelines/response/optimum_stage.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/run/accurate_curves.hpp"
#include "pipelines/run/curve_family.hpp"
#include "pipelines/run/missed_effects.hpp"
#include "pipelines/run/questions.hpp"
#include "pipelines/run/run_record.hpp"
#include "pipelines/run/solved_again.hpp"
#include "pipelines/scene/damping_ratios.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/in_parallel.hpp"
#include "pipelines/system/interrupt.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/system/result_cache.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/temporary_folder.hpp"

namespace microslip::pipelines {
namespace {

template <typename... What>
void ask(RunRecord& record, const What&... what) {
  for (const std::string& question : questions(what...)) record.progress().warning(question);
}

void tell_ranks(Progress& progress) {
  if (fem::n_ranks() == 1) return;
  progress.info(fmt::format("{} MPI ranks solve for the modes together, rank 0 does the rest",
                            fem::n_ranks()));
  if (fem::n_ranks_here() <= fem::n_cores()) return;
  progress.warning(fmt::format(
      "{} MPI ranks share {} cores of this machine and wait for each other: {} would be faster",
      fem::n_ranks_here(), fem::n_cores(), fem::n_cores()));
}

/// mesh → modes. nullptr: a kind that gives its modes itself.
StructurePointer solve(const SceneDescription& scene, RunRecord& record) {
  ask(record, scene);
  if (std::holds_alternative<ModalModel>(scene.model)) return nullptr;
  tell_ranks(record.progress());
  record.stage("mesh");
  record.keep_inputs(scene);
  const auto finished = record.finished_mesh();
  mesh::Mesh mesh =
      finished ? reread_mesh(scene, *finished) : obtain_mesh(scene, record.mesh_file());
  check_names(mesh, scene);
  record.keep_mesh(mesh, scene.material.density);
  record.keep_inputs(scene);
  for (const std::string& line : describe_places(mesh, scene)) record.progress().info(line);
  ask(record, scene, mesh);
  record.stage("modes");
  std::optional<StructureModes> modes = record.finished_modes();
  if (!modes) modes = solve_structure(mesh, scene);
  for (const std::string& warning : modes->warnings) record.progress().warning(warning);
  if (!scene.modes.residual_note.empty()) record.progress().info(scene.modes.residual_note);
  record.keep_modes(mesh, *modes,
                    damping_ratios(scene.modes, modes->basis.frequency, modes->basis.n_attachment));
  record.stage("contact");
  return std::make_shared<const SolvedStructure>(
      SolvedStructure{std::move(mesh), std::move(*modes)});
}

/// → contact: the arrays the response stage needs.
ReducedModel reduce(const SceneDescription& scene, const StructurePointer& structure,
                    RunRecord& record) {
  std::vector<std::string> warnings = scene_warnings(scene);
  ReducedModel model = model_of(scene, structure.get(), warnings);
  for (const std::string& warning : warnings) record.progress().warning(warning);
  if (model.static_preload) {
    record.progress().info(
        describe_static_preload(structure->mesh, scene, *structure->modes.static_face));
  }
  ask(record, scene, model);
  if (model.effects.second_direction) {
    record.progress().info(fmt::format(
        "friction along r is simulated: motion along r is {:.2g} % of that along p. This takes "
        "some ten times "
        "longer than friction along p; effects.second_direction = \"off\" leaves it out",
        100.0 * model.effects.motion_ratio));
  }
  record.keep_effects(effects_of(scene, &model));
  record.keep_model(model);
  if (structure) record.keep_structure(structure->mesh, structure->modes.basis);
  return model;
}

/// Curves of chosen harmonics may have fewer points than a picture wants.
ReducedModel model_of_maps(const Solution& solution) {
  Discretisation settings = solution.scene.settings;
  bool any_more = false;
  for (std::size_t i = 0; i < settings.patches.size(); ++i) {
    const int given = contact_points(settings, i);
    if (settings.patches[i].n_points || given >= points_of_maps) continue;
    settings.patches[i].n_points = points_of_maps;
    any_more = true;
  }
  if (!any_more || cut_short()) return solution.model;
  std::vector<std::string> warnings;  // told already
  ReducedModel model = model_with(settings, solution.scene, solution.structure.get(), warnings);
  model.effects = solution.model.effects;
  return model;
}

CurveBudget budget_of(const Solution& solution, const solver::Optimum& best, int jobs) {
  if (!solution.scene.accuracy.error_budget || cut_short()) return {};
  return optimum_budget(solution.model, solution.scene,
                        richer_models(solution.model, solution.scene, solution.structure.get()),
                        best, jobs);
}

void find_optimum(const Solution& solution, const RunOptions& options, RunRecord& record) {
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

}  // namespace

int run_study(const SceneDescription& scene, const RunOptions& options) {
  require_response(scene);
  begin_deadline(scene.accuracy.budget);
  RunRecord record(scene, options);
  const ResultCache cache(options.cache, [&](const auto& line) { record.progress().info(line); });
  return record.run([&] {
    Solution solution{.scene = scene, .structure = solve(scene, record)};
    solution.model = reduce(scene, solution.structure, record);
    require_held(solution.model, scene);
    require_curves(solution.model, scene);
    record.stage("curves");
    fem::use_one_blas_thread();
    solution.curves = trace_family(solution.model, scene, options.jobs, record);
    record.keep_choices(scene);
    record.stage("accuracy");
    solution.budgets = budgets_of(solution.model, scene, solution.structure.get(), options.jobs,
                                  solution.curves, record.progress());
    keep_budgets(solution, record);
    put_back_missed_effects(solution, options.jobs, record);
    refine_to_tolerance(solution, options.jobs, record);
    record.tell_effects();
    if (solution.structure) ask(record, scene, solution.structure->mesh, solution.curves);
    if (options.maps) {
      record.stage("maps");
      draw_maps(model_of_maps(solution), solution.scene, solution.curves, record);
    }
    if (scene.response->optimum) find_optimum(solution, options, record);
    record.stage("report");
    record.keep_report();
  });
}

int modes_study(const SceneDescription& scene, const RunOptions& options) {
  RunRecord record(scene, options);
  const ResultCache cache(options.cache, [&](const auto& line) { record.progress().info(line); });
  return record.run([&] { static_cast<void>(reduce(scene, solve(scene, record), record)); });
}

int mesh_study(const SceneDescription& scene, const RunOptions& options) {
  const ResultCache cache(options.cache, [&](const std::string& line) {
    if (options.verbosity != Verbosity::quiet) std::cout << line << '\n';
  });
  const mesh::Mesh mesh = obtain_mesh(scene, options.output);
  if (interrupt_requested()) throw InterruptedError("interrupted after the mesh was written");
  check_names(mesh, scene);
  if (options.verbosity != Verbosity::quiet) {
    std::cout << describe_mesh(mesh, scene.material.density) << '\n';
  }
  for (const std::string& warning : mesh::shape_warnings(mesh))
    std::cerr << "warning: " << warning << '\n';
  if (options.verbosity != Verbosity::quiet)
    std::cout << "written: " << options.output.string() << '\n';
  return static_cast<int>(ExitCode::complete);
}

int converge_study(const SceneDescription& scene, const RunOptions& options) {
  require_response(scene);
  const std::filesystem::path folder = options.output / "converge";
  make_folder(folder);
  require_writable(folder);
  const auto say = [&](const std::string& sentence) {
    if (options.verbosity != Verbosity::quiet) std::cout << sentence << std::endl;
  };
  fem::use_one_blas_thread();  // every rung takes what it takes on one core
  const TimedStructure base = timed_structure(scene);
  say(fmt::format("mesh and modes: {:.1f} s", base.seconds));
  for (const Ladder& ladder : ladders(scene)) {
    const std::vector<RungResult> rungs = climb(ladder, base, say);
    write_ladder_csv(folder / (ladder.knob + ".csv"), rungs);
    say(ladder_text(ladder.knob, rungs));
  }
  const std::string failure =
      run_plot_script("plot_converge.py", {folder.string()}, std::chrono::seconds(120));
  if (!failure.empty()) std::cerr << "warning: " << failure << '\n';
  say("written: " + folder.string());
  return static_cast<int>(ExitCode::complete);
}

int campbell_study(const SceneDescription& scene, const CampbellRequest& request,
                   const RunOptions& options) {
  require_rotation(scene);
  const std::filesystem::path folder = options.output / "campbell";
  make_folder(folder);
  require_writable(folder);
  const auto say = [&](const std::string& sentence) {
    if (options.verbosity != Verbosity::quiet) std::cout << sentence << std::flush;
  };
  const ResultCache cache(options.cache, [&](const std::string& line) { say(line + '\n'); });
  const TemporaryFolder scratch;
  const mesh::Mesh mesh = obtain_mesh(scene, scratch.path() / "mesh.msh");
  check_names(mesh, scene);
  SceneDescription fastest = scene;
  fastest.rotation->speed = request.speeds.maxCoeff();
  for (const std::string& question : questions(fastest, mesh)) {
    std::cerr << "warning: " << question << '\n';
  }
  const CampbellDiagram diagram = campbell_diagram(
      mesh, scene, request.speeds, [&](double speed, const Eigen::VectorXd& frequency) {
        say(fmt::format("{:10.6g} rpm: {:.6g} Hz\n", 30.0 * speed / std::numbers::pi,
                        fmt::join(frequency / (2.0 * std::numbers::pi), ", ")));
      });
  const std::vector<Crossing> found = crossings(diagram, request.highest_engine_order);
  write_campbell(folder, diagram, found);
  say(crossings_text(found));
  const std::string failure = run_plot_script(
      "plot_campbell.py", {folder.string(), std::to_string(request.highest_engine_order)},
      std::chrono::seconds(120));
  if (!failure.empty()) std::cerr << "warning: " << failure << '\n';
  say("written: " + folder.string() + '\n');
  return static_cast<int>(ExitCode::complete);
}

int report_study(const std::filesystem::path& folder) {
  const std::string summary = read_summary(folder);
  std::optional<RunFolder> place;
  if (RunFolder::has_list(folder)) place.emplace(folder, RunStart::resumed);
  const std::vector<std::string> warnings =
      write_report(folder, place ? place->staged() : folder, summary);
  if (place) place->publish();
  if (!warnings.empty()) throw SceneError(folder.string() + ": " + warnings.front());
  return static_cast<int>(ExitCode::complete);
}

}  // namespace microslip::pipelines
