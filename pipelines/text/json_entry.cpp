#include "pipelines/text/json_entry.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {

using Json = nlohmann::ordered_json;

void JsonEntry::expected(const char* what) const {
  std::string found = value_->dump(-1, ' ', false, Json::error_handler_t::replace);
  constexpr std::size_t longest = 40;  // what helps to find the place; the rest is in the file
  if (found.size() > longest) found = value_->type_name();
  throw SceneError(
      fmt::format("{}: expected {}, found {}: the file is damaged", path_, what, found));
}

bool JsonEntry::has(const std::string& key) const {
  if (!value_->is_object()) expected("an object");
  const auto found = value_->find(key);
  return found != value_->end() && !found->is_null();
}

JsonEntry JsonEntry::at(const std::string& key) const {
  if (!value_->is_object()) expected("an object");
  const auto found = value_->find(key);
  if (found == value_->end()) {
    throw SceneError(fmt::format(
        "{}: \"{}\" is missing: the file is damaged, or no run has written it", path_, key));
  }
  return {*found, fmt::format("{}{}{}", path_, path_.ends_with(".json") ? ": " : ".", key)};
}

double JsonEntry::as_number() const {
  if (!value_->is_number()) expected("a number");
  return value_->get<double>();
}

std::string JsonEntry::as_text() const {
  if (!value_->is_string()) expected("a text");
  return value_->get<std::string>();
}

long JsonEntry::integer(const std::string& key) const {
  const JsonEntry entry = at(key);
  if (!entry.value_->is_number_integer()) entry.expected("a whole number");
  return entry.value_->get<long>();
}

bool JsonEntry::truth(const std::string& key) const {
  const JsonEntry entry = at(key);
  if (!entry.value_->is_boolean()) entry.expected("true or false");
  return entry.value_->get<bool>();
}

std::vector<JsonEntry> JsonEntry::list(const std::string& key) const {
  std::vector<JsonEntry> entries;
  if (!has(key)) return entries;
  const JsonEntry array = at(key);
  if (!array.value_->is_array()) array.expected("a list");
  for (const Json& value : *array.value_) {
    entries.emplace_back(value, fmt::format("{}[{}]", array.path_, entries.size()));
  }
  return entries;
}

Json parse_json(const std::string& text, const std::string& name) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const std::size_t read = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
    if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
      throw SceneError(fmt::format("{}: empty", name));
    }
    const std::string_view before(text.data(), read);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t column =
        read - (before.rfind('\n') + 1) + 1;  // npos + 1 is 0: the first line
    throw SceneError(fmt::format("{}:{}:{}: {}", name, line, column,
                                 read >= text.size()
                                     ? "the file ends too early: it was cut off"
                                     : "no JSON from here on: the file is damaged"));
  }
}

}  // namespace microslip::pipelines
