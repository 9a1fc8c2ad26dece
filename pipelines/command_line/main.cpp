/// @file
/// The program `microslip`: reads the command line, calls one study, turns its end into an exit
/// code. Started by mpirun it does so on rank 0.

#include <algorithm>
#include <csignal>
#include <exception>
#include <iostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "fem/ranks.hpp"
#include "fem/slepc_session.hpp"
#include "pipelines/command_line/command_line.hpp"
#include "pipelines/command_line/command_options.hpp"
#include "pipelines/command_line/processor_kernels.hpp"
#include "pipelines/commands.hpp"
#include "pipelines/system/exit_code.hpp"
#include "pipelines/system/little_memory.hpp"
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
    message = shortened(message_of(error));
    if (verdict == ExitCode::refused && message.find(arguments.input) == std::string::npos) {
      message.insert(0, arguments.input + ": ");
    }
    std::cerr << "microslip: " << message << '\n';
  }
  if (arguments.json) {
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

int answer_whatever_comes(int argc, char** argv) {
  try {
    return answer(argc, argv);
  } catch (const std::exception& error) {  // outside of what `guarded` watches
    std::cerr << "microslip: " << message_of(error) << '\n';
    return static_cast<int>(exit_code_of(error));
  }
}

/// Rank 0 is the program; the others take part in what it solves.
int answer_on_ranks(int argc, char** argv) {
  const fem::SlepcSession session;
  if (fem::rank() > 0) return serve_rank_zero();
  const int code = answer_whatever_comes(argc, argv);
  fem::dismiss(code);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  use_kernels_of_processor(argv);
  std::signal(SIGXFSZ,
              SIG_IGN);  // a file that may not grow is an error of the writer, told as such
  prepare_for_little_memory();
  if (const std::span words(argv, static_cast<std::size_t>(argc)); is_solver(words)) {
    return serve_as_solver(words);
  }
  if (!fem::started_in_parallel()) return answer_whatever_comes(argc, argv);
  try {
    return answer_on_ranks(argc, argv);
  } catch (const std::exception& error) {  // MPI itself has failed: mpirun ends the others
    std::cerr << "microslip: " << error.what() << '\n';
    return static_cast<int>(exit_code_of(error));
  }
}
