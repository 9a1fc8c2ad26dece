#include "pipelines/sections/points_section.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include <fmt/format.h>

namespace microslip::pipelines {
namespace {

/// Coordinates, or a name.
std::variant<Eigen::Vector3d, std::string> place_in(const SectionReader& s, std::string_view key) {
  const toml::node& node = *s.node(key);
  const toml::array* list = node.as_array();
  if (list == nullptr && !node.is_string()) {
    s.fail(key, "expected a name in quotes, or coordinates [x, y, z]", &node);
  }
  if (list == nullptr) return s.text(key);
  return coordinates_in(s, key);
}

auto found(const std::vector<PointDescription>& points, std::string_view name) {
  return std::ranges::find(points, name, &PointDescription::name);
}

}  // namespace

Eigen::Vector3d coordinates_in(const SectionReader& s, std::string_view key) {
  const toml::node& node = *s.node(key);
  const toml::array* list = node.as_array();
  if (list == nullptr || list->size() != 3) {
    s.fail(key, "expected three coordinates [x, y, z]", &node);
  }
  Eigen::Vector3d coordinates;
  for (std::size_t i = 0; i < 3; ++i) {
    coordinates[static_cast<Eigen::Index>(i)] = s.number_in(*list->get(i), key);
  }
  return coordinates;
}

std::vector<PointDescription> read_points(const toml::table& table, const std::string& file,
                                          toml::table& complete) {
  std::vector<PointDescription> points;
  std::vector<KeySpec> keys;
  for (const auto& [key, node] : table) keys.push_back(point_key(key.str()));
  const SectionReader section(&table, {"points", keys}, "points", file, complete);
  points.reserve(keys.size());
  for (const KeySpec& key : keys) {
    points.push_back({std::string(key.name), place_in(section, key.name), section.place(key.name)});
  }
  return points;
}

std::string name_in_mesh(const std::vector<PointDescription>& points, std::string name) {
  const auto point = found(points, name);
  if (point == points.end()) return name;
  const auto* other = std::get_if<std::string>(&point->of);
  return other != nullptr ? *other : name;
}

std::string read_place(const SectionReader& s, std::string_view key,
                       std::vector<PointDescription>& points) {
  auto place = place_in(s, key);
  if (const auto* name = std::get_if<std::string>(&place)) return name_in_mesh(points, *name);
  const Eigen::Vector3d& at = std::get<Eigen::Vector3d>(place);
  // Ten digits tell any two places apart that are not one to a mesh, and no rounding of
  // millimetres.
  std::string name = fmt::format("({:.10g}, {:.10g}, {:.10g})", at.x(), at.y(), at.z());
  if (found(points, name) == points.end()) points.push_back({name, at, s.place(key)});
  return name;
}

}  // namespace microslip::pipelines
