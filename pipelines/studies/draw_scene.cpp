#include "pipelines/studies/draw_scene.hpp"

#include <chrono>
#include <string>

#include <nlohmann/json.hpp>

#include "mesh/outer_faces.hpp"
#include "pipelines/files/plot_script.hpp"
#include "pipelines/model/contact_frame.hpp"
#include "pipelines/model/scene_places.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/system/temporary_folder.hpp"

namespace microslip::pipelines {
namespace {

using Json = nlohmann::json;

Json json_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json skin_of(const mesh::Mesh& mesh) {
  Json faces = Json::array();
  for (const auto& corners : mesh::outer_faces(mesh)) faces.push_back(corners);
  return faces;
}

Json nodes_of(const mesh::Mesh& mesh) {
  Json nodes = Json::array();
  for (Eigen::Index i = 0; i < mesh.n_nodes(); ++i) {
    nodes.push_back(json_of(mesh.nodes().row(i).transpose()));
  }
  return nodes;
}

Json places_of(const mesh::Mesh& mesh, const SceneDescription& scene) {
  Json places = Json::array();
  std::size_t contact = 0;
  for (const ScenePlace& place : scene_places(mesh, scene)) {
    Json& entry = places.emplace_back();
    entry = {{"role", name(place.role)},
             {"name", place.name},
             {"nodes", place.nodes},
             {"centre", json_of(place.centre)},
             {"direction", json_of(place.direction)}};
    if (place.role != PlaceRole::contact) continue;
    const Eigen::Matrix3d frame = contact_frame(mesh, scene.contacts[contact++]);
    for (const Eigen::Index axis : {0, 1, 2}) {
      entry["frame"].push_back(json_of(frame.row(axis).transpose()));
    }
  }
  return places;
}

}  // namespace

std::string draw_scene(const mesh::Mesh& mesh, const SceneDescription& scene,
                       const std::filesystem::path& picture) {
  using namespace std::chrono_literals;
  const TemporaryFolder folder;
  const std::filesystem::path data = folder.path() / "scene.json";
  write_whole(data, Json{{"title", scene.title},
                         {"nodes", nodes_of(mesh)},
                         {"faces", skin_of(mesh)},
                         {"places", places_of(mesh, scene)}}
                        .dump());
  return run_plot_script("plot_scene.py",
                         {data.string(), std::filesystem::absolute(picture).string()}, 120s);
}

}  // namespace microslip::pipelines
