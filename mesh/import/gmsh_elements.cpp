#include "mesh/import/gmsh_elements.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <sstream>
#include <string_view>
#include <unordered_map>

#include "mesh/shape_functions.hpp"

namespace microslip::mesh {
namespace {

constexpr std::array<GmshType, 21> types{{
    {1, 1, 2, "line", true},        {2, 2, 3, "tri3", true},         {3, 2, 4, "quad4", true},
    {4, 3, 4, "tet4", true},        {5, 3, 8, "hex8", true},         {6, 3, 6, "wedge6", true},
    {7, 3, 5, "pyramid5", true},    {8, 1, 3, "line3", true},        {9, 2, 6, "tri6", true},
    {10, 2, 9, "quad9", false},     {11, 3, 10, "tet10", true},      {12, 3, 27, "hex27", false},
    {13, 3, 18, "wedge18", false},  {14, 3, 14, "pyramid14", false}, {15, 0, 1, "point", true},
    {16, 2, 8, "quad8", true},      {17, 3, 20, "hex20", true},      {18, 3, 15, "wedge15", true},
    {19, 3, 13, "pyramid13", true}, {20, 2, 9, "tri9", false},       {21, 2, 10, "tri10", false},
}};

/// Place in gmsh's list of each node of the project's order.
std::vector<int> gmsh_place(ElementType type) {
  switch (type) {
    case ElementType::tet10:
      return {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
    case ElementType::hex20:
      return {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15};
    case ElementType::wedge15:
      return {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11};
    case ElementType::pyramid13:
      return {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12};
    case ElementType::tet4:
    case ElementType::hex8:
    case ElementType::wedge6:
    case ElementType::pyramid5:
      break;
  }
  std::vector<int> corners(static_cast<std::size_t>(n_nodes(type)));
  std::iota(corners.begin(), corners.end(), 0);
  return corners;
}

class MeshMaker {
 public:
  MeshMaker(const GmshContent& content, double unit, std::string file)
      : content_(content), unit_(unit), file_(std::move(file)) {}

  Mesh make(Joined joined) {
    read_nodes();
    for (const GmshElement& element : content_.elements) {
      const GmshType& type = *gmsh_type(element.type);
      if (!type.supported) {
        if (type.dimension < 3 && element.groups.empty()) continue;
        throw MeshError(file_ + ": element " + std::to_string(element.tag) + " is a " + type.name +
                        "; " + gmsh_remedy(&type));
      }
      if (type.dimension == 3) {
        add_volume(element);
      } else {
        add_named(element, type);
      }
    }
    std::vector<ElementBlock> blocks;
    for (auto& [type, list] : volumes_) blocks.push_back(block_of(type, list));
    return {std::move(nodes_), std::move(blocks), surfaces_, node_sets_, n_repeated_, joined};
  }

 private:
  struct VolumeList {
    std::vector<Eigen::Index> nodes;
    std::vector<std::int64_t> tags;
    // Format 2.2 writes an element once for each of its groups, under other numbers.
    std::map<std::vector<Eigen::Index>, std::set<std::int64_t>> groups;  // by sorted corners
  };

  void read_nodes() {
    const auto n = static_cast<Eigen::Index>(content_.node_tags.size());
    nodes_.resize(n, 3);
    index_.reserve(content_.node_tags.size());
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      for (Eigen::Index d = 0; d < 3; ++d) {
        nodes_(i, d) = unit_ * content_.coordinates[3 * k + static_cast<std::size_t>(d)];
      }
      if (!index_.emplace(content_.node_tags[k], i).second) {
        throw MeshError(file_ + ": node " + std::to_string(content_.node_tags[k]) +
                        " stands twice");
      }
    }
  }

  [[nodiscard]] Eigen::Index node(std::int64_t tag, const GmshElement& element) const {
    const auto found = index_.find(tag);
    if (found == index_.end()) {
      throw MeshError(file_ + ": element " + std::to_string(element.tag) + " uses node " +
                      std::to_string(tag) + ", which is not there");
    }
    return found->second;
  }

  void add_volume(const GmshElement& element) {
    static const std::map<int, ElementType> volume_types{
        {4, ElementType::tet4},     {5, ElementType::hex8},      {6, ElementType::wedge6},
        {7, ElementType::pyramid5}, {11, ElementType::tet10},    {17, ElementType::hex20},
        {18, ElementType::wedge15}, {19, ElementType::pyramid13}};
    const ElementType type = volume_types.at(element.type);
    VolumeList& list = volumes_[type];
    std::vector<Eigen::Index> nodes;
    for (const int place : gmsh_place(type)) {
      nodes.push_back(node(element.nodes[static_cast<std::size_t>(place)], element));
    }
    std::vector<Eigen::Index> corners(nodes.begin(), nodes.begin() + n_corners(type));
    std::sort(corners.begin(), corners.end());
    if (std::adjacent_find(corners.begin(), corners.end()) != corners.end()) {
      throw MeshError(file_ + ": element " + std::to_string(element.tag) + " has a corner twice");
    }
    const auto [seen, is_new] = list.groups.try_emplace(std::move(corners));
    if (!add_groups(element, seen->second) && !is_new) ++n_repeated_;
    if (!is_new) return;
    list.nodes.insert(list.nodes.end(), nodes.begin(), nodes.end());
    list.tags.push_back(element.tag);
  }

  /// False: the element says nothing new, an element without group counts as one of group 0.
  static bool add_groups(const GmshElement& element, std::set<std::int64_t>& groups) {
    if (element.groups.empty()) return groups.insert(0).second;
    bool added = false;
    for (const std::int64_t group : element.groups) added = groups.insert(group).second || added;
    return added;
  }

  void add_named(const GmshElement& element, const GmshType& type) {
    for (const std::int64_t group : element.groups) {
      const auto named = content_.group_names.find({type.dimension, group});
      const std::string name =
          named != content_.group_names.end() ? named->second : std::to_string(group);
      std::vector<Eigen::Index> nodes;
      for (const std::int64_t tag : element.nodes) nodes.push_back(node(tag, element));
      if (type.dimension == 2) {
        add_face(name, element.type, nodes);
      } else {
        auto& set = node_sets_[name];
        set.insert(set.end(), nodes.begin(), nodes.end());
      }
    }
  }

  void add_face(const std::string& name, int type, const std::vector<Eigen::Index>& nodes) {
    static const std::map<int, FaceType> face_types{
        {2, FaceType::tri3}, {3, FaceType::quad4}, {9, FaceType::tri6}, {16, FaceType::quad8}};
    std::vector<Eigen::Index> key = nodes;
    std::sort(key.begin(), key.end());
    if (!faces_seen_.emplace(name, std::move(key)).second) return;
    FaceBlock block{face_types.at(type), Connectivity(1, static_cast<Eigen::Index>(nodes.size()))};
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      block.connectivity(0, static_cast<Eigen::Index>(i)) = nodes[i];
    }
    surfaces_[name].push_back(std::move(block));
  }

