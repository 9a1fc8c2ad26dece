#include "pipelines/sections/response_section.hpp"

#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "pipelines/sections/optimum_section.hpp"
#include "pipelines/sections/points_section.hpp"

namespace microslip::pipelines {
namespace {

OutputDescription read_output(const SectionReader& s, std::vector<PointDescription>& points) {
  const toml::node& node = *s.node("output");
  if (!node.is_table()) s.fail("output", "expected { at = …, direction = [x, y, z] }", &node);
  toml::table complete;
  const SectionReader output(node.as_table(), section_spec("output"), "response.output", s.file(),
                             complete);
  return {read_place(output, "at", points), output.direction("direction"), output.place("at")};
}

double frequency_in(const SectionReader& s, const toml::node& node) {
  const double value = s.number_in(node, "frequency");
  if (!(value > 0.0)) {
    s.fail("frequency", fmt::format("{:g} Hz: frequencies must be above 0", value), &node);
  }
  return value;
}

void read_range(const SectionReader& s, ResponseDescription& response) {
  const toml::node& node = *s.node("frequency");
  const toml::array* list = node.as_array();
  if (list == nullptr) {
    response.frequency_begin_hz = response.frequency_end_hz = frequency_in(s, node);
    return;
  }
  if (list->size() != 1 && list->size() != 2) {
    s.fail("frequency", "expected [from, to], or one value", &node);
  }
  response.frequency_begin_hz = frequency_in(s, *list->get(0));
  response.frequency_end_hz = frequency_in(s, *list->get(list->size() - 1));
}

void read_maps(const SectionReader& s, ResponseDescription& response) {
  const toml::node& node = *s.node("maps");
  const toml::array* list = node.as_array();
  if (list == nullptr)
    s.fail("maps", "expected a list of \"peak\", \"folds\" or frequencies", &node);
  for (const toml::node& entry : *list) {
    const auto word = entry.is_string() ? entry.value<std::string>() : std::nullopt;
    if (word && (*word == "peak" || *word == "folds")) {
      response.maps.emplace_back(*word == "peak" ? MapName::peak : MapName::folds);
      continue;
    }
    constexpr std::array<std::string_view, 2> words{"peak", "folds"};
    const double frequency = s.number_or_word_in(entry, "maps", words);
    if (!(frequency > 0.0)) s.fail("maps", "frequencies must be above 0", &entry);
    response.maps.emplace_back(frequency);
  }
  response.map_phases = s.integer("map_phases");
}

/// Orders of a list; 0, the mean, is always solved for.
std::vector<int> read_orders(const SectionReader& s, const toml::array& list) {
  std::vector<int> orders;
  for (const toml::node& entry : list) {
    const auto order = entry.is_integer() ? entry.value<int>() : std::nullopt;
    constexpr int highest = 99;
    if (!order || *order < 0 || *order > highest) {
      s.fail("harmonics", fmt::format("expected whole numbers between 0 and {}", highest), &entry);
    }
    if (*order > 0) orders.push_back(*order);
  }
  if (std::find(orders.begin(), orders.end(), 1) == orders.end()) {
    s.fail("harmonics", "the list needs 1, the harmonic of the excitation", &list);
  }
  return orders;
}

HarmonicSettings harmonics_in(const SectionReader& s) {
  HarmonicSettings harmonics;
  const toml::node& node = *s.node("harmonics");
  const double tolerance = s.number("harmonic_tolerance");
  if (const toml::array* list = node.as_array()) {
    harmonics.orders = read_orders(s, *list);
    harmonics.highest = *std::ranges::max_element(harmonics.orders);
  } else if (node.value<std::string>() == "auto") {
    harmonics = automatic_harmonics(tolerance);
  } else if (node.is_integer()) {
    harmonics.highest = s.integer("harmonics");
  } else {
    s.fail("harmonics", "expected a whole number, a list of them, or \"auto\"", &node);
  }
  return harmonics;
}

/// What time integration has no equations for would be dropped in silence.
void refuse_choices_of_balance(const SectionReader& s, const ResponseDescription& response) {
  if (response.search_starts.value_or(0) > 0) {
    s.fail("search_starts",
           "looks for detached branches of harmonic balance; integration in time follows the "
           "motion from "
           "point to point: sweep both ways, or give method = \"harmonic_balance\"",
           s.node("search_starts"));
  }
}

/// @return empty: "auto".
std::optional<int> search_starts_in(const SectionReader& s) {
  const toml::node& node = *s.node("search_starts");
  if (node.value<std::string>() == "auto") return std::nullopt;
  if (!node.is_integer()) {
    s.fail("search_starts", "expected a whole number, 0 to 1000, or \"auto\"", &node);
  }
  return s.integer("search_starts");
}

void read_method(const SectionReader& s, ResponseDescription& response) {
  constexpr std::array<std::string_view, 2> methods{"harmonic_balance", "time"};
  if (s.word("method", methods) == "time") {
    response.method = ResponseDescription::Method::time;
  }
  response.n_time_points = s.integer("points");
  response.steps_per_period = s.integer("steps_per_period");
  response.steps_place = s.place("steps_per_period");
  if (response.steps_per_period > 0 && response.method != ResponseDescription::Method::time) {
    s.fail("steps_per_period", "is for method = \"time\"", s.node("steps_per_period"));
  }
  response.search_starts = search_starts_in(s);
  response.time_budget = s.number_or_off("time_budget").value_or(response.time_budget);
}

PreloadEntry preload_in(const SectionReader& s, const toml::node& entry) {
  if (entry.is_string()) {
    const std::string word = *entry.value<std::string>();
    if (word == "free") return LimitName::free;
    if (word == "stuck") return LimitName::stuck;
    if (word == "static") return StaticPreload{};
  }
  if (const toml::table* table = entry.as_table()) {
    toml::table complete;  // the entry itself says all there is to say
    const SectionReader gap(table, section_spec("gap"), "response.preload", s.file(), complete);
    return UniformGap{gap.number("gap")};
  }
  constexpr std::array<std::string_view, 3> words{"free", "stuck", "static"};
  return s.number_or_word_in(entry, "preload", words);
}

}  // namespace

HarmonicSettings read_harmonics(const SectionReader& s, const ResponseDescription& response) {
  HarmonicSettings harmonics = harmonics_in(s);
  if (response.method != ResponseDescription::Method::time) return harmonics;
  refuse_choices_of_balance(s, response);
  // A motion integrated in time has all harmonics: "auto" has none to choose, the number is of what
  // is written.
  return harmonics.chosen() ? HarmonicSettings{} : harmonics;
}

/// Range, method, preloads and maps: what scenes with a preload in newtons share.
ResponseDescription read_loads(const SectionReader& s, std::string_view kind) {
  ResponseDescription response;
  read_range(s, response);
  read_method(s, response);
  const toml::node& preload = *s.node("preload");
  if (const toml::array* list = preload.as_array()) {
    if (list->empty()) s.fail("preload", "the list is empty", &preload);
    for (const toml::node& entry : *list) response.preload.push_back(preload_in(s, entry));
  } else {
    response.preload.push_back(preload_in(s, preload));
  }
  response.optimum = read_optimum(s, response, kind);
  read_maps(s, response);
  return response;
}

ResponseDescription read_response(const SectionReader& s, std::string_view kind,
                                  std::vector<PointDescription>& points) {
  const OutputDescription output = read_output(s, points);
  ResponseDescription response = read_loads(s, kind);
  response.output = output;
  return response;
}

ResponseDescription read_modal_response(const SectionReader& s, std::string_view kind) {
  ResponseDescription response;
  read_range(s, response);
  read_method(s, response);
  const toml::node& scale = *s.node("preload_scale");
  const auto add = [&](const toml::node& entry) {
    const double factor = s.number_in(entry, "preload_scale");
    if (factor < 0.0) {
      s.fail("preload_scale",
             "expected at least 0: a negative factor would turn pressure into gaps and gaps into "
             "pressure",
             &entry);
    }
    response.preload_scale.push_back(factor);
  };
  response.preload_scale.clear();
  if (const toml::array* list = scale.as_array()) {
    if (list->empty()) s.fail("preload_scale", "the list is empty", &scale);
    for (const toml::node& entry : *list) add(entry);
  } else {
    add(scale);
  }
  const toml::node& limits = *s.node("limits");
  if (!limits.is_boolean()) s.fail("limits", "expected true or false", &limits);
  response.limits = *limits.value<bool>();
  response.optimum = read_optimum(s, response, kind);
  read_maps(s, response);
  return response;
}

}  // namespace microslip::pipelines
