#include "pipelines/scene/meshed_section.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "pipelines/scene/modes_section.hpp"
#include "pipelines/scene/points_section.hpp"
#include "pipelines/system/mesh_format.hpp"
#include "pipelines/text/units.hpp"

namespace microslip::pipelines {

BladeModel read_blade(const SectionReader& s) {
  static_cast<void>(s.integer("order"));
  BladeModel model;
  model.element_size = s.number("element_size");
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
  return model;
}

namespace {

double read_length_unit(const SectionReader& s, const toml::node& unit) {
  const auto name = unit.value<std::string>();
  if (!name || !unit.is_string()) return s.number_in(unit, "length_unit");
  if (name->empty()) s.fail("length_unit", "expected a unit of length, e.g. \"mm\"", &unit);
  try {
    return to_si("1 " + *name, "m");
  } catch (const UnitError& error) {
    s.fail("length_unit", error.what(), &unit);
  }
}

}  // namespace

MeshFileModel read_mesh_file(SectionReader s, const std::filesystem::path& folder) {
  static_cast<void>(s.integer("order"));
  MeshFileModel model;
  const std::filesystem::path file = s.text("file");
  model.file = file.is_absolute() ? file : folder / file;
  model.place = s.place("file");
  const MeshFormat format = mesh_format(file);
  if (format == MeshFormat::unknown) {
    s.fail("file",
           fmt::format("\"{}\": meshes are read from files that end in {}", file.string(),
                       mesh_endings()),
           s.node("file"));
  }
  s.complete("file", model.file.string());  // scene.toml stands elsewhere than the scene
  if (const toml::node* unit = s.node("length_unit")) {
    model.length_unit = read_length_unit(s, *unit);
    if (!(*model.length_unit > 0.0)) s.fail("length_unit", "must be above 0", unit);
  } else if (format == MeshFormat::gmsh) {
    model.length_unit = 1.0;
    s.complete("length_unit", "m");
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
  return basis;
}

ModesDescription read_modes(const SectionReader& s, int n_modes) {
  ModesDescription modes;
  modes.damping = read_damping(s);
  const auto* ratios = std::get_if<std::vector<double>>(&modes.damping);
  const toml::node* given = s.node("damping_ratio");
  if (given->is_array() && static_cast<int>(ratios->size()) != n_modes) {
    s.fail("damping_ratio",
           fmt::format("{} values for {} modes; give one, or one each", ratios->size(), n_modes),
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

std::vector<ForceDescription> read_forces(SectionReader& s, std::vector<PointDescription>& points) {
  const toml::node& node = *s.node("forces");
  const toml::array* list = node.as_array();
  if (list == nullptr) s.fail("forces", "expected a list of tables { at = …, … }", &node);
  std::vector<ForceDescription> forces;
  toml::array completed;
  for (const toml::node& entry : *list) {
    if (!entry.is_table()) s.fail("forces", "expected tables { at = …, … }", &entry);
    toml::table complete;
    complete.is_inline(true);
    const SectionReader force(entry.as_table(), section_spec("force"), "excitation.forces",
                              s.file(), complete);
    ForceDescription description;
    description.at = read_place(force, "at", points);
    description.place = force.place("at");
    description.direction = force.direction("direction");
    description.amplitude = force.number("amplitude");
    description.phase_deg = force.number("phase");
    forces.push_back(description);
    completed.push_back(std::move(complete));
  }
  s.complete("forces", std::move(completed));
  return forces;
}

}  // namespace microslip::pipelines
