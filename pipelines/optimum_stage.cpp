#include "pipelines/optimum_stage.hpp"

#include <algorithm>
#include <limits>
#include <string_view>
#include <utility>

#include "pipelines/response_stage.hpp"
#include "pipelines/scene_error.hpp"

namespace microslip::pipelines {
namespace {

solver::OptimumOptions options_of(const SceneDescription& scene) {
  solver::OptimumOptions options;
  if (scene.response->optimum->range) {
    options.lower = (*scene.response->optimum->range)[0];
    options.upper = (*scene.response->optimum->range)[1];
  } else {
    options.lower = std::numeric_limits<double>::infinity();
    for (const CurveRequest& request : curve_requests(scene)) {
      const auto* load = std::get_if<double>(&request.preload);
      if (load == nullptr || *load <= 0.0) continue;
      options.lower = std::min(options.lower, *load);
      options.upper = std::max(options.upper, *load);
    }
  }
  if (!(options.lower < options.upper)) {
    throw SceneError(
        "response.optimum: needs response.optimum_range = [low, high], or two positive preloads");
  }
  if (!(options.lower > 0.0)) options.scale = solver::ParameterScale::linear;
  return options;
}

ReducedModel with_friction(ReducedModel model, double factor) {
  model.friction_coefficient *= factor;
  model.vertex_friction_coefficient *= factor;
  return model;
}

ReducedModel with_stiffness(ReducedModel model, double factor) {
  for (Eigen::VectorXd* stiffness :
       {&model.tangential_stiffness, &model.second_stiffness, &model.normal_stiffness}) {
    *stiffness *= factor;
  }
  return model;
}

}  // namespace

OptimumSearch::OptimumSearch(const ReducedModel& model, const SceneDescription& scene,
                             std::shared_ptr<const SolvedStructure> structure)
    : model_(model),
      scene_(scene),
      request_(*scene.response->optimum),
      family_(scene, request_.key, model, std::move(structure)),
      options_(options_of(scene)) {}

solver::Optimum OptimumSearch::search(const Change& change, const solver::OptimumOptions& options) {
  const auto scene_at = [&](double value) {
    if (request_.of_preload()) return solver_scene(change(model_), value);
    return solver_scene(change(family_.at(value)), request_.load);
  };
  return solver::minimise_peak(scene_at, continuation_options(*scene_.response), options);
}

solver::Optimum OptimumSearch::best() {
  return search([](ReducedModel model) { return model; }, options_);
}

std::vector<OptimumOfFactor> OptimumSearch::bracket() {
  // Laws of their own hold friction or stiffness elsewhere than in the points.
  const bool friction_varies =
      !model_.effects.friction_law && request_.key.find("friction") == std::string::npos;
  const bool stiffness_varies =
      !model_.effects.roughness && request_.key.find("_stiffness") == std::string::npos;
  std::vector<OptimumOfFactor> bracket;
  const auto add = [&](const char* parameter, double factor, const solver::Optimum& optimum) {
    bracket.push_back({parameter, factor, optimum.best, optimum.found});
  };
  for (const double factor : {0.5, 2.0}) {
    if (friction_varies) {
      // Friction acts through μ n: the best preload moves by about 1/factor, and the range with it.
      solver::OptimumOptions moved = options_;
      if (request_.of_preload()) {
        moved.lower /= factor;
        moved.upper /= factor;
      }
      const auto change = [&](ReducedModel model) { return with_friction(std::move(model), factor); };
      add("friction_coefficient", factor, search(change, moved));
    }
    if (stiffness_varies) {
      const auto change = [&](ReducedModel model) { return with_stiffness(std::move(model), factor); };
      add("contact_stiffness", factor, search(change, options_));
    }
  }
  return bracket;
}

}  // namespace microslip::pipelines
