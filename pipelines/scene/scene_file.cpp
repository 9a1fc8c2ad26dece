#include "pipelines/scene/scene_file.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "contact/phase.hpp"
#include "pipelines/description/effects_left_out.hpp"
#include "pipelines/description/goal_names.hpp"
#include "pipelines/scene/bar_scene.hpp"
#include "pipelines/scene/block_scene.hpp"
#include "pipelines/scene/chain_scene.hpp"
#include "pipelines/scene/modal_scene.hpp"
#include "pipelines/scene/scene_overrides.hpp"
#include "pipelines/scene/write_scene.hpp"
#include "pipelines/sections/contact_section.hpp"
#include "pipelines/sections/effects_section.hpp"
#include "pipelines/sections/faces_section.hpp"
#include "pipelines/sections/meshed_section.hpp"
#include "pipelines/sections/modes_section.hpp"
#include "pipelines/sections/points_section.hpp"
#include "pipelines/sections/response_section.hpp"
#include "pipelines/sections/static_section.hpp"
#include "pipelines/system/mesh_format.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/csv_table.hpp"
#include "pipelines/text/nearest_name.hpp"
#include "pipelines/text/section_reader.hpp"
#include "pipelines/text/toml_text.hpp"

namespace microslip::pipelines {
namespace {

constexpr std::uintmax_t largest_scene = 64'000'000;  // bytes
constexpr std::array<std::string_view, 8> kinds{"blade", "step", "mesh",  "modes",
                                                "modal", "bar",  "chain", "block"};

/// The scene while it is read: what was given, and the completed scene that grows beside it.
struct Reading {
  toml::table given;
  toml::table complete;
  std::string file;
  std::filesystem::path folder;

  [[nodiscard]] const toml::table* table(std::string_view name) const {
    const toml::node* node = given.get(name);
    if (node == nullptr) return nullptr;
    if (const toml::table* found = node->as_table()) return found;
    throw SceneError(
        fmt::format("{}: {}: {}", place_of(node, file), name,
                    node->is_array() && name == "contact"
                        ? "several contact patches are for kinds with a mesh"
                        : fmt::format("expected a section [{}]{}", name,
                                      node->is_array() ? ", once; found a list, or [[…]]" : "")));
  }

  /// [contact], or every [[contact]].
  std::vector<SectionReader> contacts() {
    std::vector<SectionReader> sections;
    const toml::node* node = given.get("contact");
    const toml::array* list = node != nullptr ? node->as_array() : nullptr;
    if (node != nullptr && list == nullptr) sections.push_back(section("contact", "contact"));
    if (list == nullptr) return sections;
    const auto [position, added] = complete.insert_or_assign("contact", toml::array{});
    toml::array& completed = *position->second.as_array();
    for (std::size_t i = 0; i < list->size(); ++i) {
      const std::string path = fmt::format("contact[{}]", i);
      const toml::table* entry = list->get(i)->as_table();
      if (entry == nullptr) {
        throw SceneError(fmt::format("{}: {}: expected a section [[contact]]",
                                     place_of(list->get(i), file), path));
      }
      completed.push_back(toml::table{});
      sections.emplace_back(entry, section_spec("contact"), path, file,
                            *completed.back().as_table());
    }
    return sections;
  }

  SectionReader section(std::string_view name, std::string_view spec) {
    return section(name, section_spec(spec));
  }

