#include "pipelines/scene/static_section.hpp"

#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "pipelines/scene/points_section.hpp"
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

}  // namespace

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
