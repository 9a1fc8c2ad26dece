#include "pipelines/stages/solution_maps.hpp"

#include <cstddef>
#include <string>
#include <vector>

#include "pipelines/stages/curve_family.hpp"
#include "pipelines/system/deadline.hpp"

namespace microslip::pipelines {
namespace {

/// Curves of chosen harmonics may have fewer points than a picture wants.
ReducedModel model_of_maps(const Solution& solution) {
  Discretisation settings = solution.scene.settings;
  bool any_more = false;
  for (std::size_t i = 0; i < settings.patches.size(); ++i) {
    const int given = contact_points(settings, i);
    if (settings.patches[i].n_points || given >= points_of_maps) continue;
    settings.patches[i].n_points = points_of_maps;
    any_more = true;
  }
  if (!any_more || cut_short()) return solution.model;
  std::vector<std::string> warnings;  // told already
  ReducedModel model = model_with(settings, solution.scene, solution.structure.get(), warnings);
  model.effects = solution.model.effects;
  return model;
}

}  // namespace

bool draws_maps(const SceneDescription& scene, const RunOptions& options) {
  return options.maps && scene.response && !scene.response->maps.empty();
}

void draw_maps(const Solution& solution, int jobs, RunRecord& record) {
  draw_maps(model_of_maps(solution), solution.scene, solution.curves, jobs, record);
}

}  // namespace microslip::pipelines
