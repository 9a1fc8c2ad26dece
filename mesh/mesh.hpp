/// @file
/// A volume mesh in metres with named surfaces and node sets. Checked when made; has no gmsh in it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "mesh/element_block.hpp"
#include "mesh/mesh_error.hpp"
#include "mesh/surface.hpp"

namespace microslip::mesh {

/// What joins the parts of a body: nodes they share, or constraints that are no mesh (ties,
/// equations).
enum class Joined : std::uint8_t { by_nodes, by_constraints };

class Mesh {
 public:
  using NodeSets = std::map<std::string, std::vector<Eigen::Index>>;

  /// @param nodes      coordinates [m], n × 3.
  /// @param elements   volume elements.
  /// @param surfaces   faces per name as found in the file, any orientation; they are matched to
  ///                   the volume elements and turned outward.
  /// @param node_sets  named points, edges or sets of nodes. The outer faces all of whose nodes are
  ///                   in a set are a surface of its name, unless `surfaces` has one.
  /// @param n_repeated  elements of the source that are there once more and were left out.
  /// @param joined      by constraints: parts that share no node are none to be refused.
  /// @throws MeshError  a finding of the checks (mesh_quality.hpp): inverted elements, duplicate
  ///         nodes or loose parts, a surface that is not on the boundary.
  Mesh(Eigen::MatrixX3d nodes, std::vector<ElementBlock> elements,
       const std::map<std::string, std::vector<FaceBlock>>& surfaces, const NodeSets& node_sets,
       Eigen::Index n_repeated = 0, Joined joined = Joined::by_nodes);

  [[nodiscard]] Eigen::Index n_nodes() const { return nodes_.rows(); }
  [[nodiscard]] Eigen::Index n_elements() const;
  /// Nodes that were given but belong to no volume element (centres of arcs and the like):
  /// left out.
  [[nodiscard]] Eigen::Index n_loose_nodes() const { return n_loose_nodes_; }
  /// Volume elements that stood in the source once more, in the same group:
  /// left out the second time.
  [[nodiscard]] Eigen::Index n_repeated_elements() const { return n_repeated_elements_; }
  [[nodiscard]] const Eigen::MatrixX3d& nodes() const { return nodes_; }
  [[nodiscard]] const std::vector<ElementBlock>& elements() const { return elements_; }
  /// A surface by its name, or the faces of a node set.
  /// @throws MeshError  no such surface; the message lists the
  /// names there are.
  [[nodiscard]] const Surface& surface(const std::string& name) const;
  /// Nodes of a named point, set or surface. @throws MeshError  as above.
  [[nodiscard]] std::vector<Eigen::Index> node_set(const std::string& name) const;
  /// Names nodes that the source does not. @throws MeshError  the name is taken.
  void name_nodes(const std::string& name, std::vector<Eigen::Index> nodes);
  /// What a user of the mesh should know of its source, a sentence each.
  [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }
  void add_remark(std::string sentence) { remarks_.push_back(std::move(sentence)); }
  /// Surfaces that were given as such.
  [[nodiscard]] std::vector<std::string> surface_names() const;
  /// Whether surface() gives faces for this name.
  [[nodiscard]] bool has_faces(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> node_set_names() const;
  [[nodiscard]] const NodeSets& node_sets() const { return node_sets_; }
  [[nodiscard]] double volume() const { return volume_; }  ///< [m³]
  /// Of the element about a place of the body, the geometric mean over all places [m³]: small
  /// elements at edges, of which there are many, weigh as little as what they fill.
  [[nodiscard]] double typical_element_volume() const { return typical_element_volume_; }
  [[nodiscard]] Eigen::Vector3d lower() const { return lower_; }  ///< bounding box [m]
  [[nodiscard]] Eigen::Vector3d upper() const { return upper_; }
  [[nodiscard]] double longest_side() const { return (upper_ - lower_).maxCoeff(); }  ///< of it

 private:
  Eigen::MatrixX3d nodes_;
  std::vector<ElementBlock> elements_;
  std::map<std::string, Surface> surfaces_;
  NodeSets node_sets_;
  std::map<std::string, Surface> faces_of_sets_;
  Eigen::Index n_loose_nodes_ = 0;
  Eigen::Index n_repeated_elements_ = 0;
  std::vector<std::string> remarks_;
  double volume_ = 0.0;
  double typical_element_volume_ = 0.0;
  Eigen::Vector3d lower_;
  Eigen::Vector3d upper_;
};

}  // namespace microslip::mesh
