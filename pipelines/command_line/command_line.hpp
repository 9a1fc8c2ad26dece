/// @file
/// What is wrong with a command line, with the nearest name for what was meant.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace microslip::pipelines {

/// What is wrong with the first word when it is no command; empty when it is one, or an option.
[[nodiscard]] std::string unknown_command(const CLI::App& app, int argc, char** argv);

/// The parser's words about its error, with the nearest option for one it does not know.
[[nodiscard]] std::string explained(const CLI::ParseError& error, const CLI::App& app, int argc,
                                    char** argv);

/// A message with its begin and its end, where it quotes more than anybody reads.
[[nodiscard]] std::string shortened(const std::string& message);

}  // namespace microslip::pipelines
