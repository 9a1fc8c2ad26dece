#include "pipelines/command_line/command_line.hpp"

#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipelines/text/nearest_name.hpp"

namespace microslip::pipelines {

std::string unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc >= 2 && argv[1][0] == '-') return {};
  const std::string word = argc < 2 ? "" : argv[1];
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == word) return {};
    names.push_back(command->get_name());
  }
  if (word.empty()) return fmt::format("expected a command: {}", fmt::join(names, ", "));
  const std::vector<std::string_view> views(names.begin(), names.end());
  const std::string near = nearest_name(word, views);
  return near.empty() ? fmt::format("unknown command \"{}\"; the commands are: {}", word,
                                    fmt::join(names, ", "))
                      : fmt::format("unknown command \"{}\"; did you mean \"{}\"?", word, near);
}

std::string explained(const CLI::ParseError& error, const CLI::App& app, int argc, char** argv) {
  std::string text = error.what();
  if (error.get_exit_code() != static_cast<int>(CLI::ExitCodes::ExtrasError)) return text;
  std::vector<std::string> names{"--output", "--harmonics", "--without", "--help"};
  for (const CLI::Option* option : app.get_options()) names.push_back(option->get_name());
  const std::vector<std::string_view> views(names.begin(), names.end());
  for (const std::string word : std::span(argv + 1, static_cast<std::size_t>(argc - 1))) {
    if (!word.starts_with("--")) continue;
    const std::string given = word.substr(0, word.find('='));
    if (std::find(names.begin(), names.end(), given) != names.end()) continue;
    const std::string near = nearest_name(given, views);
    if (!near.empty()) text += fmt::format("; did you mean {}?", near);
  }
  return text;
}

std::string shortened(const std::string& message) {
  constexpr std::size_t most = 1500;
  constexpr std::size_t end = 300;
  if (message.size() <= most) return message;
  const auto continues = [&](std::size_t i) {  // a character of several bytes
    return (static_cast<unsigned char>(message[i]) & 0xC0U) == 0x80U;
  };
  std::size_t first = most - end;
  std::size_t last = message.size() - end;
  while (first > 0 && continues(first)) --first;
  while (last < message.size() && continues(last)) ++last;
  return message.substr(0, first) + " … " + message.substr(last);
}

}  // namespace microslip::pipelines
