#include "pipelines/sections/effects_section.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipelines/description/curve_request.hpp"
#include "pipelines/description/effects_left_out.hpp"
#include "pipelines/text/effect_table.hpp"

namespace microslip::pipelines {
namespace {

constexpr std::array<std::string_view, 3> settings{"auto", "on", "off"};

const ModalModel* modal_of(const SceneDescription& scene) {
  return std::get_if<ModalModel>(&scene.model);
}

bool has_contact(const SceneDescription& scene) {
  const ModalModel* modal = modal_of(scene);
  return modal != nullptr ? !modal->points.empty() : !scene.contacts.empty();
}

bool lacks_contact(const SceneDescription& scene) { return !has_contact(scene); }

bool lacks_friction(const SceneDescription& scene) {
  if (const ModalModel* modal = modal_of(scene)) {
    return std::ranges::none_of(modal->points, [](const auto& point) { return point.rubs(); });
  }
  return std::ranges::all_of(
      scene.contacts, [](const ContactDescription& contact) { return contact.friction.is_zero(); });
}

bool has_constant_load(const SceneDescription& scene) {
  if (const ModalModel* modal = modal_of(scene)) {
    return std::ranges::none_of(modal->points,
                                [](const auto& point) { return point.normal_stiffness > 0.0; });
  }
  return std::ranges::none_of(scene.contacts, [](const ContactDescription& contact) {
    return contact.normal_stiffness.value_or(1.0) > 0.0;
  });
}

bool lacks_normal_motion(const SceneDescription& scene) {
  return setting_of(scene, "normal_motion") == "off";
}

/// The linear limits alone.
bool lacks_nonlinearity(const SceneDescription& scene) {
  return setting_of(scene, "nonlinearity") == "off";
}

bool searches_for_speed(const SceneDescription& scene) {
  return scene.response && scene.response->optimum &&
         scene.response->optimum->key == "static.speed";
}

/// A range searched for the best preload is one above zero.
bool asks_for_gap(const SceneDescription& scene) {
  return scene.response &&
         std::ranges::any_of(scene.response->preload, [](const PreloadEntry& entry) {
           const auto* load = std::get_if<double>(&entry);
           return std::holds_alternative<UniformGap>(entry) || (load != nullptr && *load < 0.0);
         });
}

/// Under some load the whole contact is open at rest.
bool is_all_open(const SceneDescription& scene) {
  if (const ModalModel* modal = modal_of(scene); modal != nullptr && !modal->points.empty()) {
    if (std::ranges::all_of(modal->points, [](const auto& p) { return p.rest_load < 0.0; })) {
      return true;
    }
  }
  return asks_for_gap(scene);
}

/// Somewhere the contact is open at rest.
bool has_gap(const SceneDescription& scene) {
  if (lacks_normal_motion(scene)) return false;
  const ModalModel* modal = modal_of(scene);
  if (modal != nullptr &&
      std::ranges::any_of(modal->points, [](const auto& p) { return p.rest_load < 0.0; })) {
    return true;
  }
  return asks_for_gap(scene);  // chains and blocks as well, whose points are loaded by it
}

/// The motion along r of given modes; the modes of a mesh have one.
bool lacks_motion_along_r(const SceneDescription& scene) {
  const ModalModel* modal = modal_of(scene);
  return modal != nullptr && (modal->shapes.w.size() == 0 || modal->shapes.w.isZero(0.0));
}

bool has_harmonics(const SceneDescription& scene) { return scene.settings.harmonics.highest > 1; }
bool is_smooth(const SceneDescription& scene) { return !is_rough(scene); }
bool has_constant_friction(const SceneDescription& scene) { return !is_rate_dependent(scene); }
bool lacks_area(const SceneDescription& scene) { return !has_area(scene); }

bool lacks_residual(const SceneDescription& scene) {
  return scene.settings.basis.residual == ResidualKind::none;
}
/// The residual is the stiffness of a contact.
bool is_rigid(const SceneDescription& scene) {
  return !lacks_residual(as_written(scene)) &&
         std::ranges::any_of(scene.contacts, [](const ContactDescription& contact) {
           return !contact.normal_stiffness || !contact.tangential_stiffness;
         });
}

bool lacks_static_preload(const SceneDescription& scene) { return !has_static_preload(scene); }

bool rotates(const SceneDescription& scene) {
  return scene.rotation && scene.rotation->speed > 0.0;
}
bool is_at_rest(const SceneDescription& scene) { return !rotates(scene); }
bool presses_by_rotation_alone(const SceneDescription& scene) {
  const SceneDescription& written = as_written(scene);
  return has_static_preload(written) && rotates(written) && written.static_loads.place.empty() &&
         std::ranges::none_of(written.contacts,
                              [](const ContactDescription& contact) { return contact.gap < 0.0; });
}

bool lacks_wear(const SceneDescription& scene) { return !has_wear(scene); }
bool lacks_maps(const SceneDescription& scene) {
  return !scene.response || scene.response->maps.empty();
}
bool refuses_maps(const SceneDescription& scene) { return setting_of(scene, "maps") == "off"; }

bool searches(const SceneDescription& scene) {
  return scene.response && scene.response->search_starts.value_or(0) > 0;
}
bool refuses_to_search(const SceneDescription& scene) {
  return scene.response && scene.response->search_starts == 0;
}
bool goes_in_time(const SceneDescription& scene) {
  return scene.response && scene.response->method == ResponseDescription::Method::time;
}

bool lacks_harmonics(const SceneDescription& scene) {
  return !has_harmonics(scene) && !goes_in_time(scene);
}

/// Curves beside the two limits.
bool asks_for_preloads(const SceneDescription& scene) {
  if (!scene.response || lacks_contact(scene)) return false;
  return std::ranges::any_of(scene.response->preload, [](const PreloadEntry& entry) {
    return !std::holds_alternative<LimitName>(entry);
  });
}
bool asks_for_scales(const SceneDescription& scene) {
  return scene.response && has_contact(scene) && scene.response->preload.empty();
}

bool asks_for_best_value(const SceneDescription& scene) {
  return scene.response && scene.response->optimum.has_value();
}

bool lacks_faces(const SceneDescription& scene) { return scene.contacts.empty(); }
bool is_fitted(const SceneDescription& scene, std::size_t contact) {
  return scene.settings.patches[contact].fit == PatchSettings::Fit::degree;
}
/// Left out with the areas as well: there would be no scene to put it back into.
bool is_tilted(const SceneDescription& scene, std::size_t contact) {
  return as_written(scene).contacts[contact].preload_moment != std::array{0.0, 0.0};
}

template <bool (*is_so)(const SceneDescription&, std::size_t contact)>
bool is_any(const SceneDescription& scene) {
  std::size_t contact = 0;
  while (contact < scene.contacts.size() && !is_so(scene, contact)) ++contact;
  return contact < scene.contacts.size();
}

/// A key that is left out instead of the effect, where a user has given it.
struct OtherKey {
  const char* name = nullptr;
  /// Whether that of one of several contacts contradicts; nullptr: any does.
  bool (*contradicts)(const SceneDescription&, std::size_t contact) = nullptr;
};

/// What one setting of an effect cannot stand beside.
struct Contradiction {
  std::string_view effect, setting;
  bool (*is_there)(const SceneDescription&);
  std::string_view why;  ///< names the other key
  OtherKey other{};
};

constexpr std::string_view no_normal_stiffness =
    "needs normal_stiffness in [contact], or at a contact point: the load is constant";
constexpr std::string_view without_normal_motion =
    "contradicts effects.normal_motion = \"off\": then the load stays that of rest";

constexpr std::string_view without_nonlinearity =
    "contradicts effects.nonlinearity = \"off\": then contact is a spring, or nothing";

/// Of each effect of loads.
bool has_limits_alone(const SceneDescription& scene) {
  return has_contact(scene) && is_linear_study(scene);
}
constexpr std::string_view without_load =
    "needs contact under a load, and response.preload asks for the limits alone";

constexpr std::array contradictions{
    Contradiction{"nonlinearity", "on", lacks_contact, "needs a [contact]"},
    Contradiction{"nonlinearity",
                  "off",
                  asks_for_preloads,
                  "contradicts response.preload: contact without it is one of the limits, "
                  "response.preload = [\"free\", \"stuck\"]",
                  {"response.preload"}},
    Contradiction{"nonlinearity", "off", asks_for_scales,
                  "contradicts response.preload_scale (1 where it is not given): scenes of kinds "
                  "modal and bar have no curves of the limits alone"},
    Contradiction{"nonlinearity",
                  "off",
                  asks_for_best_value,
                  "contradicts response.optimum, which searches along curves of contact that slips",
                  {"response.optimum"}},
    Contradiction{"normal_motion", "on", has_constant_load, no_normal_stiffness},
    Contradiction{"normal_motion",
                  "off",
                  is_rough,
                  "contradicts contact.roughness: rough surfaces are felt by normal motion",
                  {"contact.roughness"}},
    Contradiction{"normal_motion",
                  "off",
                  is_all_open,
                  "contradicts a gap, which normal motion alone closes: response.preload below "
                  "0, or preload of every contact point. Without it the "
                  "contact never touches: response.preload = [\"free\"] asks for that",
                  {"response.preload"}},
    Contradiction{
        "separation", "on", lacks_normal_motion, without_normal_motion, {"effects.normal_motion"}},
    Contradiction{"separation", "on", has_constant_load, no_normal_stiffness},
    Contradiction{
        "separation", "on", lacks_nonlinearity, without_nonlinearity, {"effects.nonlinearity"}},
    Contradiction{"separation",
                  "off",
                  has_gap,
                  "contradicts a gap, which closes and opens: response.preload below 0, or preload "
                  "of a contact point",
                  {"response.preload"}},
    Contradiction{"mean_coupling",
                  "on",
                  lacks_normal_motion,
                  without_normal_motion,
                  {"effects.normal_motion"}},
    Contradiction{"mean_coupling", "on", has_constant_load, no_normal_stiffness},
    Contradiction{
        "mean_coupling", "on", lacks_nonlinearity, without_nonlinearity, {"effects.nonlinearity"}},
    Contradiction{"second_direction", "on", lacks_motion_along_r,
                  "needs modes that move along r: phi_w_1 … of modal.points (kinds chain and bar "
                  "have none)"},
    Contradiction{"second_direction", "on", lacks_friction,
                  "needs a friction_coefficient above 0 in [contact], or at a contact point"},
    Contradiction{"higher_harmonics", "on", lacks_harmonics, "needs response.harmonics above 1"},
    Contradiction{"higher_harmonics",
                  "on",
                  lacks_nonlinearity,
                  without_nonlinearity,
                  {"effects.nonlinearity"}},
    Contradiction{"higher_harmonics",
                  "off",
                  has_harmonics,
                  "contradicts response.harmonics",
                  {"response.harmonics"}},
    Contradiction{"higher_harmonics",
                  "off",
                  goes_in_time,
                  "contradicts response.method = \"time\", which has all harmonics",
                  {"response.method"}},
    Contradiction{"roughness", "on", is_smooth, "needs contact.roughness"},
    Contradiction{"rate_dependence", "on", has_constant_friction,
                  "needs a law of contact.friction_coefficient"},
    Contradiction{"rate_dependence",
                  "on",
                  lacks_nonlinearity,
                  without_nonlinearity,
                  {"effects.nonlinearity"}},
    Contradiction{"moments", "on", lacks_area,
                  "needs an area: cells and size in contact.points, or p and r of modal.points"},
    Contradiction{"residual", "on", lacks_residual,
                  "needs modes.residual \"stiffness\" or \"attachment\": modal scenes and \"none\" "
                  "have no residual"},
    Contradiction{"residual", "off", is_rigid,
                  "contradicts contact.normal_stiffness or tangential_stiffness = \"rigid\", which "
                  "is the residual stiffness alone: give one in N/m^3"},
    Contradiction{
        "local_frames", "on", lacks_faces,
        "needs contact.surface, a face of a mesh: contact points of a modal scene have the "
        "directions of the modes given for them"},
    Contradiction{"local_frames",
                  "on",
                  is_any<is_fitted>,
                  "contradicts contact.fit: a field is fitted in a plane",
                  {"contact.fit", is_fitted}},
    Contradiction{"local_frames",
                  "on",
                  is_any<is_tilted>,
                  "contradicts contact.preload_moment, which tilts a plane face",
                  {"contact.preload_moment", is_tilted}},
    Contradiction{"static_preload", "on", lacks_static_preload,
                  "needs contact.preload = \"static\" and the loads of [static]"},
    Contradiction{"centrifugal", "on", is_at_rest, "needs static.speed and static.axis"},
    Contradiction{"centrifugal",
                  "off",
                  searches_for_speed,
                  "contradicts response.optimum = \"static.speed\", which searches for it",
                  {"response.optimum"}},
    Contradiction{"centrifugal", "off", presses_by_rotation_alone,
                  "contradicts contact.preload = \"static\", which nothing presses without "
                  "static.speed: expected static.forces, static.pressure or contact.gap below 0"},
    Contradiction{"wear", "on", lacks_wear, "needs contact.wear_coefficient"},
    Contradiction{"wear",
                  "on",
                  refuses_maps,
                  "contradicts effects.maps = \"off\": it is drawn in maps",
                  {"effects.maps"}},
    Contradiction{"wear", "on", lacks_maps, "needs response.maps, which it is drawn in"},
    Contradiction{"maps", "on", lacks_maps, "needs response.maps"},
    Contradiction{"coexistence",
                  "on",
                  refuses_to_search,
                  "contradicts response.search_starts = 0",
                  {"response.search_starts"}},
    Contradiction{"coexistence",
                  "on",
                  goes_in_time,
                  "needs response.method = \"harmonic_balance\": integration in time follows one "
                  "motion",
                  {"response.method"}},
    Contradiction{
        "coexistence", "on", lacks_nonlinearity, without_nonlinearity, {"effects.nonlinearity"}},
    Contradiction{"coexistence",
                  "off",
                  searches,
                  "contradicts response.search_starts",
                  {"response.search_starts"}},
};

/// Of a key as a user writes it, the contact's where it stands in [[contact]]; nullptr: not given.
const toml::node* node_of(std::string_view key, const toml::table& given, std::size_t contact) {
  const std::size_t dot = key.find('.');
  const toml::node* section = given.get(key.substr(0, dot));
  if (section != nullptr && section->is_array()) section = section->as_array()->get(contact);
  const toml::node* node = section != nullptr && section->is_table()
                               ? section->as_table()->get(key.substr(dot + 1))
                               : nullptr;
  // Where a scene does not say, the program completes it: such a key has no place.
  return node != nullptr && node->source().path ? node : nullptr;
}

/// "leave out response.harmonics (scene.toml:12) or "; that of every contact which contradicts.
std::string leaving_out(const OtherKey& other, const toml::table& given,
                        const SceneDescription& scene, const std::string& file) {
  if (other.name == nullptr) return "else leave out ";
  const bool is_of_contact = std::string_view(other.name).starts_with("contact.");
  const auto* contacts = given.get_as<toml::array>("contact");
  const std::size_t n = is_of_contact && contacts != nullptr ? contacts->size() : 1;
  std::vector<std::string> keys;
  for (std::size_t contact = 0; contact < n; ++contact) {
    if (other.contradicts != nullptr && !other.contradicts(scene, contact)) continue;
    const toml::node* node = node_of(other.name, given, contact);
    if (node != nullptr) keys.push_back(fmt::format("{} ({})", other.name, place_of(node, file)));
  }
  if (keys.empty()) return "else leave out ";
  return fmt::format("leave out {} or ", fmt::join(keys, " and "));
}

}  // namespace

void read_effects(const SectionReader& s, const toml::table& given, SceneDescription& scene) {
  for (const EffectRow& row : effect_table) {
    scene.effects.emplace_back(row.name, s.word(row.name, settings));
  }
  leave_out_effects(scene);
  const auto refuse = [&](const Contradiction& found) {
    const auto& [effect, setting, is_there, why, other] = found;
    if (setting_of(scene, effect) != setting || !is_there(scene)) return;
    const std::string leaving = leaving_out(other, given, scene, s.file());
    s.fail(effect, fmt::format("\"{}\" {}; {}effects.{}", setting, why, leaving, effect),
           s.node(effect));
  };
  std::ranges::for_each(contradictions, refuse);
  for (const EffectRow& row : effect_table) {
    if (row.of_loads) {
      refuse({row.name, "on", has_limits_alone, without_load, {"response.preload"}});
    }
  }
  if (const std::string frames = setting_of(scene, "local_frames"); frames != "auto") {
    for (ContactDescription& contact : scene.contacts) contact.local_frames = frames == "on";
  }
  using enum Discretisation::Choice;
  const std::string both = setting_of(scene, "second_direction");
  scene.settings.second_direction = both == "on" ? on : both == "off" ? off : automatic;
}

}  // namespace microslip::pipelines
