#include "pipelines/model/preload_of.hpp"

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {

double total_normal_stiffness(const ReducedModel& model) {
  double total = 0.0;
  for (const contact::Patch& patch : model.patches) {
    total += patch.cells.stiffness.col(1).dot(patch.cells.weights);
  }
  return total;
}

std::variant<double, LimitName> preload_of(const CurveRequest& request, const ReducedModel& model) {
  if (const auto* limit = std::get_if<LimitName>(&request.preload)) return *limit;
  if (std::holds_alternative<StaticPreload>(request.preload)) return model.static_preload.value();
  const auto* gap = std::get_if<UniformGap>(&request.preload);
  if (gap == nullptr) return std::get<double>(request.preload);
  const double total = total_normal_stiffness(model);
  if (!(total > 0.0)) {
    throw RefusedError("response.preload: a gap needs a normal contact stiffness, and it is zero");
  }
  return -gap->width * total;
}

std::optional<double> gap_of(const std::variant<double, LimitName>& preload,
                             const ReducedModel& model) {
  const double* load = std::get_if<double>(&preload);
  if (load == nullptr || !(*load < 0.0) || !in_newtons(model)) return std::nullopt;
  return -*load / total_normal_stiffness(model);
}

}  // namespace microslip::pipelines
