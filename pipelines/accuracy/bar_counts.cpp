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
  SceneDescription other = with_value(scene, "contact.points", counts.points);
  if (bar_counts(other)->modes != counts.modes) {
    other = with_value(other, "modes.count", counts.modes);
  }
  scene.model = std::move(other.model);
  return scene;
}

double left_with_points(double times) { return 1.0 / times; }

double left_with_modes(const SceneDescription& scene, double times) {
  const auto& bar = std::get<ModalModel>(scene.model);
  return std::pow(times, bar.residual == ResidualKind::none ? -1.0 : -3.0);
}

}  // namespace microslip::pipelines
