#include "pipelines/commands.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <memory>
#include <system_error>
#include <variant>

#include <fmt/format.h>

#include "fem/slepc_session.hpp"
#include "mesh/count_text.hpp"
#include "pipelines/cycle/cycle_plot.hpp"
#include "pipelines/cycle/cycle_table.hpp"
#include "pipelines/files/checkpoint.hpp"
#include "pipelines/files/columns.hpp"
#include "pipelines/files/write_faces.hpp"
#include "pipelines/files/write_report.hpp"
#include "pipelines/files/write_summary.hpp"
#include "pipelines/import/mesh_file.hpp"
#include "pipelines/import/mesh_names.hpp"
#include "pipelines/import/mesh_scene.hpp"
#include "pipelines/import/mesher_limits.hpp"
#include "pipelines/import/step_mesh.hpp"
#include "pipelines/import/step_scene.hpp"
#include "pipelines/record/failed_start.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "pipelines/scene/scene_template.hpp"
#include "pipelines/sections/static_section.hpp"
#include "pipelines/stages/shared_curves.hpp"
#include "pipelines/structure/campbell.hpp"
#include "pipelines/structure/on_all_ranks.hpp"
#include "pipelines/structure/solver_process.hpp"
#include "pipelines/structure/structure_task.hpp"
#include "pipelines/system/exit_code.hpp"
#include "pipelines/system/interrupt.hpp"
#include "pipelines/system/mesh_format.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/system/result_cache.hpp"
#include "pipelines/text/json_entry.hpp"
#include "pipelines/text/units.hpp"

