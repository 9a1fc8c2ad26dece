#include "pipelines/accuracy/ladders.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "pipelines/accuracy/bar_counts.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

using Method = ResponseDescription::Method;

/// The scene with one thing changed.
template <typename Change>
Rung rung(const SceneDescription& scene, std::string value, double size, const Change& change) {
  Rung result = rung_of(scene, std::move(value), size);
  change(result.scene);
  return result;
}

/// @param factors  of the size that the scene has.
Ladder of_element_size(const SceneDescription& scene, const std::vector<double>& factors) {
  Ladder ladder{element_size_knob, "mesh", {}};
  const double given = *element_size_of(scene);
  for (const double factor : factors) {
    const double size = factor * given;
    ladder.rungs.push_back(rung(scene, fmt::format("{:.4g}", size), size,
                                [&](auto& other) { other = with_elements_scaled(other, factor); }));
    ladder.rungs.back().same_mesh = factor == 1.0;
    ladder.rungs.back().same_basis = factor == 1.0;
  }
  return ladder;
}

/// Sizes are relative to the elements of the file.
Ladder of_refinement(const SceneDescription& scene) {
  constexpr std::array names{"given", "halved", "quartered", "eighth", "sixteenth"};
  Ladder ladder{refinement_knob, "mesh", {}};
  const int own = std::get<MeshFileModel>(scene.model).refinement;
  double size = 1.0;
  for (int cuts = 0; cuts <= own + 1; ++cuts, size *= 0.5) {
    const char* name = names.at(static_cast<std::size_t>(cuts));
    ladder.rungs.push_back(rung(scene, name, size, [cuts](SceneDescription& other) {
      std::get<MeshFileModel>(other.model).refinement = cuts;
    }));
    ladder.rungs.back().same_mesh = ladder.rungs.back().same_basis = cuts == own;
  }
  return ladder;
}

Ladder of_modes(const SceneDescription& scene) {
  Ladder ladder{"modes", "basis", {}};
  const BasisSettings& basis = scene.settings.basis;
  const int given = basis.n_modes;
  for (const int n :
       std::set{std::max(1, given / 4), std::max(1, given / 2), given, 2 * given, 4 * given}) {
    ladder.rungs.push_back(rung(scene, fmt::format("{}", n), 0.0, [&](auto& other) {
      other.settings.basis.n_modes = n;
      other.settings.basis.reach = 0.0;  // their number as the rung tells it
    }));
    ladder.rungs.back().same_basis = n == given && basis.reach == 0.0;
  }
  return ladder;
}

Ladder of_attachment_degree(const SceneDescription& scene) {
  Ladder ladder{"attachment_degree", "basis", {}};
  for (const int degree : {0, 1, 2}) {
    ladder.rungs.push_back(rung(scene, fmt::format("{}", degree), 0.0, [&](auto& other) {
      other.settings.basis.attachment_degree = degree;
    }));
    ladder.rungs.back().same_basis = scene.settings.basis.attachment_degree == degree;
  }
  return ladder;
}

Ladder of_cells(const SceneDescription& scene) {
  Ladder ladder{"cells", "cells", {}};
  const int given = contact_points(scene.settings, 0);
  for (const int n : {given / 16, given / 4, given, 4 * given, 16 * given}) {
    if (n < 1) continue;
    ladder.rungs.push_back(rung(scene, fmt::format("{}", n), 1.0 / n, [&](auto& other) {
      for (PatchSettings& patch : other.settings.patches) patch.n_points = n;
    }));
  }
  return ladder;
}

Ladder of_fit(const SceneDescription& scene) {
  Ladder ladder{"fit", "fit", {}};
  for (const int degree : {1, 2, 3, 4}) {
    ladder.rungs.push_back(rung(scene, fmt::format("{}", degree), 0.0, [&](auto& other) {
      for (PatchSettings& patch : other.settings.patches) {
        patch.fit = PatchSettings::Fit::degree;
        patch.fit_degree = degree;
      }
    }));
  }
  ladder.rungs.push_back(rung(scene, "none", 0.0, [](auto& other) {
    for (PatchSettings& patch : other.settings.patches) patch.fit = PatchSettings::Fit::none;
  }));
  return ladder;
}

