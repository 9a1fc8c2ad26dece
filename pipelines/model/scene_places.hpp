/// @file
/// What of its mesh a scene uses, and where that is: supports, contacts, forces, output,
/// static loads.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "mesh/mesh.hpp"
#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

enum class PlaceRole : std::uint8_t { clamped, contact, force, output, static_force, pressure };

[[nodiscard]] const char* name(PlaceRole role);

struct ScenePlace {
  PlaceRole role = PlaceRole::clamped;
  std::string name;                 ///< of the mesh
  std::vector<Eigen::Index> nodes;  ///< of the mesh
  double area = 0.0;                ///< of its faces [m²]; 0: it has none
  Eigen::Vector3d
      centre;  ///< [m]; of faces the centroid, of nodes and of what acts at a set their mean
  Eigen::Vector3d direction =
      Eigen::Vector3d::Zero();  ///< of a force, of the output, of slip; of pressure the mean one
  std::string load{};           ///< of a force: amplitude and phase, for people
};

/// @throws mesh::MeshError  a name that is not there (check_names() tells it better).
[[nodiscard]] std::vector<ScenePlace> scene_places(const mesh::Mesh& mesh,
                                                   const SceneDescription& scene);

/// What a contact carries of a preload of the list: the mean pressure,
/// or the gap a negative one stands for.
struct PatchPreload {
  std::string text;              ///< as the scene has it: "1000 N"; of a gap given as length empty
  double pressure = 0.0;         ///< mean [Pa]
  double gap = 0.0;              ///< [m]; 0: pressed
  bool gap_needs_modes = false;  ///< its width follows from residual stiffness
};

/// Of contact `index` of the scene, for every load of the list but the limits.
[[nodiscard]] std::vector<PatchPreload> patch_preloads(const mesh::Mesh& mesh,
                                                       const SceneDescription& scene,
                                                       std::size_t index);

/// The unit of a STEP file; a line for each place, with nodes, area and centre; for each contact
/// its axes and preloads; for each point given by coordinates the distance of its node.
[[nodiscard]] std::vector<std::string> describe_places(const mesh::Mesh& mesh,
                                                       const SceneDescription& scene);

}  // namespace microslip::pipelines
