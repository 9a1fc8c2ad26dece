#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

#include <gmsh.h>
#include <Eigen/Core>

#include "mesh/checks/mesh_quality.hpp"
#include "mesh/gmsh/gmsh_session.hpp"
#include "mesh/mesh_error.hpp"

namespace microslip::mesh {
namespace {

// Of the largest Jacobian of an element: margin for the rounding of coordinates in the file.
constexpr double least_share = 1e-9;

/// A tet10 of the model that is turned inside out somewhere; nodes in the order of gmsh.
struct InvertedElement {
  std::array<std::size_t, 10> nodes;
};

constexpr int gmsh_tet10 = 11;
// Order of the project from that of gmsh: the last two edges change places.
constexpr std::array<std::size_t, 10> project_order{0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
// Ends of the edges that carry nodes 4 to 9 of gmsh.
constexpr std::array<std::array<std::size_t, 2>, 6> edges{
    {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}}};

using Places = std::unordered_map<std::size_t, Eigen::RowVector3d>;

Places node_places() {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates;
  std::vector<double> parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters);
  Places places;
  places.reserve(tags.size());
  for (std::size_t i = 0; i < tags.size(); ++i) {
    places.emplace(tags[i], Eigen::Map<const Eigen::RowVector3d>(&coordinates[3 * i]));
  }
  return places;
}

/// Curved elements at thin edges turn inside out between any samples:
/// by the bound the reader refuses them with.
std::vector<InvertedElement> inverted_elements(const Places& places) {
  std::vector<std::size_t> tags;
  std::vector<std::size_t> nodes;
  gmsh::model::mesh::getElementsByType(gmsh_tet10, tags, nodes);
  std::vector<InvertedElement> inverted;
  Eigen::MatrixX3d own(10, 3);
  for (std::size_t e = 0; e < tags.size(); ++e) {
    InvertedElement element{};
    std::copy_n(nodes.begin() + static_cast<std::ptrdiff_t>(10 * e), 10, element.nodes.begin());
    for (std::size_t i = 0; i < 10; ++i) {
      own.row(static_cast<Eigen::Index>(i)) = places.at(element.nodes[project_order[i]]);
    }
    const JacobianRange range = jacobian_range(ElementType::tet10, own);
    if (range.least <= least_share * range.largest) inverted.push_back(element);
  }
  return inverted;
}

/// Mid-edge nodes to the middle of their edges: a tetrahedron with straight edges cannot be inside
/// out.
void straighten(const InvertedElement& element, Places& places) {
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const std::size_t node = element.nodes[4 + k];
    const Eigen::RowVector3d middle =
        0.5 * (places.at(element.nodes[edges[k][0]]) + places.at(element.nodes[edges[k][1]]));
    places.at(node) = middle;
    gmsh::model::mesh::setNode(node, {middle[0], middle[1], middle[2]}, {});
  }
}

/// Mends elements that curving turned inside out. gmsh's optimisers keep to the curved surface but
/// give up on some elements, each on others: what the first leaves the second takes. The few left
/// get straight edges, which errs locally by the curvature over one element;
/// neighbours share these edges, hence the passes.
void untangle() {
  for (const char* method : {"HighOrder", "HighOrderElastic"}) {
    if (inverted_elements(node_places()).empty()) return;
    try {
      gmsh::model::mesh::optimize(method);
    } catch (const std::runtime_error& error) {
      std::cerr << method << ": " << error.what() << '\n';
    } catch (const std::string& error) {
      std::cerr << method << ": " << error << '\n';
    }
  }
  constexpr int passes = 5;  // the reader refuses what is left
  Places places = node_places();
  for (int pass = 0; pass < passes; ++pass) {
    const std::vector<InvertedElement> inverted = inverted_elements(places);
    if (inverted.empty()) return;
    for (const InvertedElement& element : inverted) straighten(element, places);
  }
}

}  // namespace

GmshSession::GmshSession() {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("General.NumThreads", 1);  // the same mesh every time; see also main()
  gmsh::option::setNumber("Mesh.MaxNumThreads3D", 1);
}

GmshSession::~GmshSession() { gmsh::finalize(); }

void add_group(int dimension, const std::vector<int>& tags, const std::string& name) {
  if (tags.empty()) throw MeshError("no face of the geometry could be named \"" + name + "\"");
  gmsh::model::setPhysicalName(dimension, gmsh::model::addPhysicalGroup(dimension, tags), name);
}

namespace {

/// gmsh does not say that it could not write.
void require_whole(const std::string& file) {
  constexpr std::streamoff longest_line = 64;
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = in ? static_cast<std::streamoff>(in.tellg()) : 0;
  in.seekg(std::max<std::streamoff>(size - longest_line, 0));
  const std::string end{std::istreambuf_iterator<char>(in), {}};
  const std::size_t last = end.rfind("$End");
  if (last == std::string::npos || end.find('\n', last) + 1 != end.size()) {
    throw MeshRoomError("the mesh is not written whole");
  }
}

}  // namespace

void write_volume_mesh(double element_size, double least_size, const std::string& file) {
  gmsh::option::setNumber("Mesh.MeshSizeMax", element_size);
  gmsh::option::setNumber("Mesh.MeshSizeMin", 0.5 * least_size);
  gmsh::option::setNumber("Mesh.SecondOrderLinear", 0);
  gmsh::option::setNumber("Mesh.MshFileVersion", 4.1);
  gmsh::option::setNumber("Mesh.Binary", 1);
  gmsh::model::mesh::generate(3);
  gmsh::model::mesh::setOrder(2);
  untangle();
  gmsh::write(file);
  require_whole(file);
}

}  // namespace microslip::mesh
