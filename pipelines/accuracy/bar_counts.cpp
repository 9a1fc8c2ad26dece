#include "pipelines/accuracy/bar_counts.hpp"

#include <cmath>
#include <utility>
#include <variant>

#include "pipelines/scene/scene_file.hpp"

namespace microslip::pipelines {

std::optional<BarCounts> bar_counts(const SceneDescription& scene) {
  const auto* bar = std::get_if<ModalModel>(&scene.model);
  if (scene.kind != "bar" || bar == nullptr) return std::nullopt;
  return BarCounts{static_cast<int>(bar->points.size()),
                   static_cast<int>(bar->frequency_hz.size())};
}

SceneDescription with_bar_counts(SceneDescription scene, const BarCounts& counts) {
  const BarCounts own = bar_counts(scene).value();
  if (counts.points != own.points) {
    scene = with_formula_value(std::move(scene), "contact.points", counts.points);
  }
  if (counts.modes != own.modes) {
    scene = with_formula_value(std::move(scene), "modes.count", counts.modes);
  }
  return scene;
}

double left_with_points(double times) { return 1.0 / times; }

double left_with_modes(const SceneDescription& scene, double times) {
  const auto& bar = std::get<ModalModel>(scene.model);
  return std::pow(times, bar.residual == ResidualKind::none ? -1.0 : -3.0);
}

}  // namespace microslip::pipelines
