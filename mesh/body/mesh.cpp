#include "mesh/mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "mesh/checks/mesh_overlap.hpp"
#include "mesh/checks/mesh_quality.hpp"
#include "mesh/count_text.hpp"
#include "mesh/elements/face_map.hpp"
#include "mesh/shape_functions.hpp"

namespace microslip::mesh {
namespace {

struct FacesOfType {
  FaceType type = FaceType::tri3;
  std::vector<std::vector<Eigen::Index>> faces;
};

/// Faces as the volume elements have them: outward, with all their nodes.
class SurfaceBuilder {
 public:
  SurfaceBuilder(const std::vector<ElementBlock>& elements, const FaceMap& owners)
      : elements_(elements), owners_(owners) {}

  Surface build(const std::string& name, const std::vector<FaceBlock>& given) {
    lists_ = {};
    missing_ = inside_ = 0;
    for (const FaceBlock& block : given) {
      const int corners = n_corners(block.type);
      for (Eigen::Index f = 0; f < block.connectivity.rows(); ++f) {
        std::array<Eigen::Index, 4> nodes{};
        for (int i = 0; i < corners; ++i) {
          nodes[static_cast<std::size_t>(i)] = block.connectivity(f, i);
        }
        add(face_key(nodes, corners));
      }
    }
    if (missing_ > 0) {
      throw MeshError("bad-mesh: surface \"" + name + "\": " +
                      counted(missing_, "face belongs", "faces belong") + " to no volume element");
    }
    if (inside_ > 0) {
      throw MeshError("bad-mesh: surface \"" + name +
                      "\": " + counted(inside_, "face lies", "faces lie") +
                      " inside the volume, between two elements");
    }
    return collect(name);
  }

  /// @param faces  of the boundary.
  Surface build(const std::string& name, const std::vector<FaceUse>& faces) {
    lists_ = {};
    for (const FaceUse& face : faces) put(face);
    return collect(name);
  }

 private:
  void add(const FaceKey& key) {
    const auto found = owners_.find(key);
    if (found == owners_.end()) {
      ++missing_;
      return;
    }
    if (found->second.count > 1) {
      ++inside_;
      return;
    }
    put(found->second.uses.front());
  }

  void put(const FaceUse& use) {
    const FaceType type = face_type(elements_[use.block].type, use.face);
    FacesOfType& list = lists_[static_cast<std::size_t>(type)];
    list.type = type;
    list.faces.push_back(face_nodes(elements_, use));
  }

  [[nodiscard]] Surface collect(const std::string& name) const {
    Surface surface;
    surface.name = name;
    for (const FacesOfType& list : lists_) {
      if (list.faces.empty()) continue;
      FaceBlock block{list.type, Connectivity(static_cast<Eigen::Index>(list.faces.size()),
                                              n_nodes(list.type))};
      for (Eigen::Index f = 0; f < block.connectivity.rows(); ++f) {
        for (Eigen::Index a = 0; a < block.connectivity.cols(); ++a) {
          const Eigen::Index node =
              list.faces[static_cast<std::size_t>(f)][static_cast<std::size_t>(a)];
          block.connectivity(f, a) = node;
          surface.nodes.push_back(node);
        }
      }
      surface.faces.push_back(std::move(block));
    }
    std::sort(surface.nodes.begin(), surface.nodes.end());
    surface.nodes.erase(std::unique(surface.nodes.begin(), surface.nodes.end()),
                        surface.nodes.end());
    return surface;
  }

  const std::vector<ElementBlock>& elements_;
  const FaceMap& owners_;
  std::array<FacesOfType, all_face_types.size()> lists_;
  Eigen::Index missing_ = 0;
  Eigen::Index inside_ = 0;
};

/// New number of every node, −1 for those no element uses.
std::vector<Eigen::Index> numbering(Eigen::Index n_nodes,
                                    const std::vector<ElementBlock>& elements) {
  std::vector<Eigen::Index> number(static_cast<std::size_t>(n_nodes), -1);
  for (const ElementBlock& block : elements) {
    for (Eigen::Index i = 0; i < block.connectivity.size(); ++i) {
      const Eigen::Index node = block.connectivity.data()[i];
      if (node < 0 || node >= n_nodes) {
        throw MeshError("bad-mesh: an element uses node " + std::to_string(node + 1) + " of " +
                        std::to_string(n_nodes));
      }
      number[static_cast<std::size_t>(node)] = 0;
    }
  }
  Eigen::Index next = 0;
  for (Eigen::Index& n : number) {
    if (n == 0) n = next++;
  }
  return number;
}

/// Of the faces of the boundary those all of whose nodes are in a set.
std::vector<FaceUse> faces_within(const std::vector<Eigen::Index>& set,
                                  const std::vector<FaceUse>& boundary,
                                  const std::vector<ElementBlock>& elements) {
  std::vector<FaceUse> found;
  if (set.size() < 3) return found;
  const auto is_in_set = [&](Eigen::Index node) {
    return std::binary_search(set.begin(), set.end(), node);
  };
  for (const FaceUse& face : boundary) {
    const std::vector<Eigen::Index> nodes = face_nodes(elements, face);
    if (std::all_of(nodes.begin(), nodes.end(), is_in_set)) found.push_back(face);
  }
  return found;
}

std::string listed(const std::vector<std::string>& names) {
  if (names.empty()) return "none";
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "\"" : ", \"") + name + "\"";
  return text;
}

template <typename Map>
std::vector<std::string> keys_of(const Map& map) {
  std::vector<std::string> keys;
  keys.reserve(map.size());
  for (const auto& [key, value] : map) keys.push_back(key);
  return keys;
}

}  // namespace

