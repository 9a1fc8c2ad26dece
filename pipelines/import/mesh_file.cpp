#include "pipelines/import/mesh_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mesh/mesh_reader.hpp"
#include "pipelines/system/mesh_format.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/temporary_folder.hpp"

namespace microslip::pipelines {
namespace {

namespace fs = std::filesystem;

std::string extents(const mesh::Mesh& mesh, double unit) {
  const Eigen::Vector3d size = unit * (mesh.upper() - mesh.lower());
  return fmt::format("{:.3g} x {:.3g} x {:.3g}", size.x(), size.y(), size.z());
}

}  // namespace

MeshOfFile read_mesh(const fs::path& file, std::optional<double> length_unit,
                     const ConverterLimits& limits) {
  if (mesh_format(file) == MeshFormat::gmsh) {
    return {mesh::read_gmsh(file, length_unit.value_or(1.0)), length_unit};
  }
  const TemporaryFolder folder;
  const fs::path converted = folder.path() / "mesh.msh";
  const auto unit = convert_file("convert_mesh.py", file, converted, limits).at("length_unit");
  if (!length_unit && !unit.is_null()) length_unit = unit.get<double>();
  return {mesh::read_gmsh(converted, length_unit.value_or(1.0), file.string()), length_unit};
}

mesh::Mesh read_mesh(const MeshFileModel& model) {
  MeshOfFile read = read_mesh(model.file, model.length_unit);
  if (!read.length_unit) {
    throw SceneError(fmt::format(
        "{}: model.length_unit is missing, and {} does not say in which unit its coordinates are. "
        "The mesh is {}; write length_unit = \"m\", \"mm\", \"in\" or what it is",
        model.place, model.file.filename().string(), size_readings(read.mesh)));
  }
  return std::move(read.mesh);
}

std::string size_readings(const mesh::Mesh& mesh) {
  return fmt::format("{0} m, {0} mm, or {1} m if they are inches", extents(mesh, 1.0),
                     extents(mesh, 0.0254));
}

}  // namespace microslip::pipelines
