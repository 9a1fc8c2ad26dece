/// @file
/// The program `microslip`: reads the command line, calls one study, turns its end into an exit code.

#include <clocale>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "fem/slepc_session.hpp"
#include "pipelines/cycle_table.hpp"
#include "pipelines/exit_code.hpp"
#include "pipelines/interrupt.hpp"
#include "pipelines/output_file.hpp"
#include "pipelines/scene_file.hpp"
#include "pipelines/scene_keys.hpp"
#include "pipelines/scene_template.hpp"
#include "pipelines/study.hpp"

namespace {

using namespace microslip;
using namespace microslip::pipelines;

struct Arguments {
  std::string input;  // scene, table, kind or folder
  std::string output;
  std::vector<std::string> overrides;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  int harmonics = 1;
  std::string tolerance;
  std::string budget;
  bool resume = false;
  bool dry_run = false;
  bool quiet = false;
  bool verbose = false;
  bool json = false;
  int rank = 0;
};

/// Options that interfaces.md names and this version does not have: refused, never ignored.
void refuse_later_options(const Arguments& arguments) {
  const auto refuse = [](const char* name) {
    throw SceneError(fmt::format("{} is not available in this version", name));
  };
  if (arguments.resume) refuse("--resume");
  if (!arguments.tolerance.empty()) refuse("--tolerance");
  if (!arguments.budget.empty()) refuse("--budget");
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

/// runs/STEM in the working folder.
std::filesystem::path run_folder(const Arguments& arguments) {
  if (!arguments.output.empty()) return arguments.output;
  return std::filesystem::path("runs") / std::filesystem::path(arguments.input).stem();
}

SceneDescription scene_of(const Arguments& arguments) {
  return read_scene(arguments.input, arguments.overrides);
}

int run_scene(Arguments& arguments, int (*study)(const SceneDescription&, const RunOptions&),
              const std::filesystem::path& output) {
  const SceneDescription scene = scene_of(arguments);
  if (arguments.dry_run) return check_study(scene, std::cout);
  std::unique_ptr<fem::SlepcSession> session;  // modal scenes need no finite elements
  if (!std::holds_alternative<ModalModel>(scene.model)) {
    session = std::make_unique<fem::SlepcSession>();
    arguments.rank = session->rank();
  }
  watch_for_interrupts();  // after MPI, which sets handlers of its own
  return study(scene, options_of(arguments, output));
}

int init(const Arguments& arguments) {
  const std::string text = scene_template(arguments.input.empty() ? "blade" : arguments.input);
  if (arguments.output.empty()) {
    std::cout << text;
    return 0;
  }
  if (std::filesystem::exists(arguments.output)) {
    throw SceneError(arguments.output + ": exists; init overwrites nothing");
  }
  write_whole(arguments.output, text);
  return 0;
}

int cycle(const Arguments& arguments) {
  if (arguments.harmonics != 1) {
    throw SceneError("--harmonics: mean and first harmonic only in this version: expected 1");
  }
  const std::string json = cycles_as_json(CsvTable::read(arguments.input));
  if (arguments.output.empty()) {
    std::cout << json;
  } else {
    write_whole(arguments.output, json);
  }
  return 0;
}

/// The commands, and what each does; the chosen one is left in `chosen`.
using Action = std::function<int()>;

void add_global_options(CLI::App& app, Arguments& a) {
  app.add_option("--set", a.overrides,
                 "key.path=value: overrides any key of the scene; may be repeated")
      ->take_all()
      ->expected(1);
  app.add_option("-j,--jobs", a.jobs, "curves traced at the same time; the numbers do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_flag("--resume", a.resume, "continue an interrupted run (not available in this version)");
  app.add_option("--tolerance", a.tolerance,
                 "accuracy asked for, e.g. 1% (not available in this version)");
  app.add_option("--budget", a.budget, "time allowed, e.g. 60s (not available in this version)");
  app.add_flag("--dry-run", a.dry_run, "check the scene and stop, as `check` does");
  app.add_flag("-q,--quiet", a.quiet, "warnings and errors only");
  app.add_flag("-v,--verbose", a.verbose, "one line per solution point");
  app.add_flag("--json", a.json, "last line on standard output is one JSON object");
}

CLI::App* add_command(CLI::App& app, Action& chosen, const char* name, const char* what,
                      Action action) {
  CLI::App* command = app.add_subcommand(name, what);
  command->fallthrough();
  command->callback([&chosen, action = std::move(action)] { chosen = action; });
  return command;
}

void add_commands(CLI::App& app, Arguments& a, Action& chosen) {
  const auto with_scene = [&](CLI::App* command) {
    command->add_option("scene", a.input, "scene file (TOML)")->required();
    return command;
  };
  const auto with_output = [&](CLI::App* command, const char* what) {
    command->add_option("-o,--output", a.output, what);
    return command;
  };
  auto* init_command = add_command(app, chosen, "init", "print a commented template scene",
                                   [&] { return init(a); });
  init_command->add_option("kind", a.input, "blade, mesh or modal")->default_str("blade");
  with_output(init_command, "file to write; it must not exist");
  with_scene(add_command(app, chosen, "check",
                         "parse, check units and names, show mesh, effects and forecast; solve nothing",
                         [&] { return check_study(scene_of(a), std::cout); }));
  auto* mesh_command = with_scene(add_command(app, chosen, "mesh", "geometry to mesh", [&] {
    return mesh_study(scene_of(a), options_of(a, a.output));
  }));
  with_output(mesh_command, "gmsh file to write (.msh)")->get_option("--output")->required();
  auto* modes_command =
      with_scene(add_command(app, chosen, "modes", "mesh to modes and residual flexibility",
                             [&] { return run_scene(a, modes_study, run_folder(a)); }));
  with_output(modes_command, "run folder; default runs/SCENE");
  auto* run_command =
      with_scene(add_command(app, chosen, "run", "everything: modes, curves, maps, report",
                             [&] { return run_scene(a, run_study, run_folder(a)); }));
  with_output(run_command, "run folder; default runs/SCENE");
  auto* cycle_command = add_command(app, chosen, "cycle",
                                    "steady friction cycles of single contact points",
                                    [&] { return cycle(a); });
  cycle_command->add_option("table", a.input, "CSV file, see README")->required();
  with_output(cycle_command, "JSON file to write; default standard output");
  cycle_command->add_option("--harmonics", a.harmonics, "harmonics put out")->capture_default_str();
  with_scene(add_command(app, chosen, "converge", "what accuracy costs (not available in this version)",
                         []() -> int {
                           throw SceneError("converge is not available in this version; "
                                            "share/scripts/mesh_convergence.py varies the mesh");
                         }));
  auto* report_command = add_command(app, chosen, "report", "rebuild plots and report of a run folder",
                                     [&] { return report_study(a.input); });
  report_command->add_option("folder", a.input, "run folder")->required();
}

/// What is wrong with the first word when it is no command; empty when it is one, or an option.
std::string unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return {};
  const std::string word = argv[1];
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == word) return {};
    names.push_back(command->get_name());
  }
  const std::vector<std::string_view> views(names.begin(), names.end());
  const std::string near = nearest_name(word, views);
  return near.empty() ? fmt::format("unknown command \"{}\"; the commands are: {}", word,
                                    fmt::join(names, ", "))
                      : fmt::format("unknown command \"{}\"; did you mean \"{}\"?", word, near);
}

