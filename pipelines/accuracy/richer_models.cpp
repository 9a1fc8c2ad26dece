#include "pipelines/accuracy/richer_models.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "contact/contact_force.hpp"
#include "pipelines/accuracy/bar_counts.hpp"
#include "pipelines/accuracy/coarser_mesh.hpp"
#include "pipelines/accuracy/given_mesh.hpp"
#include "pipelines/response/solver_scenes.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

/// The model with other settings of its patches; effects as decided for the model at hand.
RicherModel with_patches(const char* source, const ReducedModel& model,
                         const SceneDescription& scene, const SolvedStructure& structure,
                         void (*change)(Discretisation&, std::size_t patch)) {
  Discretisation settings = scene.settings;
  for (std::size_t i = 0; i < settings.patches.size(); ++i) change(settings, i);
  std::vector<std::string> warnings;  // those of the scene itself are told already
  RicherModel richer{source, model_with(settings, scene, &structure, warnings)};
  richer.model.effects = model.effects;
  return richer;
}

Eigen::Index n_cells(const ReducedModel& model) {
  Eigen::Index n = 0;
  for (const contact::Patch& patch : model.patches) n += patch.cells.size();
  return n;
}

/// Four times as many cells: the error falls as their number grows (theory 14),
/// and that of both is told.
RicherModel with_more_cells(const ReducedModel& model, const SceneDescription& scene,
                            const SolvedStructure& structure) {
  RicherModel richer = with_patches(
      "cells", model, scene, structure, [](Discretisation& settings, std::size_t patch) {
        settings.patches[patch].n_points = 4 * contact_points(settings, patch);
      });
  const auto more = static_cast<double>(n_cells(richer.model));
  const auto given = static_cast<double>(n_cells(model));
  richer.share = more > given ? more / (more - given) : 1.0;
  return richer;
}

/// Friction along r beside p. @return empty: it is there, or the contact has no stiffness along r.
std::optional<RicherModel> with_second_direction(const ReducedModel& model,
                                                 const SceneDescription& scene,
                                                 const SolvedStructure& structure) {
  if (model.effects.second_direction || setting_of(scene, "second_direction") == "off") return {};
  SceneDescription other = scene;
  other.settings.second_direction = Discretisation::Choice::on;
  std::vector<std::string> warnings;
  try {
    RicherModel both{"second_direction", model_of(other, &structure, warnings)};
    ++both.model.effects.doublings;  // beside a peak of many harmonics the usual instants are rough
    return both;
  } catch (const RefusedError&) {
    return {};
  }
}

/// Events located in place of forces sampled in time, and every motion of the patch.
RicherModel with_located_events(const ReducedModel& model) {
  RicherModel richer{"instants", model};
  richer.model.effects.located = true;
  return richer;
}

/// @return empty: the degree was given, so that no more shapes are at hand.
std::optional<RicherModel> with_more_shapes(const ReducedModel& model,
                                            const SceneDescription& scene,
                                            const SolvedStructure& structure) {
  if (!structure.modes.richer) return std::nullopt;
  const fem::RicherBasis& richer = *structure.modes.richer;
  std::vector<std::string> warnings;
  RicherModel result{"basis", model_on_basis(scene, structure, richer.basis, warnings),
                     richer.embedding};
  result.model.effects = model.effects;
  return result;
}

/// @return empty: the bar cannot have as many, or its modes are picked one by one.
std::optional<RicherModel> bar_with(const char* source, const ReducedModel& model,
                                    const SceneDescription& scene, const BarCounts& counts) {
  std::vector<std::string> warnings;  // those of the scene itself are told already
  try {
    RicherModel richer{source, model_of(with_bar_counts(scene, counts), nullptr, warnings)};
    const Eigen::Index n = model.frequency.size();
    const Eigen::Index more = richer.model.frequency.size();
    if (more == n && n_cells(richer.model) == n_cells(model)) return std::nullopt;
    richer.model.effects = model.effects;
    if (more != n) richer.embedding = Eigen::MatrixXd::Identity(more, n);  // the first are the same
    return richer;
  } catch (const SceneError&) {
    return std::nullopt;
  } catch (const RefusedError&) {
    return std::nullopt;
  }
}

