#include "pipelines/accuracy/given_mesh.hpp"

#include "pipelines/structure/larger_elements.hpp"

namespace microslip::pipelines {

std::optional<RicherModel> without_mesh_excess(const ReducedModel& model,
                                               const SceneDescription& scene,
                                               const SolvedStructure& structure) {
  const FrequencyExcess& told = frequency_excess(structure, scene);
  if (told.modes.empty() || !told.is_whole) return std::nullopt;
  RicherModel without{"mesh", model};
  without.model.frequency *= 1.0 - told.excess.maxCoeff();
  for (std::size_t i = 0; i < told.modes.size(); ++i) {
    const Eigen::Index mode = told.modes[i];
    without.model.frequency[mode] =
        model.frequency[mode] * (1.0 - told.excess[static_cast<Eigen::Index>(i)]);
  }
  return without;
}

}  // namespace microslip::pipelines
