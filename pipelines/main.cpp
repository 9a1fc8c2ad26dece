/// @file
/// The program `microslip`: reads the command line, calls one study, turns its end into an exit code.

#include <algorithm>
#include <csignal>
#include <exception>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "pipelines/command_line/command_line.hpp"
#include "pipelines/command_line/command_options.hpp"
#include "pipelines/commands.hpp"
#include "pipelines/system/exit_code.hpp"
#include "pipelines/system/scene_error.hpp"

namespace {

using namespace microslip;
using namespace microslip::pipelines;

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
int misused(const Arguments& arguments, const std::string& whole, int argc, char** argv) {
  const std::string message = shortened(whole);
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
    message =
        shortened(verdict == ExitCode::internal ? fmt::format("internal error: {}", error.what())
                                                : std::string(error.what()));
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

int answer(int argc, char** argv) {
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

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ,
              SIG_IGN);  // a file that may not grow is an error of the writer, told as such
  try {
    return answer(argc, argv);
  } catch (const std::exception& error) {  // outside of what `guarded` watches
    std::cerr << "microslip: internal error: " << error.what() << '\n';
    return static_cast<int>(ExitCode::internal);
  }
}
