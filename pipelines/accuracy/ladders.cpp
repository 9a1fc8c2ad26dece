#include "pipelines/accuracy/ladders.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

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

/// One without a size: of two rungs no order is told.
Ladder of_refinement(const SceneDescription& scene) {
  Ladder ladder{refinement_knob, "mesh", {}};
  ladder.rungs.push_back(rung_of(scene, "given", 0.0));
  ladder.rungs.push_back(rung_of(scene, "halved", 0.0));
  ladder.rungs.back().n_cuts = 1;
  ladder.rungs.back().same_mesh = ladder.rungs.back().same_basis = false;
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
  if (element_size_of(scene)) {
    result.push_back(of_element_size(scene, {4.0, 2.0, 1.0, 2.0 / 3.0}));
  }
  if (scene.kind == "mesh") result.push_back(of_refinement(scene));
  if (!std::holds_alternative<ModalModel>(scene.model) && !scene.contacts.empty()) {
    result.push_back(of_modes(scene));
    if (scene.settings.basis.residual == ResidualKind::attachment) {
      result.push_back(of_attachment_degree(scene));
    }
    result.push_back(of_cells(scene));
    result.push_back(of_fit(scene));
    result.push_back(of_second_direction(scene));
  }
  result.push_back(of_harmonics(scene));
  if (!scene.contacts.empty()) result.push_back(of_instants(scene));
  return result;
}

}  // namespace microslip::pipelines
