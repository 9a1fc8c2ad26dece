#include "pipelines/effects/picture_cost.hpp"

#include <algorithm>
#include <vector>

#include "pipelines/description/curve_request.hpp"
#include "pipelines/effects/curve_cost.hpp"
#include "pipelines/system/machine_speed.hpp"

namespace microslip::pipelines {

PictureSeconds picture_seconds(const SceneDescription& scene) {
  // Of the default blade and a coarse one, one to ten curves; a plot of two files.
  constexpr double of_start = 1.3;
  constexpr double of_a_plot = 0.6;
  constexpr double of_a_map = 0.08;
  constexpr double of_a_harmonic = 0.02;
  constexpr double of_a_motion = 0.05;  // at the peak, beside any maps
  if (!scene.response) return {};
  const std::vector<CurveRequest> curves = curve_requests(scene);
  const auto n_loaded = static_cast<double>(std::ranges::count_if(curves, is_loaded));
  const double n_maps = n_loaded * static_cast<double>(scene.response->maps.size());
  const double harmonics = usual_harmonics(scene);
  const double maps = n_maps * (of_a_map + of_a_harmonic * harmonics) +
                      (n_maps > 0.0 ? n_loaded * of_a_motion : 0.0);
  return {.maps = machine_slowness() * maps,
          .plots = machine_slowness() * (of_start + of_a_plot * n_maps)};
}

}  // namespace microslip::pipelines
