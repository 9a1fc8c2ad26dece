/// @file
/// A scene as the user wrote it, every default filled in, in SI (frequencies in Hz as written).
/// Made by scene_file, read by study and the writers; plain values.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "contact/patch.hpp"
#include "fem/material.hpp"
#include "fem/rotation.hpp"
#include "mesh/blade_geometry.hpp"
#include "pipelines/description/discretisation.hpp"
#include "pipelines/description/field.hpp"
#include "pipelines/description/goal_names.hpp"

namespace microslip::pipelines {

struct BladeModel {
  mesh::BladeGeometry geometry;
  mesh::ElementSizes sizes;
};

/// A face of a STEP file by what a person sees of it: a point on it, its normal, or its number.
struct FaceChoice {
  std::optional<Eigen::Vector3d> point;   ///< on the face [m]
  std::optional<Eigen::Vector3d> normal;  ///< outward, unit
  std::optional<Eigen::Vector3d> near;    ///< of faces with that normal the nearest to it [m]
  std::optional<int> number;              ///< as `microslip faces` tells
  std::optional<double> size, edge_size;  ///< of elements on the face, and at its edges [m]
};

/// An entry of [faces].
struct FaceDescription {
  std::string name;
  std::vector<FaceChoice> choices;  ///< one or several, together the surface
  std::string place;                ///< "file:line: key", for messages
};

/// The solid of a STEP file, meshed here.
struct StepModel {
  std::filesystem::path file;         ///< absolute
  double element_size = 0.004;        ///< [m]
  std::optional<double> length_unit;  ///< metres per unit, in place of what the file says
  std::vector<FaceDescription> faces;
  std::string place;         ///< "file:line: key" of `file`, for messages
  std::string length_place;  ///< … of `length_unit`
  std::string size_place;    ///< … of `element_size`
};

/// Modes of another code, on the mesh of the model.
struct ModesFile {
  std::filesystem::path file;  ///< absolute
  double mass_unit = 1.0;      ///< of the shapes: ΦᵀMΦ = 1 in it [kg]
  bool rescaled = false;       ///< to ΦᵀMΦ = 1 by the mass of mesh and density
  std::string place;           ///< "file:line: key" of `file`, for messages
};

/// Stiffness and mass of another code, on the mesh of the model.
struct MatrixFiles {
  std::filesystem::path stiffness, mass;  ///< Matrix Market, absolute
  std::filesystem::path nodes;            ///< places of the nodes and their rows, absolute
  double mass_unit = 1.0;                 ///< [kg]; of the stiffness: N per unit of length
  std::string place;                      ///< "file:line: key" of `nodes`, for messages
};

struct MeshFileModel {
  std::filesystem::path file;           ///< absolute
  std::optional<double> length_unit;    ///< metres per unit of the file; none: as the file says
  std::string place;                    ///< "file:line: key" of `file`, for messages
  std::optional<int> order;             ///< of its elements as the scene says; the file counts
  std::optional<ModesFile> modes;       ///< none: the modes are solved for
  std::optional<MatrixFiles> matrices;  ///< none: K and M are those of the finite elements
  int refinement = 0;  ///< times that each element is cut along each edge (mesh/refined_mesh.hpp)
  bool midside_nodes = false;  ///< linear elements get some, and are quadratic
};

using contact::LoadMeasure;
using contact::TiltedArea;

/// Modes and contact points given directly (interfaces.md, modal scenes), or by the formulas of the
/// kinds `bar`, `chain` and `block`.
struct ModalModel {
  Eigen::VectorXd frequency_hz;
  Eigen::VectorXd damping_ratio;
  Eigen::VectorXd force_sine, force_cosine, force_static;  ///< [N/√kg]
  Eigen::VectorXd output;
  Eigen::VectorXd weights;
  std::vector<contact::PointParameters> points;
  contact::ModalShapes shapes;
  Eigen::VectorXd second_stiffness;  ///< along r [N/m³]; empty: that along p
  Eigen::MatrixX2d positions;        ///< (p, r) per point [m]; 0 rows when the scene gives none
  LoadMeasure load_measure = LoadMeasure::scale;  ///< force: the rest loads sum to 1 N
  std::vector<TiltedArea> tilted_areas;           ///< where moments act beside the load
  ResidualKind residual = ResidualKind::none;  ///< stiffness: that of the points has it in series
  Eigen::MatrixX3d compliance;    ///< that residual along p, q, r [m³/N]; 0 rows: not known apart
  Eigen::Index n_attachment = 0;  ///< so many modes, the last, are attachment shapes
  std::optional<double> local_stiffness;  ///< contact.tangential_stiffness where that is so [N/m²]
};

struct RayleighDamping {
  double alpha = 0.0;  ///< [1/s]
  double beta = 0.0;   ///< [s]
};

struct ModesDescription {
  std::variant<std::vector<double>, RayleighDamping>
      damping;  ///< ratios: one for all, or one per mode
  /// That a rigid contact made the residual `stiffness`, which the scene did not say; else empty.
  std::string residual_note;
};

/// One patch of a meshed scene.
struct ContactDescription {
  std::string name;  ///< of its columns and files where there are several; else that of the surface
  std::string key = "contact";  ///< path of its section, for messages: "contact", or "contact[1]"
  std::string surface;
  std::string place;       ///< "file:line: key" of `surface`, for messages
  std::string slip_place;  ///< … of `slip_direction`
  Eigen::Vector3d slip_direction = Eigen::Vector3d::UnitZ();
  Field friction;                      ///< μ over the patch, in p and r from its centroid
  std::optional<Field> preload_field;  ///< shape of the preload; none: uniform
  /// "file:line: key" of preload = "static", the static preload in place of a preload field; empty:
  /// not given.
  std::string static_preload_place;
  double gap = 0.0;  ///< before the static loads act [m]; below 0: interference
  std::array<double, 2> preload_moment{0.0, 0.0};  ///< about p and r through the centroid [N m]
  std::optional<double> normal_stiffness;          ///< [N/m³]; without value: "rigid"
  std::optional<double> tangential_stiffness;      ///< [N/m³]; without value: "rigid"
  double wear_coefficient = 0.0;                   ///< Archard [m²/N]
  std::optional<double>
      preload_share;            ///< of the load of a curve, relative to the others; none: by area
  contact::SurfaceRules rules;  ///< friction law and roughness; their local stiffness is that above
  /// Whether every place of the face has axes of its own; without value: where it is not plane.
  std::optional<bool> local_frames;
};

/// A point of the scene: an entry of [points], or coordinates that stand where a name is asked for.
struct PointDescription {
  std::string
      name;  ///< of the node set the mesh is given; coordinates as text where they have none
  std::variant<Eigen::Vector3d, std::string> of;  ///< coordinates [m], or a name of the mesh
  std::string place;                              ///< "file:line: key", for messages
};

struct ForceDescription {
  std::string at;  ///< a name of the mesh, or of a point that has coordinates
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< normalised
  double amplitude = 0.0;                                ///< [N], total over the nodes of `at`
  double phase_deg = 0.0;
  std::string place;  ///< "file:line: key" of `at`, for messages
};

/// A pressure that does not vary, against a surface from outside.
struct PressureDescription {
  std::string surface;
  double pressure = 0.0;  ///< [Pa]; below 0: suction
  std::string place;      ///< "file:line: key" of `surface`, for messages
};

/// Loads that do not vary, beside those of the rotation.
struct StaticLoads {
  std::vector<ForceDescription> forces;  ///< without phase
  std::vector<PressureDescription> pressures;
  std::string place;  ///< "file:line: key" of the first, for messages; empty: there is none
};

struct OutputDescription {
  std::string at;  ///< as that of a force
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  std::string place;  ///< "file:line: key" of `at`, for messages
};

enum class LimitName { free, stuck };
/// A uniform gap given as a length: the same whatever stiffness the contact has.
struct UniformGap {
  double width = 0.0;  ///< [m], > 0
  [[nodiscard]] bool operator==(const UniformGap&) const = default;
};
/// What the static loads make of it.
struct StaticPreload {
  [[nodiscard]] bool operator==(const StaticPreload&) const = default;
};
/// [N], a linear limit, a gap, or that of the static loads.
using PreloadEntry = std::variant<double, LimitName, UniformGap, StaticPreload>;
enum class MapName { peak, folds };
using MapEntry = std::variant<MapName, double>;  ///< or a frequency [Hz]

/// A motion integrated in time has all harmonics; at least so many are kept of it.
inline constexpr int least_harmonics_of_time = 60;
/// Where harmonics are given, the highest peak is solved again with so many more
/// (response/harmonics_check.hpp).
inline constexpr int harmonics_of_a_check = 8;

/// The one number of a scene whose best value is searched.
struct OptimumRequest {
  std::string key;  ///< "preload", or the key of another number: "contact.friction_coefficient"
  std::optional<std::array<double, 2>> range;  ///< in SI; none: between the positive preloads
  /// Under which another key is searched: preload [N], or scale; none: that of the static loads.
  std::optional<double> load;
  std::string unit{};  ///< of the number in SI; empty: it has none, or is the preload