  static ElementBlock block_of(ElementType type, VolumeList& list) {
    ElementBlock block;
    block.type = type;
    block.connectivity = Eigen::Map<const Connectivity>(
        list.nodes.data(), static_cast<Eigen::Index>(list.tags.size()), n_nodes(type));
    block.tags = std::move(list.tags);
    return block;
  }

  const GmshContent& content_;
  double unit_;
  std::string file_;
  Eigen::MatrixX3d nodes_;
  std::unordered_map<std::int64_t, Eigen::Index> index_;
  std::map<ElementType, VolumeList> volumes_;
  std::map<std::string, std::vector<FaceBlock>> surfaces_;
  std::set<std::pair<std::string, std::vector<Eigen::Index>>> faces_seen_;
  Mesh::NodeSets node_sets_;
  Eigen::Index n_repeated_ = 0;
};

/// Beyond, powers of lengths that stiffness and mass are made of leave the range of numbers.
void require_size_of_a_body(const Mesh& mesh, const std::string& file) {
  constexpr double smallest = 1e-12;
  constexpr double largest = 1e12;
  const double length = mesh.longest_side();
  if (length >= smallest && length <= largest) return;
  std::ostringstream text;
  text << file << ": the longest side of the mesh is " << length << " m; expected " << smallest
       << " to " << largest << " m: is length_unit that of the file?";
  throw MeshError(text.str());
}

}  // namespace

const GmshType* gmsh_type(std::int64_t number) {
  const auto found = std::find_if(types.begin(), types.end(),
                                  [&](const GmshType& type) { return type.number == number; });
  return found == types.end() ? nullptr : &*found;
}

std::string gmsh_remedy(const GmshType* type) {
  constexpr std::array complete{10, 12, 13, 14};  // with nodes inside faces
  if (type != nullptr && std::ranges::find(complete, type->number) != complete.end()) {
    return "nodes in the middle of faces are not read: mesh with Mesh.SecondOrderIncomplete = 1";
  }
  return "read are tetrahedra, hexahedra, wedges and pyramids of first or second order "
         "(Mesh.ElementOrder 1 or 2)";
}

Mesh make_mesh(const GmshContent& content, double length_unit, const std::string& file,
               Joined joined) {
  try {
    Mesh mesh = MeshMaker(content, length_unit, file).make(joined);
    require_size_of_a_body(mesh, file);
    return mesh;
  } catch (const MeshError& error) {  // the checks of a mesh do not know its file
    const std::string message = error.what();
    constexpr std::string_view finding = "bad-mesh: ";
    if (!message.starts_with(finding)) throw;
    throw MeshError(std::string(finding) + file + ": " + message.substr(finding.size()));
  }
}

}  // namespace microslip::mesh