  SectionReader section(std::string_view name, SectionSpec spec) {
    const auto [position, added] = complete.insert_or_assign(name, toml::table{});
    return {table(name), spec, std::string(name), file, *position->second.as_table()};
  }
};

void check_sections(const Reading& reading, std::string_view kind) {
  std::vector<std::string_view> known{"title"};
  for (const std::string_view name : sections_of_kind(kind)) known.push_back(name);
  for (const auto& [key, node] : reading.given) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    const std::string near = nearest_name(key.str(), known);
    throw SceneError(fmt::format("{}: {}: unknown in a scene of kind \"{}\"; {}",
                                 place_of(&node, reading.file), key.str(), kind,
                                 near.empty() ? fmt::format("known: {}", fmt::join(known, ", "))
                                              : fmt::format("did you mean \"{}\"?", near)));
  }
}

std::string kind_of(const Reading& reading) {
  const toml::table* model = reading.table("model");
  const toml::node* kind = model != nullptr ? model->get("kind") : nullptr;
  if (kind == nullptr) {
    throw SceneError(fmt::format("{}: model.kind: is missing; expected one of: {}", reading.file,
                                 fmt::join(kinds, ", ")));
  }
  const auto value = kind->value<std::string>();
  if (!value || std::find(kinds.begin(), kinds.end(), *value) == kinds.end()) {
    throw SceneError(fmt::format("{}: model.kind: {} is not available; expected one of: {}",
                                 place_of(kind, reading.file),
                                 value ? "\"" + *value + "\"" : "this", fmt::join(kinds, ", ")));
  }
  return *value;
}

/// One harmonic is meant by a scene that does not say, or leaves it to the program and asks for no
/// more by its effects; and by one that asks for what has all of them.
void complete_harmonics(toml::table& given) {
  toml::table* response = given["response"].as_table();
  if (response == nullptr) return;
  const toml::node* harmonics = response->get("harmonics");
  const bool chosen = harmonics != nullptr && harmonics->value<std::string>() == "auto";
  const bool in_time = given["response"]["method"].value<std::string>() == "time";
  const bool off = given["effects"]["higher_harmonics"].value<std::string>() == "off";
  const bool is_left = harmonics == nullptr || (chosen && off);
  if (is_left && (in_time || off)) response->insert_or_assign("harmonics", 1);
}

/// Preloads of a scene that does not say: the limits, and that of the static loads.
void complete_preload(Reading& reading, const SceneDescription& scene) {
  toml::table* response = reading.given["response"].as_table();
  if (!has_static_preload(scene) || response == nullptr || response->contains("preload")) return;
  response->insert("preload", toml::array{"free", "static", "stuck"});
}

/// Without contact there is no preload to set, and none to choose.
std::string contact_keys_without_contact(const SectionReader& response) {
  for (const char* key : {"preload", "optimum", "maps"}) {
    if (response.given(key)) return response.place(key) + ": the scene has no [contact]";
  }
  return {};
}

/// Files and columns are called by the names of the contacts.
void require_distinct(const std::vector<ContactDescription>& contacts) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactDescription& contact = contacts[i];
    const auto refuse = [&](const std::string& why) {
      throw SceneError(
          fmt::format("{} (the contact \"{}\"): {}", contact.place, contact.name, why));
    };
    if (contacts.size() > 1 && contact.name.find_first_of("/\\,\"\n") != std::string::npos) {
      refuse("a name with one of / \\ , \" can be no file or column; give contact.name");
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (contacts[k].surface == contact.surface) refuse("another contact has the same surface");
      if (contacts[k].name == contact.name) refuse("another contact has the same name");
    }
    if (contact.preload_share.has_value() != contacts.front().preload_share.has_value()) {
      refuse("preload_share: give it to all contacts or to none");
    }
  }
}

/// What modes are solved from: geometry, material, supports; and how many.
SectionReader read_structure(Reading& reading, const std::string& kind, SceneDescription& scene) {
  if (kind == "blade") {
    scene.model = read_blade(reading.section("model", "model.blade"));
  } else if (kind == "step") {
    StepModel model = read_step_file(reading.section("model", "model.step"), reading.folder);
    if (const toml::table* faces = reading.table("faces")) {
      const auto [position, added] = reading.complete.insert_or_assign("faces", toml::table{});
      model.faces = read_faces(*faces, reading.file, *position->second.as_table());
    }
    scene.model = std::move(model);
  } else {
    scene.model = read_mesh_file(reading.section("model", "model.mesh"), reading.folder);
  }
  scene.material = read_material(reading.section("material", "material"));
  const SectionReader supports = reading.section("supports", "supports");
  for (const std::string& name : read_names(supports, "clamped")) {
    scene.clamped.push_back(name_in_mesh(scene.points, name));
  }
  scene.clamped_place = supports.place("clamped");
  const SectionReader loads = reading.section("static", "static");
  scene.rotation = read_rotation(loads);
  scene.static_loads = read_static_loads(loads, scene.points);
  SectionReader modes = reading.section("modes", "modes");
  scene.settings.basis = read_basis(modes);
  scene.modes = read_modes(modes, scene.settings.basis.n_modes);
  const bool rotates = scene.rotation && scene.rotation->speed > 0.0;
  if (rotates && scene.settings.basis.solver == fem::SolverKind::iterative) {
    modes.fail(
        "solver",
        "the equilibrium of [static] speed is found by factorisations: \"direct\" goes with it",
        modes.node("solver"));
  }
  return modes;
}

