#include "pipelines/response/curve_maps.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "contact/phase.hpp"
#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/sampled_curve.hpp"
#include "pipelines/response/solver_scenes.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

/// One per patch.
std::vector<NamedMap> maps_of(const ReducedModel& model, const SceneDescription& scene, double load,
                              const std::string& name, const solver::ResponsePoint& point) {
  const int phases = scene.response->map_phases;
  const contact::ContactForce contact = contact_of(model, load);
  std::vector<NamedMap> maps;
  for (std::size_t patch = 0; patch < model.patches.size(); ++patch) {
    const auto draw = [&](contact::Places places) {
      return or_refused(
          [&] { return contact.map(patch, places, point.q, point.frequency, phases); });
    };
    NamedMap map;
    map.name = model.patches.size() == 1 ? name : name + "." + model.patches[patch].name;
    map.patch = patch;
    map.frequency_hz = point.frequency / contact::two_pi;
    map.amplitude = point.amplitude;
    map.stability = point.stability;
    map.points = draw(contact::Places::cells);
    if (model.patches[patch].vertices.size() > 0) map.vertices = draw(contact::Places::vertices);
    maps.push_back(std::move(map));
  }
  return maps;
}

/// Those of a curve that lie at a frequency [rad/s].
std::vector<solver::ResponsePoint> points_of(const solver::ResponseCurve& curve, double frequency) {
  constexpr double same = 1e-9;
  std::vector<solver::ResponsePoint> points;
  std::ranges::copy_if(curve.points, std::back_inserter(points), [&](const auto& point) {
    return std::abs(point.frequency - frequency) <= same * frequency;
  });
  return points;
}

/// Solutions at a frequency [Hz]. A motion that was integrated is not replaced by one of harmonic
/// balance.
std::vector<solver::ResponsePoint> solutions_at(const ReducedModel& model,
                                                const SceneDescription& scene, double load,
                                                const CurveResult& result, double frequency_hz) {
  const ResponseDescription& range = *scene.response;
  const double frequency = contact::two_pi * frequency_hz;
  if (result.integrated) return points_of(result.curve, frequency);
  if (frequency_hz == range.frequency_begin_hz && frequency_hz == range.frequency_end_hz) {
    return result.curve.points;
  }
  const solver::ContinuationOptions options = continuation_options(scene, model);
  return solver::points_at_frequency(balanced_scene(model, load, options), result.curve, frequency,
                                     options);
}

std::string no_map(const CurveResult& result, double frequency_hz) {
  if (result.integrated) {
    return fmt::format(
        "curve {}: no map at {:g} Hz, where no motion was integrated: set "
        "response.maps to frequencies that it has, or response.frequency to this one",
        result.name, frequency_hz);
  }
  return fmt::format(
      "curve {}: no map at {:g} Hz, where it has no solution, or none whose proof "
      "passes: set response.maps to frequencies that it passes, or "
      "response.frequency to a range with it",
      result.name, frequency_hz);
}

}  // namespace

CurveMaps curve_maps(const ReducedModel& model, const SceneDescription& scene,
                     const CurveResult& result) {
  CurveMaps drawn;
  const auto* load = std::get_if<double>(&result.load);
  if (load == nullptr || model.patches.empty()) return drawn;
  const auto add = [&](const std::string& suffix, const solver::ResponsePoint& point) {
    for (NamedMap& map : maps_of(model, scene, *load, result.name + "_" + suffix, point)) {
      drawn.maps.push_back(std::move(map));
    }
  };
  const ReducedModel solved = model_of(model, result.curve);
  for (const MapEntry& entry : scene.response->maps) {
    if (const auto* frequency = std::get_if<double>(&entry)) {
      const auto points = solutions_at(solved, scene, *load, result, *frequency);
      for (std::size_t i = 0; i < points.size(); ++i) {
        add(fmt::format("{:g}Hz_{}", *frequency, i + 1), points[i]);
      }
      if (points.empty()) drawn.missing.push_back(no_map(result, *frequency));
    } else if (std::get<MapName>(entry) == MapName::peak) {
      if (const auto* peak = highest_peak(result.curve)) add("peak", *peak);
    } else if (result.integrated) {
      drawn.missing.push_back(fmt::format(
          "curve {}: no map at folds, which motions integrated in time do not show: set "
          "response.maps to \"peak\" or to frequencies",
          result.name));
    } else {
      int count = 0;
      for (const solver::ResponsePoint& point : result.curve.points) {
        if (point.mark == solver::PointMark::fold) add(fmt::format("fold_{}", ++count), point);
      }
    }
  }
  return drawn;
}

}  // namespace microslip::pipelines
