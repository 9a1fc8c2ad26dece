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
#include "pipelines/text/effect_table.hpp"

namespace microslip::pipelines {
namespace {

constexpr double percent = 100.0;

bool is_told(const SceneDescription& scene, const StructureModes& modes) {
  const auto* file = std::get_if<MeshFileModel>(&scene.model);
  return file != nullptr && !file->modes && !file->matrices && modes.basis.n_free() > 0;
}

/// Those that are not rigid, up to the end of the range, at least one; of no range all.
std::vector<Eigen::Index> modes_of_range(const SceneDescription& scene,
                                         const StructureModes& modes) {
  const double end = scene.response ? std::max(scene.response->frequency_begin_hz,
                                               scene.response->frequency_end_hz)
                                    : std::numeric_limits<double>::infinity();
  std::vector<Eigen::Index> in_range;
  for (Eigen::Index i = modes.basis.n_rigid_body; i < modes.basis.n_free(); ++i) {
    const bool is_above = modes.basis.frequency[i] > 2.0 * std::numbers::pi * end;
    if (is_above && !in_range.empty()) break;
    in_range.push_back(i);
  }
  return in_range;
}

}  // namespace

MeshExcess mesh_excess(const mesh::Mesh& mesh, const StructureModes& modes,
                       const SceneDescription& scene) {
  MeshExcess told;
  if (!is_told(scene, modes)) return told;
  const std::vector<Eigen::Index> which = modes_of_range(scene, modes);
  if (which.empty()) return told;
  const Eigen::VectorXd excess =
      fem::frequency_excess(mesh, scene.material, modes.basis.shapes(Eigen::all, which));
  std::vector<std::string> each;
  for (std::size_t i = 0; i < which.size(); ++i) {
    each.push_back(fmt::format("{:.2g} % (mode {})", percent * excess[static_cast<Eigen::Index>(i)],
                               which[i] + 1));
  }
  told.text = fmt::format(
      "elements: by the jumps of stress between them natural frequencies are too high by some {}",
      fmt::join(each, ", "));
  const double limit = scene.accuracy.tolerance > 0.0 ? scene.accuracy.tolerance : worth_a_warning;
  if (excess.maxCoeff() <= limit) return told;
  told.warning = fmt::format(
      "model.file: its elements put natural frequencies too high by up to some {:.2g} %, and peaks "
      "with them, which is in no bar: take smaller or quadratic ones",
      percent * excess.maxCoeff());
  return told;
}

}  // namespace microslip::pipelines
