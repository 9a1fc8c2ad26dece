#include "pipelines/sections/faces_section.hpp"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "pipelines/sections/points_section.hpp"
#include "pipelines/text/section_reader.hpp"

namespace microslip::pipelines {
namespace {

std::optional<Eigen::Vector3d> coordinates(const SectionReader& s, std::string_view key) {
  if (!s.given(key)) return std::nullopt;
  return coordinates_in(s, key);
}

std::optional<double> size(const SectionReader& s, std::string_view key) {
  if (!s.given(key)) return std::nullopt;
  return s.number(key);
}

FaceChoice read_choice(const SectionReader& s) {
  FaceChoice choice;
  choice.point = coordinates(s, "point");
  if (s.given("normal")) choice.normal = s.direction("normal");
  choice.near = coordinates(s, "near");
  if (s.given("number")) choice.number = s.integer("number");
  choice.size = size(s, "size");
  choice.edge_size = size(s, "edge_size");
  const int n_ways = int{choice.point.has_value()} + int{choice.normal.has_value()} +
                     int{choice.number.has_value()};
  if (n_ways != 1) {
    s.fail("point",
           fmt::format("a face is named by one of point, normal and number; here are {}", n_ways));
  }
  if (choice.near && !choice.normal) s.fail("near", "goes with normal alone", s.node("near"));
  return choice;
}

}  // namespace

std::vector<FaceDescription> read_faces(const toml::table& table, const std::string& file,
                                        toml::table& complete) {
  std::vector<FaceDescription> faces;
  std::vector<KeySpec> keys;
  for (const auto& [name, node] : table) keys.push_back(face_key(name.str()));
  SectionReader section(&table, {"faces", keys}, "faces", file, complete);
  for (const KeySpec& key : keys) {
    const std::string name(key.name);
    FaceDescription& face = faces.emplace_back(FaceDescription{name, {}, section.place(name)});
    const toml::node& node = *section.node(name);
    const auto add = [&](const toml::node& entry) {
      if (!entry.is_table()) {
        section.fail(name, "expected a table such as { point = [x, y, z] }, or a list of them",
                     &entry);
      }
      toml::table completed;
      completed.is_inline(true);
      face.choices.push_back(
          read_choice({entry.as_table(), section_spec("face"), "faces." + name, file, completed}));
      return completed;
    };
    if (const toml::array* list = node.as_array()) {
      if (list->empty()) section.fail(name, "the list is empty", &node);
      toml::array completed;
      for (const toml::node& entry : *list) completed.push_back(add(entry));
      section.complete(name, std::move(completed));
    } else {
      section.complete(name, add(node));
    }
  }
  return faces;
}

}  // namespace microslip::pipelines
