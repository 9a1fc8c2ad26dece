#include "mesh/gmsh/gmsh_mesher.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

#include <gmsh.h>
#include <Eigen/Core>

#include "mesh/checks/mesh_quality.hpp"
#include "mesh/mesh_error.hpp"

namespace microslip::mesh {
namespace {

namespace occ = gmsh::model::occ;

using Entity = std::pair<int, int>;  // dimension, tag
using Entities = std::vector<Entity>;

// Of the largest Jacobian of an element: margin for the rounding of coordinates in the file.
constexpr double least_share = 1e-9;
constexpr int half_outline_points = 9;  // per spline, from an edge to mid-chord

/// Points from one end of a spline to the other, denser at the rounded edges.
std::vector<double> chord_shares(double from, double to) {
  std::vector<double> shares;
  for (int i = 0; i < half_outline_points; ++i) {
    const double turn = from + (to - from) * i / (half_outline_points - 1);
    shares.push_back(0.5 * (1.0 - std::cos(std::numbers::pi * turn)));
  }
  return shares;
}

/// The closed outline of a section: four splines that meet at the edges and at mid-chord.
int section_wire(const BladeGeometry& geometry, double height) {
  const auto point = [&](double share, double side) {
    const SectionPoint p = section_point(geometry, height, share, side);
    return occ::addPoint(p.x, p.y, p.z);
  };
  const int leading = point(0.0, 1.0);
  const int trailing = point(1.0, 1.0);
  const int suction = point(0.5, 1.0);
  const int pressure = point(0.5, -1.0);
  const auto spline = [&](int first, int last, double from, double to, double side) {
    std::vector<int> points{first};
    const std::vector<double> shares = chord_shares(from, to);
    for (std::size_t i = 1; i + 1 < shares.size(); ++i) points.push_back(point(shares[i], side));
    points.push_back(last);
    return occ::addSpline(points);
  };
  return occ::addWire(
      {spline(leading, suction, 0.0, 0.5, 1.0), spline(suction, trailing, 0.5, 1.0, 1.0),
       spline(trailing, pressure, 1.0, 0.5, -1.0), spline(pressure, leading, 0.5, 0.0, -1.0)});
}

/// Root block, platform and aerofoil as one volume.
void build_volume(const BladeGeometry& g) {
  const int root = occ::addBox(-0.5 * g.root_width, 0.0, -0.5 * g.root_length, g.root_width,
                               g.root_height, g.root_length);
  const int platform = occ::addBox(-0.5 * g.platform_width, g.root_height, -0.5 * g.platform_length,
                                   g.platform_width, g.platform_height, g.platform_length);
  std::vector<int> wires;
  // The loft starts a little inside the platform: a face in the platform's face would be
  // degenerate.
  const double sunk = -std::min(0.02, 0.5 * g.platform_height / g.span);
  for (const double height : {sunk, 0.25, 0.5, 0.75, 1.0}) wires.push_back(section_wire(g, height));
  Entities aerofoil;
  occ::addThruSections(wires, aerofoil, -1, true);
  Entities tools{{3, platform}};
  for (const Entity& entity : aerofoil) {
    if (entity.first == 3) tools.push_back(entity);
  }
  Entities result;
  std::vector<Entities> map;
  occ::fuse({{3, root}}, tools, result, map);
  occ::synchronize();
  Entities volumes;
  gmsh::model::getEntities(volumes, 3);
  if (volumes.size() != 1) {
    throw MeshError("the blade came out as " + std::to_string(volumes.size()) +
                    " volumes instead of one; the aerofoil must stand on the platform");
  }
}

/// The plane face whose centre of mass has the coordinate `value` along `axis`.
std::vector<int> faces_at(int axis, double value, double tolerance) {
  std::vector<int> found;
  Entities surfaces;
  gmsh::model::getEntities(surfaces, 2);
  for (const Entity& surface : surfaces) {
    std::string type;
    gmsh::model::getType(2, surface.second, type);
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    occ::getCenterOfMass(2, surface.second, x, y, z);
    const double centre = axis == 0 ? x : (axis == 1 ? y : z);
    if (type == "Plane" && std::abs(centre - value) < tolerance) found.push_back(surface.second);
  }
  return found;
}

int nearest_point(const SectionPoint& target) {
  Entities points;
  gmsh::model::getEntities(points, 0);
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (const Entity& point : points) {
    std::vector<double> x;
    gmsh::model::getValue(0, point.second, {}, x);
    const double distance = std::hypot(x[0] - target.x, x[1] - target.y, x[2] - target.z);
    if (distance < least) {
      least = distance;
      best = point.second;
    }
  }
  return best;
}

void add_group(int dimension, const std::vector<int>& tags, const std::string& name) {
  if (tags.empty()) throw MeshError("no face of the geometry could be named \"" + name + "\"");
  gmsh::model::setPhysicalName(dimension, gmsh::model::addPhysicalGroup(dimension, tags), name);
}

/// Names come from geometry, after the Boolean operation has numbered everything anew.
void name_entities(const BladeGeometry& g) {
  const double tolerance = 1e-6 * (g.span + g.platform_width);
  add_group(2, faces_at(1, 0.0, tolerance), "root");
  add_group(2, faces_at(0, 0.5 * g.platform_width, tolerance), "contact");
  add_group(2, faces_at(0, -0.5 * g.platform_width, tolerance), "platform_left");
  add_group(2, faces_at(1, g.root_height + g.platform_height + g.span, tolerance), "tip");
  add_group(0, {nearest_point(section_point(g, 1.0, 0.5, 1.0))}, "A");
  add_group(0, {nearest_point(section_point(g, 1.0, 0.0, 1.0))}, "B");
  add_group(0, {nearest_point(section_point(g, 1.0, 1.0, 1.0))}, "B'");
  Entities volumes;
  gmsh::model::getEntities(volumes, 3);
  add_group(3, {volumes.front().second}, "blade");
}

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

/// Curved elements at thin edges turn inside out between any samples: by the bound the reader refuses them with.
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

/// Mid-edge nodes to the middle of their edges: a tetrahedron with straight edges cannot be inside out.
void straighten(const InvertedElement& element, Places& places) {
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const std::size_t node = element.nodes[4 + k];
    const Eigen::RowVector3d middle =
        0.5 * (places.at(element.nodes[edges[k][0]]) + places.at(element.nodes[edges[k][1]]));
    places.at(node) = middle;
    gmsh::model::mesh::setNode(node, {middle[0], middle[1], middle[2]}, {});
  }
}

/// Mends elements that curving turned inside out. gmsh's optimisers keep to the curved surface but give up on
/// some elements, each on others: what the first leaves the second takes. The few left get straight edges,
/// which errs locally by the curvature over one element; neighbours share these edges, hence the passes.
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

class Session {
 public:
  Session() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);  // the same mesh every time
  }
  ~Session() { gmsh::finalize(); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  Session(Session&&) = delete;
  Session& operator=(Session&&) = delete;
};

}  // namespace

void mesh_blade_with_gmsh(const BladeGeometry& geometry, double element_size,
                          const std::string& file) {
  check_geometry(geometry, element_size);
  const Session session;
  gmsh::option::setNumber("Mesh.MaxNumThreads3D", 1);
  gmsh::option::setNumber("Mesh.MeshSizeMax", element_size);
  gmsh::option::setNumber("Mesh.MeshSizeMin", 0.5 * element_size);
  gmsh::option::setNumber("Mesh.SecondOrderLinear", 0);
  gmsh::option::setNumber("Mesh.MshFileVersion", 4.1);
  gmsh::option::setNumber("Mesh.Binary", 1);
  build_volume(geometry);
  name_entities(geometry);
  gmsh::model::mesh::generate(3);
  gmsh::model::mesh::setOrder(2);
  untangle();
  gmsh::write(file);
}

}  // namespace microslip::mesh
