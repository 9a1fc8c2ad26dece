#include "pipelines/description/damping_ratios.hpp"

#include <variant>
#include <vector>

#include <fmt/format.h>

#include "mesh/count_text.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {

Eigen::VectorXd damping_ratios(const ModesDescription& modes, const Eigen::VectorXd& frequency,
                               Eigen::Index n_attachment) {
  if (const auto* rayleigh = std::get_if<RayleighDamping>(&modes.damping)) {
    if (rayleigh->alpha != 0.0 && frequency.minCoeff() == 0.0) {
      throw SceneError(
          "modes.damping_ratio: alpha acts on a rigid-body mode; ζ = α/(2ω) is infinite");
    }
    Eigen::VectorXd ratio = 0.5 * rayleigh->beta * frequency;
    if (rayleigh->alpha != 0.0) ratio += 0.5 * rayleigh->alpha * frequency.cwiseInverse();
    return ratio;
  }
  const auto& list = std::get<std::vector<double>>(modes.damping);
  if (list.size() == 1) return Eigen::VectorXd::Constant(frequency.size(), list.front());
  const auto n_given = static_cast<Eigen::Index>(list.size());
  if (n_given != frequency.size() - n_attachment) {
    throw SceneError(fmt::format("modes.damping_ratio: {} for {}; give one, or one each",
                                 mesh::counted(n_given, "value", "values"),
                                 mesh::counted(frequency.size() - n_attachment, "mode", "modes")));
  }
  Eigen::VectorXd ratios = Eigen::VectorXd::Constant(frequency.size(), list.back());
  ratios.head(n_given) = Eigen::Map<const Eigen::VectorXd>(list.data(), n_given);
  return ratios;
}

}  // namespace microslip::pipelines