/// Modes of another code: supports are in them, of the material the density may be known.
SectionReader read_given_structure(Reading& reading, SceneDescription& scene) {
  const SectionReader material = reading.section("material", "material.modes");
  if (material.given("density")) scene.material.density = material.number("density");
  scene.model = read_modes_file(reading.section("model", "model.modes"), reading.folder,
                                scene.material.density > 0.0);
  scene.static_loads = read_static_loads(reading.section("static", "static.modes"), scene.points);
  const bool solved = given_matrices(scene) != nullptr;
  SectionReader modes = reading.section("modes", solved ? "modes" : "modes.modes");
  scene.settings.basis = solved ? read_basis(modes) : read_given_basis(modes);
  scene.modes.damping = read_damping(modes);
  return modes;
}

void read_meshed(Reading& reading, const std::string& kind, SceneDescription& scene) {
  if (const toml::table* points = reading.table("points")) {
    const auto [position, added] = reading.complete.insert_or_assign("points", toml::table{});
    scene.points = read_points(*points, reading.file, *position->second.as_table());
  }
  SectionReader modes =
      kind == "modes" ? read_given_structure(reading, scene) : read_structure(reading, kind, scene);
  BasisSettings& basis = scene.settings.basis;
  for (const SectionReader& section : reading.contacts()) {
    scene.contacts.push_back(read_contact(section, reading.folder));
    scene.settings.patches.push_back(read_patch_settings(section));
    const std::string note = settle_residual(modes, basis, scene.contacts.back());
    if (!note.empty()) scene.modes.residual_note = note;
  }
  require_distinct(scene.contacts);
  SectionReader excitation = reading.section("excitation", "excitation");
  scene.forces = read_forces(excitation, "force", scene.points);
  complete_preload(reading, scene);
  if (reading.given.contains("response")) {
    const SectionReader response = reading.section("response", "response");
    scene.response = read_response(response, kind, scene.points);
    scene.settings.harmonics = read_harmonics(response, *scene.response);
    if (scene.contacts.empty()) scene.without_contact = contact_keys_without_contact(response);
  }
}

void read_modal_scene(Reading& reading, SceneDescription& scene) {
  static_cast<void>(reading.section("model", "model.modal"));
  ModalModel model = read_modal(reading.section("modal", "modal"), reading.folder);
  scene.settings.basis.residual = model.residual;
  scene.rules = read_surface_rules(reading.section("contact", "contact.modal"), reading.folder,
                                   model, scene.wear_coefficient);
  scene.model = std::move(model);
  if (reading.given.contains("response")) {
    const SectionReader response = reading.section("response", "response.modal");
    scene.response = read_modal_response(response, "modal");
    scene.settings.harmonics = read_harmonics(response, *scene.response);
  }
}

/// The kinds that have formulas for their modes end in the same model as a modal scene.
void read_lean_scene(Reading& reading, const std::string& kind, SceneDescription& scene) {
  const auto section = [&](std::string_view name) {
    return reading.section(name, section_spec(name, kind));
  };
  const LeanSections sections{section("model"), section("modes"), section("contact"),
                              section("excitation")};
  std::string coordinate;
  std::optional<BlockOutput> output;
  if (reading.given.contains("response")) {
    SectionReader response = section("response");
    scene.response =
        kind == "bar" ? read_modal_response(response, kind) : read_loads(response, kind);
    scene.settings.harmonics = read_harmonics(response, *scene.response);
    if (kind == "chain") coordinate = response.text("output");
    if (kind == "block") output = read_block_output(response);
  }
  const ModalModel model = kind == "bar"     ? read_bar(sections)
                           : kind == "chain" ? read_chain(sections, coordinate)
                                             : read_block(sections, output, reading.folder,
                                                          scene.rules, scene.wear_coefficient);
  if (model.points.empty() && reading.given.contains("response")) {
    scene.without_contact = contact_keys_without_contact(section("response"));
  }
  scene.settings.basis.residual = model.residual;
  scene.model = model;
}

std::vector<std::string> read_goals(const SectionReader& s) {
  constexpr std::array known{peak_amplitude_goal, peak_frequency_goal, dissipated_energy_goal,
                             optimum_goal};
  const toml::node& node = *s.node("goals");
  const toml::array* list = node.as_array();
  const std::string expected = fmt::format("expected a list of \"{}\"", fmt::join(known, "\", \""));
  if (list == nullptr || list->empty()) s.fail("goals", expected, &node);
  std::vector<std::string> goals;
  for (const toml::node& entry : *list) {
    const auto goal = entry.value<std::string>();
    const bool is_known = goal && std::ranges::find(known, *goal) != known.end();
    if (!is_known) s.fail("goals", expected, &entry);
    goals.push_back(*goal);
  }
  // A best value is found among peaks: they are what is refined.
  const bool alone =
      std::ranges::all_of(goals, [](const auto& one) { return one == optimum_goal; });
  if (alone) goals.emplace_back(peak_amplitude_goal);
  return goals;
}

