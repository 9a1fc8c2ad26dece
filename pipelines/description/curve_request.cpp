#include "pipelines/description/curve_request.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace microslip::pipelines {
namespace {

CurveRequest request_of(const PreloadEntry& entry) {
  if (const auto* limit = std::get_if<LimitName>(&entry)) {
    return {*limit == LimitName::free ? "free" : "stuck", *limit};
  }
  if (const auto* gap = std::get_if<UniformGap>(&entry)) {
    return {fmt::format("gap_{:g}um", 1e6 * gap->width), *gap};
  }
  if (std::holds_alternative<StaticPreload>(entry)) return {"preload_static", entry};
  return {fmt::format("preload_{:g}", std::get<double>(entry)), std::get<double>(entry)};
}

/// A name twice (preload given twice) gets a number, so that no file overwrites another.
void make_unique(std::vector<CurveRequest>& requests) {
  for (std::size_t i = 0; i < requests.size(); ++i) {
    int copy = 1;
    const std::string stem = requests[i].name;
    const auto taken = [&] {
      return std::any_of(requests.begin(), requests.begin() + static_cast<std::ptrdiff_t>(i),
                         [&](const CurveRequest& other) { return other.name == requests[i].name; });
    };
    while (taken()) requests[i].name = fmt::format("{}_{}", stem, ++copy);
  }
}

}  // namespace

bool is_loaded(const CurveRequest& request) {
  return !std::holds_alternative<LimitName>(request.load);
}

std::vector<CurveRequest> curve_requests(const SceneDescription& scene) {
  std::vector<CurveRequest> requests;
  if (!scene.response->preload.empty()) {
    for (const PreloadEntry& entry : scene.response->preload) requests.push_back(request_of(entry));
  } else {
    for (const double scale : scene.response->preload_scale) {
      requests.push_back({fmt::format("scale_{:g}", scale), scale});
    }
    if (scene.response->limits) {
      requests.push_back({"free", LimitName::free});
      requests.push_back({"stuck", LimitName::stuck});
    }
  }
  make_unique(requests);
  for (CurveRequest& request : requests) request.place = place_in(scene, "response.preload");
  return requests;
}

bool only_limits(const SceneDescription& scene) {
  return scene.response && std::ranges::none_of(curve_requests(scene), is_loaded);
}

bool is_linear_study(const SceneDescription& scene) {
  return only_limits(scene) && !scene.response->optimum;
}

}  // namespace microslip::pipelines
