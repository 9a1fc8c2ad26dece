#include "pipelines/scene/block_scene.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "contact/patch/contact_area.hpp"
#include "pipelines/scene/chain_system.hpp"
#include "pipelines/sections/contact_section.hpp"
#include "pipelines/sections/friction_section.hpp"
#include "pipelines/text/scene_keys.hpp"

namespace microslip::pipelines {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

Eigen::VectorXd read_vector(const SectionReader& s, std::string_view key, Eigen::Index n,
                            const char* expected) {
  Eigen::VectorXd values = read_numbers(s, key);
  if (values.size() != n) {
    s.fail(key, fmt::format("{} numbers; expected {}", values.size(), expected), s.node(key));
  }
  return values;
}

Eigen::Vector3d read_vector3(const SectionReader& s, std::string_view key) {
  return read_vector(s, key, 3, "[p, q, r]");
}

/// The contact rectangle, its cells counted and seen from its centre.
struct Rectangle {
  contact::PlanarCells cells;              // weights [m²]
  Eigen::Vector3d centre;                  // from the centre of mass [m]
  double area = 0.0;                       // [m²]
  std::array<double, 2> moment{0.0, 0.0};  // of the preload, about p and r [N m]
};

int read_count(const SectionReader& s, const toml::node& entry) {
  constexpr std::int64_t most = 10'000;
  const auto value = entry.is_integer() ? entry.value<std::int64_t>() : std::nullopt;
  if (!value || *value < 1 || *value > most) {
    s.fail("cells", fmt::format("expected whole numbers from 1 to {}", most), &entry);
  }
  return static_cast<int>(*value);
}

Rectangle read_rectangle(const SectionReader& model, const SectionReader& s) {
  const toml::node& node = *s.node("cells");
  const toml::array* list = node.as_array();
  if (list == nullptr || list->size() != 2) s.fail("cells", "expected [along p, along r]", &node);
  const int n_p = read_count(s, *list->get(0));
  const int n_r = read_count(s, *list->get(1));
  const Eigen::Vector2d size = read_vector(s, "size", 2, "[along p, along r]");
  if (!(size.minCoeff() > 0.0)) s.fail("size", "both must be above 0", s.node("size"));
  const Eigen::Vector2d centre = read_vector(s, "centre", 2, "[p, r]");
  const Eigen::Vector2d moment = read_vector(s, "preload_moment", 2, "[about p, about r]");
  if ((moment[0] != 0.0 && n_r < 2) || (moment[1] != 0.0 && n_p < 2)) {
    s.fail("preload_moment", "a moment about p needs several cells along r, and the reverse",
           s.node("preload_moment"));
  }
  return {contact::rectangle_cells(size[1], size[0], n_r, n_p),
          {centre[0], model.number("height"), centre[1]},
          size.prod(),
          {moment[0], moment[1]}};
}

Eigen::MatrixXd read_stiffness(const SectionReader& s) {
  const bool diagonal = s.given("stiffness") || s.given("rotational_stiffness");
  if (diagonal == s.given("stiffness_matrix")) {
    s.fail("stiffness",
           "expected stiffness with rotational_stiffness, or stiffness_matrix: one of the two");
  }
  if (!diagonal) {
    Eigen::MatrixXd K = read_symmetric(s, "stiffness_matrix");
    if (K.rows() == 6) return K;
    s.fail("stiffness_matrix", fmt::format("{0} x {0}; expected 6 x 6", K.rows()),
           s.node("stiffness_matrix"));
  }
  for (const char* key : {"stiffness", "rotational_stiffness"}) {
    if (!s.given(key)) s.fail(key, "is missing: three springs and three that turn go together");
  }
  // What is read may be refused: that comes before a matrix that is filled.
  const Eigen::Vector3d stiffness = read_vector3(s, "stiffness");
  const Eigen::Vector3d rotational = read_vector3(s, "rotational_stiffness");
  Vector6 springs;
  springs << stiffness, rotational;
  return springs.asDiagonal();
}

ChainSystem read_system(const LeanSections& sections) {
  const SectionReader& s = sections.model;
  const double mass = s.number("mass");
  const Eigen::Vector3d moments = read_vector3(s, "moments_of_inertia");
  Vector6 inertia;
  inertia << Eigen::Vector3d::Constant(mass), moments;
  if (!(inertia.minCoeff() > 0.0)) {
    s.fail("moments_of_inertia", "all three must be above 0", s.node("moments_of_inertia"));
  }
  const Eigen::MatrixXd K = read_stiffness(s);
  const char* key = s.given("stiffness_matrix") ? "stiffness_matrix" : "stiffness";
  ChainSystem system;
  try {
    system = modes_of_matrices(K, inertia.asDiagonal());
  } catch (const std::invalid_argument& error) {
    s.fail(key, error.what(), s.node(key));
  }
  keep_lowest(system, sections.modes);
  return system;
}

/// (d, φ) of the centre of the rectangle in the letters of paper B, (x, y, z) = (q, r, p).
Eigen::MatrixXd centre_motions(const Eigen::MatrixXd& shapes, const Eigen::Vector3d& centre) {
  const Eigen::MatrixXd moved = point_motion(centre) * shapes;
  Eigen::MatrixXd motions(6, shapes.cols());
  motions << moved.row(1), moved.row(2), moved.row(0), shapes.row(4), shapes.row(5), shapes.row(3);
  return motions;
}

void set_contact(ModalModel& model, const SectionReader& s, const Rectangle& rectangle,
                 const Eigen::MatrixXd& shapes, const Field& friction) {
  const double area = rectangle.area;
  const contact::PointParameters point{s.number("tangential_stiffness") / area,
                                       s.number("normal_stiffness") / area, 0.0, 1.0 / area};
  const contact::ContactArea cells(rectangle.cells);
  model.load_measure = LoadMeasure::force;
  model.weights = rectangle.cells.weights;
  model.points.assign(static_cast<std::size_t>(cells.n_cells()), point);
  model.shapes = cells.modal_shapes(centre_motions(shapes, rectangle.centre));
  model.positions.resize(cells.n_cells(), 2);
  model.positions << rectangle.cells.z, rectangle.cells.y;
  const Eigen::VectorXd coefficient = friction.at(rectangle.cells.z, rectangle.cells.y);
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    model.points[i].friction_coefficient = coefficient[static_cast<Eigen::Index>(i)];
  }
  if (rectangle.moment != std::array{0.0, 0.0}) {
    model.tilted_areas.push_back(
        {"contact.preload_moment", 0, rectangle.cells.z, rectangle.cells.y, 1.0, rectangle.moment});
  }
}