Ladder of_harmonics(const SceneDescription& scene) {
  Ladder ladder{"harmonics", "harmonics", {}};
  for (const int highest : {1, 3, 5, 9, 17}) {
    ladder.rungs.push_back(rung(scene, fmt::format("{}", highest), 0.0, [&](auto& other) {
      other.settings.harmonics = {
          .highest = highest, .orders = {}, .tolerance = 0.0, .checked = false};
    }));
  }
  return ladder;
}

Ladder of_instants(const SceneDescription& scene) {
  Ladder ladder{"instants", "instants", {}};
  for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
    ladder.rungs.push_back(rung(scene, fmt::format("to {:g}", tolerance), 0.0,
                                [&](auto& other) { other.settings.force_tolerance = tolerance; }));
  }
  return ladder;
}

Ladder of_second_direction(const SceneDescription& scene) {
  Ladder ladder{"second_direction", "second_direction", {}};
  using enum Discretisation::Choice;
  for (const auto& [name, choice] : {std::pair{"off", off}, std::pair{"on", on}}) {
    ladder.rungs.push_back(rung(scene, name, 0.0, [choice = choice](auto& other) {
      other.settings.second_direction = choice;
    }));
  }
  return ladder;
}

/// Without what stands for the modes left out, and with it.
Ladder of_residual(const SceneDescription& scene) {
  Ladder ladder{"residual", "basis", {}};
  using enum ResidualKind;
  for (const auto& [name, kind] : {std::pair{"none", none}, std::pair{"stiffness", stiffness},
                                   std::pair{"attachment", attachment}}) {
    ladder.rungs.push_back(rung(
        scene, name, 0.0, [kind = kind](auto& other) { other.settings.basis.residual = kind; }));
    ladder.rungs.back().same_basis = scene.settings.basis.residual == kind;
  }
  return ladder;
}

void add_contact_ladders(const SceneDescription& scene, std::vector<Ladder>& result) {
  result.push_back(of_modes(scene));
  if (given_modes(scene) == nullptr) result.push_back(of_residual(scene));
  if (scene.settings.basis.residual == ResidualKind::attachment) {
    result.push_back(of_attachment_degree(scene));
  }
  result.push_back(of_cells(scene));
  result.push_back(of_fit(scene));
  result.push_back(of_second_direction(scene));
}

/// Of a bar, which is another scene with other counts of points or modes.
Ladder of_counts(const SceneDescription& scene, const char* knob, const char* source,
                 int BarCounts::*count, const std::set<int>& numbers) {
  Ladder ladder{knob, source, {}};
  for (const int n : numbers) {
    Rung rung = rung_of(scene, fmt::format("{}", n), 1.0 / n);
    BarCounts counts = *bar_counts(scene);
    counts.*count = n;
    try {
      rung.scene = with_bar_counts(std::move(rung.scene), counts);
      const bool has_them = bar_counts(rung.scene).value().*count == n;
      if (!has_them) rung.refused = fmt::format("the scene names its {} one by one", knob);
    } catch (const SceneError& error) {
      rung.refused = error.what();
    } catch (const RefusedError& error) {
      rung.refused = error.what();
    }
    ladder.rungs.push_back(std::move(rung));
  }
  return ladder;
}

void add_bar_ladders(const SceneDescription& scene, std::vector<Ladder>& result) {
  const auto [points, modes] = *bar_counts(scene);
  result.push_back(of_counts(
      scene, "points", "cells", &BarCounts::points,
      {std::max(1, points / 16), std::max(1, points / 4), points, 4 * points, 16 * points}));
  result.push_back(
      of_counts(scene, "modes", "basis", &BarCounts::modes,
                {std::max(1, modes / 4), std::max(1, modes / 2), modes, 2 * modes, 4 * modes}));
}