/// Four times the contact points, and three times the modes or four more; of many a part instead,
/// which costs less than more of them and tells as much.
void add_bar(const ReducedModel& model, const SceneDescription& scene,
             const std::function<bool(const char*)>& asked,
             const std::function<void(const char*, std::optional<RicherModel>)>& keep) {
  constexpr int times_points = 4;
  constexpr int many_points = 5000;
  constexpr int times_modes = 3;
  constexpr int least_more = 4;
  constexpr int many_modes = 60;
  const std::optional<BarCounts> own = bar_counts(scene);
  if (!own || model.patches.empty()) return;
  BarCounts points = *own;
  points.points =
      own->points > many_points ? own->points / times_points : times_points * own->points;
  BarCounts modes = *own;
  modes.modes = own->modes > many_modes
                    ? own->modes / times_modes
                    : std::max(times_modes * own->modes, own->modes + least_more);
  // Of a coarser model too: its error is 1/left times that at hand.
  const auto with_share = [](std::optional<RicherModel> other, double left) {
    if (other) other->share = 1.0 / (1.0 - left);
    return other;
  };
  if (asked("cells")) {
    const double times = static_cast<double>(points.points) / own->points;
    keep("cells", with_share(bar_with("cells", model, scene, points), left_with_points(times)));
  }
  if (asked("basis")) {
    const double times = static_cast<double>(modes.modes) / own->modes;
    keep("basis",
         with_share(bar_with("basis", model, scene, modes), left_with_modes(scene, times)));
  }
}

std::optional<RicherModel> other_mesh(const ReducedModel& model, const SceneDescription& scene,
                                      const SolvedStructure& structure, std::string& note) {
  if (largest_factor(scene) >= 2.0) return coarser_mesh(model, scene, structure, note);
  return without_mesh_excess(model, scene, structure);
}

bool is_fitted(const ReducedModel& model) {
  return std::ranges::any_of(model.patches,
                             [](const contact::Patch& patch) { return patch.fit_degree >= 0; });
}

}  // namespace

double frequency_factor(const ReducedModel& model, const ReducedModel& other, double peak,
                        const Eigen::MatrixXd& embedding) {
  Eigen::Index nearest = 0;
  (model.frequency.array() - peak).abs().minCoeff(&nearest);
  Eigen::Index same = nearest;
  if (embedding.size() > 0) embedding.col(nearest).cwiseAbs().maxCoeff(&same);
  const bool usual = same < other.frequency.size() && model.frequency[nearest] > 0.0;
  return usual ? other.frequency[same] / model.frequency[nearest] : 1.0;
}

solver::ContinuationOptions options_of_both(const SceneDescription& scene,
                                            const ReducedModel& model, const ReducedModel& richer) {
  const bool sampled = contact::is_sampled(richer.patches, richer.effects);
  solver::ContinuationOptions options = continuation_options(scene, sampled ? richer : model);
  const ReducedModel& other = sampled ? model : richer;
  if (continuation_options(scene, other).orders.empty()) options.orders.clear();  // all, for both
  options.search_starts = 0;
  return options;
}

RicherModels richer_models(const ReducedModel& model, const SceneDescription& scene,
                           const SolvedStructure* structure,
                           const std::vector<std::string>& sources) {
  RicherModels result;
  const auto asked = [&](const char* source) {
    return sources.empty() || std::ranges::find(sources, source) != sources.end();
  };
  const auto keep = [&](const char* source, std::optional<RicherModel> richer) {
    if (richer) {
      result.models.push_back(std::move(*richer));
    } else {
      result.unknown.emplace_back(source);
    }
  };
  if (asked("instants") && contact::is_sampled(model.patches, model.effects)) {
    result.models.push_back(with_located_events(model));
  }
  if (structure == nullptr) {
    add_bar(model, scene, asked, keep);
    return result;
  }
  if (asked("eigensolver")) result.eigen_residual = structure->modes.basis.residual;
  if (model.patches.empty()) {
    if (asked("mesh")) keep("mesh", other_mesh(model, scene, *structure, result.note));
    return result;
  }
  if (asked("cells")) result.models.push_back(with_more_cells(model, scene, *structure));
  if (asked("fit") && is_fitted(model)) {
    result.models.push_back(with_patches("fit", model, scene, *structure,
                                         [](Discretisation& settings, std::size_t patch) {
                                           settings.patches[patch].fit = PatchSettings::Fit::none;
                                         }));
  }
  if (asked("basis")) keep("basis", with_more_shapes(model, scene, *structure));
  if (asked("second_direction")) {
    if (auto both = with_second_direction(model, scene, *structure)) {
      result.models.push_back(std::move(*both));
    }
  }
  if (asked("mesh")) keep("mesh", other_mesh(model, scene, *structure, result.note));
  return result;
}

}  // namespace microslip::pipelines
