#include "pipelines/text/section_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/nearest_name.hpp"
#include "pipelines/text/units.hpp"

namespace microslip::pipelines {
namespace {

void copy_into(toml::table& table, std::string_view key, const toml::node& node) {
  node.visit([&](const auto& value) { table.insert_or_assign(key, value); });
}

/// A value as the scene has it, in a few words.
std::string shown(const toml::node& node) {
  std::ostringstream stream;
  node.visit([&](const auto& value) {
    if constexpr (toml::is_table<decltype(value)> || toml::is_array<decltype(value)>) {
      stream << toml::toml_formatter(value, toml::toml_formatter::default_flags);
    } else {
      stream << value;
    }
  });
  std::string text = stream.str();
  std::ranges::replace(text, '\n', ' ');
  constexpr std::size_t longest = 60;
  if (text.size() <= longest) return text;
  std::size_t end = longest;  // of a whole character
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return node.is_array()   ? fmt::format("a list of {}", node.as_array()->size())
         : node.is_table() ? fmt::format("a table of {} keys", node.as_table()->size())
                           : text.substr(0, end) + "…";
}

}  // namespace

std::string place_of(const toml::node* node, const std::string& file) {
  if (node == nullptr) return file;
  const auto& source = node->source();
  std::string path = source.path ? *source.path : file;
  if (path.starts_with("--set ") || source.begin.line == 0) return path;
  return fmt::format("{}:{}", path, source.begin.line);
}

SectionReader::SectionReader(const toml::table* table, SectionSpec spec, std::string path,
                             std::string file, toml::table& complete)
    : spec_(spec),
      given_(table),
      path_(std::move(path)),
      file_(std::move(file)),
      complete_(complete) {
  std::vector<std::string_view> names;
  for (const KeySpec& key : spec_.keys) names.push_back(key.name);
  if (given_ != nullptr) {
    for (const auto& [key, node] : *given_) {
      const std::string_view name = key.str();
      if (std::find(names.begin(), names.end(), name) != names.end()) continue;
      const std::string near = nearest_name(name, names);
      fail(name,
           near.empty() ? fmt::format("unknown key; known here: {}", fmt::join(names, ", "))
                        : fmt::format("unknown key; did you mean \"{}\"?", near),
           &node);
    }
  }
  for (const KeySpec& key : spec_.keys) {
    if (given(key.name)) {
      copy_into(complete_, key.name, *given_->get(key.name));
    } else if (!key.preset.empty()) {
      const toml::table parsed = toml::parse(fmt::format("x = {}", key.preset), file_);
      copy_into(complete_, key.name, *parsed.get("x"));
    }
  }
}

const KeySpec& SectionReader::spec_of(std::string_view key) const {
  const auto found = std::find_if(spec_.keys.begin(), spec_.keys.end(),
                                  [&](const KeySpec& spec) { return spec.name == key; });
  if (found == spec_.keys.end()) throw std::logic_error("no key " + std::string(key));
  return *found;
}

bool SectionReader::given(std::string_view key) const {
  return given_ != nullptr && given_->contains(key);
}

const toml::node* SectionReader::node(std::string_view key) const {
  if (given(key)) return given_->get(key);
  const KeySpec& spec = spec_of(key);
  if (spec.preset.empty() && !spec.optional) {
    fail(key,
         fmt::format("is missing: {}{}", spec.meaning,
                     spec.unit.empty() || spec.unit == "1" ? "" : fmt::format(" [{}]", spec.unit)));
  }
  return complete_.get(key);
}

const toml::node& SectionReader::required(std::string_view key) const {
  const toml::node* found = node(key);
  if (found == nullptr) fail(key, "is missing");
  return *found;
}

void SectionReader::tables(std::string_view key, std::string_view keys, std::string_view example,
                           const std::function<void(const SectionReader&)>& read) {
  const toml::node& node = required(key);
  const toml::array* list = node.as_array();
  if (list == nullptr) fail(key, fmt::format("expected a list of tables {}", example), &node);
  toml::array completed;
  for (const toml::node& entry : *list) {
    if (!entry.is_table()) fail(key, fmt::format("expected tables {}", example), &entry);
    toml::table complete;
    complete.is_inline(true);
    read(SectionReader(entry.as_table(), section_spec(keys), fmt::format("{}.{}", path_, key),
                       file_, complete));
    completed.push_back(std::move(complete));
  }
  this->complete(key, std::move(completed));
}

double SectionReader::number_in(const toml::node& node, std::string_view key) const {
  const KeySpec& spec = spec_of(key);
  double value = 0.0;
  if (node.is_number()) {
    value = *node.value<double>();
  } else if (const auto text = node.value<std::string>(); text && node.is_string()) {
    try {
      value = to_si(*text, std::string(spec.unit));
    } catch (const UnitError& error) {
      fail(key, error.what(), &node);
    }
  } else {
    fail(key,
         node.is_table() ? "a law or table is not available in this version; expected a number"
                         : "expected a number, or a string with a unit",
         &node);
  }
  if (!is_of_usable_size(value)) {
    fail(key, "expected a finite number, 0 or of a size from 1e-100 to 1e100", &node);
  }
  const bool too_low = spec.above_low ? value <= spec.low : value < spec.low;
  const bool ranged = spec.low != 0.0 || spec.high != 0.0;  // both zero: no range in the table
  if (ranged && (too_low || value > spec.high)) {
    const bool may_be_percent = spec.unit == "1" && value > 1.0 && 0.01 * value <= spec.high;
    const std::string in_percent =
        may_be_percent ? fmt::format("; did you mean {:g} %?", value) : "";
    fail(key,
         fmt::format("{:g} is out of range; expected {}{}{}", value, range_text(spec),
                     spec.unit == "1" ? "" : fmt::format(" {}", spec.unit), in_percent),
         &node);
  }
  return value;
}

double SectionReader::number_or_word_in(const toml::node& node, std::string_view key,
                                        std::span<const std::string_view> words) const {
  const auto text = node.is_string() ? node.value<std::string>() : std::nullopt;
  constexpr std::string_view number_begins = "0123456789.+- \t";
  if (text && (text->empty() || number_begins.find(text->front()) == std::string_view::npos)) {
    const std::string near = nearest_name(*text, words);
    fail(key,
         fmt::format("\"{}\" is not known; expected {} or a number [{}]{}", *text,
                     fmt::join(words, ", "), spec_of(key).unit,
                     near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near)),
         &node);
  }
  return number_in(node, key);
}