Mesh::Mesh(Eigen::MatrixX3d nodes, std::vector<ElementBlock> elements,
           const std::map<std::string, std::vector<FaceBlock>>& surfaces, const NodeSets& node_sets,
           Eigen::Index n_repeated, Joined joined)
    : elements_(std::move(elements)), n_repeated_elements_(n_repeated) {
  std::erase_if(elements_, [](const ElementBlock& b) { return b.connectivity.rows() == 0; });
  if (elements_.empty()) throw MeshError("bad-mesh: the mesh has no volume elements");
  if (!nodes.allFinite()) throw MeshError("bad-mesh: a coordinate is not a finite number");
  const std::vector<Eigen::Index> number = numbering(nodes.rows(), elements_);
  const auto renumbered = [&](Eigen::Index node) { return number[static_cast<std::size_t>(node)]; };
  Eigen::Index n_used = 0;
  for (const Eigen::Index n : number) n_used += n >= 0 ? 1 : 0;
  n_loose_nodes_ = nodes.rows() - n_used;
  nodes_.resize(n_used, 3);
  for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
    if (renumbered(i) >= 0) nodes_.row(renumbered(i)) = nodes.row(i);
  }
  for (ElementBlock& block : elements_)
    block.connectivity = block.connectivity.unaryExpr(renumbered);
  check_elements(nodes_, elements_);
  check_coincident_nodes(nodes_);
  if (joined == Joined::by_nodes) check_connected(nodes_.rows(), elements_, nodes_);
  const FaceMap owners = map_faces(elements_);
  check_faces(elements_, owners);
  check_outer_faces(nodes_, elements_, owners);

  SurfaceBuilder builder(elements_, owners);
  for (const auto& [name, as_given] : surfaces) {
    std::vector<FaceBlock> blocks = as_given;
    for (FaceBlock& block : blocks) block.connectivity = block.connectivity.unaryExpr(renumbered);
    Surface surface = builder.build(name, blocks);
    if (!surface.faces.empty()) surface.area = sample_surface(nodes_, surface, 1).weights.sum();
    surfaces_.emplace(name, std::move(surface));
  }
  const std::vector<FaceUse> boundary = outer_faces(owners);
  for (const auto& [name, set] : node_sets) {
    auto& kept = node_sets_[name];
    for (const Eigen::Index node : set) {
      if (renumbered(node) >= 0) kept.push_back(renumbered(node));
    }
    std::sort(kept.begin(), kept.end());
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
    const std::vector<FaceUse> faces = faces_within(kept, boundary, elements_);
    if (faces.empty() || surfaces_.contains(name)) continue;
    Surface& surface = faces_of_sets_[name] = builder.build(name, faces);
    surface.area = sample_surface(nodes_, surface, 1).weights.sum();
  }
  double logarithms = 0.0;
  for (const ElementBlock& block : elements_) {
    Eigen::MatrixX3d own(block.connectivity.cols(), 3);
    for (Eigen::Index e = 0; e < block.connectivity.rows(); ++e) {
      for (Eigen::Index a = 0; a < own.rows(); ++a)
        own.row(a) = nodes_.row(block.connectivity(e, a));
      const double volume = element_volume(block.type, own);
      volume_ += volume;
      logarithms += volume * std::log(volume);
    }
  }
  typical_element_volume_ = std::exp(logarithms / volume_);
  lower_ = nodes_.colwise().minCoeff();
  upper_ = nodes_.colwise().maxCoeff();
}

Eigen::Index Mesh::n_elements() const {
  Eigen::Index n = 0;
  for (const ElementBlock& block : elements_) n += block.connectivity.rows();
  return n;
}

const Surface& Mesh::surface(const std::string& name) const {
  const auto found = surfaces_.find(name);
  if (found != surfaces_.end()) {
    if (found->second.faces.empty()) throw MeshError("surface \"" + name + "\" is empty");
    return found->second;
  }
  const auto of_set = faces_of_sets_.find(name);
  if (of_set != faces_of_sets_.end()) return of_set->second;
  std::string there = "the surfaces are: " + listed(surface_names());
  if (!faces_of_sets_.empty()) {
    there += "; node sets that hold whole faces: " + listed(keys_of(faces_of_sets_));
  }
  if (node_sets_.contains(name)) {
    throw MeshError("\"" + name + "\" is a set of nodes that holds all nodes of no outer face; " +
                    there);
  }
  throw MeshError("no surface is named \"" + name + "\"; " + there);
}

bool Mesh::has_faces(const std::string& name) const {
  const auto found = surfaces_.find(name);
  return found != surfaces_.end() ? !found->second.faces.empty() : faces_of_sets_.contains(name);
}

std::vector<Eigen::Index> Mesh::node_set(const std::string& name) const {
  const auto found = node_sets_.find(name);
  if (found != node_sets_.end() && !found->second.empty()) return found->second;
  if (surfaces_.contains(name)) return surface(name).nodes;
  if (found != node_sets_.end()) {
    throw MeshError("\"" + name + "\" has no node that a volume element uses");
  }
  throw MeshError("nothing is named \"" + name + "\"; surfaces: " + listed(surface_names()) +
                  "; points and node sets: " + listed(node_set_names()));
}

void Mesh::name_nodes(const std::string& name, std::vector<Eigen::Index> nodes) {
  if (surfaces_.contains(name) || node_sets_.contains(name)) {
    throw MeshError("the mesh has a \"" + name + "\" already: give it another name");
  }
  node_sets_.emplace(name, std::move(nodes));
}

std::vector<std::string> Mesh::surface_names() const { return keys_of(surfaces_); }
std::vector<std::string> Mesh::node_set_names() const { return keys_of(node_sets_); }

}  // namespace microslip::mesh
