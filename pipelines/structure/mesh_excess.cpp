#include "pipelines/structure/mesh_excess.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "fem/stress_jumps.hpp"
#include "mesh/refined_mesh.hpp"
#include "pipelines/text/effect_table.hpp"

namespace microslip::pipelines {
namespace {

constexpr double percent = 100.0;
constexpr std::ptrdiff_t most_told = 4;  // modes that are told: each takes as long as an assembly

bool is_told(const SceneDescription& scene, const StructureModes& modes) {
  const auto* file = std::get_if<MeshFileModel>(&scene.model);
  if (file != nullptr && (file->modes || file->matrices)) return false;
  return !scene.rotation && modes.basis.n_free() > modes.basis.n_rigid_body;
}

/// Those that are not rigid, up to the end of the range, at least one, and of many the last few:
/// they count for the curves. Of no range the first few.
std::vector<Eigen::Index> modes_of_range(const SceneDescription& scene,
                                         const StructureModes& modes) {
  const double end = scene.response ? std::max(scene.response->frequency_begin_hz,
                                               scene.response->frequency_end_hz)
                                    : std::numeric_limits<double>::infinity();
  std::vector<Eigen::Index> in_range;
  for (Eigen::Index i = modes.basis.n_rigid_body; i < modes.basis.n_free(); ++i) {
    const bool is_above = modes.basis.frequency[i] > 2.0 * std::numbers::pi * end;
    if (is_above && !in_range.empty()) break;
    if (!scene.response && std::ssize(in_range) == most_told) break;
    in_range.push_back(i);
  }
  if (std::ssize(in_range) > most_told)
    in_range.erase(in_range.begin(), in_range.end() - most_told);
  return in_range;
}

}  // namespace

bool has_elements_of_file(const SceneDescription& scene) {
  const auto* file = std::get_if<MeshFileModel>(&scene.model);
  return file != nullptr && file->refinement == 0;
}

FrequencyExcess frequency_excess(const mesh::Mesh& mesh, const StructureModes& modes,
                                 const SceneDescription& scene) {
  FrequencyExcess told;
  if (!is_told(scene, modes)) return told;
  told.modes = modes_of_range(scene, modes);
  told.excess =
      fem::frequency_excess(mesh, scene.material, modes.basis.shapes(Eigen::all, told.modes));
  told.is_whole = mesh::has_midside_nodes(mesh);
  return told;
}

MeshExcess mesh_excess(const FrequencyExcess& excess, const SceneDescription& scene) {
  MeshExcess told;
  if (excess.modes.empty()) return told;
  const char* at_least = excess.is_whole ? "" : " or more";
  std::vector<std::string> each;
  for (std::size_t i = 0; i < excess.modes.size(); ++i) {
    each.push_back(fmt::format("{:.2g} %{} (mode {})",
                               percent * excess.excess[static_cast<Eigen::Index>(i)], at_least,
                               excess.modes[i] + 1));
  }
  told.text = fmt::format(
      "elements: by the jumps of stress between them natural frequencies are too high by some {}",
      fmt::join(each, ", "));
  const bool is_refined = scene.accuracy.tolerance > 0.0 && excess.is_whole;
  if (is_refined || excess.excess.maxCoeff() <= worth_a_warning) return told;
  told.warning = fmt::format(
      "model.file: its elements put natural frequencies too high by up to some {:.2g} %{}, and "
      "peaks with them{}: take {}",
      percent * excess.excess.maxCoeff(), at_least, excess.is_whole ? "" : ", which is in no bar",
      excess.is_whole ? "smaller ones, or model.refinement = 1"
                      : "quadratic ones, or model.midside_nodes = \"on\"");
  return told;
}

}  // namespace microslip::pipelines