void print_json_line(const Arguments& arguments, int code, const std::string& message) {
  nlohmann::ordered_json line{{"program", "microslip"}, {"version", MICROSLIP_VERSION},
                              {"exit_code", code},      {"input", arguments.input},
                              {"output", arguments.output}};
  if (!message.empty()) line["message"] = message;
  std::cout << line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)
            << std::endl;
}

int guarded(Arguments& arguments, const Action& action) {
  std::string message;
  int code = 0;
  try {
    refuse_later_options(arguments);
    code = action();
  } catch (const std::exception& error) {
    const ExitCode verdict = exit_code_of(error);
    code = static_cast<int>(verdict);
    message = verdict == ExitCode::internal ? fmt::format("internal error: {}", error.what())
                                            : std::string(error.what());
    if (arguments.rank == 0) std::cerr << "microslip: " << message << '\n';
  }
  if (arguments.json && arguments.rank == 0) print_json_line(arguments, code, message);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  Action chosen;
  CLI::App app("Vibration of friction-damped turbine blades: geometry, modes, forced response, "
               "contact maps.\nExit codes: 0 complete, 1 bad input, 2 refused on physical grounds, "
               "3 incomplete, 4 out of time, memory or disk, 5 internal error.",
               "microslip");
  app.set_version_flag("--version", "microslip " MICROSLIP_VERSION);
  app.require_subcommand(1);
  add_global_options(app, arguments);
  add_commands(app, arguments, chosen);
  if (const std::string unknown = unknown_command(app, argc, argv); !unknown.empty()) {
    std::cerr << "microslip: " << unknown << '\n';
    return static_cast<int>(ExitCode::bad_input);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : static_cast<int>(ExitCode::bad_input);
  }
  return guarded(arguments, chosen);
}