void set_forces(ModalModel& model, SectionReader& s, const Eigen::MatrixXd& shapes) {
  s.tables("forces", "force.block", "{ force = …, … }", [&](const SectionReader& load) {
    const Eigen::Vector3d force = read_vector3(load, "force");
    Vector6 whole = point_motion(read_vector3(load, "at")).transpose() * force;
    whole.tail<3>() += read_vector3(load, "moment");
    const double phase = load.number("phase") * std::numbers::pi / 180.0;
    // F sin(θ + φ) = F cos φ sin θ + F sin φ cos θ
    model.force_sine += std::cos(phase) * (shapes.transpose() * whole);
    if (phase != 0.0) model.force_cosine += std::sin(phase) * (shapes.transpose() * whole);
  });
}

}  // namespace

Eigen::Matrix<double, 3, 6> point_motion(const Eigen::Vector3d& c) {
  Eigen::Matrix<double, 3, 6> D;
  D << 1.0, 0.0, 0.0, 0.0, c[2], -c[1],  //
      0.0, 1.0, 0.0, -c[2], 0.0, c[0],   //
      0.0, 0.0, 1.0, c[1], -c[0], 0.0;
  return D;
}

BlockOutput read_block_output(SectionReader& s) {
  const toml::node& node = *s.node("output");
  if (!node.is_table())
    s.fail("output", "expected { at = [p, q, r], direction = [p, q, r] }", &node);
  toml::table complete;
  complete.is_inline(true);
  const SectionReader output(node.as_table(), section_spec("output.block"), "response.output",
                             s.file(), complete);
  BlockOutput result{read_vector3(output, "at"), output.direction("direction")};
  s.complete("output", std::move(complete));
  return result;
}

ModalModel read_block(LeanSections sections, const std::optional<BlockOutput>& output,
                      const std::filesystem::path& folder, contact::SurfaceRules& rules,
                      double& wear_coefficient) {
  const ChainSystem system = read_system(sections);
  const Eigen::Index n_modes = system.frequency.size();
  ModalModel model;
  model.frequency_hz = system.frequency / (2.0 * std::numbers::pi);
  model.damping_ratio = read_damping_ratios(sections.modes, system.frequency);
  model.force_sine = model.force_cosine = model.force_static = Eigen::VectorXd::Zero(n_modes);
  set_forces(model, sections.excitation, system.shapes);
  const FrictionDescription friction =
      read_friction(sections.contact, "friction_coefficient", folder);
  rules.friction = friction.law;
  rules.roughness = read_roughness(sections.contact);
  wear_coefficient = sections.contact.number("wear_coefficient");
  set_contact(model, sections.contact, read_rectangle(sections.model, sections.contact),
              system.shapes, friction.at_rest);
  if (rules.roughness && rules.roughness->height() > 0.0 &&
      !(model.points[0].normal_stiffness > 0.0)) {
    sections.contact.fail("roughness", "rough surfaces need a normal_stiffness above 0",
                          sections.contact.node("roughness"));
  }
  model.output = Eigen::VectorXd::Zero(n_modes);
  if (output) {
    model.output =
        (output->direction.transpose() * point_motion(output->at) * system.shapes).transpose();
  }
  return model;
}

}  // namespace microslip::pipelines