std::optional<double> SectionReader::number_or_off(std::string_view key) const {
  constexpr std::array<std::string_view, 1> words{"off"};
  const toml::node& node = required(key);
  if (node.value<std::string>() == "off") return std::nullopt;
  return number_or_word_in(node, key, words);
}

double SectionReader::number(std::string_view key) const { return number_in(required(key), key); }

int SectionReader::integer(std::string_view key) const {
  const toml::node& found = required(key);
  const KeySpec& spec = spec_of(key);
  const auto value = found.value<std::int64_t>();
  if (!found.is_integer() || !value) {
    const bool has_range = spec.low != 0.0 || spec.high != 0.0;
    fail(key,
         fmt::format("expected a whole number{}{}", has_range ? ", " : "",
                     has_range ? range_text(spec) : ""),
         &found);
  }
  const auto number = static_cast<double>(*value);
  if (number < spec.low || number > spec.high) {
    fail(key, fmt::format("{} is out of range; expected {}", *value, range_text(spec)), &found);
  }
  return static_cast<int>(*value);
}

std::string SectionReader::text(std::string_view key) const {
  const toml::node& found = required(key);
  const auto value = found.value<std::string>();
  if (!found.is_string() || value->empty()) fail(key, "expected a text in quotes", &found);
  return *value;
}

std::string SectionReader::word(std::string_view key,
                                std::span<const std::string_view> allowed) const {
  std::string value = text(key);
  if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) {
    fail(key,
         fmt::format("\"{}\" is not available; expected one of: {}", value,
                     fmt::join(allowed, ", ")),
         &required(key));
  }
  return value;
}

Eigen::Vector3d SectionReader::direction(std::string_view key) const {
  const toml::node& found = required(key);
  const toml::array* list = found.as_array();
  if (list == nullptr || list->size() != 3) fail(key, "expected three numbers [x, y, z]", &found);
  Eigen::Vector3d vector;
  for (std::size_t i = 0; i < 3; ++i) {
    const toml::node& entry = *list->get(i);
    if (!entry.is_number() || !std::isfinite(*entry.value<double>())) {
      fail(key, "expected three finite numbers [x, y, z]", &found);
    }
    vector[static_cast<Eigen::Index>(i)] = *entry.value<double>();
  }
  const double size = vector.stableNorm();
  if (size == 0.0) fail(key, "the direction is zero", &found);
  return vector / size;
}

std::string SectionReader::place(std::string_view key) const {
  const toml::node* node = given(key) ? given_->get(key) : given_;
  return fmt::format("{}: {}{}{}", place_of(node, file_), path_, path_.empty() ? "" : ".", key);
}

void SectionReader::fail(std::string_view key, const std::string& message,
                         const toml::node* at) const {
  const toml::node* node = at != nullptr ? at : given_;
  const bool wants = message.starts_with("expected") && at != nullptr;
  throw SceneError(fmt::format("{}: {}{}{}: {}{}", place_of(node, file_), path_,
                               path_.empty() ? "" : ".", key, message,
                               wants ? "; found " + shown(*at) : ""));
}

}  // namespace microslip::pipelines