/// Of a period, fixed; last those between the changes of contact, each of which is located.
Ladder of_steps(const SceneDescription& scene) {
  Ladder ladder{"steps", "time", {}};
  for (const int n : {250, 500, 1000, 2000, 4000, 0}) {
    ladder.rungs.push_back(rung(scene, n > 0 ? fmt::format("{}", n) : "located",
                                n > 0 ? 1.0 / n : 0.0, [n](auto& other) {
                                  other.response->steps_per_period = n;
                                  other.response->steps_place = "response.steps_per_period";
                                }));
  }
  return ladder;
}

/// Not of hundreds of points with tens of modes: an integration takes minutes.
bool is_cheap_in_time(const SceneDescription& scene) {
  constexpr double most = 5000.0;  // 200 points, 10 modes: 7 s
  const auto& modal = std::get<ModalModel>(scene.model);
  return static_cast<double>(modal.points.size()) *
             static_cast<double>(modal.frequency_hz.size()) <=
         most;
}

/// Harmonics of a scene that is integrated were none to choose: chosen ones.
Ladder of_method(const SceneDescription& scene) {
  constexpr double tolerance = 0.005;
  Ladder ladder{"method", "time", {}};
  for (const auto& [name, in_time] :
       {std::pair{"harmonic_balance", false}, std::pair{"time", true}}) {
    ladder.rungs.push_back(rung(scene, name, 0.0, [&](auto& other) {
      if (scene.response->method != Method::time) return;
      other.response->method = Method::harmonic_balance;
      other.settings.harmonics = automatic_harmonics(tolerance);
      other.settings.harmonics.checked = false;
    }));
    ladder.rungs.back().in_time = in_time;
  }
  return ladder;
}

}  // namespace

Rung rung_of(const SceneDescription& scene, std::string value, double size) {
  Rung rung{std::move(value), size, scene};
  rung.scene.settings.harmonics.checked = false;
  return rung;
}

Ladder ladder_of_sizes(const SceneDescription& scene, const std::vector<double>& sizes) {
  const std::optional<double> given = element_size_of(scene);
  if (!given) {
    throw SceneError(fmt::format(
        "--sizes: goes with scenes of kind \"blade\" or \"step\"; {} is of "
        "kind \"{}\"{}",
        scene.file.string(), scene.kind, scene.kind == "mesh" ? ": give --meshes" : ""));
  }
  if (sizes.size() < 2) {
    throw SceneError("--sizes: one size does not converge: expected two or more");
  }
  std::vector<double> factors;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (!(sizes[i] > 0.0) || (i > 0 && !(sizes[i] < sizes[i - 1]))) {
      throw SceneError(
          fmt::format("--sizes: {:g} m: expected lengths above 0 from coarse to fine", sizes[i]));
    }
    factors.push_back(sizes[i] == *given ? 1.0 : sizes[i] / *given);
  }
  return of_element_size(scene, factors);
}

std::vector<Ladder> ladders(const SceneDescription& scene) {
  std::vector<Ladder> result;
  const bool meshed = !std::holds_alternative<ModalModel>(scene.model);
  const bool in_time = scene.response && scene.response->method == Method::time;
  if (element_size_of(scene)) {
    result.push_back(of_element_size(scene, {4.0, 2.0, 1.0, 2.0 / 3.0}));
  }
  if (scene.kind == "mesh") result.push_back(of_refinement(scene));
  if (meshed && !scene.contacts.empty()) add_contact_ladders(scene, result);
  if (bar_counts(scene)) add_bar_ladders(scene, result);
  result.push_back(in_time ? of_steps(scene) : of_harmonics(scene));
  if (!scene.contacts.empty() && !in_time) result.push_back(of_instants(scene));
  if (scene.response && !meshed && is_cheap_in_time(scene)) result.push_back(of_method(scene));
  return result;
}

}  // namespace microslip::pipelines
