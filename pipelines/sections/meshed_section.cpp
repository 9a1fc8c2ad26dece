#include "pipelines/sections/meshed_section.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "mesh/count_text.hpp"
#include "pipelines/description/element_count.hpp"
#include "pipelines/sections/modes_section.hpp"
#include "pipelines/sections/points_section.hpp"
#include "pipelines/system/mesh_format.hpp"
#include "pipelines/text/units.hpp"

namespace microslip::pipelines {

BladeModel read_blade(const SectionReader& s) {
  static_cast<void>(s.integer("order"));
  BladeModel model;
  model.sizes.element_size = s.number("element_size");
  if (s.given("edge_size")) model.sizes.edge_size = s.number("edge_size");
  mesh::BladeGeometry& g = model.geometry;
  g.root_width = s.number("root_width");
  g.root_height = s.number("root_height");
  g.root_length = s.number("root_length");
  g.platform_width = s.number("platform_width");
  g.platform_height = s.number("platform_height");
  g.platform_length = s.number("platform_length");
  g.span = s.number("span");
  g.root_chord = s.number("root_chord");
  g.tip_chord = s.number("tip_chord");
  g.root_thickness = s.number("root_thickness");
  g.tip_thickness = s.number("tip_thickness");
  g.root_stagger = s.number("root_stagger");
  g.tip_stagger = s.number("tip_stagger");
  g.camber = s.number("camber");
  g.lean = s.number("lean");
  const double height = g.root_height + g.platform_height + g.span;
  const std::string fault = too_many_elements(model.sizes.element_size, blade_volume(g), height);
  if (!fault.empty()) s.fail("element_size", fault);
  return model;
}

namespace {

/// SI value of a unit by its name, or of a number of SI units. @param si  "m", "kg".
double read_unit(const SectionReader& s, std::string_view key, const toml::node& unit,
                 const char* example, const char* si) {
  const auto name = unit.value<std::string>();
  double value = 0.0;
  if (!name || !unit.is_string()) {
    value = s.number_in(unit, key);
  } else if (name->empty()) {
    s.fail(key, fmt::format("expected a unit, e.g. \"{}\"", example), &unit);
  } else {
    try {
      value = to_si("1 " + *name, si);
    } catch (const UnitError& error) {
      s.fail(key, error.what(), &unit);
    }
  }
  if (!(value > 0.0)) s.fail(key, "must be above 0", &unit);
  return value;
}

/// A path of the scene as one that stands anywhere: scene.toml stands elsewhere than the scene.
std::filesystem::path absolute_file(SectionReader& s, std::string_view key,
                                    const std::filesystem::path& folder) {
  const std::filesystem::path file = s.text(key);
  std::filesystem::path absolute = file.is_absolute() ? file : folder / file;
  s.complete(key, absolute.string());
  return absolute;
}

void require_mesh_format(const SectionReader& s, const char* key,
                         const std::filesystem::path& file) {
  if (mesh_format(file) != MeshFormat::unknown) return;
  s.fail(key,
         fmt::format("\"{}\": meshes are read from files that end in {}", file.filename().string(),
                     mesh_endings()),
         s.node(key));
}

std::optional<double> read_length_unit(SectionReader& s, const std::filesystem::path& mesh_file) {
  if (const toml::node* unit = s.node("length_unit"))
    return read_unit(s, "length_unit", *unit, "mm", "m");
  if (mesh_format(mesh_file) != MeshFormat::gmsh) return std::nullopt;
  s.complete("length_unit", "m");
  return 1.0;
}

void require_step_format(const SectionReader& s, const std::string& file) {
  if (is_step_file(file)) return;
  s.fail("file", fmt::format("\"{}\": STEP files end in .step or .stp", file), s.node("file"));
}

/// The mesh of a modes file: named, or found beside it.
std::filesystem::path mesh_of_modes(SectionReader& s, const std::filesystem::path& modes,
                                    const std::filesystem::path& folder) {
  std::filesystem::path mesh = mesh_beside(modes);
  if (s.given("mesh")) {
    mesh = absolute_file(s, "mesh", folder);
    require_mesh_format(s, "mesh", mesh);
  } else if (mesh.empty()) {
    s.fail("mesh",
           "is missing; expected the file that has the mesh of the modes with names for its "
           "surfaces, e.g. the deck (.inp)");
  }
  if (is_punch_file(modes) && !is_nastran_deck(mesh)) {
    s.fail("mesh",
           "a punched file tells nodes by their numbers: expected the deck these modes were "
           "computed with (.bdf, .nas, .fem)",
           s.node("mesh"));
  }
  s.complete("mesh", mesh.string());
  return mesh;
}

void require_modes_format(const SectionReader& s, const std::filesystem::path& file) {
  constexpr std::array<std::string_view, 5> endings{".frd", ".pch", ".med", ".npz", ".csv"};
  if (std::ranges::find(endings, file.extension().string()) != endings.end()) return;
  std::string told = fmt::format("\"{}\": modes are read from files that end in {}",
                                 file.filename().string(), fmt::join(endings, ", "));
  if (file.extension() == ".op2") {
    told +=
        "; pyNastran, which reads .op2, is no Debian package: let Nastran write the modes as text "
        "(VECTOR(PUNCH)=ALL in the case control), or write them as .npz by a script of your own";
  }
  s.fail("file", told, s.node("file"));
}

bool is_rescaled(const SectionReader& s, bool has_density) {
  constexpr std::array<std::string_view, 2> normalisations{"mass", "other"};
  const bool rescaled = s.word("normalisation", normalisations) == "other";
  if (rescaled && !has_density) {
    s.fail("normalisation", "\"other\" needs material.density, by which the shapes are rescaled",
           s.node("normalisation"));
  }
  return rescaled;
}

}  // namespace

StepModel read_step_file(SectionReader s, const std::filesystem::path& folder) {
  static_cast<void>(s.integer("order"));
  require_step_format(s, s.text("file"));
  StepModel model;
  model.file = absolute_file(s, "file", folder);
  model.place = s.place("file");
  model.element_size = s.number("element_size");
  model.size_place = s.place("element_size");
  model.length_place = s.place("length_unit");
  if (const toml::node* unit = s.node("length_unit")) {
    model.length_unit = read_unit(s, "length_unit", *unit, "mm", "m");
  }
  return model;
}

MeshFileModel read_mesh_file(SectionReader s, const std::filesystem::path& folder) {
  MeshFileModel model;
  if (s.given("order")) model.order = s.integer("order");
  model.refinement = s.integer("refinement");
  constexpr std::array<std::string_view, 2> choices{"on", "off"};
  model.midside_nodes = s.word("midside_nodes", choices) == "on";
  require_mesh_format(s, "file", s.text("file"));
  model.file = absolute_file(s, "file", folder);
  model.place = s.place("file");
  model.length_unit = read_length_unit(s, model.file);
  return model;
}

MeshFileModel read_modes_file(SectionReader s, const std::filesystem::path& folder,
                              bool has_density) {
  MeshFileModel model;
  const bool matrices = s.given("stiffness");
  if (matrices == s.given("file"))
    s.fail("file", "expected either file, or stiffness, mass and nodes", s.node("file"));
  const std::filesystem::path modes = matrices ? "" : absolute_file(s, "file", folder);
  if (!matrices) require_modes_format(s, modes);
  model.file = mesh_of_modes(s, modes, folder);
  model.place = s.place("mesh");
  model.length_unit = read_length_unit(s, model.file);
  if (!model.length_unit) {
    s.fail("length_unit",
           "is missing; expected the unit of the coordinates in both files: \"m\", \"mm\"");
  }
  const toml::node* unit = s.node("mass_unit");
  // N s²/m, the unit that goes with newtons, seconds and the unit of length.
  const double mass_unit =
      unit != nullptr ? read_unit(s, "mass_unit", *unit, "t", "kg") : 1.0 / *model.length_unit;
  if (matrices) {
    model.matrices =
        MatrixFiles{absolute_file(s, "stiffness", folder), absolute_file(s, "mass", folder),
                    absolute_file(s, "nodes", folder), mass_unit, s.place("nodes")};
  } else {
    model.modes = ModesFile{modes, mass_unit, is_rescaled(s, has_density), s.place("file")};
  }
  return model;
}

fem::Material read_material(const SectionReader& s) {
  return {s.number("youngs_modulus"), s.number("poissons_ratio"), s.number("density")};
}

std::vector<std::string> read_names(const SectionReader& s, std::string_view key) {
  const toml::node& node = *s.node(key);
  const toml::array* list = node.as_array();
  if (list == nullptr) s.fail(key, "expected a list of names", &node);
  std::vector<std::string> names;
  for (const toml::node& entry : *list) {
    if (!entry.is_string()) s.fail(key, "expected names in quotes", &entry);
    names.push_back(*entry.value<std::string>());
  }
  return names;
}

namespace {

constexpr int highest_attachment_degree = 12;

std::optional<int> read_attachment_degree(const SectionReader& s) {
  const toml::node& node = *s.node("attachment_degree");
  if (node.is_string() && node.value<std::string>() == "auto") return std::nullopt;
  const auto degree = node.value<std::int64_t>();
  if (!node.is_integer() || *degree < 0 || *degree > highest_attachment_degree) {
    s.fail("attachment_degree",
           fmt::format("expected a degree from 0 to {}, or \"auto\"", highest_attachment_degree),
           &node);
  }
  return static_cast<int>(*degree);
}

}  // namespace

BasisSettings read_basis(const SectionReader& s) {
  BasisSettings basis;
  basis.n_modes = s.integer("count");
  constexpr std::array<std::string_view, 3> residuals{"attachment", "stiffness", "none"};
  const std::string residual = s.word("residual", residuals);
  basis.residual = residual == "none"        ? ResidualKind::none
                   : residual == "stiffness" ? ResidualKind::stiffness
                                             : ResidualKind::attachment;
  basis.attachment_degree = read_attachment_degree(s);
  if (basis.attachment_degree && basis.residual != ResidualKind::attachment) {
    s.fail("attachment_degree",
           fmt::format("goes with residual = \"attachment\", not with \"{}\"", residual),
           s.node("attachment_degree"));
  }
  constexpr std::array<std::string_view, 2> solvers{"direct", "iterative"};
  basis.solver = s.word("solver", solvers) == "iterative" ? fem::SolverKind::iterative
                                                          : fem::SolverKind::direct;
  return basis;
}

BasisSettings read_given_basis(const SectionReader& s) {
  BasisSettings basis;
  basis.n_modes = s.given("count") ? s.integer("count") : 0;
  if (s.given("attachment_degree")) {
    s.fail("attachment_degree", "goes with matrices: modes in a file bring their own shapes",
           s.node("attachment_degree"));
  }
  constexpr std::array<std::string_view, 2> residuals{"none", "attachment"};
  basis.residual =
      s.word("residual", residuals) == "none" ? ResidualKind::none : ResidualKind::attachment;
  return basis;
}

ModesDescription read_modes(const SectionReader& s, int n_modes) {
  ModesDescription modes;
  modes.damping = read_damping(s);
  const auto* ratios = std::get_if<std::vector<double>>(&modes.damping);
  const toml::node* given = s.node("damping_ratio");
  if (given->is_array() && static_cast<int>(ratios->size()) != n_modes) {
    s.fail("damping_ratio",
           fmt::format("{} for {}; give one, or one each",
                       mesh::counted(ratios->size(), "value", "values"),
                       mesh::counted(n_modes, "mode", "modes")),
           given);
  }
  return modes;
}

std::string settle_residual(SectionReader& s, BasisSettings& basis,
                            const ContactDescription& contact) {
  const char* rigid = !contact.normal_stiffness       ? "normal_stiffness"
                      : !contact.tangential_stiffness ? "tangential_stiffness"
                                                      : nullptr;
  if (rigid == nullptr || basis.residual != ResidualKind::attachment) return {};
  if (s.given("residual") || basis.attachment_degree) {
    const char* key = s.given("residual") ? "residual" : "attachment_degree";
    s.fail(key,
           fmt::format("attachment shapes leave the contact its local stiffness alone, and "
                       "contact.{} = \"rigid\" "
                       "gives none; give a stiffness in N/m^3, or modes.residual = \"stiffness\"",
                       rigid),
           s.node(key));
  }
  basis.residual = ResidualKind::stiffness;
  s.complete("residual", "stiffness");
  return fmt::format(
      "contact.{} = \"rigid\": modes.residual = \"stiffness\" is used, the omitted modes are all "
      "the stiffness "
      "there is",
      rigid);
}

std::vector<ForceDescription> read_forces(SectionReader& s, std::string_view spec,
                                          std::vector<PointDescription>& points) {
  std::vector<ForceDescription> forces;
  s.tables("forces", spec, "{ at = …, … }", [&](const SectionReader& force) {
    ForceDescription description;
    description.at = read_place(force, "at", points);
    description.place = force.place("at");
    description.direction = force.direction("direction");
    description.amplitude = force.number("amplitude");
    if (spec == "force") description.phase_deg = force.number("phase");
    forces.push_back(description);
  });
  return forces;
}

}  // namespace microslip::pipelines
