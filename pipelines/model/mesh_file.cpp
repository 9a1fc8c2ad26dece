#include "pipelines/model/mesh_file.hpp"

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mesh/mesh_error.hpp"
#include "mesh/mesh_reader.hpp"
#include "pipelines/system/child_process.hpp"
#include "pipelines/system/mesh_format.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/script.hpp"
#include "pipelines/system/temporary_folder.hpp"

namespace microslip::pipelines {
namespace {

namespace fs = std::filesystem;

void require_file(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) throw mesh::MeshError(file.string() + ": no such file");
  if (!fs::is_regular_file(file, error)) throw mesh::MeshError(file.string() + ": not a file");
}

/// MICROSLIP_CONVERTER stands in for the script, as MICROSLIP_MESHER does for the mesher.
std::vector<std::string> converter() {
  std::vector<std::string> command = script_command("convert_mesh.py");
  if (const char* given = std::getenv("MICROSLIP_CONVERTER")) command.back() = given;
  // Neither PYTHONPATH nor modules of the user may change what is read.
  command.insert(command.begin() + 1, "-I");
  return command;
}

void convert(const fs::path& file, const fs::path& mesh_file, const fs::path& facts,
             const ConverterLimits& limits) {
  const double megabytes = static_cast<double>(fs::file_size(file)) / 1e6;
  const double seconds = limits.seconds + megabytes;
  const double memory = limits.memory_mb + 40.0 * megabytes;
  std::vector<std::string> command = converter();
  for (const std::string& word : {file.string(), mesh_file.string(), facts.string(),
                                  fmt::format("{}", seconds), fmt::format("{}", memory)}) {
    command.push_back(word);
  }
  const auto limit = std::chrono::milliseconds(static_cast<long>(1e3 * seconds));
  const ChildResult result = run_child(command, limit);
  if (result.succeeded && fs::exists(mesh_file) && fs::exists(facts)) return;
  if (result.message.starts_with(file.string())) throw SceneError(result.message);
  throw SceneError(
      fmt::format("{}: it cannot be converted: {}", file.string(),
                  result.message.empty() ? "the converter left nothing" : result.message));
}

std::optional<double> unit_of(const fs::path& facts) {
  const auto unit = nlohmann::json::parse(std::ifstream(facts)).at("length_unit");
  return unit.is_null() ? std::nullopt : std::optional<double>(unit.get<double>());
}

std::string extents(const mesh::Mesh& mesh, double unit) {
  const Eigen::Vector3d size = unit * (mesh.upper() - mesh.lower());
  return fmt::format("{:.3g} x {:.3g} x {:.3g}", size.x(), size.y(), size.z());
}

}  // namespace

MeshOfFile read_mesh(const fs::path& file, std::optional<double> length_unit,
                     const ConverterLimits& limits) {
  require_file(file);
  if (mesh_format(file) == MeshFormat::gmsh) {
    return {mesh::read_gmsh(file, length_unit.value_or(1.0)), length_unit};
  }
  const TemporaryFolder folder;
  const fs::path converted = folder.path() / "mesh.msh";
  const fs::path facts = folder.path() / "facts.json";
  convert(file, converted, facts, limits);
  if (!length_unit) length_unit = unit_of(facts);
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
