#include "pipelines/accuracy/mesh_files.hpp"

#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "mesh/mesh.hpp"
#include "pipelines/structure/structure_stage.hpp"
#include "pipelines/system/mesh_format.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/required_file.hpp"

namespace microslip::pipelines {
namespace {

namespace fs = std::filesystem;

/// What is compared between files.
struct MeshFacts {
  std::string file;  ///< as it was typed
  Eigen::Index n_nodes = 0;
  double volume = 0.0;                    ///< [m³]
  double element_size = 0.0;              ///< (1) [m]
  std::set<mesh::ElementType> types{};    ///< of elements
  std::map<std::string, double> areas{};  ///< of contact surfaces [m²]
};

void require_files(const SceneDescription& scene, const std::vector<std::string>& files) {
  if (scene.kind != "mesh") {
    throw SceneError(fmt::format(
        "--meshes: goes with scenes of kind \"mesh\", and {} is of kind \"{}\"{}",
        scene.file.string(), scene.kind,
        element_size_of(scene) ? ": its elements are made here, of several sizes" : ""));
  }
  if (files.size() < 2) {
    throw SceneError(
        fmt::format("--meshes {}: one mesh does not converge: expected two files or "
                    "more, from coarse to fine",
                    files.front()));
  }
  for (const std::string& file : files) {
    if (mesh_format(file) == MeshFormat::unknown) {
      throw SceneError(fmt::format("--meshes {}: meshes are read from files that end in {}", file,
                                   mesh_endings()));
    }
    require_file(fs::absolute(file), "--meshes");
  }
}

SceneDescription with_file(SceneDescription scene, const std::string& file) {
  auto& model = std::get<MeshFileModel>(scene.model);
  model.file = fs::absolute(file);
  return scene;
}

MeshFacts facts_of(const SceneDescription& scene, const std::string& file) {
  try {
    const mesh::Mesh mesh = obtain_mesh(scene, {});
    check_names(mesh, scene);
    MeshFacts facts{file, mesh.n_nodes(), mesh.volume(),
                    std::cbrt(mesh.volume() / static_cast<double>(mesh.n_elements()))};
    for (const mesh::ElementBlock& block : mesh.elements()) facts.types.insert(block.type);
    for (const ContactDescription& contact : scene.contacts) {
      facts.areas[contact.surface] = mesh.surface(contact.surface).area;
    }
    return facts;
  } catch (const mesh::MeshRoomError&) {
    throw;
  } catch (const mesh::MeshError& error) {
    throw SceneError(fmt::format("--meshes {}: {}", file, error.what()));
  } catch (const SceneError& error) {
    throw SceneError(fmt::format("--meshes {}: {}", file, error.what()));
  }
}

/// @throws SceneError  no two meshes of a body differ as much.
void require_alike(double one, double other, const std::string& what, const std::string& unit,
                   const MeshFacts& coarser, const MeshFacts& finer) {
  constexpr double most = 1.5;  // chords of a coarse mesh lose less of a curved body
  if (one < most * other && other < most * one) return;
  throw SceneError(
      fmt::format("--meshes: {} is {:.4g} {} in {}, {:.4g} {} in {}: another body, or another unit",
                  what, one, unit, coarser.file, other, unit, finer.file));
}

void require_finer(const MeshFacts& coarser, const MeshFacts& finer) {
  require_alike(coarser.volume, finer.volume, "the volume", "m^3", coarser, finer);
  for (const auto& [surface, area] : coarser.areas) {
    require_alike(area, finer.areas.at(surface), fmt::format("surface \"{}\"", surface), "m^2",
                  coarser, finer);
  }
  if (finer.n_nodes > coarser.n_nodes) return;
  throw SceneError(
      fmt::format("--meshes: expected from coarse to fine: {} has {} nodes, {} before it has {}",
                  finer.file, finer.n_nodes, coarser.file, coarser.n_nodes));
}

bool have_equal_types(const std::vector<MeshFacts>& meshes) {
  for (const MeshFacts& mesh : meshes) {
    if (mesh.types != meshes.front().types) return false;
  }
  return true;
}

/// Their names alone; as they were typed where two in different folders have the same.
std::vector<std::string> values_of(const std::vector<std::string>& files) {
  std::vector<std::string> names;
  for (const std::string& file : files) names.push_back(fs::path(file).filename().string());
  const bool differ = std::set(names.begin(), names.end()).size() == names.size();
  return differ ? names : files;
}

bool is_own(const SceneDescription& scene, const std::string& file) {
  std::error_code error;
  return fs::equivalent(file, std::get<MeshFileModel>(scene.model).file, error);
}

}  // namespace

Ladder ladder_of_files(const SceneDescription& scene, const std::vector<std::string>& files) {
  require_files(scene, files);
  std::vector<MeshFacts> meshes;
  for (const std::string& file : files) {
    meshes.push_back(facts_of(with_file(scene, file), file));
    if (meshes.size() > 1) require_finer(meshes[meshes.size() - 2], meshes.back());
  }
  const bool have_sizes = have_equal_types(meshes);
  const std::vector<std::string> values = values_of(files);
  Ladder ladder{"mesh_file", "mesh", {}};
  for (std::size_t i = 0; i < files.size(); ++i) {
    Rung rung = rung_of(scene, values[i], have_sizes ? meshes[i].element_size : 0.0);
    rung.same_mesh = rung.same_basis = is_own(scene, files[i]);
    if (!rung.same_mesh) rung.scene = with_file(std::move(rung.scene), files[i]);
    ladder.rungs.push_back(std::move(rung));
  }
  return ladder;
}

}  // namespace microslip::pipelines
