#include "pipelines/effects/simulated_scene.hpp"

#include <utility>

#include "pipelines/description/effects_left_out.hpp"
#include "pipelines/effects/effect_choice.hpp"

namespace microslip::pipelines {

std::vector<std::string> to_leave_out(const SceneDescription& scene, const ReducedModel& model) {
  std::vector<std::string> names;
  const EffectFacts facts = effect_facts(scene, &model);
  for (const char* name : {"roughness", "rate_dependence"}) {
    if (!is_given(scene, name)) continue;
    const EffectDecision decision = decide(effect_row(name), facts);
    if (decision.simulated == Simulated::no && decision.can_be) names.emplace_back(name);
  }
  return names;
}

SimulatedScene simulated(const SceneDescription& scene, ReducedModel model,
                         const SolvedStructure* structure) {
  const std::vector<std::string> names = to_leave_out(scene, model);
  SimulatedScene result{scene, std::move(model)};
  if (names.empty()) return result;
  leave_out_by_choice(result.scene, names);
  std::vector<std::string> warnings;  // those of the model with them are told already
  result.model = model_of(result.scene, structure, warnings);
  return result;
}

}  // namespace microslip::pipelines
