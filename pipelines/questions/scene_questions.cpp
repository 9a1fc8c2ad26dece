#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "pipelines/description/curve_request.hpp"
#include "pipelines/description/element_count.hpp"
#include "pipelines/questions/question.hpp"

namespace microslip::pipelines {
namespace {

constexpr double largest_contact_stiffness = 1e16;  // [N/m³]: a layer of 20 micrometres of steel

template <double fem::Material::*property>
Findings of_material(const Facts& facts, const char* key) {
  if (!is_meshed(facts.scene) || facts.scene.material.*property == 0.0) return {};
  return {{key, facts.scene.material.*property}};
}

Findings youngs_modulus(const Facts& facts) {
  return of_material<&fem::Material::youngs_modulus>(facts, "material.youngs_modulus");
}
Findings poissons_ratio(const Facts& facts) {
  return of_material<&fem::Material::poissons_ratio>(facts, "material.poissons_ratio");
}
Findings density(const Facts& facts) {
  return of_material<&fem::Material::density>(facts, "material.density");
}

Findings element_size(const Facts& facts) {
  const auto* blade = std::get_if<BladeModel>(&facts.scene.model);
  if (blade == nullptr) return {};
  const mesh::BladeGeometry& g = blade->geometry;
  const double height = g.root_height + g.platform_height + g.span;
  return {{"model.element_size", percent * blade->sizes.element_size / height,
           fmt::format("({:g} m)", blade->sizes.element_size)}};
}

/// Of every contact whose coefficient is a number or a law;
/// of all points of a scene without a mesh the largest.
Findings friction_coefficient(const Facts& facts) {
  Findings findings;
  for (const ContactDescription& contact : facts.scene.contacts) {
    const auto* number = std::get_if<double>(&contact.friction.value);
    if (number != nullptr) findings.push_back({contact.key + ".friction_coefficient", *number});
  }
  const auto* modal = std::get_if<ModalModel>(&facts.scene.model);
  if (modal == nullptr || modal->points.empty()) return findings;
  const auto largest =
      std::ranges::max_element(modal->points, {}, &contact::PointParameters::friction_coefficient);
  const bool listed = facts.scene.kind == "modal" || facts.scene.kind == "chain";
  const char* key = facts.scene.kind == "modal" ? "modal.points" : "contact.points";
  findings.push_back(
      {listed ? key : "contact.friction_coefficient", largest->friction_coefficient});
  return findings;
}

/// Of contacts that have a number; 0 keeps the load constant, or rubs without sticking.
template <std::optional<double> ContactDescription::*stiffness>
Findings contact_stiffness(const Facts& facts, const char* key) {
  Findings findings;
  for (const ContactDescription& contact : facts.scene.contacts) {
    const std::optional<double>& given = contact.*stiffness;
    if (given.value_or(0.0) == 0.0) continue;
    findings.push_back({fmt::format("{}.{}", contact.key, key), *given});
  }
  return findings;
}

Findings normal_stiffness(const Facts& facts) {
  return contact_stiffness<&ContactDescription::normal_stiffness>(facts, "normal_stiffness");
}
Findings tangential_stiffness(const Facts& facts) {
  return contact_stiffness<&ContactDescription::tangential_stiffness>(facts,
                                                                      "tangential_stiffness");
}

/// The largest of given ratios. α and β make some ratios large by nature: of them the smallest.
Findings damping_ratio(const Facts& facts) {
  if (facts.scene.kind == "modal") {
    const auto& modal = std::get<ModalModel>(facts.scene.model);
    return {{"modal.damping_ratio", percent * modal.damping_ratio.maxCoeff()}};
  }
  if (const auto* modal = std::get_if<ModalModel>(&facts.scene.model)) {
    return {{"modes.damping_ratio", percent * modal->damping_ratio.minCoeff()}};
  }
  const auto* ratios = std::get_if<std::vector<double>>(&facts.scene.modes.damping);
  if (ratios == nullptr || ratios->empty()) return {};
  return {{"modes.damping_ratio", percent * *std::ranges::max_element(*ratios)}};
}

/// Rayleigh damping is least where its two parts are the same: ζ = √(αβ); α alone damps the lowest
/// frequency of the range least at its end, β alone at its begin.
Findings rayleigh_damping(const Facts& facts) {
  const auto* given = std::get_if<RayleighDamping>(&facts.scene.modes.damping);
  if (given == nullptr || !facts.scene.response) return {};
  const auto [low, high] = std::minmax(
      {facts.scene.response->frequency_begin_hz, facts.scene.response->frequency_end_hz});
  const double least = given->beta > 0.0 ? std::sqrt(given->alpha / given->beta) : unlimited;
  const double omega =
      std::clamp(least, 2.0 * std::numbers::pi * low, 2.0 * std::numbers::pi * high);
  return {{"modes.damping_ratio", percent * 0.5 * (given->alpha / omega + given->beta * omega),
           fmt::format("at {:.4g} Hz, by alpha and beta", omega / (2.0 * std::numbers::pi))}};
}

/// How often each load stands in the list of preloads or scales.
Findings repeated_preload(const Facts& facts) {
  Findings findings;
  if (!facts.scene.response) return findings;
  std::vector<CurveRequest> loads = curve_requests(facts.scene);
  while (!loads.empty()) {
    const CurveRequest first = loads.front();
    const auto n =
        std::erase_if(loads, [&](const CurveRequest& other) { return other.load == first.load; });
    findings.push_back(
        {facts.scene.response->preload.empty() ? "response.preload_scale" : "response.preload",
         static_cast<double>(n), fmt::format("(curve {})", first.name)});
  }
  return findings;
}

constexpr std::array about_scene{
    Question{"Young's modulus", "Pa", 1e9, 1.3e12, "plastics 3e9, titanium 1.1e11, steel 2.1e11",
             "is it in MPa or GPa? give the unit", youngs_modulus, true},
    Question{"Poisson's ratio", "", 0.0, 0.495, "metals 0.3", "is it another property?",
             poissons_ratio},
    Question{"the density", "kg/m^3", 300.0, 25000.0, "composites 1600, titanium 4400, steel 7800",
             "is it in g/cm^3 or t/mm^3? give the unit", density, true},
    Question{"the normal stiffness per area", "N/m^3", least_contact_stiffness,
             largest_contact_stiffness, "metal faces 1e11 to 1e15",
             "is it in N/mm^3 (1 N/mm^3 = 1e9 N/m^3)? give the unit; or \"rigid\"",
             normal_stiffness, true},
    Question{"the tangential stiffness per area", "N/m^3", least_contact_stiffness,
             largest_contact_stiffness, "metal faces 1e11 to 1e15",
             "is it in N/mm^3 (1 N/mm^3 = 1e9 N/m^3)? give the unit; or \"rigid\"",
             tangential_stiffness, true},
    Question{"the element size", "% of the blade's height", percent* smallest_usual_element,
             percent* largest_usual_element, "", "is it in millimetres? give the unit",
             element_size},
    Question{"the friction coefficient", "", 0.0, 2.0, "metals 0.1 to 1",
             "is it in percent? give it so, \"40 %\"", friction_coefficient},
    Question{"the damping ratio", "%", 0.0, 20.0, "blades 0.01 to 2",
             "is it in percent already? then write \"0.2 %\"; is it a quality factor?",
             damping_ratio},
    Question{"the damping ratio", "%", 0.0, 20.0, "blades 0.01 to 2",
             "are alpha in rad/s and beta in s? zeta = (alpha/omega + beta omega)/2",
             rayleigh_damping},
    Question{"a load is given", "×", 1.0, 1.0, "", "each makes the same curve", repeated_preload},
};

}  // namespace

std::span<const Question> scene_questions() { return about_scene; }

}  // namespace microslip::pipelines
