#include "pipelines/scene/scene_overrides.hpp"

#include <charconv>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/toml_text.hpp"

namespace microslip::pipelines {
namespace {

constexpr std::size_t most_steps = 100;  // every one is a table in another

struct Step {
  std::string key;
  std::optional<std::size_t> index;  // of a list entry
};

[[noreturn]] void refuse(const std::string& assignment, const std::string& why) {
  throw SceneError(fmt::format("--set {}: {}", assignment, why));
}

std::vector<Step> steps_of(const std::string& path, const std::string& assignment) {
  std::vector<Step> steps;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    Step step{path.substr(begin, end - begin), std::nullopt};
    begin = end + 1;
    if (const auto bracket = step.key.find('['); bracket != std::string::npos) {
      std::size_t index = 0;
      const char* last = step.key.data() + step.key.size();
      const auto [stop, error] = std::from_chars(step.key.data() + bracket + 1, last, index);
      if (error != std::errc() || stop + 1 != last || *stop != ']') {
        refuse(assignment, "expected an index like forces[0]");
      }
      step.index = index;
      step.key.resize(bracket);
    }
    if (step.key.empty()) refuse(assignment, "a key is empty");
    if (steps.size() == most_steps) {
      refuse(assignment, fmt::format("a key of more than {} parts", most_steps));
    }
    steps.push_back(std::move(step));
  }
  return steps;
}

std::string quoted(const std::string& text) {
  std::ostringstream stream;
  stream << toml::value<std::string>(text);
  return stream.str();
}

/// The value under the key "x". It is parsed even where it is plain text, so that it remembers
/// where it came from and messages about it can say --set.
toml::table value_of(const std::string& text, const std::string& assignment) {
  const std::string source = "--set " + assignment;
  require_shallow_keys(text, "--set");
  // 2.5 mm, stuck, … is meant as a text; what begins like a list, a table or a text is meant as
  // TOML.
  const std::size_t first = text.find_first_not_of(" \t");
  constexpr std::string_view toml_begins = "[{\"'";
  const bool is_meant =
      first != std::string::npos && toml_begins.find(text[first]) != std::string_view::npos;
  if (foreign_letter(text) == std::string_view::npos) {
    try {
      toml::table table = toml::parse("x = " + text, source);
      if (table.size() == 1) return table;  // more: a line break smuggled in further keys
    } catch (const toml::parse_error& error) {
      if (is_meant) refuse(assignment, description_of(error));
    }
  } else if (is_meant) {
    refuse(assignment, "a letter that is not plain ASCII stands outside of quotes");
  }
  try {
    return toml::parse("x = " + quoted(text), source);
  } catch (const toml::parse_error& error) {
    refuse(assignment, description_of(error));
  }
}

/// Moves, because a copy would forget its source.
void assign(toml::table& table, const std::string& key, toml::node& value) {
  value.visit([&](auto& content) { table.insert_or_assign(key, std::move(content)); });
}

/// The table one step down, made when it is not there.
toml::table& descend(toml::table& table, const Step& step, const std::string& assignment) {
  if (!table.contains(step.key)) {
    toml::table made = value_of("{}", assignment);
    assign(table, step.key, *made.get("x"));
  }
  toml::node* node = table.get(step.key);
  // [contact] stands for one [[contact]].
  const bool is_only_one = step.key == "contact" && step.index == 0U && node->is_table();
  if (step.index && !is_only_one) {
    toml::array* list = node->as_array();
    if (list == nullptr || *step.index >= list->size()) {
      refuse(assignment, fmt::format("{} has no entry {}", step.key, *step.index));
    }
    node = list->get(*step.index);
  }
  toml::table* below = node->as_table();
  if (below == nullptr) {
    refuse(assignment, node->is_array()
                           ? fmt::format("{0} is a list: say which entry, as {0}[0]", step.key)
                           : fmt::format("{} is not a table", step.key));
  }
  return *below;
}

/// The list a last step names an entry of.
toml::array& list_with(toml::table& table, const Step& last, const std::string& assignment) {
  toml::node* node = table.get(last.key);
  toml::array* list = node != nullptr ? node->as_array() : nullptr;
  if (list == nullptr || *last.index >= list->size()) {
    refuse(assignment, fmt::format("{} has no entry {}", last.key, *last.index));
  }
  return *list;
}

/// Takes a key or an entry of a list away; what is not there was misspelt.
void remove(toml::table& scene, const std::vector<Step>& steps, const std::string& assignment) {
  toml::table* table = &scene;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    if (!table->contains(steps[i].key)) {
      refuse(assignment, fmt::format("the scene has no \"{}\" to take away", steps[i].key));
    }
    table = &descend(*table, steps[i], assignment);
  }
  const Step& last = steps.back();
  if (!table->contains(last.key)) {
    refuse(assignment, fmt::format("the scene has no \"{}\" to take away", last.key));
  }
  if (!last.index) {
    table->erase(last.key);
    return;
  }
  toml::array& list = list_with(*table, last, assignment);
  list.erase(list.cbegin() + static_cast<std::ptrdiff_t>(*last.index));
}

}  // namespace

void apply_override(toml::table& scene, const std::string& assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    refuse(assignment, "expected key.path=value");
  }
  const auto steps = steps_of(assignment.substr(0, equals), assignment);
  if (assignment.find_first_not_of(" \t", equals + 1) == std::string::npos) {
    remove(scene, steps, assignment);
    return;
  }
  toml::table value = value_of(assignment.substr(equals + 1), assignment);
  toml::table* table = &scene;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) table = &descend(*table, steps[i], assignment);
  const Step& last = steps.back();
  if (!last.index) {
    assign(*table, last.key, *value.get("x"));
    return;
  }
  toml::array& list = list_with(*table, last, assignment);
  value.get("x")->visit([&](auto& content) {
    list.replace(list.cbegin() + static_cast<std::ptrdiff_t>(*last.index), std::move(content));
  });
}

}  // namespace microslip::pipelines
