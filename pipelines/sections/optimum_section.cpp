#include "pipelines/sections/optimum_section.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "pipelines/sections/static_section.hpp"
#include "pipelines/text/nearest_name.hpp"
#include "pipelines/text/units.hpp"

namespace microslip::pipelines {
namespace {

/// "excitation.forces[0].amplitude" → excitation, forces, amplitude.
std::vector<std::string> names_of(const std::string& path) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    const std::string name = path.substr(begin, end - begin);
    names.push_back(name.substr(0, name.find('[')));
    begin = end + 1;
  }
  return names;
}

/// Keys of the section or inline table a path leads into.
SectionSpec keys_along(const SectionReader& s, const std::vector<std::string>& names,
                       std::string_view kind) {
  const auto known = sections_of_kind(kind);
  const bool in_section = names.size() >= 2 && names.size() <= 3 &&
                          std::find(known.begin(), known.end(), names[0]) != known.end();
  if (in_section && names[0] != "response" && names[0] != "effects") {
    if (names.size() == 2) return section_spec(names[0], kind);
    if (names[1] == "forces") return section_spec("force", kind);
    if (names[0] == "static" && names[1] == "pressure") return section_spec("static.pressure");
    if (names[1] == "points" && kind == "chain") return section_spec("contact.chain.point");
  }
  s.fail("optimum",
         "expected \"preload\" or the key of a number outside [response], e.g. "
         "\"contact.friction_coefficient\" or \"excitation.forces[0].amplitude\"",
         s.node("optimum"));
}

std::string unit_of(const SectionReader& s, const std::string& path, std::string_view kind) {
  const std::vector<std::string> names = names_of(path);
  const SectionSpec section = keys_along(s, names, kind);
  std::vector<std::string_view> known;
  for (const KeySpec& key : section.keys) {
    if (key.name == names.back() && key.type == KeyType::integer) {
      s.fail("optimum", fmt::format("\"{}\" is a whole number; those are not searched", path),
             s.node("optimum"));
    }
    if (key.name == names.back()) return std::string(key.unit);
    known.push_back(key.name);
  }
  const std::string near = nearest_name(names.back(), known);
  const std::string above = path.substr(0, path.size() - names.back().size());
  s.fail("optimum",
         fmt::format("\"{}\": no key of that name{}", path,
                     near.empty() ? "" : fmt::format("; did you mean \"{}{}\"?", above, near)),
         s.node("optimum"));
}

double bound_in(const SectionReader& s, const toml::node& node, const std::string& unit) {
  double value = 0.0;
  if (node.is_number()) {
    value = *node.value<double>();
  } else if (node.is_string()) {
    try {
      const std::string text = *node.value<std::string>();
      // Of a rotation "50 Hz" are turns per second.
      value = unit == "rad/s" ? rotation_speed(text) : to_si(text, unit.empty() ? "1" : unit);
    } catch (const UnitError& error) {
      s.fail("optimum_range", error.what(), &node);
    }
  } else {
    s.fail("optimum_range", "expected numbers, or strings with a unit", &node);
  }
  if (!std::isfinite(value)) s.fail("optimum_range", "expected finite numbers", &node);
  return value;
}

std::array<double, 2> range_in(const SectionReader& s, const std::string& unit, bool positive) {
  const toml::node& node = *s.node("optimum_range");
  const toml::array* list = node.as_array();
  if (list == nullptr || list->size() != 2) s.fail("optimum_range", "expected [low, high]", &node);
  const std::array<double, 2> range{bound_in(s, *list->get(0), unit),
                                    bound_in(s, *list->get(1), unit)};
  if (!(range[0] < range[1]) || (positive && !(range[0] > 0.0))) {
    s.fail("optimum_range", positive ? "expected 0 < low < high" : "expected low < high", &node);
  }
  return range;
}

/// Different positive preloads, or scales, of the curves.
std::set<double> positive_preloads(const ResponseDescription& response) {
  std::set<double> positive;
  for (const double scale :
       response.preload.empty() ? response.preload_scale : std::vector<double>()) {
    if (scale > 0.0) positive.insert(scale);
  }
  for (const PreloadEntry& entry : response.preload) {
    const auto* load = std::get_if<double>(&entry);
    if (load != nullptr && *load > 0.0) positive.insert(*load);
  }
  return positive;
}

/// The preload another key is searched under: as given, or the only one of the curves that presses.
std::optional<double> load_of(const SectionReader& s, const ResponseDescription& response) {
  if (s.given("optimum_at")) {
    const toml::node& at = *s.node("optimum_at");
    if (at.value<std::string>() == "static") return std::nullopt;
    return s.number_in(at, "optimum_at");
  }
  const std::set<double> positive = positive_preloads(response);
  const bool of_loads = std::ranges::count(response.preload, PreloadEntry(StaticPreload{})) > 0;
  if (positive.empty() && of_loads) return std::nullopt;
  if (positive.size() != 1) {
    s.fail("optimum_at",
           fmt::format(
               "is missing: the scene has {} positive preloads; under which is \"{}\" searched?",
               positive.size(), s.text("optimum")),
           s.node("optimum"));
  }
  return *positive.begin();
}

void refuse_alone(const SectionReader& s) {
  for (const char* key : {"optimum_range", "optimum_at"}) {
    if (s.given(key)) s.fail(key, "has no meaning without optimum", s.node(key));
  }
}

}  // namespace

std::optional<OptimumRequest> read_optimum(const SectionReader& s,
                                           const ResponseDescription& response,
                                           std::string_view kind) {
  if (!s.given("optimum")) {
    refuse_alone(s);
    return std::nullopt;
  }
  OptimumRequest request;
  request.key = s.text("optimum");
  if (request.key == "response.preload" || request.key == "preload_scale") request.key = "preload";
  if (request.of_preload()) {
    if (s.given("optimum_range")) request.range = range_in(s, "N", true);
    if (!request.range && positive_preloads(response).size() < 2) {
      s.fail("optimum", "needs optimum_range = [low, high], or two positive preloads",
             s.node("optimum"));
    }
    if (s.given("optimum_at")) {
      s.fail("optimum_at", "has no meaning with optimum = \"preload\"", s.node("optimum_at"));
    }
    return request;
  }
  request.unit = unit_of(s, request.key, kind);
  if (request.unit == "1") request.unit.clear();
  if (!s.given("optimum_range")) {
    s.fail("optimum_range", fmt::format("is missing: [low, high] of \"{}\"", request.key),
           s.node("optimum"));
  }
  request.range = range_in(s, request.unit, false);
  request.load = load_of(s, response);
  return request;
}

}  // namespace microslip::pipelines
