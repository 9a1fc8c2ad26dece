#include "pipelines/run/questions.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "fem/bending_error.hpp"
#include "mesh/surface.hpp"
#include "pipelines/description/curve_request.hpp"
#include "pipelines/description/element_count.hpp"
#include "pipelines/import/mesh_file.hpp"
#include "pipelines/import/named_points.hpp"
#include "pipelines/import/step_mesh.hpp"
#include "pipelines/model/contact_frame.hpp"
#include "pipelines/model/scene_places.hpp"
#include "pipelines/response/response_stage.hpp"

namespace microslip::pipelines {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr double percent = 100.0;
constexpr double least_contact_stiffness = 1e6;     // [N/m³]: softer than any joint
constexpr double largest_contact_stiffness = 1e16;  // a layer of 20 micrometres of steel
constexpr double to_degrees = 180.0 / std::numbers::pi;

/// What is known at a stage; nullptr: later.
struct Facts {
  const SceneDescription& scene;
  const mesh::Mesh* mesh = nullptr;
  const ReducedModel* model = nullptr;
  const std::vector<CurveResult>* curves = nullptr;
};

struct Finding {
  std::string key;
  double value = 0.0;   ///< in the unit of its row
  std::string where{};  ///< what the value is of, in words after it
};
using Findings = std::vector<Finding>;

enum class Stage : std::uint8_t { scene, mesh, modes, response };

/// One question: asked where a finding is below `low` or above `high`.
struct Question {
  Stage stage;
  const char* quantity;
  const char* unit;
  double low, high;   ///< usual
  const char* usual;  ///< examples, "": none
  const char* remedy;
  Findings (*measure)(const Facts&);
  bool is_of_units = false;  ///< what was most likely written in another unit: modes say nothing
};

bool is_meshed(const SceneDescription& scene) {
  return !std::holds_alternative<ModalModel>(scene.model);
}

// What a scene says ------------------------------------------------------------------------------

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

double longest_side(const mesh::Mesh& mesh) { return (mesh.upper() - mesh.lower()).maxCoeff(); }

Findings element_size(const Facts& facts) {
  const auto* blade = std::get_if<BladeModel>(&facts.scene.model);
  if (blade == nullptr) return {};
  const mesh::BladeGeometry& g = blade->geometry;
  const double height = g.root_height + g.platform_height + g.span;
  return {{"model.element_size", percent * blade->sizes.element_size / height,
           fmt::format("({:g} m)", blade->sizes.element_size)}};
}

/// The height of a body that others drew is known once it is meshed.
Findings element_size_of_step(const Facts& facts) {
  const auto* step = std::get_if<StepModel>(&facts.scene.model);
  if (step == nullptr) return {};
  return {{"model.element_size", percent * step->element_size / longest_side(*facts.mesh),
           fmt::format("({:g} m)", step->element_size)}};
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

// What it says of its mesh -----------------------------------------------------------------------

Findings size(const Facts& facts) {
  const double mass = facts.scene.material.density * facts.mesh->volume();
  const bool blade = std::holds_alternative<BladeModel>(facts.scene.model);
  return {{blade ? "model.span" : "model.length_unit", longest_side(*facts.mesh),
           mass > 0.0 ? fmt::format("and the mass {:.3g} kg", mass) : ""}};
}

Findings circumferential_speed(const Facts& facts) {
  if (!facts.scene.rotation) return {};
  const fem::Rotation& rotation = *facts.scene.rotation;
  double radius = 0.0;
  for (const auto& node : facts.mesh->nodes().rowwise()) {
    const Eigen::Vector3d arm = node.transpose() - rotation.origin;
    radius = std::max(radius, rotation.direction.cross(arm).norm());
  }
  return {
      {"static.speed", rotation.speed * radius, fmt::format("({:.3g} m off the axis)", radius)}};
}

/// Share of the nodes of every place in a role that are held.
Findings held_share(const Facts& facts, PlaceRole role, const char* key) {
  Findings findings;
  std::set<Eigen::Index> held;
  const std::vector<ScenePlace> places = scene_places(*facts.mesh, facts.scene);
  for (const ScenePlace& place : places) {
    if (place.role == PlaceRole::clamped) held.insert(place.nodes.begin(), place.nodes.end());
  }
  for (const ScenePlace& place : places) {
    if (place.role != role) continue;
    const auto n =
        std::ranges::count_if(place.nodes, [&](Eigen::Index node) { return held.contains(node); });
    findings.push_back({key,
                        percent * static_cast<double>(n) / static_cast<double>(place.nodes.size()),
                        fmt::format("of \"{}\"", place.name)});
  }
  return findings;
}

Findings held_contact(const Facts& facts) {
  return held_share(facts, PlaceRole::contact, "supports.clamped");
}
Findings held_force(const Facts& facts) {
  return held_share(facts, PlaceRole::force, "excitation.forces");
}
Findings held_output(const Facts& facts) {
  return held_share(facts, PlaceRole::output, "response.output");
}

/// Angle between the slip direction as given and the face.
Findings slip_angle(const Facts& facts) {
  Findings findings;
  for (const ContactDescription& contact : facts.scene.contacts) {
    const double cosine = std::min(1.0, steepest_place(*facts.mesh, contact).sine);
    findings.push_back({contact.key + ".slip_direction", to_degrees * std::acos(cosine),
                        fmt::format("against \"{}\"", contact.surface)});
  }
  return findings;
}

/// Linear elements cannot keep their volume while they bend:
/// the nearer ν is to 0.5 the stiffer they are.
Findings locking(const Facts& facts) {
  for (const mesh::ElementBlock& block : facts.mesh->elements()) {
    if (mesh::is_quadratic(block.type)) continue;
    Findings findings = poissons_ratio(facts);
    for (Finding& finding : findings)
      finding.where = fmt::format("in {} elements", name(block.type));
    return findings;
  }
  return {};
}

/// Modes and matrices that are given come from elements of another code.
Findings stiff_in_bending(const Facts& facts) {
  const auto* file = std::get_if<MeshFileModel>(&facts.scene.model);
  if (file != nullptr && (file->modes || file->matrices)) return {};
  if (facts.mesh->elements().empty()) return {};
  const mesh::ElementType type = facts.mesh->elements().front().type;
  return {{"model.file", percent * fem::bending_error(*facts.mesh),
           fmt::format("too high, by {} elements of this size", name(type))}};
}

Findings pressure(const Facts& facts) {
  Findings findings;
  for (std::size_t i = 0; i < facts.scene.contacts.size(); ++i) {
    for (const PatchPreload& preload : patch_preloads(*facts.mesh, facts.scene, i)) {
      findings.push_back(
          {"response.preload", preload.pressure,
           fmt::format("on \"{}\" under {}", facts.scene.contacts[i].surface, preload.text)});
    }
  }
  return findings;
}

/// Of places from the centroid of a face along p and r [m].
Eigen::AlignedBox2d box_of(const mesh::Mesh& mesh, const ContactDescription& contact) {
  const mesh::Surface& surface = mesh.surface(contact.surface);
  const Eigen::MatrixX3d nodes = mesh.nodes()(surface.nodes, Eigen::all);
  const auto [p, r] = in_plane(nodes, mesh::fit_plane(mesh.nodes(), surface).centroid,
                               contact_frame(mesh, contact));
  return {Eigen::Vector2d(p.minCoeff(), r.minCoeff()), Eigen::Vector2d(p.maxCoeff(), r.maxCoeff())};
}

double reach(const Eigen::AlignedBox2d& box) {
  return box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
}

std::string extents(const Eigen::AlignedBox2d& box) {
  return fmt::format("p {:.4g} to {:.4g}, r {:.4g} to {:.4g} m", box.min().x(), box.max().x(),
                     box.min().y(), box.max().y());
}

/// How far tables over a face reach.
Findings reach_of_tables(const Facts& facts) {
  Findings findings;
  for (const ContactDescription& contact : facts.scene.contacts) {
    const auto look_at = [&](const Field& field, const char* key) {
      if (!field.table_box) return;
      const Eigen::AlignedBox2d face = box_of(*facts.mesh, contact);
      findings.push_back({fmt::format("{}.{}", contact.key, key),
                          reach(*field.table_box) / reach(face),
                          fmt::format("as far as the face (table {}; face {})",
                                      extents(*field.table_box), extents(face))});
    };
    look_at(contact.friction, "friction_coefficient");
    if (contact.preload_field) look_at(*contact.preload_field, "preload_field");
  }
  return findings;
}

Findings distance_of_points(const Facts& facts) {
  Findings findings;
  for (const LocatedPoint& point : locate_points(*facts.mesh, facts.scene)) {
    findings.push_back({point.place, percent * point.distance / point.element_size,
                        fmt::format("({:.3g} m) from \"{}\"", point.distance, point.name)});
  }
  return findings;
}

/// Names of the mesh in the scene, each with its first key.
std::map<std::string, std::string> names_used(const SceneDescription& scene) {
  std::map<std::string, std::string> keys;
  for (const ContactDescription& contact : scene.contacts) {
    keys.emplace(contact.surface, contact.key + ".surface");
  }
  for (const std::string& name : scene.clamped) keys.emplace(name, "supports.clamped");
  for (const ForceDescription& force : scene.forces) keys.emplace(force.at, "excitation.forces");
  for (const ForceDescription& force : scene.static_loads.forces) {
    keys.emplace(force.at, "static.forces");
  }
  for (const PressureDescription& entry : scene.static_loads.pressures) {
    keys.emplace(entry.surface, "static.pressure");
  }
  if (scene.response) keys.emplace(scene.response->output.at, "response.output");
  return keys;
}

/// A surface and a node set of one name are two things where their nodes differ.
Findings two_of_one_name(const Facts& facts) {
  const mesh::Mesh& mesh = *facts.mesh;
  const std::vector<std::string> surfaces = mesh.surface_names();
  Findings findings;
  for (const auto& [name, key] : names_used(facts.scene)) {
    const auto set = mesh.node_sets().find(name);
    if (set == mesh.node_sets().end() || set->second.empty()) continue;
    if (std::ranges::count(surfaces, name) == 0) continue;
    const std::vector<Eigen::Index>& on_surface = mesh.surface(name).nodes;
    const std::set<Eigen::Index> a(on_surface.begin(), on_surface.end());
    const std::set<Eigen::Index> b(set->second.begin(), set->second.end());
    std::vector<Eigen::Index> apart;
    std::ranges::set_symmetric_difference(a, b, std::back_inserter(apart));
    findings.push_back({key, static_cast<double>(apart.size()),
                        fmt::format("of surface \"{}\" ({} nodes) and node set \"{}\" ({} nodes)",
                                    name, a.size(), name, b.size())});
  }
  return findings;
}

// What the modes say -----------------------------------------------------------------------------

/// Natural frequencies of the two linear limits [Hz], ascending, as many of each.
struct LimitFrequencies {
  Eigen::VectorXd free, stuck;
  double last = 0.0;  ///< of the modes, without static shapes
};

LimitFrequencies limit_frequencies(const ReducedModel& model) {
  LimitFrequencies limits{.free = model.frequency / (2.0 * std::numbers::pi),
                          .stuck = stuck_frequencies(model)};
  limits.last = limits.free.head(limits.free.size() - model.n_attachment).maxCoeff();
  std::ranges::sort(limits.free);
  return limits;
}

std::pair<double, double> range_of(const SceneDescription& scene) {
  return std::minmax({scene.response->frequency_begin_hz, scene.response->frequency_end_hz});
}

/// Given modes may be all there are: of them the beginning of the range counts, else its end.
Findings range_beyond_modes(const Facts& facts) {
  if (!facts.scene.response) return {};
  const double last = limit_frequencies(*facts.model).last;
  const auto [low, high] = range_of(facts.scene);
  if (!(last > 0.0)) return {};
  return {{"response.frequency", percent * (is_meshed(facts.scene) ? high : low) / last,
           fmt::format("of the last natural frequency, {:.6g} Hz", last)}};
}

/// Of a range that lies above the last mode altogether,
/// though not far enough for the question before.
Findings range_above_modes(const Facts& facts) {
  if (!facts.scene.response || !is_meshed(facts.scene)) return {};
  const double last = limit_frequencies(*facts.model).last;
  const auto [low, high] = range_of(facts.scene);
  if (!(last > 0.0) || high > 1.5 * last) return {};
  return {{"response.frequency", percent * low / last,
           fmt::format("of the last natural frequency, {:.6g} Hz", last)}};
}

/// Frequencies of another code may be angular ones. "": that would not explain a range without any.
std::string angular_hint(const SceneDescription& scene, const Eigen::VectorXd& frequencies,
                         std::pair<double, double> range) {
  if (given_modes(scene) == nullptr) return {};
  const Eigen::ArrayXd divided = frequencies.array() / (2.0 * std::numbers::pi);
  const auto n = (divided >= range.first && divided <= range.second).count();
  return n == 0
             ? std::string()
             : fmt::format("; divided by 2 pi, {} of them would be: does the file have rad/s?", n);
}

/// Modes that have the range, or a part of it, between their free and their stuck frequency.
Findings modes_in_range(const Facts& facts) {
  if (!facts.scene.response) return {};
  const auto [low, high] = range_of(facts.scene);
  if (low == high) return {};  // one point, not a search for a peak
  const LimitFrequencies limits = limit_frequencies(*facts.model);
  constexpr double margin = 0.02;  // damping and excitation move a peak a little
  int n = 0;
  Eigen::Index nearest = 0;
  double distance = unlimited;
  for (Eigen::Index i = 0; i < limits.free.size(); ++i) {
    const double from = (1.0 - margin) * limits.free[i];
    const double to = (1.0 + margin) * std::max(limits.free[i], limits.stuck[i]);
    if (from <= high && to >= low) ++n;
    const double away = std::max(from - high, low - to);
    if (away < distance) nearest = i;
    distance = std::min(distance, away);
  }
  const std::string hint = n > 0 ? "" : angular_hint(facts.scene, limits.free, {low, high});
  return {
      {"response.frequency", static_cast<double>(n),
       fmt::format("between {:g} and {:g} Hz; the nearest has {:.6g} Hz free, {:.6g} Hz stuck{}",
                   low, high, limits.free[nearest], limits.stuck[nearest], hint)}};
}

std::string stiffness_text(const std::optional<double>& stiffness) {
  return stiffness ? fmt::format("{:g} N/m^3", *stiffness) : "rigid";
}

/// Of the modes that have the range, or a part of it, between their limits; of all where none has.
double largest_shift(const LimitFrequencies& limits, std::pair<double, double> range) {
  double inside = -1.0;
  double anywhere = 0.0;
  for (Eigen::Index i = 0; i < limits.free.size() && limits.free[i] <= limits.last; ++i) {
    const double shift = (limits.stuck[i] - limits.free[i]) / limits.free[i];
    anywhere = std::max(anywhere, shift);
    const bool meets = limits.free[i] <= range.second && limits.stuck[i] >= range.first;
    if (meets) inside = std::max(inside, shift);
  }
  return inside < 0.0 ? anywhere : inside;
}

/// A contact that sticks moves the natural frequencies, or it does nothing. Asked before where a
/// stiffness is not usual by itself.
Findings shift_by_sticking(const Facts& facts) {
  if (facts.scene.contacts.empty() || !facts.scene.response) return {};
  const ContactDescription& contact = facts.scene.contacts.front();
  for (const auto* stiffness : {&contact.normal_stiffness, &contact.tangential_stiffness}) {
    if (*stiffness && **stiffness<least_contact_stiffness&&* * stiffness> 0.0) return {};
  }
  return {{contact.key + ".normal_stiffness",
           percent * largest_shift(limit_frequencies(*facts.model), range_of(facts.scene)),
           fmt::format("by a contact that sticks (normal_stiffness {}, tangential_stiffness {})",
                       stiffness_text(contact.normal_stiffness),
                       stiffness_text(contact.tangential_stiffness))}};
}

/// Given modes move as they move; the axes of a face are chosen in the scene.
Findings motion_along_r(const Facts& facts) {
  if (facts.scene.contacts.empty()) return {};
  return {{facts.scene.contacts.front().key + ".slip_direction",
           percent * facts.model->effects.motion_ratio, "of that along p"}};
}

// What the curves say ----------------------------------------------------------------------------

/// Beside other curves the limits do not count: no blade moves like that.
Findings amplitude(const Facts& facts) {
  Finding largest{"excitation.forces", 0.0};
  const auto is_limit = [](const CurveResult& result) {
    return std::holds_alternative<LimitName>(result.load);
  };
  const bool limits_alone = std::ranges::all_of(*facts.curves, is_limit);
  for (const CurveResult& result : *facts.curves) {
    if (is_limit(result) && !limits_alone) continue;
    for (const solver::ResponsePoint& point : result.curve.points) {
      const double share = percent * point.amplitude / longest_side(*facts.mesh);
      if (share <= largest.value) continue;
      largest.value = share;
      largest.where = fmt::format("of the longest side of the mesh ({:.3g} m, curve {})",
                                  point.amplitude, result.name);
    }
  }
  return {largest};
}

constexpr std::array table{
    Question{Stage::scene, "Young's modulus", "Pa", 1e9, 1.3e12,
             "plastics 3e9, titanium 1.1e11, steel 2.1e11", "is it in MPa or GPa? give the unit",
             youngs_modulus, true},
    Question{Stage::scene, "Poisson's ratio", "", 0.0, 0.495, "metals 0.3",
             "is it another property?", poissons_ratio},
    Question{Stage::scene, "the density", "kg/m^3", 300.0, 25000.0,
             "composites 1600, titanium 4400, steel 7800",
             "is it in g/cm^3 or t/mm^3? give the unit", density, true},
    Question{Stage::scene, "the normal stiffness per area", "N/m^3", least_contact_stiffness,
             largest_contact_stiffness, "metal faces 1e11 to 1e15",
             "is it in N/mm^3 (1 N/mm^3 = 1e9 N/m^3)? give the unit; or \"rigid\"",
             normal_stiffness, true},
    Question{Stage::scene, "the tangential stiffness per area", "N/m^3", least_contact_stiffness,
             largest_contact_stiffness, "metal faces 1e11 to 1e15",
             "is it in N/mm^3 (1 N/mm^3 = 1e9 N/m^3)? give the unit; or \"rigid\"",
             tangential_stiffness, true},
    Question{Stage::scene, "the element size", "% of the blade's height",
             percent* smallest_usual_element, percent* largest_usual_element, "",
             "is it in millimetres? give the unit", element_size},
    Question{Stage::scene, "the friction coefficient", "", 0.0, 2.0, "metals 0.1 to 1",
             "is it in percent? give it so, \"40 %\"", friction_coefficient},
    Question{Stage::scene, "the damping ratio", "%", 0.0, 20.0, "blades 0.01 to 2",
             "is it in percent already? then write \"0.2 %\"; is it a quality factor?",
             damping_ratio},
    Question{Stage::scene, "the damping ratio", "%", 0.0, 20.0, "blades 0.01 to 2",
             "are alpha in rad/s and beta in s? zeta = (alpha/omega + beta omega)/2",
             rayleigh_damping},
    Question{Stage::scene, "a load is given", "×", 1.0, 1.0, "", "each makes the same curve",
             repeated_preload},
    Question{Stage::mesh, "the element size", "% of the blade's height",
             percent* smallest_usual_element, percent* largest_usual_element, "",
             "is it in millimetres? give the unit", element_size_of_step},
    Question{Stage::mesh, "the longest side of the mesh", "m", 2e-3, 3.0, "blades 0.02 to 3",
             "is the file in another unit than length_unit says?", size, true},
    Question{Stage::mesh, "the speed of the outermost point", "m/s", 0.0, 900.0,
             "blades 200 to 600",
             "is it in rpm? give the unit; does the axis stand where it should, in metres?",
             circumferential_speed},
    Question{Stage::mesh, "the clamped share", "% of the nodes", 0.0, 50.0, "",
             "what is held does not rub", held_contact},
    Question{Stage::mesh, "the clamped share", "% of the nodes", 0.0, 99.0, "",
             "a force on what is held moves nothing", held_force},
    Question{Stage::mesh, "the clamped share", "% of the nodes", 0.0, 99.0, "",
             "what is held does not move", held_output},
    Question{Stage::mesh, "the slip direction rises", "degrees", 0.0, 60.0, "",
             "it is nearly the normal, and p is the little of it that lies in the face",
             slip_angle},
    Question{
        Stage::mesh, "Poisson's ratio", "", -1.0, 0.45, "",
        "linear elements of a material that keeps its volume lock, frequencies come out too high; "
        "use quadratic ones",
        locking},
    Question{Stage::mesh, "in bending, frequencies may be", "%", 0.0, 2.0, "",
             "linear elements are too stiff there; use quadratic ones (gmsh -order 2) or more over "
             "the thickness",
             stiff_in_bending},
    Question{Stage::mesh, "the mean pressure", "Pa", 0.0, 3e9, "yield of steels 3e8 to 2e9",
             "is the preload in newtons, the mesh in its unit?", pressure},
    Question{Stage::mesh, "the table reaches", "times", 0.0, 3.0, "",
             "p and r are in metres from the centroid of the face; are they in millimetres? divide "
             "them by 1000",
             reach_of_tables},
    Question{Stage::mesh, "the nearest node is", "% of an element", 0.0, 100.0, "",
             "is the point on the body, and in the axes of the mesh?", distance_of_points},
    Question{Stage::mesh, "the number of nodes that are not in both", "", 0.0, 0.0, "",
             "a contact, a pressure, forces and output take the surface, supports the set; rename "
             "one of them in the file if that is not what you mean",
             two_of_one_name},
    Question{Stage::modes, "the frequency range reaches", "%", 0.0, 150.0, "",
             "modes beyond the last are left out; raise modes.count or lower the range",
             range_beyond_modes},
    Question{Stage::modes, "the frequency range rises from", "%", 0.0, 100.0, "",
             "the modes in and above it are left out; raise modes.count", range_above_modes},
    Question{Stage::modes, "the number of modes", "", 1.0, unlimited, "",
             "the curve has no peak of theirs; is the range the right one?", modes_in_range},
    Question{Stage::modes, "the largest shift of a natural frequency", "%", 0.01, unlimited, "",
             "stuck is the same as free: is the stiffness in N/mm^3? give the unit; does the face "
             "move in these modes?",
             shift_by_sticking},
    Question{Stage::modes, "motion along r is", "%", 0.0, 200.0, "",
             "does the face slide along r rather? turn the slip direction", motion_along_r},
    Question{Stage::response, "the largest amplitude is", "%", 0.0, 2.0, "",
             "vibrations are taken as small; are force, damping and units right?", amplitude},
};

std::string usual_text(const Question& question) {
  std::string text = question.low == question.high ? fmt::format("{:g}", question.high)
                     : question.high == unlimited  ? fmt::format("at least {:g}", question.low)
                     : question.low == 0.0
                         ? fmt::format("at most {:g}", question.high)
                         : fmt::format("{:g} to {:g}", question.low, question.high);
  if (*question.unit != 0) text += fmt::format(" {}", question.unit);
  if (*question.usual != 0) text += fmt::format(" ({})", question.usual);
  return text;
}

/// "is" stands between a quantity and its value unless the quantity brings its verb.
std::string sentence(const Question& question, const Finding& finding) {
  const std::string_view quantity = question.quantity;
  const bool has_verb = quantity.ends_with("is") || quantity.ends_with("be") ||
                        quantity.ends_with("given") || quantity.ends_with("rises") ||
                        quantity.ends_with("reaches") || quantity.ends_with("from");
  std::string text =
      fmt::format("{}: {} {}{:.4g}", finding.key, quantity, has_verb ? "" : "is ", finding.value);
  if (*question.unit != 0) text += fmt::format(" {}", question.unit);
  if (!finding.where.empty()) text += " " + finding.where;
  return text + fmt::format("; usual is {}: {}", usual_text(question), question.remedy);
}

bool is_usual(const Question& question, const Finding& finding) {
  return finding.value >= question.low && finding.value <= question.high;
}

std::vector<std::string> asked(Stage stage, const Facts& facts) {
  std::vector<std::string> sentences;
  for (const Question& question : table) {
    if (question.stage != stage) continue;
    for (const Finding& finding : question.measure(facts)) {
      if (!is_usual(question, finding)) sentences.push_back(sentence(question, finding));
    }
  }
  return sentences;
}

/// The file counts. @return "": the scene says the same, or nothing
std::string order_question(const SceneDescription& scene, const mesh::Mesh& mesh) {
  const auto* file = std::get_if<MeshFileModel>(&scene.model);
  if (file == nullptr || !file->order) return {};
  const mesh::ElementType type = mesh.elements().front().type;
  const int order = mesh::is_quadratic(type) ? 2 : 1;
  if (order == *file->order) return {};
  return fmt::format(
      "model.order: {} is written, the elements of {} are of order {} ({}), and are taken as they "
      "are: is it the file that is meant?",
      *file->order, file->file.filename().string(), order, name(type));
}

/// Of a STEP file; those of meshes are among the remarks of the mesh.
std::string step_unit_question(const SceneDescription& scene, const mesh::Mesh& mesh) {
  const auto* step = std::get_if<StepModel>(&scene.model);
  return step == nullptr ? std::string{}
                         : unit_question(step->file, step->length_unit, unit_of_file(*step),
                                         longest_side(mesh) / step->length_unit.value_or(1.0));
}

}  // namespace

std::vector<std::string> questions(const SceneDescription& scene) {
  return asked(Stage::scene, {.scene = scene});
}

std::vector<std::string> questions(const SceneDescription& scene, const mesh::Mesh& mesh) {
  std::vector<std::string> sentences = mesh.remarks();
  for (const std::string& question :
       {order_question(scene, mesh), step_unit_question(scene, mesh)}) {
    if (!question.empty()) sentences.push_back(question);
  }
  for (std::string& sentence : asked(Stage::mesh, {.scene = scene, .mesh = &mesh})) {
    sentences.push_back(std::move(sentence));
  }
  return sentences;
}

bool may_be_in_other_units(const SceneDescription& scene, const mesh::Mesh& mesh) {
  const Facts facts{.scene = scene, .mesh = &mesh};
  return std::ranges::any_of(table, [&](const Question& question) {
    return question.is_of_units && std::ranges::any_of(question.measure(facts), [&](const auto& f) {
             return !is_usual(question, f);
           });
  });
}

std::vector<std::string> questions(const SceneDescription& scene, const ReducedModel& model) {
  return asked(Stage::modes, {.scene = scene, .model = &model});
}

std::vector<std::string> questions(const SceneDescription& scene, const mesh::Mesh& mesh,
                                   const std::vector<CurveResult>& curves) {
  return asked(Stage::response, {.scene = scene, .mesh = &mesh, .curves = &curves});
}

}  // namespace microslip::pipelines