  [[nodiscard]] bool of_preload() const { return key == "preload"; }
};

struct ResponseDescription {
  OutputDescription output;  ///< kinds with a mesh
  double frequency_begin_hz = 0.0;
  double frequency_end_hz = 0.0;  ///< equal to begin: the solution at one frequency
  enum class Method { harmonic_balance, time } method = Method::harmonic_balance;
  /// Of a search for detached branches; 0: none; without value: as the effect `coexistence` says.
  std::optional<int> search_starts{};
  double time_budget = std::numeric_limits<double>::infinity();  ///< of one curve [s]
  int n_time_points = 40;                                        ///< frequencies of method = "time"
  int steps_per_period = 0;  ///< of method = "time": fixed steps; 0: changes of contact are located
  std::string steps_place;   ///< "file:line: key" of it, for messages
  std::vector<PreloadEntry> preload;       ///< kinds with a mesh; one curve each
  std::vector<double> preload_scale{1.0};  ///< modal scenes; one curve each
  bool limits = true;                      ///< modal scenes: free and stuck curves as well
  std::optional<OptimumRequest> optimum;
  std::vector<MapEntry> maps;
  int map_phases = 24;
};

/// [accuracy]
struct AccuracyRequest {
  bool error_budget = true;  ///< each choice of the discretisation is refined at the peaks
  double tolerance = 0.0;    ///< of the goals, relative; 0: settings as written
  /// What the tolerance is kept for: a best value is judged by it, not refined.
  std::vector<std::string> goals{peak_amplitude_goal, peak_frequency_goal};
  double budget = std::numeric_limits<double>::infinity();  ///< wall time of a run [s]
  bool extrapolation = true;  ///< of modes to elements of no size, where a tolerance is asked for
};

struct SceneDescription {
  std::string title;
  std::string kind;            ///< of its model, as written
  std::filesystem::path file;  ///< the scene file, "" for text
  std::variant<BladeModel, MeshFileModel, ModalModel, StepModel> model;
  fem::Material material;
  std::vector<std::string> clamped;
  std::string clamped_place;  ///< "file:line: key" of `clamped`, for messages
  std::optional<fem::Rotation>
      rotation;              ///< of the whole structure; speed 0 where only an axis is given
  StaticLoads static_loads;  ///< kinds with a mesh
  ModesDescription modes;
  std::vector<ContactDescription> contacts;  ///< kinds with a mesh; none: nothing rubs
  contact::SurfaceRules rules;               ///< of modal scenes
  double wear_coefficient = 0.0;             ///< of modal scenes, Archard [m²/N]
  std::vector<PointDescription> points;      ///< kinds with a mesh
  std::vector<ForceDescription> forces;
  std::optional<ResponseDescription> response;
  /// Why `run` refuses: [response] speaks of a contact the scene does not have. Empty: it does not.
  std::string without_contact;
  std::string complete_toml;  ///< the scene with --set and every default written out: scene.toml
  std::vector<std::pair<std::string, std::string>> effects;  ///< [effects] name → auto | on | off
  /// "section.key" → "file:line: section.key", of what a user gives in sections that stand once.
  std::map<std::string, std::string, std::less<>> places;
  bool areas = true;  ///< contact acts on areas; else on one point in the middle of each
  bool uniform_static_preload = false;  ///< of a static preload its force alone counts
  bool judges_stability = true;         ///< of points
  /// The scene as its keys give it, where effects that are "off" are taken out of this one
  /// (effects_left_out.hpp); nullptr: nothing is. Shared: copies of a scene were written alike.
  std::shared_ptr<const SceneDescription> written;
  Discretisation settings;
  AccuracyRequest accuracy;
};

/// Of a scene whose geometry is meshed here [m]; none: it has a mesh, or needs none.
[[nodiscard]] inline std::optional<double> element_size_of(const SceneDescription& scene) {
  if (const auto* blade = std::get_if<BladeModel>(&scene.model)) return blade->sizes.element_size;
  if (const auto* step = std::get_if<StepModel>(&scene.model)) return step->element_size;
  return std::nullopt;
}

/// Whether elements of a scene's file may be cut or get more nodes; else modes belong to them.
[[nodiscard]] inline bool is_mesh_refined_here(const SceneDescription& scene) {
  const auto* file = std::get_if<MeshFileModel>(&scene.model);
  return file != nullptr && !file->modes && !file->matrices;
}

/// So many times as large as those of the scene elements can be made here: those that elements of a
/// file were cut into have larger ones.
[[nodiscard]] inline double largest_factor(const SceneDescription& scene) {
  if (element_size_of(scene)) return std::numeric_limits<double>::infinity();
  const auto* file = std::get_if<MeshFileModel>(&scene.model);
  return file != nullptr ? std::ldexp(1.0, file->refinement) : 1.0;
}

/// The same scene on elements so many times as large.
/// @param factor  of a mesh file a power of two, up to largest_factor().
[[nodiscard]] inline SceneDescription with_elements_scaled(SceneDescription scene, double factor) {
  if (auto* blade = std::get_if<BladeModel>(&scene.model)) {
    blade->sizes.element_size *= factor;
    if (blade->sizes.edge_size) *blade->sizes.edge_size *= factor;
  }
  if (auto* step = std::get_if<StepModel>(&scene.model)) {
    step->element_size *= factor;
    for (FaceDescription& face : step->faces) {
      for (FaceChoice& choice : face.choices) {
        for (std::optional<double>* size : {&choice.size, &choice.edge_size}) {
          if (*size) **size *= factor;
        }
      }
    }
  }
  if (auto* file = std::get_if<MeshFileModel>(&scene.model)) {
    file->refinement -= static_cast<int>(std::lround(std::log2(factor)));
  }
  return scene;
}

/// The modes a scene has from another code; nullptr: none.
[[nodiscard]] inline const ModesFile* given_modes(const SceneDescription& scene) {
  const auto* model = std::get_if<MeshFileModel>(&scene.model);
  return model != nullptr && model->modes ? &*model->modes : nullptr;
}

/// The matrices a scene has from another code; nullptr: none.
[[nodiscard]] inline const MatrixFiles* given_matrices(const SceneDescription& scene) {
  const auto* model = std::get_if<MeshFileModel>(&scene.model);
  return model != nullptr && model->matrices ? &*model->matrices : nullptr;
}

/// Whether the preload is that of the static loads: of all contacts or of none.
[[nodiscard]] inline bool has_static_preload(const SceneDescription& scene) {
  return !scene.contacts.empty() && !scene.contacts.front().static_preload_place.empty();
}

/// Of all surfaces of a scene: one entry per patch, one for all points of a modal scene.
[[nodiscard]] inline std::vector<contact::SurfaceRules> surface_rules(
    const SceneDescription& scene) {
  std::vector<contact::SurfaceRules> rules;
  for (const ContactDescription& contact : scene.contacts) rules.push_back(contact.rules);
  if (rules.empty()) rules.push_back(scene.rules);
  return rules;
}

/// Of "section.key", for messages; the key alone where it is not given.
[[nodiscard]] inline std::string place_in(const SceneDescription& scene, std::string_view key) {
  const auto found = scene.places.find(key);
  return found != scene.places.end() ? found->second : std::string(key);
}

/// What the scene says of an effect: auto, on or off.
[[nodiscard]] inline std::string setting_of(const SceneDescription& scene, std::string_view name) {
  for (const auto& [effect, setting] : scene.effects) {
    if (effect == name) return setting;
  }
  return "auto";
}

[[nodiscard]] inline bool is_rough(const SceneDescription& scene) {
  return std::ranges::any_of(surface_rules(scene),
                             [](const auto& rules) { return rules.roughness.has_value(); });
}

/// Whether a friction coefficient depends on the slip speed.
[[nodiscard]] inline bool is_rate_dependent(const SceneDescription& scene) {
  return std::ranges::any_of(surface_rules(scene),
                             [](const auto& rules) { return rules.friction.has_value(); });
}

/// Whether maps can show a depth of wear.
[[nodiscard]] inline bool has_wear(const SceneDescription& scene) {
  return scene.wear_coefficient > 0.0 ||
         std::ranges::any_of(scene.contacts, [](const ContactDescription& contact) {
           return contact.wear_coefficient > 0.0;
         });
}

/// Harmonics of a bracket beside a short search, and of how its best value moves.
inline constexpr int few_harmonics = 3;

/// Bodies with patches err by their meshes, which shows as some per cent of a peak that is level
/// over as much: their searches for a best value may end sooner. Points of bars, chains and modal
/// scenes are searched to the end.
[[nodiscard]] inline bool has_short_search(const SceneDescription& scene) {
  const HarmonicSettings& harmonics = scene.settings.harmonics;
  return !scene.contacts.empty() && (harmonics.chosen() || harmonics.highest > few_harmonics);
}

/// Whether contact acts on an area, of which points at several places share the load.
[[nodiscard]] inline bool has_area(const SceneDescription& scene) {
  const auto* modal = std::get_if<ModalModel>(&scene.model);
  if (modal == nullptr) return !scene.contacts.empty();
  return modal->positions.rows() > 1 || !modal->tilted_areas.empty();
}

}  // namespace microslip::pipelines
