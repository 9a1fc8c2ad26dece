#include "pipelines/accuracy/models_left_out.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "contact/dense.hpp"
#include "pipelines/description/curve_request.hpp"
#include "pipelines/description/effects_left_out.hpp"
#include "pipelines/effects/effect_choice.hpp"
#include "pipelines/effects/motion_along_r.hpp"
#include "pipelines/model/contact_coordinates.hpp"
#include "pipelines/model/contact_frame.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

using Names = std::vector<std::string>;

bool has(const Names& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

bool moves_along_normal(const ReducedModel& model) {
  return std::ranges::any_of(model.patches, [](const contact::Patch& patch) {
    return !patch.cells.stiffness.col(1).isZero(0.0) && !patch.cells.shapes.v.isZero(0.0);
  });
}

/// What friction along r would do is told nowhere else: error budgets have it of meshes alone. That
/// the linear limits do not move along r is no reason: points that slip unevenly turn the patch.
bool asks_for_direction(const ReducedModel& model, const SceneDescription& scene) {
  if (model.effects.second_direction || model.patches.empty()) return false;
  const bool stiff = std::ranges::all_of(model.patches, [](const contact::Patch& patch) {
    return patch.cells.stiffness.col(2).minCoeff() >= 0.0;
  });
  if (!stiff) return false;
  if (!can_rub_along_r(model)) return false;
  const bool given_points = scene.contacts.empty();
  return given_points || setting_of(scene, "second_direction") == "off" || in_time(scene) ||
         only_limits(scene);
}

bool frames_are_off(const SceneDescription& scene) {
  return setting_of(scene, "local_frames") == "off";
}

/// On a face that is not plane, switched off where it counts or left out because it hardly does.
bool asks_for_frames(const ReducedModel& model, const SceneDescription& scene) {
  const double limit =
      frames_are_off(scene) ? effect_row("local_frames").threshold : plane_to_rounding;
  return std::ranges::any_of(model.patches, [limit](const contact::Patch& patch) {
    return patch.cells.normals.rows() == 0 && patch.off_plane > limit;
  });
}

struct Described {
  const char* name;
  bool changes_modes;
  bool of_contact;
};

constexpr std::array described{
    Described{"roughness", false, true},   Described{"rate_dependence", false, true},
    Described{"moments", false, true},     Described{"static_preload", false, true},
    Described{"residual", true, false},    Described{"centrifugal", true, false},
    Described{"local_frames", true, true},
};

bool is_switch(std::string_view name) {
  return name == "normal_motion" || name == "mean_coupling" || name == "second_direction";
}

SceneDescription with_frames(SceneDescription scene) {
  const bool where_they_count = frames_are_off(scene);
  for (ContactDescription& contact : scene.contacts) {
    contact.local_frames = where_they_count ? std::nullopt : std::optional(true);
  }
  return scene;
}

SceneDescription described_with(const Names& names, SceneDescription scene) {
  for (const std::string& name : names) {
    if (is_switch(name)) continue;
    if (name == "local_frames") {
      scene = with_frames(std::move(scene));
    } else {
      scene = with_effect(scene, name);
    }
  }
  return scene;
}

/// Coordinates of one basis from those of another on the same mesh, by least squares.
Eigen::MatrixXd between(const fem::ModalBasis& from, const fem::ModalBasis& to) {
  return contact::solved(to.shapes.transpose() * to.shapes, to.shapes.transpose() * from.shapes);
}

/// The first modes are the same, those that follow stand still.
Eigen::MatrixXd with_more(const ReducedModel& from, const ReducedModel& to) {
  return Eigen::MatrixXd::Identity(to.frequency.size(), from.frequency.size());
}

/// As the scene is described; which switches of the contact are on stays as it was.
RicherModel built(const Names& names, const ReducedModel& model, const SceneDescription& with,
                  const SolvedStructure* structure) {
  const bool changes_modes = std::ranges::any_of(
      names, [&](const std::string& name) { return leaving_out_changes_modes(name, with); });
  std::vector<std::string> warnings;  // those of the scene itself are told already
  RicherModel other;
  if (structure != nullptr && changes_modes) {
    const SolvedStructure solved = solved_on(structure->mesh, with);
    other.model = model_of(with, &solved, warnings);
    other.embedding = between(structure->modes.basis, solved.modes.basis);
  } else {
    other.model = model_of(with, structure, warnings);
    if (changes_modes) other.embedding = with_more(model, other.model);
  }
  other.model.effects = model.effects;
  return other;
}

RicherModel with_effects(const Names& names, const ReducedModel& model,
                         const SceneDescription& scene, const SolvedStructure* structure) {
  const bool only_switches =
      std::ranges::all_of(names, [](const std::string& name) { return is_switch(name); });
  const SceneDescription with = described_with(names, scene);
  RicherModel other = only_switches ? RicherModel{"", model} : built(names, model, with, structure);
  other.source = fmt::format("{}", fmt::join(names, together));
  contact::ContactEffects& effects = other.model.effects;
  if (has(names, "normal_motion") || is_rough(other.model)) effects.normal_motion = true;
  if (has(names, "mean_coupling")) effects.mean_coupling = true;
  if (has(names, "second_direction")) effects.second_direction = true;
  other.model.coordinates = contact_coordinates(other.model, with);
  return other;
}

/// @param names  of one model.
void add(const Names& names, const ReducedModel& model, const SceneDescription& scene,
         const SolvedStructure* structure, RicherModels& others) {
  const std::string source = fmt::format("{}", fmt::join(names, together));
  if (cut_short()) {
    others.no_bound.push_back({source, "the time was over"});
    return;
  }
  try {
    others.models.push_back(with_effects(names, model, scene, structure));
  } catch (const InterruptedError&) {
    throw;
  } catch (const std::exception& error) {  // a check that fails does not cost the run
    others.no_bound.push_back({source, error.what()});
    others.note = fmt::format("what leaving out {} changes is not known: {}", source, error.what());
  }
}

}  // namespace

