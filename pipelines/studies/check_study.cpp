#include "pipelines/studies/check_study.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <ostream>
#include <utility>

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include "mesh/count_text.hpp"
#include "mesh/element_shape.hpp"
#include "mesh/mesh.hpp"
#include "pipelines/description/curve_request.hpp"
#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/effects/curve_cost.hpp"
#include "pipelines/effects/effect_choice.hpp"
#include "pipelines/effects/effect_indicators.hpp"
#include "pipelines/effects/effects.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/effects/simulated_scene.hpp"
#include "pipelines/import/given_matrices.hpp"
#include "pipelines/import/matrix_checks.hpp"
#include "pipelines/model/contact_preload.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/model/scene_places.hpp"
#include "pipelines/model/scene_warnings.hpp"
#include "pipelines/questions/questions.hpp"
#include "pipelines/response/curve_requirements.hpp"
#include "pipelines/response/curve_trial.hpp"
#include "pipelines/structure/extrapolated_modes.hpp"
#include "pipelines/structure/memory_before_mesh.hpp"
#include "pipelines/structure/solver_time.hpp"
#include "pipelines/structure/static_preload.hpp"
#include "pipelines/structure/structure_stage.hpp"
#include "pipelines/studies/draw_scene.hpp"
#include "pipelines/system/interrupt.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/temporary_folder.hpp"
#include "pipelines/text/rounded.hpp"

