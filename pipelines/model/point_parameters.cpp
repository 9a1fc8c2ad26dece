#include "pipelines/model/point_parameters.hpp"

#include "pipelines/system/scene_error.hpp"
#include "pipelines/model/tilted_area.hpp"

namespace microslip::pipelines {
namespace {

/// Pressure of each point: the unit field times the load, or the gap the load stands for.
Eigen::VectorXd pressures(const Eigen::VectorXd& unit, const Eigen::VectorXd& normal_stiffness,
                          double total_stiffness, double load) {
  if (load >= 0.0 || unit.size() == 0 || total_stiffness == 0.0) return load * unit;
  return (load / total_stiffness) * normal_stiffness;
}

constexpr const char* gap_without_stiffness =
    "response.preload: a gap needs a normal contact stiffness, and it is zero";

}  // namespace

std::variant<double, LimitName> preload_of(const CurveRequest& request, const ReducedModel& model) {
  if (const auto* limit = std::get_if<LimitName>(&request.preload)) return *limit;
  const auto* gap = std::get_if<UniformGap>(&request.preload);
  if (gap == nullptr) return std::get<double>(request.preload);
  const double total = model.normal_stiffness.dot(model.weights);
  if (!(total > 0.0)) throw RefusedError(gap_without_stiffness);
  return -gap->width * total;
}

std::vector<contact::PointParameters> point_parameters(const ReducedModel& model, double load,
                                                       bool on_vertices) {
  const bool in_newtons = model.load_measure == LoadMeasure::force;
  const auto& stiffness = on_vertices ? model.vertex_normal_stiffness : model.normal_stiffness;
  const auto& tangential =
      on_vertices ? model.vertex_tangential_stiffness : model.tangential_stiffness;
  const auto& friction =
      on_vertices ? model.vertex_friction_coefficient : model.friction_coefficient;
  const auto& unit = on_vertices ? model.vertex_preload : model.preload;
  const double total = in_newtons ? model.normal_stiffness.dot(model.weights) : 0.0;
  if (in_newtons && load < 0.0 && total <= 0.0) {
    throw RefusedError(gap_without_stiffness);
  }
  Eigen::VectorXd preload = pressures(unit, stiffness, total, load);
  for (const TiltedArea& area : model.tilted_areas) {
    const Eigen::VectorXd tilted = tilted_pressures(model, area, load, on_vertices);
    preload.segment(on_vertices ? 0 : area.begin, tilted.size()) = tilted;
  }
  std::vector<contact::PointParameters> points(static_cast<std::size_t>(preload.size()));
  for (Eigen::Index i = 0; i < preload.size(); ++i) {
    points[static_cast<std::size_t>(i)] = {
        tangential[i], model.effects.normal_stiffness(stiffness[i]), friction[i], preload[i]};
  }
  return points;
}

}  // namespace microslip::pipelines
