#include "pipelines/structure/geometry_bytes.hpp"

#include <array>
#include <bit>
#include <tuple>

#include "mesh/mesher_process.hpp"
#include "pipelines/system/byte_archive.hpp"
#include "pipelines/system/sealed_bytes.hpp"

namespace microslip::pipelines {

// Structured bindings name every member: one that is added and not told does not compile.
auto members(Is<FaceChoice> auto& value) {
  auto& [point, normal, near, number, size, edge_size] = value;
  return std::tie(point, normal, near, number, size, edge_size);
}
auto members(Is<FaceDescription> auto& value) {
  auto& [name, choices, place] = value;
  static_cast<void>(place);
  return std::tie(name, choices);
}
auto members(Is<BladeModel> auto& value) {
  auto& [geometry, sizes] = value;
  using Numbers = std::array<double, sizeof geometry / sizeof(double)>;  // it has nothing else
  return std::tuple(std::bit_cast<Numbers>(geometry), sizes.element_size, sizes.edge_size);
}
auto members(Is<StepModel> auto& value) {
  auto& [file, element_size, length_unit, faces, place, length_place, size_place] = value;
  static_cast<void>(place);
  static_cast<void>(length_place);
  static_cast<void>(size_place);
  return std::tuple_cat(std::tuple(bytes_of(file)), std::tie(element_size, length_unit, faces));
}

std::string geometry_of(const SceneDescription& scene) {
  ByteWriter bytes;
  bytes(fingerprint(bytes_of(mesh::mesher_program())));
  bytes(scene.kind);
  if (const auto* step = std::get_if<StepModel>(&scene.model)) {
    bytes(*step);
  } else {
    bytes(std::get<BladeModel>(scene.model));
  }
  return bytes.bytes();
}

}  // namespace microslip::pipelines