namespace microslip::pipelines {
namespace {

constexpr double memory_without_a_mesh = 0.06;  // [GB], measured
constexpr double memory_before_modes = 0.15;    // with the libraries of finite elements
constexpr double longest_solution = 2.0;        // [s] forecast, of modes that `check` solves for
constexpr double longest_trial = 1.0;           // [s] that curves are begun for

/// @param model  where effects are decided, else nullptr.
void add_curves(const SceneDescription& scene, const ReducedModel* model, Forecast& forecast) {
  if (!scene.response) return;
  forecast.pictures = picture_seconds(scene);
  using enum Discretisation::Choice;
  const Discretisation::Choice along_r = scene.settings.second_direction;
  if (model != nullptr) {
    const CurveEffects effects = decided_curve_effects(scene, *model);
    forecast.response = tried_seconds(*model, scene, effects, longest_trial);
    return;
  }
  forecast.response = response_seconds(scene, curve_effects(scene, along_r == on));
  if (along_r == automatic) {
    forecast.response_along_r = response_seconds(scene, curve_effects(scene, true));
  }
}

/// @param model  where the scene brings its modes, else nullptr.
Forecast forecast_of(const mesh::Mesh& mesh, const SceneDescription& scene,
                     const ReducedModel* model) {
  Forecast forecast;
  forecast.degrees_of_freedom = 3.0 * static_cast<double>(mesh.n_nodes());
  forecast.modes_seconds = mesh_and_modes_seconds(forecast.degrees_of_freedom, scene);
  if (is_extrapolated(scene)) {
    forecast.modes_seconds += larger_elements_seconds(forecast.degrees_of_freedom, scene);
  }
  forecast.solver_memory = solver_memory(mesh, scene.settings.basis.solver);
  forecast.memory_gb = memory_before_modes + 1e-3 * forecast.solver_memory->needed_mb();
  add_curves(scene, model, forecast);
  if (!scene.response) return forecast;
  const double more = coarser_meshes_seconds(forecast.degrees_of_freedom, scene) +
                      modes_again_seconds(forecast.degrees_of_freedom, scene, model);
  forecast.response.errors += more;
  if (forecast.response_along_r) forecast.response_along_r->errors += more;
  return forecast;
}

/// What a run is told to leave out is no part of what one costs.
void leave_out(const RunOptions& options, Forecast& forecast) {
  if (!options.plots) forecast.pictures.plots = 0.0;
  if (!options.maps) forecast.pictures.maps = 0.0;
  if (options.bracket) return;
  forecast.response.bracket = 0.0;
  if (forecast.response_along_r) forecast.response_along_r->bracket = 0.0;
}

std::string text_of(const ResponseSeconds& seconds) {
  std::string text = fmt::format("curves {:.2g} s", seconds.curves);
  if (seconds.errors > 0.0) text += fmt::format(", their errors {:.2g} s", seconds.errors);
  if (seconds.best_value > 0.0) {
    text += fmt::format(", best value {:.2g} s", seconds.best_value);
  }
  if (seconds.bracket > 0.0) text += fmt::format(" and its bracket {:.2g} s", seconds.bracket);
  return text;
}

/// What a round of refinement takes depends on errors that only the curves tell.
void describe(const AccuracyRequest& accuracy, std::ostream& out) {
  if (!(accuracy.tolerance > 0.0)) return;
  fmt::print(out,
             "asked for {}: what refining takes beyond that is told by `run` after the first "
             "curves{}\n",
             percent_text(accuracy.tolerance),
             std::isfinite(accuracy.budget) ? "" : "; --budget 60s would end it in time");
}

void describe(const Forecast& forecast, bool has_curves, std::ostream& out) {
  std::vector<std::string> parts;
  if (forecast.degrees_of_freedom > 0.0) {
    parts.push_back(fmt::format("{:.0f} degrees of freedom; mesh and modes {:.2g} s, {:.1f} GB",
                                forecast.degrees_of_freedom, forecast.modes_seconds,
                                forecast.memory_gb));
    if (forecast.solver_memory) {
      parts.back() += fmt::format(" of {:.1f} GB available",
                                  1e-3 * forecast.solver_memory->available.megabytes);
    }
  }
  if (has_curves) parts.push_back(text_of(forecast.response));
  const auto& [maps, plots] = forecast.pictures;
  if (maps > 0.0) parts.push_back(fmt::format("maps and motion at the peaks {:.2g} s", maps));
  if (plots > 0.0) parts.push_back(fmt::format("plots {:.2g} s", plots));
  if (forecast.response_along_r) {
    parts.push_back("if friction along r is called for " + text_of(*forecast.response_along_r));
  }
  if (parts.empty()) return;
  fmt::print(out, "forecast, on one core: {}\n", fmt::join(parts, "; "));
}

void describe(const std::vector<EffectRecord>& effects, std::ostream& out) {
  out << "effects:\n";
  for (const std::string& line : effect_lines(effects)) out << "  " << line << '\n';
}

void describe_modes(const ModalModel& modal, const ReducedModel& model, std::ostream& out) {
  Eigen::VectorXd free = modal.frequency_hz;
  std::sort(free.begin(), free.end());
  const Eigen::VectorXd stuck = stuck_frequencies(model);
  constexpr Eigen::Index longest_list = 20;
  fmt::print(out, "  natural frequencies [Hz]      free     all stuck\n");
  for (Eigen::Index i = 0; i < std::min(free.size(), longest_list); ++i) {
    fmt::print(out, "  {:<20}{:14.6g}{:14.6g}\n", i + 1, free[i], stuck[i]);
  }
  if (free.size() > longest_list) fmt::print(out, "  … {} in all\n", free.size());
}

void describe_points(const ModalModel& modal, std::ostream& out) {
  double load = 0.0;
  int n_gaps = 0;
  for (std::size_t i = 0; i < modal.points.size(); ++i) {
    const double rest_load = modal.points[i].rest_load;
    load += std::max(rest_load, 0.0) * modal.weights[static_cast<Eigen::Index>(i)];
    if (rest_load < 0.0) ++n_gaps;
  }
  if (modal.load_measure == LoadMeasure::force) {
    fmt::print(out, "{} contact point{}\n", modal.points.size(),
               modal.points.size() == 1 ? "" : "s");
    return;
  }
  fmt::print(out, "{} contact point{}: weights sum to {:.6g}, preload to {:.6g} N, {} with a gap\n",
             modal.points.size(), modal.points.size() == 1 ? "" : "s", modal.weights.sum(), load,
             n_gaps);
}

ReducedModel check_modal(const ModalModel& modal, const SceneDescription& scene,
                         std::ostream& out) {
  fmt::print(out, "{}\n", mesh::counted(modal.frequency_hz.size(), "mode", "modes"));
  ReducedModel model = reduced_model(scene);
  model.effects = contact_effects(model, scene);
  require_held(model, scene);
  describe_modes(modal, model, out);
  describe_points(modal, out);
  if (scene.response) {
    require_curves(model, scene);
    const ResponseDescription& response = *scene.response;
    const std::size_t n_curves = curve_requests(scene).size();
    fmt::print(out, "{} {} from {:.6g} to {:.6g} Hz\n", n_curves,
               n_curves == 1 ? "curve" : "curves", response.frequency_begin_hz,
               response.frequency_end_hz);
  }
  return model;
}

template <typename... What>
void ask(CheckResult& result, const What&... what) {
  for (std::string& question : questions(what...)) result.warnings.push_back(std::move(question));
}

/// Modes are solved for where that is short: `run` takes them from there,
/// and their questions need no run.
bool is_short(const mesh::Mesh& mesh, const SceneDescription& scene) {
  const double degrees_of_freedom = 3.0 * static_cast<double>(mesh.n_nodes());
  if (modes_seconds(degrees_of_freedom, scene.settings.basis) > longest_solution) {
    return false;
  }
  const SolverMemory memory = solver_memory(mesh, scene.settings.basis.solver);
  return memory.needed_mb() <= memory.available.megabytes;
}

/// Whether the modes are of the scene that is meant.
bool tells_modes(const mesh::Mesh& mesh, const SceneDescription& scene, std::ostream& out) {
  if (!may_be_in_other_units(scene, mesh)) return true;
  out << "modes: not solved for here: what is asked below of material, size or stiffness comes "
         "first\n";
  return false;
}

/// Of a file, kept by an earlier run, or quickly solved for; empty: known to `run` alone.
std::optional<StructureModes> modes_to_ask(const mesh::Mesh& mesh, const SceneDescription& scene,
                                           std::ostream& out) {
  if (given_modes(scene) != nullptr) return solve_structure(mesh, scene);
  if (!scene.response || !tells_modes(mesh, scene, out)) return std::nullopt;
  if (auto kept = kept_structure(mesh, scene)) return kept;
  if (!is_short(mesh, scene)) return std::nullopt;
  out << "modes: solved for, as that takes seconds\n";
  return solve_structure(mesh, scene);
}

/// The two linear limits in a line.
std::string describe_frequencies(const ReducedModel& model) {
  const Eigen::VectorXd free =
      model.frequency.head(model.frequency.size() - model.n_attachment) / (2.0 * std::numbers::pi);
  std::string text = fmt::format("natural frequencies: {} from {:.6g} to {:.6g} Hz", free.size(),
                                 free.minCoeff(), free.maxCoeff());
  if (model.patches.empty()) return text;
  return text + fmt::format("; with every contact point stuck from {:.6g} Hz",
                            stuck_frequencies(model).minCoeff());
}

/// What `run` asks of modes.
SimulatedScene check_modes(const SolvedStructure& structure, const SceneDescription& scene,
                           CheckResult& result, std::ostream& out) {
  for (const std::string& line : structure.modes.notes) out << line << '\n';
  result.warnings.insert(result.warnings.end(), structure.modes.warnings.begin(),
                         structure.modes.warnings.end());
  ReducedModel model = model_of(scene, &structure, result.warnings);
  if (scene.response) {
    require_held(model, scene);
    require_curves(model, scene);
  }
  out << describe_frequencies(model) << '\n';
  return simulated(scene, std::move(model), &structure);
}

/// What the matrices say by themselves.
void check_matrices(const mesh::Mesh& mesh, const SceneDescription& scene, bool modes_tell,
                    CheckResult& result, std::ostream& out) {
  const fem::GivenMatrices matrices = matrices_of(mesh, scene);  // they are read and checked
  fmt::print(out, "mass of what is free to move, by the matrix: {:.6g} kg\n", free_mass(matrices));
  if (modes_tell) return;
  if (std::string question = mass_question(mesh, matrices); !question.empty()) {
    result.warnings.push_back(std::move(question));
  }
}

std::string static_preload_in(const mesh::Mesh& mesh, const SceneDescription& scene,
                              const std::optional<StructureModes>& modes) {
  return modes && modes->static_face ? describe_static_preload(mesh, scene, *modes->static_face)
                                     : describe_static_preload(mesh, scene);
}

/// @return whether modes are known.
bool check_meshed(const SceneDescription& scene, const std::filesystem::path& picture,
                  const RunOptions& options, CheckResult& result, std::ostream& out) {
  const TemporaryFolder folder;
  require_memory_before_mesh(scene);
  const mesh::Mesh mesh = obtain_mesh(scene, folder.path() / "mesh.msh");
  if (interrupt_requested()) throw InterruptedError("interrupted");
  check_names(mesh, scene);
  out << describe_mesh(mesh, scene.material.density) << '\n';
  for (const std::string& line : describe_places(mesh, scene)) out << line << '\n';
  for (std::string& warning : mesh::shape_warnings(mesh))
    result.warnings.push_back(std::move(warning));
  std::optional<StructureModes> modes = modes_to_ask(mesh, scene, out);
  if (given_matrices(scene) != nullptr) {
    check_matrices(mesh, scene, modes.has_value(), result, out);
  } else if (given_modes(scene) == nullptr && scene.clamped.empty() && scene.response) {
    result.warnings.emplace_back(
        "nothing is clamped: the structure has rigid-body modes, which only a contact that "
        "sticks holds");
  }
  ask(result, scene, mesh);
  std::optional<SimulatedScene> known;
  if (modes) {
    known = check_modes({mesh, *modes}, scene, result, out);
    ask(result, known->scene, known->model);
  }
  const ReducedModel* model = known ? &known->model : nullptr;
  const SceneDescription& as_simulated = known ? known->scene : scene;
  if (const std::string text = describe_preload(mesh, scene); !text.empty()) out << text << '\n';
  if (has_static_preload(scene)) out << static_preload_in(mesh, scene, modes) << '\n';
  if (!picture.empty()) {
    const std::string failure = draw_scene(mesh, scene, picture);
    if (!failure.empty()) result.warnings.push_back("--plot: " + failure);
  }
  result.forecast = forecast_of(mesh, as_simulated, model);
  leave_out(options, result.forecast);
  describe(result.forecast, scene.response.has_value(), out);
  describe(scene.accuracy, out);
  if (given_modes(scene) == nullptr) {
    if (std::string text = memory_warning(*result.forecast.solver_memory); !text.empty()) {
      result.warnings.push_back(std::move(text));
    }
  }
  result.effects = effects_of(as_simulated, model, &mesh);
  if (modes) {
    const SolvedStructure structure{mesh, std::move(*modes)};
    tell_moments_left_out(as_simulated, structure, result.effects);
    if (is_short(mesh, scene)) tell_residual_left_out(as_simulated, structure, result.effects);
  }
  return known.has_value();
}

const char* left_to_run(bool modes_are_known) {
  return modes_are_known
             ? "asked by `run` alone, which knows the curves: how large the amplitude is\n"
             : "asked by `run`, which knows the modes and the curves: whether modes lie in the "
               "frequency range, whether the face slides along r, how large the amplitude is; the "
               "first two by `check` as well once the modes are quickly solved for, or kept by "
               "`modes` or a run\n";
}

std::string verdict(const SceneDescription& scene, std::size_t n_warnings) {
  if (!scene.response)
    return "the scene is complete for `mesh` and `modes`; `run` needs a [response]";
  if (n_warnings == 0) return "the scene is complete and consistent";
  return fmt::format("the scene is complete; {} above",
                     mesh::counted(n_warnings, "warning", "warnings"));
}

}  // namespace

CheckResult check_study(const SceneDescription& scene, const std::filesystem::path& picture,
                        std::ostream& out, const RunOptions& options) {
  if (scene.response) require_response(scene);
  CheckResult result;
  result.warnings = scene_warnings(scene);
  ask(result, scene);
  bool modes_are_known = false;
  if (const auto* modal = std::get_if<ModalModel>(&scene.model)) {
    if (!picture.empty()) {
      throw SceneError(
          fmt::format("--plot: a scene of kind \"{}\" has no mesh to draw", scene.kind));
    }
    const SimulatedScene known = simulated(scene, check_modal(*modal, scene, out), nullptr);
    ask(result, known.scene, known.model);
    result.effects = effects_of(known.scene, &known.model);
    result.forecast.memory_gb = memory_without_a_mesh;
    add_curves(known.scene, &known.model, result.forecast);
    leave_out(options, result.forecast);
    describe(result.forecast, scene.response.has_value(), out);
    describe(scene.accuracy, out);
  } else {
    modes_are_known = check_meshed(scene, picture, options, result, out);
  }
  for (const EffectRecord& effect : result.effects) {
    if (effect.objection.empty()) continue;
    result.warnings.push_back(fmt::format("effects.{}: {}", effect.name, effect.objection));
  }
  for (const std::string& warning : result.warnings) out << "warning: " << warning << '\n';
  describe(result.effects, out);
  if (scene.response && !std::holds_alternative<ModalModel>(scene.model)) {
    out << left_to_run(modes_are_known);
  }
  out << verdict(scene, result.warnings.size()) << '\n';
  return result;
}

}  // namespace microslip::pipelines
