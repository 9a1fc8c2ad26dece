#include "pipelines/description/effects_left_out.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace microslip::pipelines {
namespace {

/// How an effect is taken out of a description, and put back as it is written.
struct Removal {
  EffectLeftOut told;
  bool (*is_given)(const SceneDescription&);
  void (*take_out)(SceneDescription&);
  void (*put_back)(SceneDescription& scene, const SceneDescription& written);
  bool may_be_chosen = false;  ///< `auto` may leave it out
};

/// A member of the rules of every surface.
template <auto member>
void forget(SceneDescription& scene) {
  (scene.rules.*member).reset();
  for (ContactDescription& contact : scene.contacts) (contact.rules.*member).reset();
}

template <auto member>
void restore(SceneDescription& scene, const SceneDescription& written) {
  scene.rules.*member = written.rules.*member;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    scene.contacts[i].rules.*member = written.contacts[i].rules.*member;
  }
}

void take_out_law(SceneDescription& scene) {
  if (auto* modal = std::get_if<ModalModel>(&scene.model)) {
    for (contact::PointParameters& point : modal->points) {
      if (point.rubs()) point.friction_coefficient = scene.rules.friction->at_rest();
    }
  }
  forget<&contact::SurfaceRules::friction>(scene);
}

void copy_friction(const ModalModel& from, ModalModel& to) {
  for (std::size_t i = 0; i < to.points.size(); ++i) {
    to.points[i].friction_coefficient = from.points[i].friction_coefficient;
  }
}

void put_back_law(SceneDescription& scene, const SceneDescription& written) {
  restore<&contact::SurfaceRules::friction>(scene, written);
  if (auto* modal = std::get_if<ModalModel>(&scene.model)) {
    copy_friction(std::get<ModalModel>(written.model), *modal);
  }
}

bool has_residual(const SceneDescription& scene) {
  return scene.settings.basis.residual != ResidualKind::none;
}

/// 1/k_local = 1/k − c.
double local_part(double stiffness, double flexibility) {
  return stiffness > 0.0 ? 1.0 / (1.0 / stiffness - flexibility) : 0.0;
}

/// Stiffness of given points without what stands in series with it.
void take_out_compliance(ModalModel& modal) {
  for (std::size_t i = 0; i < modal.points.size(); ++i) {
    contact::PointParameters& point = modal.points[i];
    if (modal.local_stiffness) point.tangential_stiffness = *modal.local_stiffness;
    if (modal.compliance.rows() == 0) continue;
    const auto row = static_cast<Eigen::Index>(i);
    point.tangential_stiffness = local_part(point.tangential_stiffness, modal.compliance(row, 0));
    modal.second_stiffness[row] = local_part(modal.second_stiffness[row], modal.compliance(row, 2));
    const double normal = local_part(point.normal_stiffness, modal.compliance(row, 1));
    // A gap is −rest load over the stiffness: the length stays.
    if (point.rest_load < 0.0 && normal > 0.0) point.rest_load *= normal / point.normal_stiffness;
    point.normal_stiffness = normal;
  }
  modal.compliance.resize(0, 3);
  modal.local_stiffness.reset();
}

/// The last modes, which are static shapes.
void take_out_attachment(ModalModel& modal) {
  const Eigen::Index n = modal.frequency_hz.size() - modal.n_attachment;
  for (Eigen::VectorXd* values : {&modal.frequency_hz, &modal.damping_ratio, &modal.force_sine,
                                  &modal.force_cosine, &modal.force_static, &modal.output}) {
    values->conservativeResize(n);
  }
  for (Eigen::MatrixXd* shape : {&modal.shapes.u, &modal.shapes.v, &modal.shapes.w}) {
    if (shape->size() > 0) shape->conservativeResize(Eigen::NoChange, n);
  }
  modal.n_attachment = 0;
}

void take_out_residual(SceneDescription& scene) {
  scene.settings.basis.residual = ResidualKind::none;
  scene.settings.basis.attachment_degree.reset();
  scene.modes.residual_note.clear();
  if (auto* modal = std::get_if<ModalModel>(&scene.model)) {
    take_out_compliance(*modal);
    take_out_attachment(*modal);
    modal->residual = ResidualKind::none;
  }
}

void put_back_residual(SceneDescription& scene, const SceneDescription& written) {
  scene.settings.basis.residual = written.settings.basis.residual;
  scene.settings.basis.attachment_degree = written.settings.basis.attachment_degree;
  scene.modes.residual_note = written.modes.residual_note;
  if (auto* modal = std::get_if<ModalModel>(&scene.model)) {
    ModalModel whole = std::get<ModalModel>(written.model);
    copy_friction(*modal, whole);  // what others have taken out stays out
    whole.tilted_areas = modal->tilted_areas;
    *modal = std::move(whole);
  }
}

void take_out_moments(SceneDescription& scene) {
  scene.areas = false;
  for (ContactDescription& contact : scene.contacts) contact.preload_moment = {0.0, 0.0};
  if (auto* modal = std::get_if<ModalModel>(&scene.model)) modal->tilted_areas.clear();
}

void put_back_moments(SceneDescription& scene, const SceneDescription& written) {
  scene.areas = true;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    scene.contacts[i].preload_moment = written.contacts[i].preload_moment;
  }
  if (auto* modal = std::get_if<ModalModel>(&scene.model)) {
    modal->tilted_areas = std::get<ModalModel>(written.model).tilted_areas;
  }
}

/// Gaps and all.
bool has_shaped_preload(const SceneDescription& scene) {
  return has_static_preload(scene) && !scene.uniform_static_preload;
}

bool rotates(const SceneDescription& scene) {
  return scene.rotation && scene.rotation->speed > 0.0;
}