/// @param closer_is_asked  the scene has a response.harmonic_tolerance of its own,
///                         which may be the smaller one.
AccuracyRequest read_accuracy(const SectionReader& s, bool closer_is_asked,
                              SceneDescription& scene) {
  constexpr std::array<std::string_view, 2> choices{"auto", "off"};
  AccuracyRequest accuracy;
  accuracy.error_budget = s.word("error_budget", choices) == "auto";
  accuracy.tolerance = s.number_or_off("tolerance").value_or(0.0);
  accuracy.budget = s.number_or_off("budget").value_or(accuracy.budget);
  accuracy.extrapolation = s.word("extrapolation", choices) == "auto";
  accuracy.goals = read_goals(s);
  if (accuracy.tolerance == 0.0) return accuracy;
  if (!accuracy.error_budget) {
    s.fail("tolerance",
           "accuracy.error_budget = \"off\" tells no errors to be kept below it; leave one of both "
           "out",
           s.node("tolerance"));
  }
  if (scene.response && scene.response->method == ResponseDescription::Method::time) {
    s.fail("tolerance",
           "response.method = \"time\" has settings of its own and no error budget; set "
           "accuracy.tolerance = \"off\"",
           s.node("tolerance"));
  }
  HarmonicSettings& harmonics = scene.settings.harmonics;
  const double share = share_of_harmonics * accuracy.tolerance;
  if (harmonics.chosen()) {
    const double closer = std::min(harmonics.tolerance, share);
    harmonics = automatic_harmonics(closer_is_asked ? closer : share);
  }
  return accuracy;
}

/// The modes of a mesh reach what closely chosen harmonics are asked: beyond them nothing is.
void let_modes_reach_harmonics(SceneDescription& scene) {
  const HarmonicSettings& harmonics = scene.settings.harmonics;
  const double refined = share_of_harmonics * scene.accuracy.tolerance;
  const double choice = harmonics.chosen() ? harmonics.tolerance : refined;
  const bool close = choice > 0.0 && choice < close_choice;
  const bool from_mesh = !std::holds_alternative<ModalModel>(scene.model) &&
                         given_modes(scene) == nullptr && given_matrices(scene) == nullptr;
  const auto* ratios = std::get_if<std::vector<double>>(&scene.modes.damping);
  const bool ratio_each = ratios != nullptr && ratios->size() > 1;
  BasisSettings& basis = scene.settings.basis;
  const bool attached = basis.residual == ResidualKind::attachment;
  if (!scene.response || !close || !from_mesh || ratio_each || !attached) return;
  const double lowest =
      std::min(scene.response->frequency_begin_hz, scene.response->frequency_end_hz);
  basis.reach = most_close_harmonics * contact::two_pi * lowest;
}

/// Of every key that a user gives, in sections that stand once.
std::map<std::string, std::string, std::less<>> places_of(const Reading& reading) {
  std::map<std::string, std::string, std::less<>> places;
  for (const auto& [section, node] : reading.given) {
    if (!node.is_table()) continue;
    for (const auto& [key, value] : *node.as_table()) {
      if (!value.source().path) continue;  // the program has completed it
      const std::string whole = fmt::format("{}.{}", section.str(), key.str());
      places.emplace(whole, fmt::format("{}: {}", place_of(&value, reading.file), whole));
    }
  }
  return places;
}

SceneDescription scene_of(toml::table given, const std::string& name,
                          const std::filesystem::path& folder) {
  Reading reading{std::move(given), {}, name, folder};
  const std::string kind = kind_of(reading);
  check_sections(reading, kind);
  complete_harmonics(reading.given);
  SceneDescription scene;
  scene.kind = kind;
  scene.file = name;
  if (const toml::node* title = reading.given.get("title")) {
    if (!title->is_string()) {
      throw SceneError(place_of(title, name) + ": title: expected a text in quotes");
    }
    scene.title = *title->value<std::string>();
  }
  reading.complete.insert_or_assign("title", scene.title);
  if (kind == "modal") {
    read_modal_scene(reading, scene);
  } else if (kind == "bar" || kind == "chain" || kind == "block") {
    read_lean_scene(reading, kind, scene);
  } else {
    read_meshed(reading, kind, scene);
  }
  scene.places = places_of(reading);
  require_static_preload(scene);
  read_effects(reading.section("effects", "effects"), reading.given, scene);
  scene.accuracy =
      read_accuracy(reading.section("accuracy", "accuracy"),
                    static_cast<bool>(reading.given["response"]["harmonic_tolerance"]), scene);
  let_modes_reach_harmonics(scene);
  scene.complete_toml = scene_as_toml(reading.complete, kind);
  return scene;
}

