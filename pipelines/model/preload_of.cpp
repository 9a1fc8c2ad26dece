#include "pipelines/model/preload_of.hpp"

#include <cmath>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

/// A gap is as wide as its preload over the stiffness: whether that is the same everywhere.
bool is_one_gap(const ReducedModel& model) {
  constexpr double same = 1e-6;
  const double width = 1.0 / total_normal_stiffness(model);  // at unit load
  for (const contact::Patch& patch : model.patches) {
    const Eigen::ArrayXd own = patch.cells.preload.array() / patch.cells.stiffness.col(1).array();
    if (!((own - width).abs() <= same * std::abs(width)).all()) return false;
  }
  return true;
}

}  // namespace

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
  if (!is_one_gap(model)) return std::nullopt;
  return -*load / total_normal_stiffness(model);
}

}  // namespace microslip::pipelines
