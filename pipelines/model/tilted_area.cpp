#include "pipelines/model/tilted_area.hpp"

#include <array>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

struct Moments {
  std::string key;
  std::array<double, 2> moment;  // about p and r [N m]
};

std::vector<Moments> moments_of(const SceneDescription& scene) {
  constexpr std::array none{0.0, 0.0};
  std::vector<Moments> moments;
  for (const ContactDescription& contact : scene.contacts) {
    if (contact.preload_moment == none) continue;
    moments.push_back({contact.key + ".preload_moment", contact.preload_moment});
  }
  if (const auto* modal = std::get_if<ModalModel>(&scene.model)) {
    for (const TiltedArea& area : modal->tilted_areas) {
      if (area.moment != none) moments.push_back({area.key, area.moment});
    }
  }
  return moments;
}

void require_pressing(const Moments& moments, const std::string& name, double load,
                      const char* unit = "N") {
  if (load > 0.0) return;
  throw RefusedError(
      fmt::format("preload-unbalanced: {} = {:g} {}: {} = [{:g}, {:g}] N m turns the contact under "
                  "every preload, and {} "
                  "carries no moment; leave this preload out, or the moments",
                  name, load, unit, moments.key, moments.moment[0], moments.moment[1],
                  load < 0.0 ? "a gap (a negative preload)" : "a contact without load"));
}

}  // namespace

void require_pressing_loads(const SceneDescription& scene) {
  for (const Moments& moments : moments_of(scene)) {
    for (std::size_t i = 0; i < scene.response->preload.size(); ++i) {
      const auto* load = std::get_if<double>(&scene.response->preload[i]);
      const auto* gap = std::get_if<UniformGap>(&scene.response->preload[i]);
      const std::string place = fmt::format("response.preload[{}]", i);
      if (load != nullptr) require_pressing(moments, place, *load);
      if (gap != nullptr) require_pressing(moments, place + ": minus the gap", -gap->width, "m");
    }
    const auto& optimum = scene.response->optimum;
    if (optimum && optimum->of_preload() && optimum->range) {
      require_pressing(moments, "response.optimum_range[0]", (*optimum->range)[0]);
    }
  }
}

}  // namespace microslip::pipelines
