#include "pipelines/scene/contact_section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipelines/text/units.hpp"

namespace microslip::pipelines {
namespace {

std::optional<double> read_stiffness(const SectionReader& s, std::string_view key) {
  const toml::node& node = *s.node(key);
  if (node.is_string() && *node.value<std::string>() == "rigid") return std::nullopt;
  constexpr std::array<std::string_view, 1> words{"rigid"};
  return s.number_or_word_in(node, key, words);
}

/// A number with a unit inside an inline table.
double entry_of(const SectionReader& s, std::string_view key, const toml::table& table,
                std::string_view name, const char* unit) {
  const toml::node* node = table.get(name);
  if (node == nullptr) s.fail(key, fmt::format("{} is missing", name), &table);
  double value = std::numeric_limits<double>::quiet_NaN();
  if (node->is_number()) {
    value = *node->value<double>();
  } else if (node->is_string()) {
    try {
      value = to_si(*node->value<std::string>(), unit);
    } catch (const UnitError& error) {
      s.fail(key, fmt::format("{}: {}", name, error.what()), node);
    }
  }
  if (!(std::isfinite(value) && value >= 0.0)) {
    s.fail(key, fmt::format("{}: expected a number, at least 0 [{}]", name, unit), node);
  }
  return value;
}

/// The law named in an inline table whose other keys are among those of the law.
template <std::size_t N>
std::string law_of(const SectionReader& s, std::string_view key, const toml::table& table,
                   const std::array<std::string_view, N>& laws,
                   const std::vector<std::string_view>& keys) {
  const auto law = table["law"].value<std::string>();
  if (!law || std::find(laws.begin(), laws.end(), *law) == laws.end()) {
    s.fail(key, fmt::format("law: expected one of: {}", fmt::join(laws, ", ")), &table);
  }
  for (const auto& [name, value] : table) {
    if (name.str() == "law" || std::find(keys.begin(), keys.end(), name.str()) != keys.end())
      continue;
    s.fail(key,
           fmt::format("unknown key \"{}\"; known: law, {}", name.str(), fmt::join(keys, ", ")),
           &value);
  }
  return *law;
}

contact::FrictionLaw friction_law_in(const SectionReader& s, std::string_view key,
                                     const toml::table& table) {
  constexpr std::array<std::string_view, 2> laws{"exponential", "hyperbolic"};
  const auto entry = [&](std::string_view name, const char* unit) {
    return entry_of(s, key, table, name, unit);
  };
  if (law_of(s, key, table, laws, {"static", "kinetic", "rate"}) == "exponential") {
    return contact::FrictionLaw::exponential(entry("static", "1"), entry("kinetic", "1"),
                                             entry("rate", "s/m"));
  }
  if (table.contains("kinetic")) {
    s.fail(key, "kinetic: the hyperbolic law has none; known: law, static, rate", &table);
  }
  return contact::FrictionLaw::hyperbolic(entry("static", "1"), entry("rate", "s/m"));
}

/// A number, an expression in p and r, or { file = … }. The completed scene keeps the absolute path.
FieldDescription field_in(SectionReader& s, std::string_view key,
                          const std::filesystem::path& folder, const char* unit) {
  const toml::node& node = *s.node(key);
  FieldDescription field;
  field.place = place_of(&node, s.file()) + ": " + s.path() + "." + std::string(key);
  if (const toml::table* table = node.as_table()) {
    const bool expression = table->contains("expression");
    const auto text = (*table)[expression ? "expression" : "file"].value<std::string>();
    if (!text || table->size() != 1) {
      s.fail(key, "expected { expression = \"…\" } or { file = \"….csv\" }", &node);
    }
    if (expression) {
      field.value = FieldExpression{*text};
      static_cast<void>(Field(field));  // its mistakes are those of the scene
      return field;
    }
    const std::filesystem::path file = *text;
    field.value = FieldTable{file.is_absolute() ? file : folder / file};
    static_cast<void>(Field(field));  // so are those of the table
    toml::table complete;
    complete.is_inline(true);
    complete.insert_or_assign("file", std::get<FieldTable>(field.value).file.string());
    s.complete(key, std::move(complete));
    return field;
  }
  if (!node.is_string()) {
    field.value = s.number_in(node, key);
    return field;
  }
  const std::string text = *node.value<std::string>();
  try {
    field.value = to_si(text, unit);
  } catch (const UnitError&) {  // no quantity, so an expression: its own messages follow
    field.value = FieldExpression{text};
    static_cast<void>(Field(field));
  }
  return field;
}

void read_preload(SectionReader& s, const std::filesystem::path& folder,
                  ContactDescription& contact) {
  const toml::node& field = *s.node("preload_field");
  if (!(field.is_string() && *field.value<std::string>() == "uniform")) {
    contact.preload_field = field_in(s, "preload_field", folder, "Pa");
  }
  const toml::node& moment = *s.node("preload_moment");
  const toml::array* list = moment.as_array();
  if (list == nullptr || list->size() != 2) {
    s.fail("preload_moment", "expected [M_p, M_r], the moments about p and r", &moment);
  }
  contact.preload_moment = {s.number_in(*list->get(0), "preload_moment"),
                            s.number_in(*list->get(1), "preload_moment")};
  const bool turned = contact.preload_moment[0] != 0.0 || contact.preload_moment[1] != 0.0;
  if (turned && contact.preload_field) {
    s.fail("preload_moment", "a preload_field has its own moments; give one of the two", &moment);
  }
}

/// preload = "static", and what does not go with it.
void read_static_preload(const SectionReader& s, ContactDescription& contact) {
  if (!s.given("preload")) {
    if (s.given("gap")) {
      s.fail(
          "gap",
          "goes with preload = \"static\"; the gap of a curve is response.preload = [{ gap = … }]",
          s.node("gap"));
    }
    return;
  }
  constexpr std::array<std::string_view, 1> words{"static"};
  static_cast<void>(s.word("preload", words));
  contact.static_preload = s.place("preload");
  if (s.given("gap")) contact.gap = s.number("gap");
  const char* other = contact.preload_field                            ? "preload_field"
                      : contact.preload_moment != std::array{0.0, 0.0} ? "preload_moment"
                      : contact.preload_share                          ? "preload_share"
                                                                       : nullptr;
  if (other != nullptr) {
    s.fail(other, "preload = \"static\" has a shape of its own: leave one of the two out",
           s.node(other));
  }
  if (!contact.normal_stiffness || *contact.normal_stiffness == 0.0) {
    s.fail("normal_stiffness",
           "preload = \"static\" needs the stiffness of the layer between the bodies in N/m^3, "
           "above 0",
           s.node("normal_stiffness"));
  }
  if (contact.rules.roughness) {
    s.fail(
        "roughness",
        "preload = \"static\" is solved with a layer of constant stiffness; give preload_field for "
        "rough surfaces",
        s.node("roughness"));
  }
}

void read_fit(const SectionReader& s, PatchSettings& patch) {
  const toml::node& fit = *s.node("fit");
  if (const auto word = fit.value<std::string>(); word && fit.is_string()) {
    if (*word != "auto" && *word != "none") {
      s.fail("fit", "expected a degree, \"auto\" or \"none\"", &fit);
    }
    patch.fit = *word == "auto" ? PatchSettings::Fit::automatic : PatchSettings::Fit::none;
    return;
  }
  const auto degree = fit.value<std::int64_t>();
  if (!fit.is_integer() || *degree < 0 || *degree > 30) {
    s.fail("fit", "expected a degree from 0 to 30, \"auto\" or \"none\"", &fit);
  }
  patch.fit = PatchSettings::Fit::degree;
  patch.fit_degree = static_cast<int>(*degree);
}

}  // namespace

std::optional<contact::RoughSurface> read_roughness(const SectionReader& s) {
  if (!s.given("roughness")) return std::nullopt;
  constexpr std::array<std::string_view, 2> laws{"cubic", "gaussian"};
  const toml::node& node = *s.node("roughness");
  double height = 0.0;
  std::string law;
  const auto add = [&](const toml::node& entry) {
    const toml::table* table = entry.as_table();
    if (table == nullptr) {
      s.fail("roughness",
             "expected { law = \"cubic\" | \"gaussian\", height = … }, or a list of two", &entry);
    }
    const std::string one = law_of(s, "roughness", *table, laws, {"height"});
    if (!law.empty() && one != law) {
      s.fail("roughness", "a cubic surface against a gaussian one has no law of its own", &entry);
    }
    law = one;
    height = std::hypot(height, entry_of(s, "roughness", *table, "height", "m"));
  };
  if (const toml::array* list = node.as_array()) {
    if (list->empty() || list->size() > 2)
      s.fail("roughness", "expected one or two surfaces", &node);
    for (const toml::node& entry : *list) add(entry);
  } else {
    add(node);
  }
  return law == "cubic" ? contact::RoughSurface::cubic(height)
                        : contact::RoughSurface::matching_gaussian(height);
}

double read_friction(const SectionReader& s, contact::SurfaceRules& rules) {
  const toml::node& node = *s.node("friction_coefficient");
  const toml::table* law = node.as_table();
  if (law == nullptr) return s.number_in(node, "friction_coefficient");
  rules.friction = friction_law_in(s, "friction_coefficient", *law);
  return rules.friction->at_rest();
}

ContactDescription read_contact(SectionReader s, const std::filesystem::path& folder) {
  ContactDescription contact;
  contact::SurfaceRules& rules = contact.rules;
  contact.key = s.path();
  if (const toml::node* surface = s.node("surface"); surface->is_array()) {
    s.fail("surface", "two facing bodies are not available in this version; name one surface",
           surface);
  }
  contact.surface = s.text("surface");
  contact.place = s.place("surface");
  contact.name = s.given("name") ? s.text("name") : contact.surface;
  if (s.given("preload_share")) contact.preload_share = s.number("preload_share");
  contact.slip_direction = s.direction("slip_direction");
  const toml::node& friction = *s.node("friction_coefficient");
  if (const toml::table* law = friction.as_table(); law != nullptr && !law->contains("file")) {
    rules.friction = friction_law_in(s, "friction_coefficient", *law);
    contact.friction.value = rules.friction->at_rest();
  } else {
    contact.friction = field_in(s, "friction_coefficient", folder, "1");
    contact.friction.low = 0.0;
  }
  contact.normal_stiffness = read_stiffness(s, "normal_stiffness");
  contact.tangential_stiffness = read_stiffness(s, "tangential_stiffness");
  rules.roughness = read_roughness(s);
  read_preload(s, folder, contact);
  read_static_preload(s, contact);
  contact.wear_coefficient = s.number("wear_coefficient");
  return contact;
}

PatchSettings read_patch_settings(const SectionReader& s) {
  PatchSettings patch;
  if (s.given("points")) patch.n_points = s.integer("points");
  read_fit(s, patch);
  return patch;
}

contact::SurfaceRules read_surface_rules(const SectionReader& s, double& wear_coefficient) {
  contact::SurfaceRules rules;
  if (s.given("friction_law")) {
    const toml::node& node = *s.node("friction_law");
    if (!node.is_table())
      s.fail("friction_law", "expected { law = …, static = …, rate = … }", &node);
    rules.friction = friction_law_in(s, "friction_law", *node.as_table());
  }
  rules.roughness = read_roughness(s);
  wear_coefficient = s.number("wear_coefficient");
  return rules;
}

}  // namespace microslip::pipelines
