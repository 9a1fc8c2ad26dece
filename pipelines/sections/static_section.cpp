#include "pipelines/sections/static_section.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "pipelines/sections/meshed_section.hpp"
#include "pipelines/sections/points_section.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/units.hpp"

namespace microslip::pipelines {
namespace {

double read_speed(const SectionReader& s) {
  const toml::node* node = s.node("speed");
  if (node == nullptr) return 0.0;
  if (!node->is_string()) return s.number_in(*node, "speed");
  try {
    return rotation_speed(*node->value<std::string>());
  } catch (const UnitError& error) {
    s.fail("speed", error.what(), node);
  }
}

std::vector<PressureDescription> read_pressures(SectionReader& s) {
  std::vector<PressureDescription> pressures;
  s.tables("pressure", "static.pressure", "{ surface = …, value = … }",
           [&](const SectionReader& pressure) {
             pressures.push_back(
                 {pressure.text("surface"), pressure.number("value"), pressure.place("surface")});
           });
  return pressures;
}

}  // namespace

StaticLoads read_static_loads(SectionReader s, std::vector<PointDescription>& points) {
  StaticLoads loads;
  if (s.given("forces")) loads.forces = read_forces(s, "static.force", points);
  if (s.given("pressure")) loads.pressures = read_pressures(s);
  if (!loads.pressures.empty()) loads.place = s.place("pressure");
  if (!loads.forces.empty()) loads.place = s.place("forces");
  return loads;
}

namespace {

/// Contacts beside the first have a static preload if it has one.
void require_same_of_all(const std::vector<ContactDescription>& contacts) {
  for (const ContactDescription& contact : contacts) {
    if (contact.static_preload_place.empty() == contacts.front().static_preload_place.empty())
      continue;
    const std::string& given = contact.static_preload_place.empty()
                                   ? contacts.front().static_preload_place
                                   : contact.static_preload_place;
    throw SceneError(given +
                     ": \"static\" is solved for all contacts together; give it to all of "
                     "them or to none");
  }
}

void require_loads_and_supports(const SceneDescription& scene) {
  const std::string& place = scene.contacts.front().static_preload_place;
  const bool rotates = scene.rotation && scene.rotation->speed > 0.0;
  const bool presses = std::ranges::any_of(
      scene.contacts, [](const ContactDescription& contact) { return contact.gap < 0.0; });
  const bool matrices = given_matrices(scene) != nullptr;  // with their supports in them
  if (scene.kind == "modes" && !matrices) {
    throw SceneError(
        place +
        ": \"static\" needs a stiffness, and modes of a file leave most of it out; give "
        "matrices (model.stiffness, model.mass, model.nodes), or "
        "contact.preload_field");
  }
  if (scene.static_loads.place.empty() && !rotates && !presses) {
    throw SceneError(place +
                     ": \"static\" needs a load; expected static.forces, static.pressure, "
                     "static.speed (not with matrices) or an interference (contact.gap below 0)");
  }
  if (scene.clamped.empty() && !matrices) {
    throw SceneError(place +
                     ": nothing holds the body against its static loads; expected names in "
                     "supports.clamped");
  }
}

/// Of the response: where it asks for what only a static preload gives.
bool asks_for_static(const ResponseDescription& response) {
  return std::ranges::any_of(response.preload,
                             [](const PreloadEntry& entry) {
                               return std::holds_alternative<StaticPreload>(entry);
                             }) ||
         (response.optimum && !response.optimum->of_preload() && !response.optimum->load);
}

}  // namespace

void require_static_preload(const SceneDescription& scene) {
  if (!scene.contacts.empty()) require_same_of_all(scene.contacts);
  if (has_static_preload(scene)) return require_loads_and_supports(scene);
  if (!scene.static_loads.place.empty()) {
    throw SceneError(scene.static_loads.place +
                     ": acts on nothing; expected contact.preload = \"static\", which it presses");
  }
  if (scene.response && asks_for_static(*scene.response)) {
    throw SceneError(scene.file.string() +
                     ": response.preload: \"static\" needs contact.preload = \"static\"");
  }
}

std::optional<fem::Rotation> read_rotation(SectionReader s) {
  const toml::node* axis = s.node("axis");
  if (axis == nullptr) {
    if (!s.given("speed")) return std::nullopt;
    s.fail("speed",
           "nothing says about which axis; give static.axis = { origin = [x, y, z], direction = "
           "[x, y, z] } too, or leave static.speed out",
           s.node("speed"));
  }
  if (!axis->is_table())
    s.fail("axis", "expected { origin = [x, y, z], direction = [x, y, z] }", axis);
  toml::table complete;
  complete.is_inline(true);
  const SectionReader table(axis->as_table(), section_spec("static.axis"), "static.axis", s.file(),
                            complete);
  const fem::Rotation rotation{.speed = read_speed(s),
                               .origin = coordinates_in(table, "origin"),
                               .direction = table.direction("direction")};
  s.complete("axis", std::move(complete));
  return rotation;
}

double rotation_speed(const std::string& text) {
  const bool has_unit = text.find_first_not_of("0123456789.+-eE \t") != std::string::npos;
  const double speed = has_unit ? 2.0 * std::numbers::pi * to_si(text, "Hz") : to_si(text, "rad/s");
  if (!(speed >= 0.0) || !is_of_usable_size(speed)) {
    throw UnitError(fmt::format("\"{}\" is no speed of rotation; expected 0 or more", text));
  }
  return speed;
}

}  // namespace microslip::pipelines
