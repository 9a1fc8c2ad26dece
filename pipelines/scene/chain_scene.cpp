#include "pipelines/scene/chain_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipelines/scene/chain_system.hpp"
#include "pipelines/text/scene_keys.hpp"

namespace microslip::pipelines {
namespace {

/// One contact of the scene before it becomes points.
struct Contact {
  Eigen::VectorXd slip, approach;  // u, v = slip · x, approach · x
  contact::PointParameters whole;  // stiffness of all cells together [N/m]; rest load is the share
  int n_along = 1, n_across = 1;   // cells along p and r
  double length = 0.0, width = 0.0;       // along p and r [m]; 0: a point
  double moment_p = 0.0, moment_r = 0.0;  // [N·m]
};

Eigen::Index coordinate(const SectionReader& s, std::string_view key, const std::string& name,
                        const ChainSystem& system, const toml::node* at) {
  const auto& names = system.coordinates;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    s.fail(key, fmt::format("no coordinate \"{}\"; there are: {}", name, fmt::join(names, ", ")),
           at);
  }
  return found - names.begin();
}

/// A coordinate, or a sum { m1 = 1, m2 = -1 }, as factors on the coordinates.
Eigen::VectorXd read_motion(const SectionReader& s, std::string_view key,
                            const ChainSystem& system) {
  const toml::node& node = *s.node(key);
  Eigen::VectorXd factors = Eigen::VectorXd::Zero(system.shapes.rows());
  if (const auto name = node.is_string() ? node.value<std::string>() : std::nullopt) {
    factors[coordinate(s, key, *name, system, &node)] = 1.0;
    return factors;
  }
  if (!node.is_table()) s.fail(key, "expected a coordinate, or { m1 = 1, m2 = -1 }", &node);
  for (const auto& [name, value] : *node.as_table()) {
    factors[coordinate(s, key, std::string(name.str()), system, &value)] = s.number_in(value, key);
  }
  if (factors.isZero(0.0)) s.fail(key, "moves nothing", &node);
  return factors;
}

std::pair<int, int> read_cells(const SectionReader& s) {
  const toml::node& node = *s.node("cells");
  const toml::array* list = node.as_array();
  constexpr std::int64_t most = 10'000;
  const auto count = [&](std::size_t i) {
    const auto value = list->get(i)->value<std::int64_t>();
    if (!list->get(i)->is_integer() || *value < 1 || *value > most) {
      s.fail("cells", fmt::format("expected two whole numbers from 1 to {}", most), &node);
    }
    return static_cast<int>(*value);
  };
  if (list == nullptr || list->size() != 2) s.fail("cells", "expected [along p, along r]", &node);
  return {count(0), count(1)};
}

std::pair<double, double> read_pair(const SectionReader& s, std::string_view key) {
  const toml::node& node = *s.node(key);
  const toml::array* list = node.as_array();
  if (list == nullptr || list->size() != 2) s.fail(key, "expected two numbers [p, r]", &node);
  return {s.number_in(*list->get(0), key), s.number_in(*list->get(1), key)};
}

void read_area(const SectionReader& s, Contact& contact) {
  std::tie(contact.n_along, contact.n_across) = read_cells(s);
  std::tie(contact.moment_p, contact.moment_r) = read_pair(s, "preload_moment");
  if (s.given("size")) {
    std::tie(contact.length, contact.width) = read_pair(s, "size");
  } else if (contact.n_along * contact.n_across > 1) {
    s.fail("size", "is missing: the cells divide an area [p, r] in m");
  }
  if (contact.moment_p != 0.0 && contact.n_across < 2) {
    s.fail("preload_moment", "a moment about p needs several cells along r",
           s.node("preload_moment"));
  }
  if (contact.moment_r != 0.0 && contact.n_along < 2) {
    s.fail("preload_moment", "a moment about r needs several cells along p",
           s.node("preload_moment"));
  }
}

Contact read_contact(const SectionReader& s, const ChainSystem& system) {
  Contact contact;
  contact.slip = read_motion(s, "slip", system);
  contact.approach = Eigen::VectorXd::Zero(contact.slip.size());
  contact.whole = {s.number("tangential_stiffness"), s.number("normal_stiffness"),
                   s.number("friction_coefficient"), s.number("share")};
  const bool varies = contact.whole.normal_stiffness > 0.0;
  if (varies != s.given("approach")) {
    s.fail(varies ? "approach" : "normal_stiffness",
           "is missing: approach and a normal_stiffness above 0 go together");
  }
  if (varies) contact.approach = read_motion(s, "approach", system);
  read_area(s, contact);
  return contact;
}

std::vector<Contact> read_contacts(SectionReader& s, const ChainSystem& system) {
  std::vector<Contact> contacts;
  double shares = 0.0;
  s.tables("points", "contact.chain.point", "{ slip = …, … }", [&](const SectionReader& point) {
    contacts.push_back(read_contact(point, system));
    shares += contacts.back().whole.rest_load;
  });
  if (!contacts.empty() && !(shares > 0.0)) {
    s.fail("points", "every share of the preload is 0", s.node("points"));
  }
  for (Contact& contact : contacts) contact.whole.rest_load /= shares;
  return contacts;
}

/// Middles of n equal cells over a length, from its centre.
Eigen::VectorXd cell_centres(int n, double length) {
  const Eigen::VectorXd number = Eigen::VectorXd::LinSpaced(n, 0.0, n - 1.0);
  return (length / n) * (number.array() - 0.5 * (n - 1.0)).matrix();
}

/// Appends the cells of one contact to the model, from row `row` on.
void add_cells(ModalModel& model, const Contact& contact, const ChainSystem& system,
               Eigen::Index row) {
  const Eigen::VectorXd p = cell_centres(contact.n_along, contact.length);
  const Eigen::VectorXd r = cell_centres(contact.n_across, contact.width);
  const double n_cells = static_cast<double>(contact.n_along) * contact.n_across;
  const Eigen::Index begin = row;
  for (Eigen::Index j = 0; j < r.size(); ++j) {
    for (Eigen::Index i = 0; i < p.size(); ++i, ++row) {
      contact::PointParameters cell = contact.whole;
      cell.tangential_stiffness /= n_cells;
      cell.normal_stiffness /= n_cells;
      cell.rest_load /= n_cells;
      model.points.push_back(cell);
      model.shapes.u.row(row) = contact.slip.transpose() * system.shapes;
      model.shapes.v.row(row) = contact.approach.transpose() * system.shapes;
      model.positions.row(row) << p[i], r[j];
    }
  }
  if (contact.moment_p == 0.0 && contact.moment_r == 0.0) return;
  const auto cells = model.positions.middleRows(begin, row - begin);
  model.tilted_areas.push_back({"contact.points.preload_moment",
                                begin,
                                cells.col(0),
                                cells.col(1),
                                contact.whole.rest_load,
                                {contact.moment_p, contact.moment_r}});
}

void set_contacts(ModalModel& model, const std::vector<Contact>& contacts,
                  const ChainSystem& system) {
  Eigen::Index n = 0;
  for (const Contact& contact : contacts) n += Eigen::Index{contact.n_along} * contact.n_across;
  const Eigen::Index n_modes = system.frequency.size();
  model.load_measure = LoadMeasure::force;
  model.weights = Eigen::VectorXd::Ones(n);
  model.shapes = {Eigen::MatrixXd::Zero(n, n_modes), Eigen::MatrixXd::Zero(n, n_modes),
                  Eigen::MatrixXd::Zero(n, n_modes)};
  model.positions = Eigen::MatrixX2d::Zero(n, 2);
  for (const Contact& contact : contacts) {
    add_cells(model, contact, system, static_cast<Eigen::Index>(model.points.size()));
  }
  if (contacts.size() > 1) model.positions.resize(0, 2);  // areas of their own: no common plane
}

void set_forces(ModalModel& model, SectionReader& s, const ChainSystem& system) {
  s.tables("forces", "force.chain", "{ at = …, … }", [&](const SectionReader& force) {
    const Eigen::Index at = coordinate(force, "at", force.text("at"), system, force.node("at"));
    const double amplitude = force.number("amplitude");
    const double phase = force.number("phase") * std::numbers::pi / 180.0;
    // F sin(θ + φ) = F cos φ sin θ + F sin φ cos θ
    model.force_sine += amplitude * std::cos(phase) * system.shapes.row(at).transpose();
    if (phase != 0.0) {
      model.force_cosine += amplitude * std::sin(phase) * system.shapes.row(at).transpose();
    }
  });
}

}  // namespace

ModalModel read_chain(LeanSections sections, const std::string& output) {
  ChainSystem system = read_chain_system(sections.model);
  keep_lowest(system, sections.modes);
  const Eigen::Index n_modes = system.frequency.size();
  ModalModel model;
  model.frequency_hz = system.frequency / (2.0 * std::numbers::pi);
  model.damping_ratio = read_damping_ratios(sections.modes, system.frequency);
  model.force_sine = model.force_cosine = model.force_static = Eigen::VectorXd::Zero(n_modes);
  set_forces(model, sections.excitation, system);
  set_contacts(model, read_contacts(sections.contact, system), system);
  model.output = Eigen::VectorXd::Zero(n_modes);
  if (!output.empty()) {
    const auto& names = system.coordinates;
    const auto found = std::find(names.begin(), names.end(), output);
    if (found == names.end()) {
      sections.model.fail("coordinates", fmt::format("response.output names \"{}\"; there are: {}",
                                                     output, fmt::join(names, ", ")));
    }
    model.output = system.shapes.row(found - names.begin()).transpose();
  }
  return model;
}

}  // namespace microslip::pipelines
