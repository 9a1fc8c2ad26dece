#include "pipelines/model/scene_warnings.hpp"

#include <algorithm>
#include <complex>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <variant>

#include <Eigen/Core>

#include <fmt/format.h>

namespace microslip::pipelines {
namespace {

/// By a force that varies in time.
bool is_excited(const SceneDescription& scene) {
  if (const auto* modal = std::get_if<ModalModel>(&scene.model)) {
    return modal->force_sine.cwiseAbs().maxCoeff() > 0.0 ||
           modal->force_cosine.cwiseAbs().maxCoeff() > 0.0;
  }
  std::map<std::string, Eigen::Vector3cd> sums;  // forces at one place may cancel
  double size = 0.0;
  for (const ForceDescription& force : scene.forces) {
    Eigen::Vector3cd& sum = sums.try_emplace(force.at, Eigen::Vector3cd::Zero()).first->second;
    const double phase = force.phase_deg * std::numbers::pi / 180.0;
    sum += std::polar(1.0, phase) * (force.amplitude * force.direction);
    size = std::max(size, std::abs(force.amplitude));
  }
  constexpr double nothing = 1e-12;
  return std::ranges::any_of(sums,
                             [&](const auto& one) { return one.second.norm() > nothing * size; });
}

Eigen::Index points_without_area(const SceneDescription& scene) {
  const auto* modal = std::get_if<ModalModel>(&scene.model);
  return modal != nullptr ? (modal->weights.array() == 0.0).count() : 0;
}

/// A mode that vibrates without damping.
bool is_undamped(const SceneDescription& scene) {
  if (const auto* modal = std::get_if<ModalModel>(&scene.model))
    return ((modal->damping_ratio.array() == 0.0) && (modal->frequency_hz.array() > 0.0)).any();
  if (const auto* rayleigh = std::get_if<RayleighDamping>(&scene.modes.damping)) {
    return rayleigh->alpha == 0.0 && rayleigh->beta == 0.0;
  }
  const auto& ratios = std::get<std::vector<double>>(scene.modes.damping);
  return std::ranges::find(ratios, 0.0) != ratios.end();
}

/// Integration in time has all harmonics. A best value is searched with those the key gives, which
/// its search tells.
std::string harmonics_question(const SceneDescription& scene) {
  const HarmonicSettings& harmonics = scene.settings.harmonics;
  const bool in_time = scene.response->method == ResponseDescription::Method::time;
  if (!in_time || harmonics.highest <= 1 || scene.response->optimum) return {};
  return fmt::format(
      "response.harmonics: {} is written beside method = \"time\", which has all harmonics and "
      "keeps {} of its motion: leave the key out, or set method = \"harmonic_balance\"",
      harmonics.highest, std::max(harmonics.highest, least_harmonics_of_time));
}

}  // namespace

std::vector<std::string> scene_warnings(const SceneDescription& scene) {
  std::vector<std::string> warnings;
  if (const auto n = points_without_area(scene); n > 0) {
    warnings.push_back(fmt::format("modal.points: {} of {} have weight 0, and do nothing", n,
                                   std::get<ModalModel>(scene.model).weights.size()));
  }
  for (const contact::SurfaceRules& rules : surface_rules(scene)) {
    const auto& law = rules.friction;
    if (!law) continue;
    constexpr double fast = 1e300;  // [m/s]: the law at any speed there is
    const double kinetic = law->at(fast).value;
    if (kinetic > law->at_rest()) {
      warnings.push_back(
          fmt::format("friction law: the kinetic coefficient {:g} is above the static {:g}: "
                      "friction grows with the slip speed; "
                      "are the two exchanged?",
                      kinetic, law->at_rest()));
    }
  }
  if (!scene.response) return warnings;
  if (!is_excited(scene))
    warnings.emplace_back("no force excites the structure: its response will be zero");
  if (is_undamped(scene)) {
    warnings.emplace_back(
        "a mode has no damping: where friction takes no energy, as in the free and the stuck "
        "limit, its peak may "
        "have no end, and the curve be incomplete then");
  }
  if (std::string text = harmonics_question(scene); !text.empty()) {
    warnings.push_back(std::move(text));
  }
  const auto [low, high] =
      std::minmax(scene.response->frequency_begin_hz, scene.response->frequency_end_hz);
  for (const MapEntry& entry : scene.response->maps) {
    const auto* frequency = std::get_if<double>(&entry);
    if (frequency == nullptr || (*frequency >= low && *frequency <= high)) continue;
    warnings.push_back(fmt::format(
        "response.maps: {:g} Hz lies outside the range {:g} to {:g} Hz: there will be no map of it",
        *frequency, low, high));
  }
  return warnings;
}

}  // namespace microslip::pipelines
