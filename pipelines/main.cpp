/// @file
/// The program `microslip`: reads the command line, calls one study, turns its end into an exit code.

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "fem/slepc_session.hpp"
#include "pipelines/command_line.hpp"
#include "pipelines/cycle_plot.hpp"
#include "pipelines/cycle_table.hpp"
#include "pipelines/exit_code.hpp"
#include "pipelines/interrupt.hpp"
#include "pipelines/output_file.hpp"
#include "pipelines/scene_file.hpp"
#include "pipelines/scene_template.hpp"
#include "pipelines/study.hpp"

namespace {

using namespace microslip;
using namespace microslip::pipelines;

struct Arguments {
  std::string command;
  std::string input;  // scene, table, kind or folder
  std::string output;
  std::vector<std::string> overrides;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::optional<int> harmonics;
  std::optional<std::string> plot_folder;
  std::string tolerance;
  std::string budget;
  bool resume = false;
  bool dry_run = false;
  bool quiet = false;
  bool verbose = false;
  bool json = false;
  int rank = 0;
  nlohmann::ordered_json findings = nlohmann::ordered_json::object();  // of `check`, for --json
};

/// Options this version does not have, or that say nothing to the command: refused, never ignored.
void refuse_idle_options(const Arguments& arguments) {
  const auto refuse_later = [](bool given, const char* name) {
    if (given) throw SceneError(fmt::format("{} is not available in this version", name));
  };
  refuse_later(arguments.resume, "--resume");
  refuse_later(!arguments.tolerance.empty(), "--tolerance");
  refuse_later(!arguments.budget.empty(), "--budget");
  const bool reads_scene =
      arguments.command != "init" && arguments.command != "cycle" && arguments.command != "report";
  if (!reads_scene && !arguments.overrides.empty()) {
    throw SceneError(fmt::format("--set: {} reads no scene", arguments.command));
  }
  if (arguments.dry_run && (arguments.command == "init" || arguments.command == "report")) {
    throw SceneError(fmt::format("--dry-run: {} has nothing to leave out", arguments.command));
  }
}

RunOptions options_of(const Arguments& arguments, const std::filesystem::path& output) {
  RunOptions options;
  options.output = output;
  options.jobs = arguments.jobs;
  options.rank = arguments.rank;
  if (arguments.quiet) options.verbosity = Verbosity::quiet;
  if (arguments.verbose) options.verbosity = Verbosity::verbose;
  return options;
}

/// runs/STEM in the working folder, where -o names none.
void choose_run_folder(Arguments& arguments) {
  if (!arguments.output.empty()) return;
  const std::filesystem::path stem = std::filesystem::path(arguments.input).stem();
  arguments.output = (std::filesystem::path("runs") / stem).string();
}

SceneDescription scene_of(const Arguments& arguments) {
  return read_scene(arguments.input, arguments.overrides);
}

/// The mesher is a process of its own that an interrupt must end, and its scratch folder with it.
int check(Arguments& arguments) {
  const SceneDescription scene = scene_of(arguments);
  watch_for_interrupts();
  const CheckResult result = check_study(scene, std::cout);
  const Forecast& forecast = result.forecast;
  nlohmann::ordered_json& cost = arguments.findings["forecast"];
  cost = {{"degrees_of_freedom", forecast.degrees_of_freedom},
          {"modes_seconds", forecast.modes_seconds},
          {"curves_seconds", forecast.curves_seconds},
          {"memory_GB", forecast.memory_gb}};
  if (forecast.curves_seconds_along_r) cost["curves_seconds_along_r"] = *forecast.curves_seconds_along_r;
  nlohmann::ordered_json& effects = arguments.findings["effects"] = nlohmann::ordered_json::array();
  for (const EffectRecord& effect : result.effects) {
    effects.push_back({{"name", effect.name},
                       {"setting", effect.setting},
                       {"simulated", effect.simulated},
                       {"reason", effect.reason}});
  }
  arguments.findings["warnings"] = result.warnings;
  return static_cast<int>(ExitCode::complete);
}

int run_scene(Arguments& arguments, int (*study)(const SceneDescription&, const RunOptions&)) {
  if (arguments.dry_run) return check(arguments);
  const SceneDescription scene = scene_of(arguments);
  choose_run_folder(arguments);
  require_folder_name(arguments.output, "-o");
  std::signal(SIGPIPE, SIG_IGN);  // who reads the progress may leave; the run is for its folder
  std::unique_ptr<fem::SlepcSession> session;  // modal scenes need no finite elements
  if (!std::holds_alternative<ModalModel>(scene.model)) {
    session = std::make_unique<fem::SlepcSession>();
    arguments.rank = session->rank();
  }
  watch_for_interrupts();  // after MPI, which sets handlers of its own
  return study(scene, options_of(arguments, arguments.output));
}

int mesh(Arguments& arguments) {
  if (arguments.dry_run) return check(arguments);
  const SceneDescription scene = scene_of(arguments);
  if (!std::holds_alternative<BladeModel>(scene.model)) {
    throw SceneError(scene.file.string() +
                     ": model.kind: this kind has no geometry to mesh; expected \"blade\"");
  }
  require_file_name(arguments.output, "-o");
  if (std::filesystem::path(arguments.output).extension() != ".msh") {
    throw SceneError(fmt::format("-o {}: expected a name that ends in .msh: gmsh's format is written", arguments.output));
  }
  const std::filesystem::path file = std::filesystem::absolute(arguments.output);
  if (!std::filesystem::is_directory(file.parent_path())) {
    throw ExhaustedError(arguments.output + ": the folder to write in does not exist");
  }
  require_writable(file.parent_path());  // before the mesher works for nothing
  watch_for_interrupts();
  return mesh_study(scene, options_of(arguments, arguments.output));
}

/// To the file given with -o, whole or not at all; else to standard output.
void put_out(const Arguments& arguments, const std::string& text) {
  if (arguments.output.empty()) {
    std::cout << text;
  } else {
    write_whole(arguments.output, text);
  }
}

int init(const Arguments& arguments) {
  const std::string text = scene_template(arguments.input.empty() ? "blade" : arguments.input);
  std::error_code ignored;  // a path that cannot be looked at cannot be written either: said there
  if (!arguments.output.empty() && std::filesystem::exists(arguments.output, ignored)) {
    throw SceneError(arguments.output + ": exists; init overwrites nothing");
  }
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
  const CsvTable table = CsvTable::read(arguments.input);
  const std::string json = cycles_as_json(table, arguments.harmonics);
  if (table.n_rows() == 0) {
    std::cerr << fmt::format("warning: {}: no rows below the header: there is no cycle to compute\n", table.name());
  }
  std::vector<CyclePlot> plots;
  if (arguments.plot_folder) plots = cycle_plots(table);
  if (arguments.dry_run) {
    std::cout << fmt::format("{} points; every row is complete\n", table.n_rows());
    return 0;
  }
  if (arguments.plot_folder) write_cycle_plots(plots, *arguments.plot_folder);
  put_out(arguments, json);
  if (arguments.plot_folder) draw_cycle_plots(plots, *arguments.plot_folder);
  return 0;
}

/// The commands, and what each does; the chosen one is left in `chosen`.
using Action = std::function<int()>;

void add_global_options(CLI::App& app, Arguments& a) {
  app.add_option("--set", a.overrides,
                 "key.path=value: overrides any key of the scene; may be repeated")
      ->take_all()
      ->expected(1);
  app.add_option("-j,--jobs", a.jobs,
                 "curves traced at the same time; the numbers do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_flag("--resume", a.resume, "continue an interrupted run (not available in this version)");
  app.add_option("--tolerance", a.tolerance,
                 "accuracy asked for, e.g. 1% (not available in this version)");
  app.add_option("--budget", a.budget, "time allowed, e.g. 60s (not available in this version)");
  app.add_flag("--dry-run", a.dry_run, "check the scene and stop, as `check` does");
  auto* quiet = app.add_flag("-q,--quiet", a.quiet, "warnings and errors only");
  app.add_flag("-v,--verbose", a.verbose, "one line per solution point")->excludes(quiet);
  app.add_flag("--json", a.json, "last line on standard output is one JSON object");
}

CLI::App* add_command(CLI::App& app, Arguments& a, Action& chosen, const char* name,
                      const char* what, Action action) {
  CLI::App* command = app.add_subcommand(name, what);
  command->fallthrough();
  command->footer([&app] {  // the help of a command is complete
    const auto* format = dynamic_cast<const CLI::Formatter*>(app.get_formatter().get());
    return format == nullptr
               ? std::string("More options: microslip --help")
               : "Of every command:\n" + format->make_groups(&app, CLI::AppFormatMode::Normal);
  });
  command->callback([&a, &chosen, name, action = std::move(action)] {
    a.command = name;
    chosen = action;
  });
  return command;
}

void add_commands(CLI::App& app, Arguments& a, Action& chosen) {
  const auto with_scene = [&](CLI::App* command) {
    command->add_option("scene", a.input, "scene file (TOML)")->required();
    return command;
  };
  const auto with_output = [&](CLI::App* command, const char* what) {
    command->add_option("-o,--output", a.output, what)
        ->check([](const std::string& name) { return name.empty() ? std::string("expected a name") : std::string(); });
    return command;
  };
  auto* init_command = add_command(app, a, chosen, "init", "print a commented template scene",
                                   [&] { return init(a); });
  init_command->add_option("kind", a.input, "blade, mesh, modal, bar, chain or block")
      ->default_str("blade");
  with_output(init_command, "file to write; it must not exist");
  with_scene(
      add_command(app, a, chosen, "check",
                  "parse, check units and names, show mesh, effects and forecast; solve nothing",
                  [&] { return check(a); }));
  auto* mesh_command =
      with_scene(add_command(app, a, chosen, "mesh", "geometry to mesh", [&] { return mesh(a); }));
  with_output(mesh_command, "gmsh file to write (.msh)")->get_option("--output")->required();
  auto* modes_command =
      with_scene(add_command(app, a, chosen, "modes", "mesh to modes and residual flexibility",
                             [&] { return run_scene(a, modes_study); }));
  with_output(modes_command, "run folder; default runs/SCENE");
  auto* run_command =
      with_scene(add_command(app, a, chosen, "run", "everything: modes, curves, maps, report",
                             [&] { return run_scene(a, run_study); }));
  with_output(run_command, "run folder; default runs/SCENE");
  auto* cycle_command =
      add_command(app, a, chosen, "cycle", "steady friction cycles of single contact points",
                  [&] { return cycle(a); });
  cycle_command
      ->add_option("table", a.input,
                   "CSV file, SI units, one point per row; columns tangential_stiffness, "
                   "normal_stiffness, friction_coefficient, preload, u_sin, u_cos, "
                   "v_mean, v_sin, v_cos, optional id, u_mean and harmonics u_sin2, "
                   "u_cos2, v_sin2, ..., second direction w_sin, w_cos, ... "
                   "and tangential_stiffness_r, in any order")
      ->required();
  with_output(cycle_command, "JSON file to write; default standard output");
  cycle_command
      ->add_option("--harmonics", a.harmonics,
                   "highest harmonic of the forces put out; default the highest of the table")
      ->check(CLI::Range(1, largest_harmonic));
  cycle_command->add_option("--plot", a.plot_folder,
                            "folder for loops of every row: sampled CSV, SVG and PNG by its id");
  with_scene(add_command(app, a, chosen, "converge",
                         "what accuracy costs (not available in this version)", []() -> int {
                           throw SceneError(
                               "converge is not available in this version; "
                               "share/scripts/mesh_convergence.py varies the mesh");
                         }));
  auto* report_command =
      add_command(app, a, chosen, "report", "rebuild plots and report of a run folder",
                  [&] { return report_study(a.input); });
  report_command->add_option("folder", a.input, "run folder")->required();
}

void print_json_line(const Arguments& arguments, int code, const std::string& message) {
  nlohmann::ordered_json line{{"program", "microslip"},       {"version", MICROSLIP_VERSION},
                              {"command", arguments.command}, {"exit_code", code},
                              {"input", arguments.input},     {"output", arguments.output}};
  if (!message.empty()) line["message"] = message;
  line.update(arguments.findings);
  std::cout << line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)
            << std::endl;
}

/// A command line that cannot be read.
int misused(const Arguments& arguments, const std::string& message, int argc, char** argv) {
  std::cerr << "microslip: " << message << "\nRun with --help for more information.\n";
  const int code = static_cast<int>(ExitCode::bad_input);
  const std::vector<std::string_view> words(argv, argv + argc);
  const bool json = std::find(words.begin(), words.end(), "--json") != words.end();
  if (json) print_json_line(arguments, code, message);
  return code;
}

constexpr const char* unwritable_output = "standard output cannot be written; is the disk full?";

int guarded(Arguments& arguments, const Action& action) {
  std::string message;
  int code = 0;
  try {
    refuse_idle_options(arguments);
    code = action();
    std::cout.flush();
    if (!std::cout) throw ExhaustedError(unwritable_output);
  } catch (const std::exception& error) {
    const ExitCode verdict = exit_code_of(error);
    code = static_cast<int>(verdict);
    message = verdict == ExitCode::internal ? fmt::format("internal error: {}", error.what())
                                            : std::string(error.what());
    if (verdict == ExitCode::refused && message.find(arguments.input) == std::string::npos) {
      message.insert(0, arguments.input + ": ");
    }
    if (arguments.rank == 0) std::cerr << "microslip: " << message << '\n';
  }
  if (arguments.json && arguments.rank == 0) {
    print_json_line(arguments, code, message);
    if (!std::cout && code == 0) {
      std::cerr << "microslip: " << unwritable_output << '\n';
      code = static_cast<int>(ExitCode::exhausted);
    }
  }
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  Action chosen;
  CLI::App app(
      "Vibration of friction-damped turbine blades: geometry, modes, forced response, "
      "contact maps.\nExit codes: 0 complete, 1 bad input, 2 refused on physical grounds, "
      "3 incomplete, 4 out of time, memory or disk, 5 internal error.",
      "microslip");
  app.set_version_flag("--version", "microslip " MICROSLIP_VERSION);
  app.require_subcommand(1);
  add_global_options(app, arguments);
  add_commands(app, arguments, chosen);
  const std::string unknown = unknown_command(app, argc, argv);
  if (!unknown.empty()) return misused(arguments, unknown, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    return misused(arguments, explained(error, app, argc, argv), argc, argv);
  }
  return guarded(arguments, chosen);
}
