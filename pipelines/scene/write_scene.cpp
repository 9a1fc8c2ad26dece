#include "pipelines/scene/write_scene.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "pipelines/system/output_file.hpp"
#include "pipelines/text/scene_keys.hpp"

namespace microslip::pipelines {
namespace {

std::string value_text(const toml::node& node);

/// A float in TOML needs a point or an exponent, else it would read back as an integer.
std::string float_text(double value) {
  std::string text = format_number(value);
  if (std::isfinite(value) && text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string string_text(const std::string& value) {
  std::ostringstream stream;
  stream << toml::value<std::string>(value);
  std::string text = stream.str();
  // toml++ prefers literal quotes; where nothing needs escaping the usual ones say the same.
  const bool plain = value.find_first_of("\"\\\n\r\t'") == std::string::npos;
  return plain && text.front() == '\'' ? "\"" + value + "\"" : text;
}

/// A name of the user may need quotes.
std::string key_text(std::string_view key) {
  const bool bare = !key.empty() && std::ranges::all_of(key, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
  return bare ? std::string(key) : string_text(std::string(key));
}

std::string table_text(const toml::table& table) {
  std::string text = "{";
  for (const auto& [key, value] : table) {
    text.append(text.size() == 1 ? " " : ", ").append(key.str()).append(" = ");
    text += value_text(value);
  }
  return text + " }";
}

std::string array_text(const toml::array& array) {
  std::string text = "[";
  const bool of_tables = !array.empty() && array.get(0)->is_table();
  for (const toml::node& entry : array) {
    if (of_tables) {
      text.append("\n  ").append(value_text(entry)).append(",");
    } else {
      text.append(text.size() == 1 ? "" : ", ").append(value_text(entry));
    }
  }
  return text + (of_tables ? "\n]" : "]");
}

std::string value_text(const toml::node& node) {
  if (const auto* table = node.as_table()) return table_text(*table);
  if (const auto* array = node.as_array()) return array_text(*array);
  if (const auto* text = node.as_string()) return string_text(text->get());
  if (const auto* number = node.as_floating_point()) return float_text(number->get());
  if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
  return node.value_or(false) ? "true" : "false";
}

std::string keys_text(const toml::table& table, std::string_view section, std::string_view kind) {
  std::string text;
  if (section == "points" || section == "faces") {
    for (const auto& [name, value] : table) {
      text += fmt::format("{} = {}\n", key_text(name.str()), value_text(value));
    }
  }
  for (const KeySpec& key : section_spec(section, kind).keys) {
    if (const toml::node* value = table.get(key.name)) {
      text += fmt::format("{} = {}\n", key.name, value_text(*value));
    }
  }
  return text;
}

}  // namespace

std::string scene_as_toml(const toml::table& scene, std::string_view kind) {
  std::string text;
  if (const toml::node* title = scene.get("title")) {
    text += fmt::format("title = {}\n", value_text(*title));
  }
  for (const std::string_view section : sections_of_kind(kind)) {
    const toml::node* node = scene.get(section);
    if (node == nullptr) continue;
    if (const toml::table* table = node->as_table()) {
      text += fmt::format("\n[{}]\n", section) + keys_text(*table, section, kind);
    } else if (const toml::array* list = node->as_array()) {
      for (const toml::node& entry : *list) {
        text += fmt::format("\n[[{}]]\n", section) + keys_text(*entry.as_table(), section, kind);
      }
    }
  }
  return text;
}

}  // namespace microslip::pipelines
