#include "mesh/gmsh/gmsh_mesher.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gmsh.h>

#include "mesh/gmsh/gmsh_session.hpp"
#include "mesh/gmsh/size_field.hpp"
#include "mesh/mesh_error.hpp"

namespace microslip::mesh {
namespace {

namespace occ = gmsh::model::occ;

using Entity = std::pair<int, int>;  // dimension, tag
using Entities = std::vector<Entity>;

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

/// Outline of the foot, and where root block and aerofoil meet the platform from inside its faces.
std::vector<double> singular_edges(const BladeGeometry& g) {
  constexpr double nearly = 1e-4;  // boxes of gmsh are a little larger than what is in them
  const double tolerance = nearly * g.platform_width;
  const double top = g.root_height + g.platform_height;
  Entities curves;
  gmsh::model::getEntities(curves, 1);
  std::vector<double> found;
  for (const Entity& curve : curves) {
    std::array<double, 6> x{};
    gmsh::model::getBoundingBox(1, curve.second, x[0], x[1], x[2], x[3], x[4], x[5]);
    const auto lies_at = [&](double height) {
      return std::abs(x[1] - height) < tolerance && std::abs(x[4] - height) < tolerance;
    };
    const double reach = std::max(std::abs(x[0] + x[3]) / g.platform_width,
                                  std::abs(x[2] + x[5]) / g.platform_length);
    const bool inside = reach < 1.0 - nearly;  // not the platform's outline
    if (lies_at(0.0) || (inside && (lies_at(g.root_height) || lies_at(top)))) {
      found.push_back(curve.second);
    }
  }
  return found;
}

/// gmsh writes the numbers of the model as millimetres.
/// To stretch the finished body would make splines of its planes.
BladeGeometry in_millimetres(BladeGeometry g) {
  for (double* length : {&g.root_width, &g.root_height, &g.root_length, &g.platform_width,
                         &g.platform_height, &g.platform_length, &g.span, &g.root_chord,
                         &g.tip_chord, &g.root_thickness, &g.tip_thickness, &g.lean}) {
    *length *= 1e3;
  }
  return g;
}

}  // namespace

void mesh_blade_with_gmsh(const BladeGeometry& geometry, const ElementSizes& sizes,
                          const std::string& file) {
  check_geometry(geometry, sizes);
  const GmshSession session;
  if (std::filesystem::path(file).extension() == ".step") {
    build_volume(in_millimetres(geometry));
    gmsh::write(file);
    return;
  }
  build_volume(geometry);
  name_entities(geometry);
  SizeField field(sizes.element_size);
  if (sizes.edge_size && *sizes.edge_size < sizes.element_size) {
    field.refine_at("CurvesList", singular_edges(geometry), *sizes.edge_size);
  }
  field.use();
  write_volume_mesh(sizes.element_size, field.least(), file);
}

}  // namespace microslip::mesh
