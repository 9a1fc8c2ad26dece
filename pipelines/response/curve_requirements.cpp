#include "pipelines/response/curve_requirements.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "contact/dense.hpp"
#include "pipelines/description/curve_request.hpp"
#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/model/curve_load.hpp"
#include "pipelines/model/tilted_area.hpp"
#include "pipelines/response/solver_scenes.hpp"
#include "pipelines/response/time_response.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
void require_response(const SceneDescription& scene) {
  if (!scene.response) {
    throw SceneError(scene.file.string() + ": [response] is missing: run needs a frequency range");
  }
  if (!scene.without_contact.empty()) throw SceneError(scene.without_contact);
  require_pressing_loads(scene);
}

void require_held(const ReducedModel& model, const SceneDescription& scene) {
  const Eigen::Index n_rigid = (model.frequency.array() == 0.0).count();
  if (n_rigid == 0) return;
  const solver::Scene problem = limit_scene(model);
  Eigen::MatrixXd stuck = model.frequency.array().square().matrix().asDiagonal();
  if (problem.contact) stuck += problem.contact->stuck_stiffness();
  const Eigen::Index n_loose = contact::nullity(stuck);
  if (n_loose == 0) return;
  const bool has_supports = !std::holds_alternative<ModalModel>(scene.model);
  throw RefusedError(fmt::format(
      "rigid-body: {} of the {} modes are rigid-body motions and nothing holds them ({} stay free "
      "even "
      "with every contact point stuck): {}",
      n_rigid, model.frequency.size(), n_loose,
      has_supports
          ? "name the clamped surfaces in [supports] clamped"
          : "give contact points whose stiffness holds them, or leave the modes of 0 Hz out"));
}

Eigen::VectorXd stuck_frequencies(const ReducedModel& model) {
  const solver::Scene scene = limit_scene(model);
  Eigen::MatrixXd K = model.frequency.array().square().matrix().asDiagonal();
  if (scene.contact) K += scene.contact->stuck_stiffness();
  const auto squares = contact::symmetric_eigenvalues(K);
  if (!squares) throw std::runtime_error("the eigenvalues of the stuck structure do not converge");
  return squares->cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi);
}

void require_loads(const ReducedModel& model, const SceneDescription& scene) {
  const bool tilts = std::ranges::any_of(
      model.patches, [](const contact::Patch& patch) { return !patch.tilted_areas.empty(); });
  if (!tilts) return;
  for (const CurveRequest& request : curve_requests(scene)) {
    const auto asked = load_of(request, model);
    const auto* load = std::get_if<double>(&asked);
    if (load != nullptr) static_cast<void>(contact_of(model, *load));
  }
  const auto& optimum = scene.response->optimum;
  if (optimum && optimum->of_preload() && optimum->range) {
    static_cast<void>(contact_of(model, (*optimum->range)[0]));
  }
}

void require_curves(const ReducedModel& model, const SceneDescription& scene) {
  require_loads(model, scene);
  const bool in_time = scene.response->method == ResponseDescription::Method::time;
  for (const CurveRequest& request : curve_requests(scene)) {
    const auto asked = load_of(request, model);
    if (const auto* load = std::get_if<double>(&asked); load != nullptr && in_time) {
      require_steps(integrated_scene(model, *scene.response, *load), *scene.response);
    }
  }
}

}  // namespace microslip::pipelines