bool leaving_out_changes_modes(std::string_view name, const SceneDescription& scene) {
  // Of a face that is all but plane shapes of tractions along its mean normal do; residual
  // flexibility and what static loads press with are kept along the axes.
  if (name == "local_frames" && !frames_are_off(scene)) {
    return scene.settings.basis.residual == ResidualKind::stiffness || has_static_preload(scene);
  }
  return std::ranges::any_of(described, [name](const Described& effect) {
    return effect.changes_modes && effect.name == name;
  });
}

std::vector<std::string> effects_left_out(const ReducedModel& model,
                                          const SceneDescription& scene) {
  std::vector<std::string> names;
  if (!model.effects.normal_motion && moves_along_normal(model))
    names.emplace_back("normal_motion");
  if (!model.effects.mean_coupling && moves_along_normal(model))
    names.emplace_back("mean_coupling");
  if (asks_for_direction(model, scene)) names.emplace_back("second_direction");
  for (const Described& effect : described) {
    if (effect.of_contact && model.patches.empty()) continue;
    const bool frames = std::string_view(effect.name) == "local_frames";
    if (frames ? asks_for_frames(model, scene) : left_out(scene, effect.name) != nullptr) {
      names.emplace_back(effect.name);
    }
  }
  return names;
}

RicherModels models_left_out(const ReducedModel& model, const SceneDescription& scene,
                             const SolvedStructure* structure) {
  RicherModels others;
  const std::vector<std::string> names = effects_left_out(model, scene);
  const bool pressed_evenly = setting_of(scene, "normal_motion") == "off";
  for (const std::string& name : names) {
    if (name == "roughness" && pressed_evenly) {
      others.no_bound.push_back({name, "it cannot be without normal_motion, which is off"});
    } else {
      add({name}, model, scene, structure, others);
    }
  }
  if (names.size() > 1) add(names, model, scene, structure, others);
  return others;
}

}  // namespace microslip::pipelines
