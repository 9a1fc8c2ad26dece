#include "mesh/step_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <string>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "mesh/import/mesher_job.hpp"
#include "mesh/mesh_error.hpp"
#include "mesh/mesher_process.hpp"

namespace microslip::mesh {
namespace {

namespace fs = std::filesystem;

std::ostringstream step_job(const char* kind, const StepSource& source) {
  std::ostringstream job = job_text();
  job << kind << "\nsource " << std::quoted(fs::absolute(source.file).string()) << "\nscale "
      << source.scale << '\n';
  return job;
}

/// Errors begin with the name of the file.
template <typename Work>
auto of_file(const StepSource& source, const Work& work) {
  try {
    return work();
  } catch (const MeshRoomError&) {
    throw;  // not of this file
  } catch (const MeshError& error) {
    throw MeshError(source.file.string() + ": " + error.what());
  }
}

/// Triangles of a face: mean normal, corners, owner.
void read_triangles(std::istream& in, StepFace& face, std::vector<double>& corners,
                    std::vector<int>& owner) {
  std::string word;
  std::size_t n = 0;
  in >> word >> n;
  double area = 0.0;
  for (std::size_t i = 0; i < n && in; ++i) {
    Eigen::Matrix3d x;  // a corner per column
    for (double& value : x.reshaped()) in >> value;
    const Eigen::Vector3d normal = 0.5 * (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0));
    area += normal.norm();
    face.normal += normal;
    corners.insert(corners.end(), x.data(), x.data() + x.size());
    owner.push_back(face.number);
  }
  constexpr double least_share = 0.3;  // of a half cylinder 2/π: less goes more than half round
  const bool has_normal = face.normal.norm() > least_share * area;
  face.normal = has_normal ? face.normal.normalized() : Eigen::Vector3d::Zero();
}

/// The triangles enclose the volume: no face is missing. Their chords err by little.
void require_closed(const StepGeometry& geometry) {
  double volume = 0.0;
  for (const auto& corners : geometry.triangles.rowwise()) {
    const Eigen::Matrix3d x = geometry.nodes(corners, Eigen::all);
    volume += x.determinant() / 6.0;
  }
  constexpr double tolerance = 0.1;
  if (std::abs(volume - geometry.volume) > tolerance * geometry.volume) {
    std::ostringstream text;
    text << "the faces of its solid do not close: they enclose " << volume << " m^3, the solid has "
         << geometry.volume << "; a part of the file may be missing, export it again";
    throw MeshError(text.str());
  }
}

StepGeometry read_list(const fs::path& file) {
  std::ifstream in(file);
  StepGeometry geometry;
  std::vector<double> corners;
  std::string word;
  in >> word >> geometry.volume;
  while (in >> word) {
    StepFace& face = geometry.faces.emplace_back();
    in >> face.number >> face.kind >> face.area;
    for (double& x : face.centre) in >> x;
    read_triangles(in, face, corners, geometry.owner);
  }
  if (geometry.faces.empty() || !in.eof()) throw MeshError("the mesher's list of faces is damaged");
  const auto n = std::ssize(corners) / 3;
  geometry.nodes = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(
      corners.data(), n, 3);
  geometry.triangles =
      Eigen::VectorX<Eigen::Index>::LinSpaced(n, 0, n - 1).reshaped<Eigen::RowMajor>(n / 3, 3);
  require_closed(geometry);
  return geometry;
}

}  // namespace

StepGeometry read_step(const StepSource& source, const fs::path& list, const MesherLimits& limits) {
  // Of the blade of share/scenes a second; what takes so much longer is a search of OpenCASCADE for
  // what damage took.
  constexpr double least = 30.0;        // s
  constexpr double per_byte = 30.0e-6;  // s
  return of_file(source, [&] {
    MesherLimits shorter = limits;
    shorter.seconds = std::min(limits.seconds,
                               least + per_byte * static_cast<double>(fs::file_size(source.file)));
    run_mesher(step_job("step_faces", source).str(), list, shorter);
    return read_list(list);
  });
}

void mesh_step(const StepSource& source, const StepMeshing& meshing, const fs::path& file,
               const MesherLimits& limits) {
  std::ostringstream job = step_job("step_mesh", source);
  job << "element_size " << meshing.element_size << '\n';
  for (const auto& [name, faces] : meshing.names) {
    job << "name " << std::quoted(name) << ' ' << faces.size();
    for (const int face : faces) job << ' ' << face;
    job << '\n';
  }
  for (const auto& [face, size] : meshing.face_size) job << "size " << face << ' ' << size << '\n';
  for (const auto& [face, size] : meshing.edge_size) {
    job << "edge_size " << face << ' ' << size << '\n';
  }
  of_file(source, [&] { run_mesher(job.str(), file, limits); });
}

}  // namespace microslip::mesh
