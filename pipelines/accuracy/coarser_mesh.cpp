#include "pipelines/accuracy/coarser_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <variant>

#include <fmt/format.h>

#include "pipelines/accuracy/given_mesh.hpp"
#include "pipelines/structure/extrapolated_modes.hpp"
#include "pipelines/structure/larger_elements.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

constexpr double least_refinement = 1.1;  // nothing is told by two meshes that are as good as one
constexpr double sure_refinement = 1.4;   // of less they may tell a half

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

/// What is left after extrapolation falls faster, but for what is not extrapolated: by an order on
/// the parametric blade, whose edges are re-entrant (measured, share/doc/accuracy.md: told so it is
/// 1 to 4 times what is true); of other bodies half an order is believed.
double extrapolated_ratio(const SolvedStructure& structure, const SceneDescription& scene) {
  double ratio = *structure.coarser->ratios.free.front();
  for (const std::optional<double>& one : structure.coarser->ratios.free) {
    ratio = std::min(ratio, one.value_or(ratio));
  }
  ratio =
      ratio_over(refinement_between(structure.mesh, structure.coarser->twice.mesh, scene), ratio);
  const bool all = structure.modes.residuals.empty() && !structure.modes.static_face;
  if (!all) return ratio;
  return (std::holds_alternative<BladeModel>(scene.model) ? 2.0 : std::numbers::sqrt2) * ratio;
}

/// @param ratio  of errors, from the coarser mesh to the one at hand.
std::optional<RicherModel> coarser_model(const ReducedModel& model, const SceneDescription& scene,
                                         const SolvedStructure& structure, double ratio) {
  std::vector<std::string> warnings;
  RicherModel coarser{"mesh", model_of(scene, &structure, warnings)};
  coarser.model.effects = model.effects;
  if (coarser.model.frequency.size() != model.frequency.size()) return std::nullopt;
  coarser.embedding = same_signs(model, coarser.model);
  coarser.share = -1.0 / (ratio - 1.0);
  return coarser;
}

/// Of the first frequency.
double told_by(const std::optional<RicherModel>& other, const ReducedModel& model) {
  if (!other) return 0.0;
  return std::abs(other->share * (other->model.frequency[0] / model.frequency[0] - 1.0));
}

std::optional<RicherModel> of_modes_as_they_are(const ReducedModel& model,
                                                const SceneDescription& scene,
                                                const SolvedStructure& structure,
                                                std::string& note) {
  const SolvedStructure& twice =
      on_larger_elements(scene, structure, 2.0, model.frequency.size() - model.n_attachment);
  double ratio = ratio_of_edges;  // of a mesh file whose elements are cut once
  if (largest_factor(scene) >= 4.0) {
    const SolvedStructure& four_times =
        on_larger_elements(scene, structure, 4.0, scene.settings.basis.n_modes);
    ratio = observed_ratio(model.frequency[0], twice.modes.basis.frequency[0],
                           four_times.modes.basis.frequency[0]);
  }
  const double refinement = refinement_between(structure.mesh, twice.mesh, scene);
  std::optional<RicherModel> coarser;
  std::optional<RicherModel> without;
  if (refinement >= least_refinement) {
    coarser = coarser_model(model, scene, twice, ratio_over(refinement, ratio));
  }
  if (refinement < sure_refinement) without = without_mesh_excess(model, scene, structure);
  if (refinement < least_refinement && !without) {
    note = "the error of the mesh is not known: elements of twice the size give the same mesh";
  }
  return !coarser || told_by(without, model) > told_by(coarser, model) ? without : coarser;
}

}  // namespace

std::optional<RicherModel> coarser_mesh(const ReducedModel& model, const SceneDescription& scene,
                                        const SolvedStructure& structure, std::string& note) {
  if (largest_factor(scene) < 2.0) return std::nullopt;
  try {
    if (structure.coarser) {
      return coarser_model(model, scene, structure.coarser->twice,
                           extrapolated_ratio(structure, scene));
    }
    return of_modes_as_they_are(model, scene, structure, note);
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
