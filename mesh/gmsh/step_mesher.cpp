#include "mesh/gmsh/step_mesher.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <istream>
#include <map>
#include <stdexcept>
#include <vector>

#include <gmsh.h>

#include "mesh/gmsh/gmsh_session.hpp"
#include "mesh/gmsh/size_field.hpp"
#include "mesh/mesh_error.hpp"

namespace microslip::mesh {
namespace {

namespace occ = gmsh::model::occ;
using Entities = std::vector<std::pair<int, int>>;  // dimension, tag

struct Job {
  std::string source;
  double scale = 1.0;         ///< metres per unit of the model
  double element_size = 0.0;  ///< this and the sizes below in units of the model
  std::map<std::string, std::vector<int>> names;
  std::map<int, double> face_size, edge_size;
};

Job read_job(std::istream& in) {
  Job job;
  for (std::string key; in >> key;) {
    int face = 0;
    if (key == "source") {
      in >> std::quoted(job.source);
    } else if (key == "scale") {
      in >> job.scale;
    } else if (key == "element_size") {
      in >> job.element_size;
    } else if (key == "name") {
      std::string name;
      std::size_t n = 0;
      in >> std::quoted(name) >> n;
      std::vector<int>& faces = job.names[name];
      for (std::size_t i = 0; i < n && in >> face; ++i) faces.push_back(face);
    } else if (key == "size" || key == "edge_size") {
      in >> face;
      in >> (key == "size" ? job.face_size : job.edge_size)[face];
    } else {
      throw MeshError("unknown parameter " + key);
    }
    if (!in) throw MeshError(key + ": cannot be read");
  }
  job.element_size /= job.scale;
  for (auto* sizes : {&job.face_size, &job.edge_size}) {
    for (auto& [face, size] : *sizes) size /= job.scale;
  }
  return job;
}

/// The one solid of the file. @return  its tag.
int import_solid(const Job& job) {
  gmsh::option::setString("Geometry.OCCTargetUnit", "M");
  Entities shapes;
  constexpr const char* unreadable = "OpenCASCADE cannot read it: it is damaged, or not STEP";
  try {
    occ::importShapes(job.source, shapes);
  } catch (const std::runtime_error&) {  // OpenCASCADE has told why itself
    throw MeshError(unreadable);
  } catch (const std::string&) {  // of this version of gmsh
    throw MeshError(unreadable);
  }
  Entities solids;
  occ::getEntities(solids, 3);
  if (solids.size() != 1) {
    Entities surfaces;
    occ::getEntities(surfaces, 2);
    throw MeshError(
        solids.empty()
            ? "it has no solid body, but " + std::to_string(surfaces.size()) +
                  " faces; export the blade as one solid (sew the faces to a closed shell)"
            : "it has " + std::to_string(solids.size()) +
                  " solid bodies; export the blade as one solid, or unite them before");
  }
  occ::synchronize();
  return solids.front().second;
}

std::vector<int> faces_of(int solid) {
  Entities boundary;
  gmsh::model::getBoundary({{3, solid}}, boundary, false, false);
  std::vector<int> faces;
  for (const auto& [dimension, tag] : boundary) faces.push_back(tag);
  std::ranges::sort(faces);
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

std::vector<double> curves_of(int face) {
  Entities boundary;
  gmsh::model::getBoundary({{2, face}}, boundary, false, false);
  std::vector<double> curves;
  for (const auto& [dimension, tag] : boundary) curves.push_back(tag);
  return curves;
}

/// gmsh's name in small letters; its several names of splines are one.
std::string kind_of(int face) {
  std::string kind;
  gmsh::model::getType(2, face, kind);
  std::ranges::transform(kind, kind.begin(), [](unsigned char c) { return std::tolower(c); });
  std::erase(kind, ' ');
  return kind.find("spline") != kind.npos || kind.find("bezier") != kind.npos ? "spline" : kind;
}

/// Coordinates in the model, lengths outside in metres: `scale` times as many.
void write_triangles(int face, double scale, std::ostream& out) {
  constexpr int triangle = 2;  // of gmsh's element types
  std::vector<std::size_t> nodes;
  std::vector<double> at;
  std::vector<double> unused;
  gmsh::model::mesh::getNodes(nodes, at, unused, 2, face, true, false);
  std::map<std::size_t, std::size_t> places;
  for (std::size_t i = 0; i < nodes.size(); ++i) places[nodes[i]] = 3 * i;
  std::vector<std::size_t> elements;
  std::vector<std::size_t> corners;
  gmsh::model::mesh::getElementsByType(triangle, elements, corners, face);
  out << "triangles " << elements.size() << '\n';
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double* x = &at[places.at(corners[i])];
    out << scale * x[0] << ' ' << scale * x[1] << ' ' << scale * x[2] << (i % 3 == 2 ? '\n' : ' ');
  }
}

void write_face(int face, double scale, std::ostream& out) {
  double area = 0.0;
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  occ::getMass(2, face, area);
  occ::getCenterOfMass(2, face, x, y, z);
  out << "face " << face << ' ' << kind_of(face) << ' ' << scale * scale * area << ' ' << scale * x
      << ' ' << scale * y << ' ' << scale * z << '\n';
  write_triangles(face, scale, out);
}

SizeField sizes_of(const Job& job) {
  SizeField field(job.element_size);
  for (const auto& [face, size] : job.face_size) {
    field.refine_at("FacesList", {static_cast<double>(face)}, size);
  }
  for (const auto& [face, size] : job.edge_size) {
    field.refine_at("CurvesList", curves_of(face), size);
  }
  return field;
}

}  // namespace

void list_step_faces(std::istream& in, const std::string& file) {
  const Job job = read_job(in);
  const GmshSession session;
  const int solid = import_solid(job);
  std::array<double, 6> x{};
  gmsh::model::getBoundingBox(3, solid, x[0], x[1], x[2], x[3], x[4], x[5]);
  const double diagonal = std::hypot(x[3] - x[0], x[4] - x[1], x[5] - x[2]);
  constexpr int triangles_per_turn = 12;
  constexpr double triangles_per_diagonal = 20.0;
  gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", triangles_per_turn);
  gmsh::option::setNumber("Mesh.MeshSizeMax", diagonal / triangles_per_diagonal);
  gmsh::model::mesh::generate(2);
  std::ofstream out(file);
  out.precision(12);
  double volume = 0.0;
  occ::getMass(3, solid, volume);
  out << "volume " << std::pow(job.scale, 3) * volume << '\n';
  for (const int face : faces_of(solid)) write_face(face, job.scale, out);
  if (!out.flush()) throw MeshRoomError("the list of faces is not written whole");
}

void mesh_step_with_gmsh(std::istream& in, const std::string& file) {
  const Job job = read_job(in);
  const GmshSession session;
  const int solid = import_solid(job);
  for (const auto& [name, faces] : job.names) add_group(2, faces, name);
  add_group(3, {solid}, "body");
  SizeField field = sizes_of(job);
  field.use();
  gmsh::option::setNumber("Mesh.ScalingFactor", job.scale);
  write_volume_mesh(job.element_size, field.least(), file);
}

}  // namespace microslip::mesh
