#include "pipelines/accuracy/coarser_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <exception>

#include <fmt/format.h>

#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/temporary_folder.hpp"

namespace microslip::pipelines {
namespace {

/// @param n_modes  however far they reach.
SolvedStructure with_element_size(const SceneDescription& scene, double factor, int n_modes) {
  const TemporaryFolder folder;
  SceneDescription coarser = with_elements_scaled(scene, factor);
  coarser.settings.basis.n_modes = n_modes;
  coarser.settings.basis.reach = 0.0;
  return solved_structure(coarser, folder.path() / "mesh.msh");
}

/// 2^p, see above.
double observed_ratio(double fine, double coarse, double coarsest) {
  constexpr double lowest = 2.0;
  constexpr double highest = 16.0;
  const double ratio = (coarsest - coarse) / (coarse - fine);
  return std::isfinite(ratio) ? std::clamp(ratio, lowest, highest) : lowest;
}

/// Modes of two meshes have the same shapes but for their signs:
/// those that the contact and the output feel.
Eigen::MatrixXd same_signs(const ReducedModel& from, const ReducedModel& to) {
  const Eigen::Index n = from.frequency.size();
  Eigen::VectorXd correlation = from.output.cwiseProduct(to.output);
  correlation /= from.output.norm() * to.output.norm();
  for (std::size_t i = 0; i < from.patches.size(); ++i) {
    const contact::PatchSamples& a = from.patches[i].cells;
    const contact::PatchSamples& b = to.patches[i].cells;
    if (a.shapes.u.rows() != b.shapes.u.rows()) continue;
    correlation += a.shapes.u.cwiseProduct(b.shapes.u).colwise().sum().transpose() /
                   (a.shapes.u.norm() * b.shapes.u.norm());
    correlation += a.shapes.v.cwiseProduct(b.shapes.v).colwise().sum().transpose() /
                   (a.shapes.v.norm() * b.shapes.v.norm());
  }
  Eigen::MatrixXd embedding = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i) embedding(i, i) = correlation[i] < 0.0 ? -1.0 : 1.0;
  return embedding;
}

}  // namespace

std::optional<RicherModel> coarser_mesh(const ReducedModel& model, const SceneDescription& scene,
                                        std::string& note) {
  if (!element_size_of(scene)) return std::nullopt;
  std::vector<std::string> warnings;
  try {
    const auto n_modes = static_cast<int>(model.frequency.size() - model.n_attachment);
    const SolvedStructure twice = with_element_size(scene, 2.0, n_modes);
    const SolvedStructure four_times = with_element_size(scene, 4.0, scene.settings.basis.n_modes);
    RicherModel coarser{"mesh", model_of(scene, &twice, warnings)};
    coarser.model.effects = model.effects;
    if (coarser.model.frequency.size() != model.frequency.size()) return std::nullopt;
    coarser.embedding = same_signs(model, coarser.model);
    const double ratio = observed_ratio(model.frequency[0], twice.modes.basis.frequency[0],
                                        four_times.modes.basis.frequency[0]);
    coarser.share = -1.0 / (ratio - 1.0);
    return coarser;
  } catch (const InterruptedError&) {
    throw;
  } catch (const std::exception& error) {  // an estimate that fails does not cost the run
    note = fmt::format(
        "the error of the mesh is not known: on elements of two and four times the "
        "size: {}",
        error.what());
    return std::nullopt;
  }
}

}  // namespace microslip::pipelines
