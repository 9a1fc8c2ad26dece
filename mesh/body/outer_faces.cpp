#include "mesh/outer_faces.hpp"

#include <algorithm>

#include "mesh/elements/face_map.hpp"

namespace microslip::mesh {

std::vector<std::array<Eigen::Index, 4>> outer_faces(const Mesh& mesh) {
  std::vector<std::array<Eigen::Index, 4>> faces;
  for (const auto& [key, owners] : map_faces(mesh.elements())) {
    if (owners.count > 1) continue;
    const std::size_t n_corners = key.front() < 0 ? 3 : 4;
    const std::vector<Eigen::Index> nodes = face_nodes(mesh.elements(), owners.uses.front());
    std::array<Eigen::Index, 4>& corners = faces.emplace_back();
    corners.fill(-1);
    std::copy_n(nodes.begin(), n_corners, corners.begin());
  }
  std::ranges::sort(faces);  // the map has an order of its own
  return faces;
}

}  // namespace microslip::mesh
