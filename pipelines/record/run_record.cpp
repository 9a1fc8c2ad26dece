#include "pipelines/record/run_record.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <iostream>
#include <numbers>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "fem/slepc_session.hpp"
#include "mesh/element_shape.hpp"
#include "pipelines/accuracy/effect_bounds.hpp"
#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/effects/effects.hpp"
#include "pipelines/files/model_file.hpp"
#include "pipelines/files/write_csv.hpp"
#include "pipelines/files/write_map.hpp"
#include "pipelines/files/write_report.hpp"
#include "pipelines/files/write_summary.hpp"
#include "pipelines/files/write_vtk.hpp"
#include "pipelines/record/failed_start.hpp"
#include "pipelines/record/failure_in_place.hpp"
#include "pipelines/record/run_folder.hpp"
#include "pipelines/record/run_messages.hpp"
#include "pipelines/response/effects_of_curves.hpp"
#include "pipelines/response/end_remedies.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/exit_code.hpp"
#include "pipelines/system/interrupt.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/sealed_bytes.hpp"

namespace microslip::pipelines {
namespace {

using namespace std::chrono_literals;

constexpr auto patience = 600ms;  // what a stage may take to notice an interrupt by itself
constexpr double hz_per_rad = 0.5 / std::numbers::pi;

/// Whether the time, or the points, that a curve may take were not enough.
bool any_is_spent(const std::vector<CurveSummary>& curves) {
  return std::ranges::find(curves, solver::Diagnosis::budget, &CurveSummary::diagnosis) !=
         curves.end();
}

/// Where the summary of an earlier run is kept until this one has begun.
std::filesystem::path earlier_summary(const std::filesystem::path& folder) {
  return folder / "checkpoint" / "summary.json";
}

std::vector<std::string> within(const std::string& folder, std::vector<std::string> files) {
  for (std::string& file : files) file.insert(0, folder + '/');
  return files;
}

}  // namespace

RunRecord::RunRecord(const SceneDescription& scene, const RunOptions& options)
    : folder_(options.output),
      start_(is_begun(folder_) ? options.start : RunStart::anew),
      place_(folder_, start_),
      staged_(place_.staged()),
      checkpoint_(folder_, start_ == RunStart::resumed),
      refines_(scene.accuracy.tolerance > 0.0),
      plots_(options.plots),
      progress_(std::cerr, ::isatty(STDERR_FILENO) == 1, options.verbosity) {
  summary_.version = MICROSLIP_VERSION;
  summary_.scene = scene.file.filename().string();
  summary_.title = scene.title;
  summary_.exit_code = ExitCode::incomplete;
  summary_.message = unfinished_message;
  summary_.machine = describe_machine();
  summary_.libraries = library_versions();
  summary_.effects = effects_of(scene, nullptr);
  scene_toml_ = scene.complete_toml;
  // An earlier run's scene, log and checkpoint stay until this scene has proved itself.
  if (start_ == RunStart::resumed || !std::filesystem::exists(folder_ / "summary.json")) {
    begin();
    write_summary(folder_ / "summary.json", summary_);
    return;
  }
  put_summary_aside();
  try {
    write_summary(folder_ / "summary.json", summary_);
  } catch (const ExhaustedError&) {
    take_summary_back();
    tell_failed_start_in_place(folder_ / "summary.json");
    throw;
  }
}

void RunRecord::begin() {
  if (begun_) return;
  begun_ = true;
  checkpoint_.begin(scene_toml_);
  progress_.keep_in(folder_, start_);
  write_whole(folder_ / "scene.toml", scene_toml_);
  std::filesystem::remove(earlier_summary(folder_));
}

void RunRecord::take_over() {
  const std::lock_guard lock(mutex_);
  begin();
}

void RunRecord::put_summary_aside() {
  const std::filesystem::path aside = earlier_summary(folder_);
  if (std::filesystem::exists(aside)) return;
  std::error_code no_links;
  std::filesystem::create_hard_link(folder_ / "summary.json", aside, no_links);
  if (no_links) std::filesystem::rename(folder_ / "summary.json", aside);
}

void RunRecord::take_summary_back() {
  std::error_code ignored;  // it was linked, and another name for the same stays
  std::filesystem::rename(earlier_summary(folder_), folder_ / "summary.json", ignored);
  std::filesystem::remove(earlier_summary(folder_), ignored);  // both are one: renamed to itself
}

void RunRecord::restore_summary(ExitCode code, const std::string& message) {
  const std::filesystem::path aside = earlier_summary(folder_);
  std::string text;
  try {
    text = summary_of_failed_start(aside, code, message);
  } catch (const SceneError&) {  // it was no summary before: it stays what it was
    std::filesystem::rename(aside, folder_ / "summary.json");
    throw;
  }
  write_whole(folder_ / "summary.json", text);
  std::filesystem::remove(aside);
}

std::filesystem::path RunRecord::mesh_file() const { return staged_ / "mesh.msh"; }

void RunRecord::keep_inputs(const SceneDescription& scene) {
  // Before it has begun nothing is kept, and an earlier run's checkpoint is not its own.
  if (!begun_ || !resumable_) return;
  make_folder(folder_ / "checkpoint" / "inputs");
  int number = 0;  // two of them may have one name
  for (const std::filesystem::path& file : files_of_structure(scene)) {
    checkpoint_.require_same(fmt::format("inputs/{}", ++number), fingerprint_of(file),
                             file.string());
  }
}

std::optional<std::filesystem::path> RunRecord::finished_mesh() const {
  const std::filesystem::path file = folder_ / "mesh.msh";
  if (!checkpoint_.find<std::uint64_t>("mesh") || !std::filesystem::exists(file)) return {};
  return file;
}

std::optional<StructureModes> RunRecord::finished_modes() const {
  return checkpoint_.find<StructureModes>("modes");
}

std::optional<CurveResult> RunRecord::finished_curve(const std::string& name) const {
  return checkpoint_.find<CurveResult>("curves/" + name);
}

void RunRecord::keep_finished(const CurveResult& result) const {
  if (resumable_) checkpoint_.keep("curves/" + result.name, result);
}

int RunRecord::run(const std::function<void()>& stages) {
  const PromptEnd promise;
  std::jthread watch([this](const std::stop_token& stop) { end_in_time(stop); });
  const auto end_watch = [&] {
    watch.request_stop();
    if (watch.joinable()) watch.join();
  };
  try {
    stages();
    end_watch();
    return finish();
  } catch (const std::exception& error) {
    end_watch();
    const ExitCode code = exit_code_of(error);
    const std::string message = place_.in_place(error.what());
    fail(code, message);
    if (code == ExitCode::exhausted) throw ExhaustedError(message);  // no room, perhaps for a file
    throw;
  }
}

void RunRecord::end_in_time(const std::stop_token& stop) {
  for (auto waited = 0ms; waited < patience && !interrupt_insisted(); waited += 20ms) {
    if (stop.stop_requested()) return;
    std::this_thread::sleep_for(20ms);
    if (!interrupt_requested() && !is_overdue()) waited = -20ms;  // a stage may end by itself
  }
  const bool overdue = !interrupt_requested();
  // A library or a long evaluation is in the way: end here.
  const std::string stage = stage_name();
  try {
    keep_unfinished();
  } catch (const std::exception& error) {
    progress_.error(error.what());
  }
  const ExitCode code = overdue ? ExitCode::exhausted : ExitCode::incomplete;
  const std::string message =
      overdue ? fmt::format(
                    "out of time: the stage {} was ended, which takes longer than the budget "
                    "leaves; what was solved before is there. Take larger elements, fewer "
                    "modes, or a longer budget",
                    stage)
              : "interrupted: the same command with --resume goes on";
  fail(code, message);
  if (overdue)
    std::cerr << "microslip: " << message << std::endl;  // nobody above is left to say it
  place_.remove_staged();                                // other threads are writing there
  place_.unlock();
  std::_Exit(static_cast<int>(code));
}

std::string RunRecord::stage_name() const {
  const std::vector<StageRecord> stages = progress_.stages();
  return stages.empty() ? "scene" : stages.back().name;
}

bool RunRecord::is_overdue() const {
  constexpr double grace = 0.5;  // stages that look at the clock have ended long before
  return seconds_left() < -grace && stage_name() != "report";
}

int RunRecord::finish() {
  show_stage();
  progress_.finish();
  const std::lock_guard lock(mutex_);
  summary_.exit_code = verdict();
  summary_.message = ending();
  place_.remove_earlier();
  write_summary_file();
  checkpoint_.end();
  return static_cast<int>(summary_.exit_code);
}

void RunRecord::stage(const std::string& name) {
  show_stage();
  if (interrupt_requested())
    throw InterruptedError("interrupted before the stage " + name +
                           ": the same command with --resume goes on");
  progress_.stage(name);
}

void RunRecord::show_stage() {
  const std::lock_guard lock(mutex_);
  if (!begun_) return;
  place_.publish();
  place_.remove_superseded();
  shown_ = summary_.curves;
  write_summary_so_far();
}

void RunRecord::show_what_is_new() {
  if (!begun_ || place_.would_replace()) return;
  place_.publish();
  shown_ = summary_.curves;
}

void RunRecord::maps_are_drawn() {
  const std::lock_guard lock(mutex_);
  show_what_is_new();
  write_summary_so_far();
}

void RunRecord::keep_mesh(const mesh::Mesh& mesh, double density) {
  take_over();
  show_stage();  // before the checkpoint says that the mesh is in its place
  if (resumable_) checkpoint_.require_same("mesh", fingerprint_of(mesh), "the mesh");
  progress_.info(describe_mesh(mesh, density));
  for (const std::string& warning : mesh::shape_warnings(mesh)) progress_.warning(warning);
  const std::lock_guard lock(mutex_);
  summary_.mesh =
      MeshSummary{mesh.n_nodes(), mesh.n_elements(), 0, mesh.volume(), density * mesh.volume()};
}

void RunRecord::keep_modes(const mesh::Mesh& mesh, const StructureModes& modes,
                           const Eigen::VectorXd& damping_ratio) {
  for (const std::string& line : modes_text(modes)) progress_.info(line);
  const std::lock_guard lock(mutex_);
  summary_.mesh->degrees_of_freedom = modes.n_dofs;
  summary_.mesh->mass = modes.mass;
  const Eigen::Index n_attachment = modes.basis.n_attachment;
  summary_.modes =
      summarise_modes(modes.basis.frequency, damping_ratio, modes.basis.residual, {}, n_attachment);
  if (resumable_ && !checkpoint_.find<StructureModes>("modes")) checkpoint_.keep("modes", modes);
  write_modes_csv(staged_ / "modes.csv",
                  {modes.basis.frequency, modes.basis.residual, damping_ratio, {}, n_attachment});
  write_modes_vtu(staged_ / "modes.vtu", mesh, modes.basis);
}

void RunRecord::keep_effects(std::vector<EffectRecord> effects) {
  const std::lock_guard lock(mutex_);
  summary_.effects = std::move(effects);
}

void RunRecord::begin_again() {
  const std::lock_guard lock(mutex_);
  summary_.curves.clear();
  summary_.error_budget.clear();
  left_out_.clear();
  resumable_ = false;
  checkpoint_.forget_parts();
}

void RunRecord::keep_bounds(double tolerance, const std::vector<NoBound>& none) {
  const std::lock_guard lock(mutex_);
  std::vector<ErrorRow> rows = summary_.error_budget;
  rows.insert(rows.end(), left_out_.begin(), left_out_.end());
  tell_bounds(rows, tolerance, summary_.effects, none);
}

void RunRecord::tell_effects() {
  const std::lock_guard lock(mutex_);
  for (const std::string& line : effect_lines(summary_.effects)) progress_.note(line);
  for (const EffectRecord& effect : summary_.effects) {
    // What harmonics given do to a peak is told with its curve.
    const bool is_told = effect.name == "higher_harmonics" && effect.bound;
    if (effect.objection.empty() || is_told) continue;
    progress_.warning(fmt::format("effects.{}: {}", effect.name, effect.objection));
  }
}

BesideBar RunRecord::left_out() {
  const std::lock_guard lock(mutex_);
  return left_out_of_curves();
}

BesideBar RunRecord::left_out_of_curves() const {
  BesideBar of_all;
  for (const CurveSummary& curve : summary_.curves) keep_larger(curve.left_out, of_all);
  return of_all;
}

void RunRecord::keep_accuracy(AccuracySummary accuracy) {
  const std::lock_guard lock(mutex_);
  summary_.accuracy = std::move(accuracy);
}

void RunRecord::judge_optimum(double bar) {
  const std::lock_guard lock(mutex_);
  if (!summary_.accuracy || bar <= summary_.accuracy->asked) return;
  AccuracySummary& accuracy = *summary_.accuracy;
  accuracy.reached = std::max(accuracy.reached, bar);
  const std::string text = fmt::format(
      "asked for {}: the best value has {}; a smaller tolerance refines the models that it is "
      "found "
      "with",
      percent_text(accuracy.asked),
      std::isfinite(bar) ? "± " + percent_text(bar) : "an error that could not be told");
  progress_.warning(text);
  accuracy.message += (accuracy.message.empty() ? "" : "; ") + text;
}

void RunRecord::keep_choices(const SceneDescription& scene) {
  const std::lock_guard lock(mutex_);
  tell_curves(scene, summary_.curves, summary_.effects);
}

void RunRecord::keep_model(const ReducedModel& model) {
  take_over();
  const std::lock_guard lock(mutex_);
  Eigen::VectorXd residual(0);
  if (!summary_.modes.empty() && summary_.modes.front().residual) {
    residual.resize(model.frequency.size() - model.n_attachment);
    for (Eigen::Index i = 0; i < residual.size(); ++i) {
      residual[i] = *summary_.modes[static_cast<std::size_t>(i)].residual;
    }
  }
  const Eigen::VectorXd fit_error = worst_fit_error(model);
  summary_.modes = summarise_modes(model.frequency, model.damping_ratio, residual, fit_error,
                                   model.n_attachment);
  write_modes_csv(staged_ / "modes.csv",
                  {model.frequency, residual, model.damping_ratio, fit_error, model.n_attachment});
  write_model(staged_ / "model.h5", model);
  if (!resumable_) return;
  checkpoint_.require_same("model", fingerprint_of(staged_ / "model.h5"), "the contact model");
}

void RunRecord::keep_structure(const mesh::Mesh& mesh, fem::ModalBasis basis) {
  structure_.emplace(Structure{mesh, std::move(basis)});
}

/// A peak or fold that was seen and not solved for is only as exact as the rows of the curve are
/// close.
void RunRecord::warn_of_unsolved(const CurveResult& result) {
  for (const solver::SolverEvent& event : result.curve.log) {
    if (event.remedy == solver::Remedy::harmonics_kept && !result.curve.points.empty()) {
      progress_.warning(fmt::format(
          "harmonics-kept: curve {}: the choice of its harmonics did not come to its end: it has "
          "{} of them",
          result.name, std::max<std::size_t>(result.curve.points.front().orders.size(), 1)));
    }
    if (event.remedy != solver::Remedy::peak_unsolved &&
        event.remedy != solver::Remedy::fold_unsolved)
      continue;
    progress_.warning(fmt::format("{}: curve {}: near {:.8g} Hz the nearest point found is marked",
                                  solver::to_string(event.remedy), result.name,
                                  hz_per_rad * event.frequency));
  }
}

/// What the contact carries at rest and, where a part of it is a gap,
/// what the plain integral comes to.
void RunRecord::keep_preload(CurveSummary& summary, const ReducedModel& model, double load) {
  const contact::RestingLoad rest = contact_of(model, load).at_rest();
  summary.preload_carried = rest.carried;
  summary.preload_integral = rest.integral;
  if (rest.partly_open) {
    progress_.info(
        fmt::format("curve {}: the contact carries {:.6g} N and is open on a part of it; its "
                    "preload integrates to {:.6g} N "
                    "with the gaps counted as pull",
                    summary.name, *summary.preload_carried, *summary.preload_integral));
  }
}

void RunRecord::keep_curve(const CurveResult& result, const ReducedModel& model) {
  const auto& curve = result.curve;
  const bool told =
      curve.complete ||
      curve.diagnosis == solver::Diagnosis::interrupted;  // that is the end of the whole run
  told ? progress_.info(outcome_text(result)) : progress_.warning(outcome_text(result));
  CurveSummary summary = summarise(result);
  if (const auto* load = std::get_if<double>(&result.load);
      load != nullptr && !model.patches.empty()) {
    keep_preload(summary, model, *load);
  }
  if (!result.integrated) {
    if (const std::string text = precision_text(summary, model); !text.empty())
      progress_.warning(text);
  }
  warn_of_unsolved(result);
  for (const std::string& text : {restless_text(result), unstable_peak_text(result)}) {
    if (!text.empty()) progress_.warning(text);
  }
  if (const std::string text = many_folds_text(result); !text.empty()) progress_.warning(text);
  if (const std::string text = left_out_text(result); !text.empty() && !refines_) {
    progress_.warning(text);
  }
  if (const auto* scale = std::get_if<double>(&result.load);
      scale != nullptr && !in_newtons(model)) {
    summary.preload_scale = *scale;
    summary.preload =
        *summary.preload_carried > 0.0 ? *summary.preload_carried : *summary.preload_integral;
  }
  if (curve.complete && !curve.message.empty()) {
    progress_.warning(fmt::format("curve {}: {}", result.name, curve.message));
  }
  const bool warns = has_higher_branch(result) && !refines_;
  for (const std::string& line : detached_text(result)) {
    warns ? progress_.warning(line) : progress_.info(line);
  }
  if (!curve.certificate.empty())
    progress_.info(fmt::format("curve {}: {}", result.name, curve.certificate));
  progress_.settle(result.name, curve.points);
  const std::lock_guard lock(mutex_);
  unfinished_.erase(result.name);
  if (model.effects.normal_motion) tell_opening(result, summary_.effects);
  summary_.curves.push_back(std::move(summary));
  write_curve(staged_, result, model.frequency.size());
  show_what_is_new();
  write_summary_so_far();
}

void RunRecord::note_point(const std::string& curve, const std::variant<double, LimitName>& load,
                           const solver::ResponsePoint& point) {
  const std::lock_guard lock(mutex_);
  CurveResult& result = unfinished_[curve];
  result.name = curve;
  result.load = load;
  result.curve.points.push_back(point);
  result.curve.iterations += point.iterations;
}

void RunRecord::keep_unfinished() {
  const std::lock_guard lock(mutex_);
  for (auto& [name, result] : unfinished_) {
    solver::ResponseCurve& curve = result.curve;
    curve.diagnosis = solver::Diagnosis::interrupted;
    curve.message = fmt::format("stopped at {:.8g} Hz", hz_per_rad * curve.points.back().frequency);
    tell_remedy(remedy_of(curve.diagnosis, ResponseDescription::Method::harmonic_balance), curve);
    progress_.info(fmt::format("curve {}: {} points, incomplete: interrupted: {}", name,
                               curve.points.size(), curve.message));
    summary_.curves.push_back(summarise(result));
    write_curve(staged_, result, curve.points.back().q.rows().cols());
  }
  unfinished_.clear();
}

std::vector<std::string> RunRecord::keep_map(const ReducedModel& model, const NamedMap& map,
                                             std::size_t curve) {
  const auto files = write_map(staged_ / "maps", model.patches.at(map.patch), map);
  const std::lock_guard lock(mutex_);
  summary_.curves.at(curve).maps.push_back(map.name);
  return within("maps", files);
}

std::vector<std::string> RunRecord::keep_motion(const std::string& name,
                                                const solver::ResponsePoint& point) {
  if (!structure_) return {};  // a modal scene has no body to draw
  return within("motion", write_motion(staged_ / "motion", name, structure_->mesh,
                                       structure_->basis, point.q, hz_per_rad * point.frequency));
}

std::optional<Pictures> RunRecord::pictures_of(const std::vector<std::string>& maps,
                                               const std::vector<std::string>& files) const {
  Pictures pictures{.maps = maps, .files = {}};
  for (const std::string& file : files) {
    pictures.files.push_back({file, bytes_of(staged_ / file)});
    if (pictures.files.back().bytes.empty()) return std::nullopt;
  }
  return pictures;
}

void RunRecord::keep_pictures(const Pictures& pictures, std::size_t curve) {
  for (const PictureFile& file : pictures.files) {
    make_folder((staged_ / file.name).parent_path());
    write_whole(staged_ / file.name, file.bytes);
  }
  const std::lock_guard lock(mutex_);
  auto& names = summary_.curves.at(curve).maps;
  names.insert(names.end(), pictures.maps.begin(), pictures.maps.end());
}

void RunRecord::keep_optimum(const ReducedModel& model, const OptimumRequest& request,
                             const solver::Optimum& optimum, const CurveBudget& budget) {
  const std::string unit_of_load = in_newtons(model) ? " N" : " times the points' rest loads";
  const std::string unit = request.of_preload()   ? unit_of_load
                           : request.unit.empty() ? ""
                                                  : " " + request.unit;
  const std::string what =
      request.of_preload() ? "best preload"
      : request.load
          ? fmt::format("best {} under preload {:g}{}", request.key, *request.load, unit_of_load)
          : fmt::format("best {} under the static preload", request.key);
  const std::string beside = budget.has_bar() ? after_bar(left_out()) : "";
  const std::string told = fmt::format("{}: {}{}", what, best_text(optimum, unit, budget), beside);
  if (optimum.found) {
    progress_.info(told);
  } else {
    progress_.warning(told);
  }
  for (const std::string& note : optimum.notes) progress_.info("optimum: " + note);
  for (const std::string& warning : optimum.warnings) progress_.warning("optimum: " + warning);
  if (const std::string text = crossing_text(optimum); !text.empty()) {
    progress_.warning("optimum: " + text);
  }
  note_optimum(model, request, optimum, budget);
}

void RunRecord::note_optimum(const ReducedModel& model, const OptimumRequest& request,
                             const solver::Optimum& optimum, const CurveBudget& budget) {
  const std::lock_guard lock(mutex_);
  OptimumSummary& summary = summary_.optimum.emplace();
  summary.request = request;
  summary.optimum = optimum;
  summary.error_budget = budget.rows;
  summary.not_in_bar = budget.unknown;
  summary.left_out = left_out_of_curves();
  if (!budget.rows.empty()) summary.dissipated_energy = budget.dissipated_energy;
  if (!in_newtons(model)) summary.newtons_per_load = contact_of(model, 1.0).at_rest().carried;
  write_optimum_csv(staged_, request, optimum);
}

void RunRecord::keep_budget(const CurveBudget& budget, BesideBar left_out,
                            const CurveResult& result, const ReducedModel& model) {
  if (const std::string text = budget_text(budget); !text.empty()) {
    progress_.info(text + after_bar(left_out));
  }
  if (const std::string text = rival_text(result, budget); !text.empty()) progress_.warning(text);
  const std::lock_guard lock(mutex_);
  summary_.error_budget.insert(summary_.error_budget.end(), budget.rows.begin(), budget.rows.end());
  left_out_.insert(left_out_.end(), budget.left_out.begin(), budget.left_out.end());
  for (CurveSummary& curve : summary_.curves) {
    if (curve.name != result.name) continue;
    curve.not_in_bar = budget.unknown;
    curve.left_out = std::move(left_out);
    break;
  }
  if (result.band) write_curve(staged_, result, model.frequency.size());
}

void RunRecord::keep_bracket(OptimumBracket bracket) {
  const std::lock_guard lock(mutex_);
  const OptimumSummary& as_given = *summary_.optimum;
  const CurveBudget budget{.rows = as_given.error_budget, .unknown = as_given.not_in_bar};
  if (const std::string text = few_harmonics_text(bracket); !text.empty()) progress_.info(text);
  for (const OptimumOfFactor& entry : bracket.entries) {
    progress_.info(fmt::format("with {} x {:g}{}: {}", entry.parameter, entry.factor,
                               range_text(entry), bracket_text(entry, budget)));
  }
  for (const std::string& reason : bracket.left_out) {
    progress_.info("not varied: " + reason);
  }
  summary_.optimum->bracket = std::move(bracket);
}

void RunRecord::keep_report() {
  RunSummary ended;
  {
    const std::lock_guard lock(mutex_);
    write_summary_file();  // the plots are drawn of it
    ended = summary_;
    ended.exit_code = verdict();
    ended.message = ending();
  }
  if (!plots_) {
    write_whole(staged_ / "report.md", report_text(summary_json(ended), {}));
    return;
  }
  for (const std::string& warning : write_report(folder_, staged_, summary_json(ended))) {
    progress_.warning(place_.in_place(warning));
  }
}

void RunRecord::write_summary_file() {
  summary_.stages = progress_.stages();
  summary_.warnings = progress_.warnings();
  if (begun_) write_summary(folder_ / "summary.json", summary_);
}

void RunRecord::write_summary_so_far() {
  RunSummary so_far = summary_;
  so_far.curves = shown_;
  so_far.stages = progress_.stages();
  so_far.warnings = progress_.warnings();
  if (begun_) write_summary(folder_ / "summary.json", so_far);
}

void RunRecord::fail(ExitCode code, const std::string& message) {
  progress_.error(message);
  progress_.finish();
  const std::lock_guard lock(mutex_);
  try {
    if (begun_) {
      tell_failure(code, message);
    } else {
      restore_summary(code, message);
    }
  } catch (const std::exception& error) {
    progress_.error(error.what());  // the first error is the one to report
    tell_failure_in_place(folder_ / "summary.json", code);
  }
}

void RunRecord::tell_failure(ExitCode code, const std::string& message) {
  summary_.exit_code = code;
  summary_.message = message;
  show_what_is_new();
  if (place_.would_replace()) {
    summary_.curves = shown_;
    summary_.message +=
        "; what the stage had finished is kept for --resume, the results of the run before stay";
  }
  write_summary_file();
  if (summary_.curves.empty()) return;
  write_whole(staged_ / "report.md",
              report_text(summary_json(summary_), {}));  // plots take seconds
  show_what_is_new();
}

std::string RunRecord::ending() const {
  if (summary_.accuracy && !summary_.accuracy->message.empty()) return summary_.accuracy->message;
  if (was_cut_short()) return "out of time: what was solved until then is there";
  return any_is_spent(summary_.curves)
             ? "the budget of a curve is over: what was solved until then is there"
             : "";
}

ExitCode RunRecord::verdict() const {
  const bool complete = std::all_of(summary_.curves.begin(), summary_.curves.end(),
                                    [](const CurveSummary& curve) { return curve.complete; });
  if (was_cut_short() || any_is_spent(summary_.curves)) return ExitCode::exhausted;
  return complete ? ExitCode::complete : ExitCode::incomplete;
}

}  // namespace microslip::pipelines
