/// @file
/// gmsh's element types and node orders: known here and nowhere else.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh.hpp"

namespace microslip::mesh {

struct GmshType {
  int number;  ///< in the file
  int dimension;
  int n_nodes;
  const char* name;
  bool supported;  ///< volumes and faces this project knows, lines and points
};

/// nullptr: a number gmsh does not define up to second order.
[[nodiscard]] const GmshType* gmsh_type(std::int64_t number);

/// What to do about an element that is not read. @param type  nullptr: one gmsh_type does not know.
[[nodiscard]] std::string gmsh_remedy(const GmshType* type);

/// One element as it stands in a file.
struct GmshElement {
  int type = 0;
  std::int64_t tag = 0;
  std::vector<std::int64_t> groups;  ///< physical groups of its dimension
  std::vector<std::int64_t> nodes;   ///< node tags, gmsh order
};

/// A file as it was read, before it becomes a Mesh.
struct GmshContent {
  std::vector<std::int64_t> node_tags;
  std::vector<double> coordinates;  ///< x y z per node
  std::vector<GmshElement> elements;
  std::map<std::pair<int, std::int64_t>, std::string> group_names;  ///< (dimension, tag) → name
};

/// @throws MeshError  duplicate or unknown node tags; checks of Mesh. @param file  for messages.
[[nodiscard]] Mesh make_mesh(const GmshContent& content, double length_unit,
                             const std::string& file, Joined joined = Joined::by_nodes);

}  // namespace microslip::mesh
