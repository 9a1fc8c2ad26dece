#include "pipelines/text/toml_text.hpp"

#include <algorithm>
#include <cstddef>
#include <regex>

#include <fmt/format.h>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

constexpr std::size_t searched_length =
    1000;  // of those searched for keys: scenes are written by hand

/// The part of a line that may hold a key or the name of a section.
std::string searched(std::string_view line) { return std::string(line.substr(0, searched_length)); }

/// section.key that the text breaks off in, as far as its lines tell; empty in front of the first
/// key. A guess for a message: what cannot be parsed has no keys to ask for.
std::string key_at_end_of(std::string_view text) {
  static const std::regex header(R"(^\s*\[\[?\s*([A-Za-z_][\w.\- ]*?)\s*\]\]?\s*(#.*)?\r?$)");
  static const std::regex assignment(R"(^\s*([\w.\-]+)\s*=)");
  static const std::regex nested(R"([{,]\s*([\w.\-]+)\s*=[^={}]*$)");
  std::string section;
  std::string key;
  std::string inner;
  std::smatch found;
  // Backwards, as far as to the header of the section: a line costs microseconds.
  for (std::size_t end = text.size(); section.empty();) {
    const std::size_t begin = end == 0 ? 0 : text.rfind('\n', end - 1) + 1;  // npos + 1 is 0
    const std::string line = searched(text.substr(begin, end - begin));
    if (end == text.size() && std::regex_search(line, found, nested)) inner = "." + found[1].str();
    if (std::regex_search(line, found, header)) {
      section = found[1].str() + ".";
    } else if (key.empty() && std::regex_search(line, found, assignment)) {
      key = found[1].str();
    }
    if (begin == 0) break;
    end = begin - 1;
  }
  key += inner;
  return key.empty() ? std::string() : section + key;
}

/// Offset of a place in a text; columns count code points.
std::size_t offset_of(const toml::source_position& place, std::string_view text) {
  std::size_t at = 0;
  for (std::size_t line = 1; line < place.line && at < text.size(); ++line) {
    at = std::min(text.find('\n', at), text.size() - 1) + 1;
  }
  const auto continues = [&](std::size_t i) {
    return (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U;
  };
  for (std::size_t column = 1; column < place.column && at < text.size() && text[at] != '\n';
       ++column) {
    do ++at;
    while (at < text.size() && continues(at));
  }
  return at;
}

/// Offset behind the quoted text that begins at `begin`;
/// its line's end where the quote is not closed.
std::size_t end_of_quoted(std::string_view text, std::size_t begin) {
  const char mark = text[begin];
  const bool many_lines = text.substr(begin, 3) == std::string(3, mark);
  const std::string_view quote = text.substr(begin, many_lines ? 3 : 1);
  for (std::size_t i = begin + quote.size(); i < text.size(); ++i) {
    if (text.substr(i, quote.size()) == quote) return i + quote.size();
    if (text[i] == '\n' && !many_lines) return i;
    if (text[i] == '\\' && mark == '"') ++i;
  }
  return text.size();
}

/// A number and the unit behind it that stand at `at` without quotes; empty:
/// something else stands there.
std::string unquoted_quantity(std::string_view text, std::size_t at) {
  static const std::regex number(R"([=\[,]\s*([-+]?[\d.][-+\d.eE]*)\s*$)");
  static const std::regex unit(R"(^\s*([A-Za-z%\x80-\xff][^,\]}#"'\n\r]*))");
  const std::size_t begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;  // npos + 1 is 0
  const std::string before = searched(text.substr(begin, at - begin));
  const std::string behind = searched(text.substr(at));
  std::smatch value;
  std::smatch name;
  if (!std::regex_search(before, value, number) || !std::regex_search(behind, name, unit))
    return {};
  const std::string words = name[1].str();
  return value[1].str() + " " + words.substr(0, words.find_last_not_of(" \t") + 1);
}

/// Offset of the first byte from `at` on that stands neither in quotes nor in a comment.
std::size_t bare(std::string_view text, std::size_t at) {
  while (at < text.size()) {
    if (text[at] == '"' || text[at] == '\'') {
      at = end_of_quoted(text, at);
    } else if (text[at] == '#') {
      at = std::min(text.find('\n', at), text.size());
    } else {
      break;
    }
  }
  return at;
}

toml::source_position place_of(std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, at);
  const auto line = 1 + std::ranges::count(before, '\n');
  const std::string_view row = before.substr(before.rfind('\n') + 1);  // npos + 1 is 0
  const auto column = 1 + std::ranges::count_if(row, [](char c) {
                        return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
                      });
  return {static_cast<toml::source_index>(line), static_cast<toml::source_index>(column)};
}

/// What is wrong, with its place and key.
std::string complaint(std::string_view text, const std::string& name,
                      const toml::source_position& place, const std::string& what) {
  const std::size_t at = offset_of(place, text);
  const std::string_view line = text.substr(text.substr(0, at).rfind('\n') + 1);  // npos + 1 is 0
  const bool begins_section = line.starts_with('[');  // the key above it is innocent
  const std::string key = begins_section ? "" : key_at_end_of(text.substr(0, at));
  const std::string quantity = unquoted_quantity(text, at);
  return fmt::format(
      "{}:{}:{}: {}{}{}", name, place.line, place.column, key, key.empty() ? "" : ": ",
      quantity.empty() ? what
                       : fmt::format("a number with a unit stands in quotes: \"{}\"", quantity));
}

}  // namespace

std::string description_of(const toml::parse_error& error) {
  static const std::regex no_value("'([^']*)' could not be interpreted as a value");
  static const std::regex too_large("'([^']*)' is not representable in 64 bits");
  const std::string text(error.description());
  std::smatch found;
  if (std::regex_search(text, found, no_value)) {
    return fmt::format("{} is out of range: expected a number of at most 1.797e308 in size",
                       found[1].str());
  }
  if (std::regex_search(text, found, too_large)) {
    return fmt::format(
        "{} is out of range: whole numbers end at 9.2e18; write 1e20 with a point or an e",
        found[1].str());
  }
  constexpr std::string_view preface = "Error while parsing ";
  return text.starts_with(preface) ? "cannot be read as TOML: " + text.substr(preface.size())
                                   : text;
}

void require_shallow_keys(std::string_view text, const std::string& name) {
  constexpr int most_points = 100;
  int points = 0;  // of this key; numbers have one
  for (std::size_t i = bare(text, 0); i < text.size(); i = bare(text, i + 1)) {
    const char c = text[i];
    if (c != '.' && std::string_view("=,[]{}\n").find(c) != std::string_view::npos) points = 0;
    if (c == '.' && ++points > most_points) {
      const auto line = 1 + std::ranges::count(text.substr(0, i), '\n');
      throw SceneError(fmt::format("{}:{}: a key of more than {} parts; expected section.key", name,
                                   line, most_points));
    }
  }
}

std::size_t foreign_letter(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  std::size_t i = bare(text, text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
  while (i < text.size() && static_cast<unsigned char>(text[i]) < 0x80U) i = bare(text, i + 1);
  return i < text.size() ? i : std::string_view::npos;
}

toml::table parse_toml(std::string_view text, const std::string& name) {
  require_shallow_keys(text, name);
  if (const std::size_t at = foreign_letter(text); at != std::string_view::npos) {
    throw SceneError(complaint(text, name, place_of(text, at),
                               "cannot be read as TOML: a letter that is not plain ASCII stands "
                               "outside of quotes"));
  }
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw SceneError(complaint(text, name, error.source().begin, description_of(error)));
  }
}

}  // namespace microslip::pipelines
