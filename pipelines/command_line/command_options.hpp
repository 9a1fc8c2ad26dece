/// @file
/// Commands and options of the program, as its help tells them.
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include "pipelines/commands.hpp"

namespace microslip::pipelines {

/// The commands, and what each does; the chosen one is left in `chosen`.
using Action = std::function<int()>;

/// Options of every command. They are read into `arguments`.
void add_global_options(CLI::App& app, Arguments& arguments);

/// The commands. Parsing leaves the one that was typed in `chosen`.
/// @param app, arguments  borrowed by the commands.
void add_commands(CLI::App& app, Arguments& arguments, Action& chosen);

}  // namespace microslip::pipelines
