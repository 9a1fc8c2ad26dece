#include "pipelines/sections/contact_section.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipelines/sections/friction_section.hpp"
#include "pipelines/sections/law_table.hpp"

namespace microslip::pipelines {
namespace {

std::optional<double> read_stiffness(const SectionReader& s, std::string_view key) {
  const toml::node& node = *s.node(key);
  if (node.is_string() && *node.value<std::string>() == "rigid") return std::nullopt;
  constexpr std::array<std::string_view, 1> words{"rigid"};
  return s.number_or_word_in(node, key, words);
}

void read_preload(SectionReader& s, const std::filesystem::path& folder,
                  ContactDescription& contact) {
  const toml::node& field = *s.node("preload_field");
  if (!(field.is_string() && *field.value<std::string>() == "uniform")) {
    contact.preload_field = read_field(s, "preload_field", folder, "Pa");
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
  contact.static_preload_place = s.place("preload");
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
           "above 0: between rigid ones the pressure at an edge grows without bound as elements "
           "get smaller; \"1e15 N/m^3\" is nearly that",
           s.node("normal_stiffness"));
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

struct HeightLawRow {
  std::string_view law;
  std::vector<std::string_view> keys;
};

/// μ of the points that rub, by their place.
void set_friction(const SectionReader& s, const Field& friction, ModalModel& model) {
  if (model.positions.rows() == 0) {
    s.fail("friction_law", "depends on the place: the points need columns p and r",
           s.node("friction_law"));
  }
  const Eigen::VectorXd values = friction.at(model.positions.col(0), model.positions.col(1));
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    double& own = model.points[i].friction_coefficient;
    if (own > 0.0) own = values[static_cast<Eigen::Index>(i)];
  }
}

}  // namespace

std::optional<contact::RoughSurface> read_roughness(const SectionReader& s) {
  if (!s.given("roughness")) return std::nullopt;
  static const std::array height_laws{HeightLawRow{"cubic", {"height"}},
                                      HeightLawRow{"gaussian", {"height"}}};
  const toml::node& node = *s.node("roughness");
  double height = 0.0;
  std::string_view law;
  const auto add = [&](const toml::node& entry) {
    const toml::table* table = entry.as_table();
    if (table == nullptr) {
      s.fail("roughness",
             "expected { law = \"cubic\" | \"gaussian\", height = … }, or a list of two", &entry);
    }
    const LawTable one(s, "roughness", *table);
    const std::string_view name = one.choose(std::span<const HeightLawRow>(height_laws)).law;
    if (!law.empty() && name != law) {
      s.fail("roughness", "a cubic surface against a gaussian one has no law of its own", &entry);
    }
    law = name;
    height = std::hypot(height, one.number("height", "m"));
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

ContactDescription read_contact(SectionReader s, const std::filesystem::path& folder) {
  ContactDescription contact;
  contact::SurfaceRules& rules = contact.rules;
  contact.key = s.path();
  if (const toml::node* surface = s.node("surface"); surface->is_array()) {
    s.fail(
        "surface",
        "one surface for each contact, which rubs on the ground: for several write a [[contact]] "
        "section each; two bodies that face each other are not available in this version",
        surface);
  }
  contact.surface = s.text("surface");
  contact.place = s.place("surface");
  contact.name = s.given("name") ? s.text("name") : contact.surface;
  if (s.given("preload_share")) contact.preload_share = s.number("preload_share");
  contact.slip_direction = s.direction("slip_direction");
  contact.slip_place = s.place("slip_direction");
  FrictionDescription friction = read_friction(s, "friction_coefficient", folder);
  contact.friction = std::move(friction.at_rest);
  rules.friction = friction.law;
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

namespace {

void require_rough_points(const SectionReader& s, const contact::SurfaceRules& rules,
                          const ModalModel& model) {
  if (!rules.roughness || rules.roughness->height() == 0.0) return;
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    if (model.points[i].normal_stiffness > 0.0) continue;
    s.fail("roughness",
           fmt::format("rough surfaces need a normal_stiffness above 0, and that of point {} of "
                       "{} in modal.points is {:g}",
                       i + 1, model.points.size(), model.points[i].normal_stiffness),
           s.node("roughness"));
  }
}

}  // namespace

contact::SurfaceRules read_surface_rules(SectionReader s, const std::filesystem::path& folder,
                                         ModalModel& model, double& wear_coefficient) {
  contact::SurfaceRules rules;
  if (s.given("friction_law")) {
    const toml::node& node = *s.node("friction_law");
    if (!node.is_table()) s.fail("friction_law", "expected a table { law = …, … }", &node);
    const FrictionDescription friction = read_friction(s, "friction_law", folder);
    rules.friction = friction.law;
    if (!friction.law) set_friction(s, friction.at_rest, model);
  }
  rules.roughness = read_roughness(s);
  require_rough_points(s, rules, model);
  wear_coefficient = s.number("wear_coefficient");
  return rules;
}

}  // namespace microslip::pipelines