namespace microslip::pipelines {
namespace {

std::filesystem::path cache_of(const Arguments& arguments) {
  return arguments.no_cache ? std::filesystem::path() : cache_folder();
}

/// Of --sizes [m].
std::vector<double> lengths_in(const std::vector<std::string>& words) {
  std::vector<double> lengths;
  for (const std::string& word : words) {
    try {
      lengths.push_back(to_si(word, "m"));
    } catch (const UnitError& error) {
      throw SceneError(fmt::format("--sizes: {}", error.what()));
    }
  }
  return lengths;
}

RunOptions options_of(const Arguments& arguments, const std::filesystem::path& output) {
  RunOptions options;
  options.output = output;
  options.jobs = arguments.jobs;
  options.repeat_seconds = arguments.repeat_seconds;
  if (arguments.resume) options.start = RunStart::resumed;
  options.cache = cache_of(arguments);
  if (arguments.quiet) options.verbosity = Verbosity::quiet;
  if (arguments.verbose) options.verbosity = Verbosity::verbose;
  const auto with = [&](const char* part) {
    return std::ranges::find(arguments.without, part) == arguments.without.end();
  };
  options.plots = with("plots");
  options.maps = with("maps");
  options.bracket = with("bracket");
  return options;
}

/// runs/STEM in the working folder, where -o names none.
void choose_run_folder(Arguments& arguments) {
  if (!arguments.output.empty()) return;
  const std::filesystem::path stem = std::filesystem::path(arguments.input).stem();
  arguments.output = (std::filesystem::path("runs") / stem).string();
}

SceneDescription scene_of(const Arguments& arguments) {
  std::vector<std::string> overrides = arguments.overrides;
  if (!arguments.tolerance.empty()) {
    overrides.push_back("accuracy.tolerance=" + arguments.tolerance);
  }
  if (!arguments.budget.empty()) overrides.push_back("accuracy.budget=" + arguments.budget);
  return read_scene(arguments.input, overrides);
}

/// To the file given with -o, whole or not at all; else to standard output.
void put_out(const Arguments& arguments, const std::string& text) {
  if (arguments.output.empty()) {
    std::cout << text;
  } else {
    write_whole(arguments.output, text);
  }
}

void require_picture_name(const std::string& file) {
  require_file_name(file, "--plot");
  const std::filesystem::path ending = std::filesystem::path(file).extension();
  if (ending != ".png" && ending != ".svg" && ending != ".pdf") {
    throw SceneError(
        fmt::format("--plot {}: expected a name that ends in .png, .svg or .pdf", file));
  }
}

void require_mesh_format(const std::string& file) {
  if (mesh_format(file) != MeshFormat::unknown) return;
  if (is_step_file(file)) {
    throw SceneError(
        fmt::format("{}: a STEP file has no mesh yet; `microslip faces` tells its faces", file));
  }
  throw SceneError(
      fmt::format("{}: meshes are read from files that end in {}", file, mesh_endings()));
}

void require_step_format(const std::string& file) {
  if (is_step_file(file)) return;
  throw SceneError(fmt::format("{}: STEP files end in .step or .stp", file));
}

std::array<double, 3> array_of(const Eigen::Vector3d& x) { return {x.x(), x.y(), x.z()}; }

}  // namespace

void refuse_idle_options(const Arguments& arguments) {
  const bool solves = arguments.command == "run" || arguments.command == "check";
  for (const auto& [given, name] : {std::pair{!arguments.tolerance.empty(), "--tolerance"},
                                    std::pair{!arguments.budget.empty(), "--budget"}}) {
    if (given && !solves) {
      throw SceneError(
          fmt::format("{}: goes with run and check, not with {}", name, arguments.command));
    }
  }
  if (arguments.resume && arguments.command != "run" && arguments.command != "modes") {
    throw SceneError(fmt::format("--resume: {} leaves nothing to go on with; run and modes do",
                                 arguments.command));
  }
  const bool reads_scene = arguments.command != "init" && arguments.command != "cycle" &&
                           arguments.command != "report" && arguments.command != "columns" &&
                           arguments.command != "surfaces" && arguments.command != "faces";
  for (const auto& [given, name] : {std::pair{!arguments.overrides.empty(), "--set"},
                                    std::pair{arguments.no_cache, "--no-cache"}}) {
    if (given && !reads_scene) {
      throw SceneError(fmt::format("{}: {} reads no scene", name, arguments.command));
    }
  }
  if (arguments.dry_run && (arguments.command == "init" || arguments.command == "report" ||
                            arguments.command == "columns" || arguments.command == "surfaces" ||
                            arguments.command == "faces")) {
    throw SceneError(fmt::format("--dry-run: {} has nothing to leave out", arguments.command));
  }
}

namespace {

/// What --json tells of a run: its peaks, best value and bars, as summary.json has them.
nlohmann::ordered_json results_in(const std::filesystem::path& folder) {
  const auto summary = parse_json(read_summary(folder), (folder / "summary.json").string());
  nlohmann::ordered_json results{{"warnings", summary.at("warnings")},
                                 {"accuracy", summary.at("accuracy")}};
  if (summary.at("message") != "") results["message"] = summary.at("message");
  results["frequency_Hz"] = nlohmann::ordered_json::array();
  for (const auto& mode : summary.at("modes")) {
    results["frequency_Hz"].push_back(mode.at("frequency_Hz"));
  }
  results["curves"] = nlohmann::ordered_json::array();
  for (const auto& curve : summary.at("curves")) {
    nlohmann::ordered_json& told = results["curves"].emplace_back();
    for (const char* key : {"name", "preload_N", "preload_scale", "complete", "diagnosis", "peak",
                            "folds_Hz", "bar", "digits"}) {
      told[key] = curve.at(key);
    }
  }
  nlohmann::ordered_json& optimum = results["optimum"] = summary.at("optimum");
  if (!optimum.is_null()) optimum.erase("trace");
  return results;
}

}  // namespace

/// The mesher is a process of its own that an interrupt must end, and its scratch folder with it.
int check(Arguments& arguments) {
  const SceneDescription scene = scene_of(arguments);
  if (arguments.picture) require_picture_name(*arguments.picture);
  std::unique_ptr<fem::SlepcSession> session;
  if (!std::holds_alternative<ModalModel>(scene.model) && !fem::SlepcSession::is_open()) {
    session = std::make_unique<fem::SlepcSession>();
  }
  const InterruptWatch watch;
  const ResultCache cache(cache_of(arguments), [](const auto& line) { std::cout << line << '\n'; });
  const CheckResult result =
      check_study(scene, arguments.picture.value_or(""), std::cout, options_of(arguments, {}));
  const Forecast& forecast = result.forecast;
  nlohmann::ordered_json& cost = arguments.findings["forecast"];
  cost = {{"degrees_of_freedom", forecast.degrees_of_freedom},
          {"modes_seconds", forecast.modes_seconds},
          {"curves_seconds", forecast.response.curves},
          {"errors_seconds", forecast.response.errors},
          {"best_value_seconds", forecast.response.best_value},
          {"bracket_seconds", forecast.response.bracket},
          {"maps_seconds", forecast.pictures.maps},
          {"plots_seconds", forecast.pictures.plots},
          {"memory_GB", forecast.memory_gb}};
  if (forecast.solver_memory) {
    cost["memory_direct_GB"] = 1e-3 * forecast.solver_memory->direct_mb;
    cost["memory_iterative_GB"] = 1e-3 * forecast.solver_memory->iterative_mb;
    cost["memory_available_GB"] = 1e-3 * forecast.solver_memory->available.megabytes;
  }
  if (forecast.response_along_r) cost["curves_seconds_along_r"] = forecast.response_along_r->curves;
  arguments.findings["effects"] = nlohmann::ordered_json::parse(effects_json(result.effects));
  arguments.findings["warnings"] = result.warnings;
  return static_cast<int>(ExitCode::complete);
}

int run_scene(Arguments& arguments, const Study& study) {
  if (arguments.dry_run) return check(arguments);
  choose_run_folder(arguments);
  require_folder_name(arguments.output, "-o");
  const SceneDescription scene = begin_in(arguments.output, [&] { return scene_of(arguments); });
  if (arguments.resume) {
    if (const auto code = ended_run(arguments.output, scene.complete_toml)) {
      const bool had_no_time = *code == static_cast<int>(ExitCode::exhausted);
      std::cerr << fmt::format(
          "{}: the run has come to its end: nothing to resume{}\n", arguments.output,
          had_no_time ? "; where its budget has ended it, the same with a longer "
                        "one and without --resume goes on from the cache"
                      : "");
      return *code;
    }
  }
  std::signal(SIGPIPE, SIG_IGN);  // who reads the progress may leave; the run is for its folder
  std::unique_ptr<fem::SlepcSession> session;  // modal scenes need no finite elements
  if (!std::holds_alternative<ModalModel>(scene.model) && !fem::SlepcSession::is_open()) {
    session = std::make_unique<fem::SlepcSession>();
  }
  const InterruptWatch watch;  // after MPI, which sets handlers of its own
  const int code = study(scene, options_of(arguments, arguments.output));
  const bool leaves_summary = arguments.command == "run" || arguments.command == "modes";
  if (arguments.json && leaves_summary) {
    arguments.findings = results_in(arguments.output);
  }
  return code;
}

namespace {

int write_geometry(const BladeModel& blade, const std::filesystem::path& file, bool quiet) {
  with_mesher([&](const mesh::MesherLimits& limits) {
    mesh::mesh_blade(blade.geometry, blade.sizes, file, limits);
  });
  if (!quiet) std::cout << "written: " << file.string() << '\n';
  return static_cast<int>(ExitCode::complete);
}

/// FROM TO N of --speeds.
Eigen::VectorXd speeds_in(const std::vector<std::string>& words) {
  constexpr int most = 10'000;
  std::array<double, 2> ends{};
  for (std::size_t i = 0; i < ends.size(); ++i) {
    try {
      ends[i] = rotation_speed(words[i]);
    } catch (const UnitError& error) {
      throw SceneError(fmt::format("--speeds: {}", error.what()));
    }
  }
  if (!(ends[0] < ends[1])) {
    throw SceneError(
        fmt::format("--speeds {} {}: expected the lower speed first", words[0], words[1]));
  }
  int n = 0;
  const char* const last = words[2].data() + words[2].size();
  const auto [end, error] = std::from_chars(words[2].data(), last, n);
  if (error != std::errc() || end != last || n < 2 || n > most) {
    throw SceneError(
        fmt::format("--speeds: \"{}\" is no number of speeds; expected 2 to {}", words[2], most));
  }
  return Eigen::VectorXd::LinSpaced(n, ends[0], ends[1]);
}

}  // namespace

int campbell(Arguments& arguments) {
  const CampbellRequest request{speeds_in(arguments.speeds), arguments.engine_orders};
  return run_scene(arguments, [&](const SceneDescription& scene, const RunOptions& options) {
    return campbell_study(scene, request, options);
  });
}

int converge(Arguments& arguments) {
  const ConvergeRequest request{arguments.meshes, lengths_in(arguments.sizes), arguments.knobs};
  const int code =
      run_scene(arguments, [&](const SceneDescription& scene, const RunOptions& options) {
        return converge_study(scene, request, options);
      });
  if (arguments.dry_run) static_cast<void>(asked_ladders(scene_of(arguments), request));
  return code;
}

int mesh(Arguments& arguments) {
  if (arguments.dry_run) return check(arguments);
  const SceneDescription scene = scene_of(arguments);
  if (!element_size_of(scene)) {
    throw SceneError(
        scene.file.string() +
        ": model.kind: this kind has no geometry to mesh; expected \"blade\" or \"step\"");
  }
  require_file_name(arguments.output, "-o");
  const auto* blade = std::get_if<BladeModel>(&scene.model);
  const std::filesystem::path ending = std::filesystem::path(arguments.output).extension();
  const bool as_step = ending == ".step" && blade != nullptr;
  if (!as_step && ending != ".msh") {
    throw SceneError(fmt::format(
        "-o {}: expected a name that ends in .msh: gmsh's format is written{}", arguments.output,
        blade != nullptr ? "; or in .step: the geometry itself" : ""));
  }
  const std::filesystem::path file = std::filesystem::absolute(arguments.output);
  require_writable(file.parent_path());  // before the mesher works for nothing
  const InterruptWatch watch;
  if (as_step) return write_geometry(*blade, file, arguments.quiet);
  return mesh_study(scene, options_of(arguments, arguments.output));
}

int surfaces(Arguments& arguments) {
  require_mesh_format(arguments.input);
  const InterruptWatch watch;
  const MeshOfFile read = read_mesh(arguments.input, std::nullopt);
  std::cout << describe_names(read.mesh, read.length_unit);
  for (const std::string& remark : left_out_remarks(read)) {
    std::cout << "warning: " << remark << '\n';
  }
  nlohmann::ordered_json& list = arguments.findings["surfaces"] = nlohmann::ordered_json::array();
  for (const MeshName& name : mesh_names(read.mesh)) {
    nlohmann::ordered_json entry{{"name", name.name},
                                 {"kind", kind_name(name.kind)},
                                 {"faces", name.n_faces},
                                 {"nodes", name.n_nodes},
                                 {"area", name.area},
                                 {"centre", array_of(name.centre)},
                                 {"normal", array_of(name.normal)},
                                 {"flatness", name.flatness}};
    list.push_back(std::move(entry));
  }
  nlohmann::ordered_json& unit = arguments.findings["length_unit"];
  if (read.length_unit) unit = *read.length_unit;
  return static_cast<int>(ExitCode::complete);
}

int faces(Arguments& arguments) {
  require_step_format(arguments.input);
  if (!arguments.output.empty()) require_folder_name(arguments.output, "-o");
  const InterruptWatch watch;
  const StepBody body = open_step(arguments.input, std::nullopt);
  std::cout << describe_faces(body);
  const std::filesystem::path folder = arguments.output.empty() ? "." : arguments.output;
  make_folder(folder);
  const std::string stem = std::filesystem::path(arguments.input).stem().string() + "_faces";
  const std::filesystem::path picture = folder / (stem + ".png");
  write_faces_vtp(folder / (stem + ".vtp"), body.geometry);
  const std::string failure = draw_faces(picture, unit_text(body), body.geometry);
  if (!arguments.quiet) {
    std::cout << fmt::format("written: {}{}\n", (folder / (stem + ".vtp")).string(),
                             failure.empty() ? ", " + picture.string() : "");
  }
  for (const std::string& warning : {failure, size_doubt(body)}) {
    if (!warning.empty()) std::cerr << "warning: " << warning << '\n';
  }
  nlohmann::ordered_json& list = arguments.findings["faces"] = nlohmann::ordered_json::array();
  for (const mesh::StepFace& face : body.geometry.faces) {
    list.push_back({{"number", face.number},
                    {"kind", face.kind},
                    {"area", face.area},
                    {"centre", array_of(face.centre)},
                    {"normal", array_of(face.normal)}});
  }
  return static_cast<int>(ExitCode::complete);
}

int columns(const Arguments& arguments) {
  put_out(arguments, columns_text());
  return static_cast<int>(ExitCode::complete);
}

namespace {

std::filesystem::path folder_of_output(const Arguments& arguments) {
  return (std::filesystem::current_path() / arguments.output).parent_path();
}

/// `init KIND`, or with a file `init mesh`, `init step` or `init modes`;
/// a STEP file is taken for what it is.
std::string new_scene(const Arguments& arguments) {
  const std::string kind = arguments.input.empty() ? "blade" : arguments.input;
  if (arguments.mesh_file.empty()) return scene_template(kind);
  if (kind != "mesh" && kind != "step" && kind != "modes") {
    throw SceneError(fmt::format("init {} {}: a file goes with init mesh, step and modes alone",
                                 kind, arguments.mesh_file));
  }
  if (kind != "modes" && !arguments.mesh_of_modes.empty()) {
    throw SceneError(fmt::format("init {} {} {}: a second file, their mesh, goes with modes alone",
                                 kind, arguments.mesh_file, arguments.mesh_of_modes));
  }
  const InterruptWatch watch;
  const std::filesystem::path folder = folder_of_output(arguments);
  if (kind == "modes") return scene_of_modes(arguments.mesh_file, arguments.mesh_of_modes, folder);
  const bool is_step = kind == "step" || is_step_file(arguments.mesh_file);
  is_step ? require_step_format(arguments.mesh_file) : require_mesh_format(arguments.mesh_file);
  return is_step ? scene_of_step(arguments.mesh_file, folder)
                 : scene_of_mesh(arguments.mesh_file, folder);
}

}  // namespace

int init(const Arguments& arguments) {
  std::error_code ignored;  // a path that cannot be looked at cannot be written either: said there
  if (!arguments.output.empty() && std::filesystem::exists(arguments.output, ignored)) {
    throw SceneError(arguments.output + ": exists; init overwrites nothing");
  }
  const std::string text = new_scene(arguments);
  if (!arguments.output.empty()) require_file_name(arguments.output, "-o");
  put_out(arguments, text);
  return 0;
}

int cycle(const Arguments& arguments) {
  if (arguments.plot_folder && arguments.plot_folder->empty()) {
    throw SceneError("--plot: expected the name of a folder");
  }
  if (arguments.plot_folder) require_folder_name(*arguments.plot_folder, "--plot");
  if (!arguments.output.empty()) require_file_name(arguments.output, "-o");
  const CsvTable table = CsvTable::read(arguments.input, Tiny::zero);
  const std::string json = cycles_as_json(table, arguments.harmonics);
  if (table.n_rows() == 0) {
    std::cerr << fmt::format(
        "warning: {}: no rows below the header: there is no cycle to compute\n", table.name());
  }
  std::vector<CyclePlot> plots;
  if (arguments.plot_folder) plots = cycle_plots(table);
  if (arguments.dry_run) {
    std::cout << fmt::format("{}; every row is complete\n",
                             mesh::counted(table.n_rows(), "point", "points"));
    return 0;
  }
  if (arguments.plot_folder) write_cycle_plots(plots, *arguments.plot_folder);
  put_out(arguments, json);
  if (arguments.plot_folder) draw_cycle_plots(plots, *arguments.plot_folder);
  return 0;
}

int serve_rank_zero() {
  static constexpr std::array parts{
      Part{modes_work,
           [](std::string_view bytes) { static_cast<void>(solve(structure_task(bytes))); }},
      Part{campbell_work, take_part_in_campbell},
      Part{curves_work, take_part_in_curves},
  };
  return serve_rank_zero(parts);
}

bool is_solver(std::span<char* const> words) {
  return words.size() > 1 && words[1] == std::string_view(solver_word);
}

int serve_as_solver(std::span<char* const> words) {
  const auto failure = failure_of([&] {
    if (words.size() != 4) throw SceneError("expected the files of a task and of its modes");
    solve_task_file(words[2], words[3]);
  });
  if (!failure) return static_cast<int>(ExitCode::complete);
  std::cerr << "microslip: " << failure->message << '\n';
  return failure->code;
}

}  // namespace microslip::pipelines