bool has_maps(const SceneDescription& scene) {
  return scene.response && !scene.response->maps.empty();
}

void take_out_wear(SceneDescription& scene) {
  scene.wear_coefficient = 0.0;
  for (ContactDescription& contact : scene.contacts) contact.wear_coefficient = 0.0;
}

void put_back_wear(SceneDescription& scene, const SceneDescription& written) {
  scene.wear_coefficient = written.wear_coefficient;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    scene.contacts[i].wear_coefficient = written.contacts[i].wear_coefficient;
  }
}

constexpr std::array removals{
    Removal{{"roughness", "contact.roughness",
             "the stiffness is that of full contact under every load"},
            is_rough,
            forget<&contact::SurfaceRules::roughness>,
            restore<&contact::SurfaceRules::roughness>,
            true},
    Removal{{"rate_dependence", "the law of contact.friction_coefficient",
             "the coefficient is that at rest, of speed 0"},
            is_rate_dependent,
            take_out_law,
            put_back_law,
            true},
    Removal{{"moments", "the area of the contact",
             "one point in its middle carries its load and has its mean motion"},
            [](const SceneDescription& scene) { return scene.areas && has_area(scene); },
            take_out_moments,
            put_back_moments},
    Removal{{"residual", "what stands for omitted modes (modes.residual)",
             "the free modes are alone, the contact stiffness is the local one"},
            has_residual,
            take_out_residual,
            put_back_residual},
    Removal{{"static_preload", "the shape of the pressure that contact.preload = \"static\" gives",
             "each face has a uniform pressure of the same force, without gaps"},
            has_shaped_preload,
            [](SceneDescription& scene) { scene.uniform_static_preload = true; },
            [](SceneDescription& scene, const SceneDescription&) {
              scene.uniform_static_preload = false;
            }},
    Removal{{"centrifugal", "static.speed", "modes and static loads are those at rest"},
            rotates,
            [](SceneDescription& scene) { scene.rotation->speed = 0.0; },
            [](SceneDescription& scene, const SceneDescription& written) {
              scene.rotation = written.rotation;
            }},
    Removal{
        {"stability", "the verdict on every point", "it is written and drawn as not known, -1"},
        [](const SceneDescription& scene) { return scene.judges_stability; },
        [](SceneDescription& scene) { scene.judges_stability = false; },
        [](SceneDescription& scene, const SceneDescription&) { scene.judges_stability = true; }},
    Removal{{"wear", "contact.wear_coefficient", "maps have no depth of wear"},
            has_wear,
            take_out_wear,
            put_back_wear},
    Removal{{"maps", "response.maps", "none is drawn"},
            has_maps,
            [](SceneDescription& scene) { scene.response->maps.clear(); },
            [](SceneDescription& scene, const SceneDescription& written) {
              scene.response->maps = written.response->maps;
            }},
};

const Removal* removal_of(std::string_view effect) {
  const auto found = std::ranges::find(removals, effect,
                                       [](const Removal& removal) { return removal.told.effect; });
  return found == removals.end() ? nullptr : &*found;
}

void set_auto(SceneDescription& scene, std::string_view effect) {
  for (auto& [name, setting] : scene.effects) {
    if (name == effect) setting = "auto";
  }
}

}  // namespace

void leave_out_effects(SceneDescription& scene) {
  const auto written = std::make_shared<const SceneDescription>(scene);
  for (const Removal& removal : removals) {
    if (setting_of(scene, removal.told.effect) != "off" || !removal.is_given(*written)) continue;
    removal.take_out(scene);
    scene.written = written;
  }
}

void leave_out_by_choice(SceneDescription& scene, const std::vector<std::string>& effects) {
  for (const std::string& effect : effects) {
    const Removal* removal = removal_of(effect);
    if (!is_given(scene, effect) || !removal->may_be_chosen) continue;
    if (!scene.written) scene.written = std::make_shared<const SceneDescription>(scene);
    removal->take_out(scene);
  }
}

std::vector<std::string> left_out_by_choice(const SceneDescription& scene) {
  std::vector<std::string> effects;
  for (const Removal& removal : removals) {
    const std::string_view name = removal.told.effect;
    if (setting_of(scene, name) == "auto" && left_out(scene, name) != nullptr) {
      effects.emplace_back(name);
    }
  }
  return effects;
}

const SceneDescription& as_written(const SceneDescription& scene) {
  return scene.written ? *scene.written : scene;
}

const EffectLeftOut* left_out(const SceneDescription& scene, std::string_view effect) {
  const Removal* removal = removal_of(effect);
  if (removal == nullptr || !scene.written) return nullptr;
  const bool is_chosen = removal->may_be_chosen && !removal->is_given(scene);
  if (setting_of(scene, effect) != "off" && !is_chosen) return nullptr;
  return removal->is_given(*scene.written) ? &removal->told : nullptr;
}

bool is_given(const SceneDescription& scene, std::string_view effect) {
  const Removal* removal = removal_of(effect);
  return removal != nullptr && left_out(scene, effect) == nullptr && removal->is_given(scene);
}

SceneDescription with_effect(const SceneDescription& scene, std::string_view effect) {
  if (left_out(scene, effect) == nullptr) {
    throw std::invalid_argument("not left out: " + std::string(effect));
  }
  SceneDescription with = scene;
  removal_of(effect)->put_back(with, *scene.written);
  set_auto(with, effect);
  return with;
}

SceneDescription without_effect(const SceneDescription& scene, std::string_view effect) {
  if (!is_given(scene, effect)) throw std::invalid_argument("not given: " + std::string(effect));
  SceneDescription without = scene;
  removal_of(effect)->take_out(without);
  return without;
}

}  // namespace microslip::pipelines
