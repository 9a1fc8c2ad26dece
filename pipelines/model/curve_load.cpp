#include "pipelines/model/curve_load.hpp"

#include <algorithm>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

/// Moments tilt the bodies, and the gap is not the same everywhere (contact/patch/patch_load.hpp).
bool is_one_gap(const ReducedModel& model) {
  return std::ranges::all_of(model.patches, [](const contact::Patch& patch) {
    return patch.tilted_areas.empty() && patch.cells.preload_field.size() > 0;
  });
}

}  // namespace

double total_normal_stiffness(const ReducedModel& model) {
  double total = 0.0;
  for (const contact::Patch& patch : model.patches) {
    total += patch.cells.stiffness.col(1).dot(patch.cells.weights);
  }
  return total;
}

std::variant<double, LimitName> load_of(const CurveRequest& request, const ReducedModel& model) {
  if (const auto* limit = std::get_if<LimitName>(&request.load)) return *limit;
  if (std::holds_alternative<StaticPreload>(request.load)) return model.static_preload.value();
  const auto* gap = std::get_if<UniformGap>(&request.load);
  const auto* load = std::get_if<double>(&request.load);
  if (load != nullptr && (*load >= 0.0 || !in_newtons(model))) return *load;
  const double total = total_normal_stiffness(model);
  if (!(total > 0.0)) {
    throw RefusedError(request.place + ": a gap needs a normal contact stiffness, and it is zero");
  }
  return gap != nullptr ? -gap->width * total : *load;
}

std::optional<double> gap_of(const std::variant<double, LimitName>& load,
                             const ReducedModel& model) {
  const double* pull = std::get_if<double>(&load);
  if (pull == nullptr || !(*pull < 0.0) || !in_newtons(model)) return std::nullopt;
  if (!is_one_gap(model)) return std::nullopt;
  return -*pull / total_normal_stiffness(model);
}

}  // namespace microslip::pipelines