/// Both ends of a search must be scenes themselves.
void check_optimum(const SceneDescription& scene) {
  if (!scene.response || !scene.response->optimum || scene.response->optimum->of_preload()) return;
  const OptimumRequest& optimum = *scene.response->optimum;
  for (const double bound : *optimum.range) {
    try {
      static_cast<void>(with_value(scene, optimum.key, bound));
    } catch (const SceneError& error) {
      throw SceneError(fmt::format("response.optimum_range: {:g} is no value of {}: {}", bound,
                                   optimum.key, error.what()));
    }
  }
}

}  // namespace

SceneDescription parse_scene(const std::string& text, const std::string& name,
                             const std::filesystem::path& folder,
                             const std::vector<std::string>& overrides) {
  toml::table given = parse_toml(text, name);
  for (const std::string& assignment : overrides) apply_override(given, assignment);
  SceneDescription scene = scene_of(std::move(given), name, folder);
  check_optimum(scene);
  return scene;
}

namespace {

/// @param left_out  keys of [response].
SceneDescription read_again(const SceneDescription& scene, const std::string& key, double value,
                            const std::vector<const char*>& left_out) {
  const std::string name = scene.file.string();
  toml::table given = parse_toml(scene.complete_toml, name);
  if (toml::table* response = given["response"].as_table()) {
    for (const char* search : left_out) response->erase(search);
  }
  apply_override(given, fmt::format("{}={:.17g}", key, value));
  return scene_of(std::move(given), name, std::filesystem::absolute(scene.file).parent_path());
}

/// How finely a scene is solved, not what it is.
bool is_setting(const std::string& key) {
  return key.starts_with("response.") || key == "model.element_size" || key == "model.edge_size" ||
         key == "model.refinement" || key == "modes.count" || key.ends_with(".points") ||
         key.ends_with(".fit") || key.ends_with("_degree");
}

/// What an accuracy asked for has refined since the scene was read stays.
void keep_refinement(SceneDescription& other, const SceneDescription& scene) {
  other.settings = scene.settings;
  const auto* blade = std::get_if<BladeModel>(&scene.model);
  auto* other_blade = std::get_if<BladeModel>(&other.model);
  if (blade != nullptr && other_blade != nullptr) other_blade->sizes = blade->sizes;
  const auto* step = std::get_if<StepModel>(&scene.model);
  auto* other_step = std::get_if<StepModel>(&other.model);
  if (step != nullptr && other_step != nullptr) {
    other_step->element_size = step->element_size;
    other_step->faces = step->faces;
  }
  const auto* file = std::get_if<MeshFileModel>(&scene.model);
  auto* other_file = std::get_if<MeshFileModel>(&other.model);
  if (file != nullptr && other_file != nullptr) {
    other_file->refinement = file->refinement;
    other_file->midside_nodes = file->midside_nodes;
  }
}

}  // namespace

SceneDescription with_value(const SceneDescription& scene, const std::string& key, double value) {
  SceneDescription other =
      read_again(scene, key, value, {"optimum", "optimum_range", "optimum_at"});
  if (!is_setting(key)) keep_refinement(other, scene);
  leave_out_by_choice(other, left_out_by_choice(scene));
  return other;
}

SceneDescription with_formula_value(SceneDescription scene, const std::string& key, double value) {
  SceneDescription other = read_again(scene, key, value, {});
  scene.model = std::move(other.model);
  scene.complete_toml = std::move(other.complete_toml);
  return scene;
}

SceneDescription read_scene(const std::filesystem::path& file,
                            const std::vector<std::string>& overrides) {
  const bool is_step = is_step_file(file);
  if (is_step || mesh_format(file) != MeshFormat::unknown) {
    throw SceneError(
        fmt::format("{0}: expected a scene (TOML), found a {1}; `microslip init {1} {0} -o "
                    "SCENE.toml` begins one",
                    file.string(), is_step ? "step" : "mesh"));
  }
  const std::string text = read_text(file, largest_scene);
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  return parse_scene(text, file.string(), folder, overrides);
}

}  // namespace microslip::pipelines
