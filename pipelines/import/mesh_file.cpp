#include "pipelines/import/mesh_file.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mesh/mesh_reader.hpp"
#include "pipelines/system/mesh_format.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/temporary_folder.hpp"
#include "pipelines/text/required_file.hpp"

namespace microslip::pipelines {
namespace {

namespace fs = std::filesystem;

std::string extents(const mesh::Mesh& mesh, double unit) {
  const Eigen::Vector3d size = unit * (mesh.upper() - mesh.lower());
  return fmt::format("{:.3g} x {:.3g} x {:.3g}", size.x(), size.y(), size.z());
}

std::vector<LeftOut> left_out_of(const nlohmann::json& facts) {
  std::vector<LeftOut> all;
  for (const nlohmann::json& entry : facts.at("left_out")) {
    all.push_back({entry.at("place"), entry.at("what"), entry.at("remedy"), entry.at("count")});
  }
  return all;
}

std::string times(const LeftOut& one) {
  return one.count > 1 ? fmt::format(" ({} of them)", one.count) : "";
}

/// What the reader made of the file. A mesh that lacks what was left out is told with it: an
/// element of an unknown type leaves faces and parts that hang on nothing.
mesh::Mesh read_converted(const fs::path& converted, double unit, const fs::path& file,
                          const std::vector<LeftOut>& left_out) {
  if (left_out.empty()) return mesh::read_gmsh(converted, unit, file.string());
  try {
    return mesh::read_gmsh(converted, unit, file.string(), mesh::Joined::by_constraints);
  } catch (const mesh::MeshError& error) {
    const LeftOut& first = left_out.front();
    throw SceneError(fmt::format("{}: {}{} is not read; {}. Without it: {}", first.place,
                                 first.what, times(first), first.remedy, error.what()));
  }
}

}  // namespace

void require_whole(const MeshOfFile& read) {
  if (read.left_out.empty()) return;
  const LeftOut& first = read.left_out.front();
  throw SceneError(
      fmt::format("{}: {}{} is not read: without it this is another structure; {}. Modes or "
                  "matrices of the whole may be given instead (kind = \"modes\")",
                  first.place, first.what, times(first), first.remedy));
}

std::vector<std::string> left_out_remarks(const MeshOfFile& read) {
  std::vector<std::string> remarks;
  for (const LeftOut& one : read.left_out) {
    remarks.push_back(
        fmt::format("{}: {}{} is no part of the mesh: only the modes or matrices that are given "
                    "hold what it does",
                    one.place, one.what, times(one)));
  }
  return remarks;
}

MeshOfFile read_mesh(const fs::path& file, std::optional<double> length_unit,
                     const ConverterLimits& limits) {
  if (mesh_format(file) == MeshFormat::gmsh) {
    return {mesh::read_gmsh(file, length_unit.value_or(1.0)), length_unit};
  }
  const TemporaryFolder folder;
  const fs::path converted = folder.path() / "mesh.msh";
  const nlohmann::json facts = convert_file("convert_mesh.py", file, converted, limits);
  std::optional<double> own_unit;
  if (!facts.at("length_unit").is_null()) own_unit = facts.at("length_unit").get<double>();
  if (!length_unit) length_unit = own_unit;
  std::vector<LeftOut> left_out = left_out_of(facts);
  mesh::Mesh mesh = read_converted(converted, length_unit.value_or(1.0), file, left_out);
  return {std::move(mesh), length_unit, std::move(left_out), own_unit};
}

std::string unit_question(const fs::path& file, std::optional<double> of_scene,
                          std::optional<double> of_file, double longest) {
  constexpr double same = 1e-6;
  constexpr double longest_blade = 3.0;  // m
  if (!of_scene || !of_file || std::abs(*of_scene / *of_file - 1.0) < same) return {};
  const bool may_be_salome = file.extension() == ".unv" && *of_file == 1.0;
  if (may_be_salome && longest > longest_blade) return {};
  return fmt::format(
      "model.length_unit: {:g} m is written, and {} says {:g} m; it is read in {:g} m: which is "
      "right? Without length_unit what the file says is taken{}",
      *of_scene, file.filename().string(), *of_file, *of_scene,
      may_be_salome ? " (Salome writes m into .unv files, whatever it draws in)" : "");
}

mesh::Mesh read_mesh(const MeshFileModel& model) {
  require_file(model.file, model.place);
  MeshOfFile read = read_mesh(model.file, model.length_unit);
  if (!read.length_unit) {
    throw SceneError(fmt::format(
        "{}: model.length_unit is missing, and {} does not say in which unit its coordinates are. "
        "The mesh is {}; write length_unit = \"m\", \"mm\", \"in\" or what it is",
        model.place, model.file.filename().string(), size_readings(read.mesh)));
  }
  if (!model.modes && !model.matrices) require_whole(read);
  for (std::string& remark : left_out_remarks(read)) read.mesh.add_remark(std::move(remark));
  const double longest = read.mesh.longest_side() / *read.length_unit;
  std::string question = unit_question(model.file, model.length_unit, read.own_unit, longest);
  if (!question.empty()) read.mesh.add_remark(std::move(question));
  return std::move(read.mesh);
}

std::string size_readings(const mesh::Mesh& mesh) {
  return fmt::format("{0} m, {0} mm, or {1} m if they are inches", extents(mesh, 1.0),
                     extents(mesh, 0.0254));
}

}  // namespace microslip::pipelines
