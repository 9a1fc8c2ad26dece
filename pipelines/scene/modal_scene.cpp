#include "pipelines/scene/modal_scene.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "mesh/count_text.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/scene_keys.hpp"
#include "pipelines/text/units.hpp"

namespace microslip::pipelines {
namespace {

/// One number per mode; a single number stands for all.
/// @param n_modes  0: the list itself tells how many.
Eigen::VectorXd per_mode(const SectionReader& section, std::string_view key, Eigen::Index n_modes) {
  const toml::node& node = *section.node(key);
  const toml::array* list = node.as_array();
  if (list == nullptr) {
    return Eigen::VectorXd::Constant(std::max<Eigen::Index>(n_modes, 1),
                                     section.number_in(node, key));
  }
  if (list->empty()) section.fail(key, "the list is empty", &node);
  if (n_modes > 0 && static_cast<Eigen::Index>(list->size()) != n_modes) {
    section.fail(key,
                 fmt::format("{} for {}", mesh::counted(list->size(), "value", "values"),
                             mesh::counted(n_modes, "mode", "modes")),
                 &node);
  }
  Eigen::VectorXd values(static_cast<Eigen::Index>(list->size()));
  for (std::size_t i = 0; i < list->size(); ++i) {
    values[static_cast<Eigen::Index>(i)] = section.number_in(*list->get(i), key);
  }
  return values;
}

void require_not_negative(const SectionReader& section, std::string_view key,
                          const Eigen::VectorXd& values) {
  if ((values.array() < 0.0).any()) {
    section.fail(key, fmt::format("{:g} is negative", values.minCoeff()), section.node(key));
  }
}

Eigen::VectorXd natural_frequencies(const SectionReader& section) {
  const bool hertz = section.given("frequency");
  if (hertz == section.given("angular_frequency")) {
    section.fail("frequency", hertz ? "give frequency or angular_frequency, not both"
                                    : "is missing: natural frequencies [Hz], or angular_frequency "
                                      "[rad/s]");
  }
  const std::string_view key = hertz ? "frequency" : "angular_frequency";
  const Eigen::VectorXd values = per_mode(section, key, 0);
  require_not_negative(section, key, values);
  return hertz ? values : Eigen::VectorXd(values / (2.0 * std::numbers::pi));
}

bool may_be_absent(std::string_view column) {
  return column.starts_with("phi_v_") || column.starts_with("phi_w_");
}

/// Of a column of points: the keys name shapes with N in place of the mode.
std::string unit_of_column(std::string_view column) {
  const std::string_view stem = column.substr(0, column.find_last_not_of("0123456789") + 1);
  for (const KeySpec& key : section_spec("modal.point").keys) {
    const bool is_shape =
        key.name.ends_with("_N") && stem == key.name.substr(0, key.name.size() - 1);
    if (key.name == column || is_shape) return std::string(key.unit);
  }
  return "1";
}

/// One number of an inline point; shapes along q and r are zero where they are not given.
double inline_value(const SectionReader& section, const toml::node& entry,
                    const std::string& column) {
  const toml::node* value = entry.as_table()->get(column);
  if (value == nullptr) {
    if (may_be_absent(column)) return 0.0;
    section.fail("points", fmt::format("this point has no {}", column), &entry);
  }
  double number = std::numeric_limits<double>::quiet_NaN();
  if (value->is_string()) {
    try {
      number = to_si(*value->value<std::string>(), unit_of_column(column));
    } catch (const UnitError& error) {
      section.fail("points", fmt::format("{}: {}", column, error.what()), value);
    }
  } else if (value->is_number()) {
    number = *value->value<double>();
  }
  if (!is_of_usable_size(number)) {
    section.fail(
        "points",
        fmt::format("{}: expected a finite number, 0 or of a size from 1e-100 to 1e100", column),
        value);
  }
  return number;
}

/// A list of inline tables as the table a CSV file would give.
CsvTable inline_points(const SectionReader& section, const toml::array& list) {
  std::set<std::string> names;
  std::vector<std::string> places;
  for (const toml::node& entry : list) {
    const toml::table* point = entry.as_table();
    if (point == nullptr) section.fail("points", "expected tables { weight = …, … }", &entry);
    for (const auto& [key, value] : *point) names.insert(std::string(key.str()));
    places.push_back(place_of(&entry, section.file()) + ": modal.points");
  }
  std::vector<std::string> columns(names.begin(), names.end());
  std::vector<double> values;
  for (const toml::node& entry : list) {
    for (const std::string& column : columns)
      values.push_back(inline_value(section, entry, column));
  }
  return CsvTable::from_rows(place_of(&list, section.file()) + ": modal.points", std::move(columns),
                             std::move(values), std::move(places));
}

std::vector<std::string> known_columns(Eigen::Index n_modes) {
  std::vector<std::string> names;
  for (const KeySpec& column : section_spec("modal.point").keys) {
    if (!column.name.ends_with("_N")) {
      names.emplace_back(column.name);
      continue;
    }
    const std::string_view shape = column.name.substr(0, column.name.size() - 1);
    for (Eigen::Index i = 1; i <= n_modes; ++i) names.push_back(fmt::format("{}{}", shape, i));
  }
  return names;
}

void refuse_unknown_columns(const CsvTable& table, Eigen::Index n_modes) {
  const std::vector<std::string> known = known_columns(n_modes);
  const std::vector<std::string_view> views(known.begin(), known.end());
  for (const std::string& column : table.columns()) {
    if (std::find(known.begin(), known.end(), column) != known.end()) continue;
    throw SceneError(unknown_column(table, column, views) + fmt::format(" ({} modes)", n_modes));
  }
}

double not_negative(const CsvTable& table, std::size_t row, std::size_t column) {
  const double value = table.at(row, column);
  if (value < 0.0) {
    throw SceneError(table.place(row, column) + fmt::format("{:g} is negative", value));
  }
  return value;
}

Eigen::MatrixXd shape_columns(const CsvTable& table, const std::string& stem, Eigen::Index n_modes,
                              bool required) {
  const auto n = static_cast<Eigen::Index>(table.n_rows());
  Eigen::MatrixXd shapes = Eigen::MatrixXd::Zero(n, n_modes);
  for (Eigen::Index mode = 0; mode < n_modes; ++mode) {
    const std::string name = fmt::format("{}{}", stem, mode + 1);
    const auto column = required ? std::optional(table.require(name)) : table.find(name);
    if (!column) continue;
    for (Eigen::Index i = 0; i < n; ++i) {
      shapes(i, mode) = table.at(static_cast<std::size_t>(i), *column);
    }
  }
  return shapes;
}

/// 1/k = 1/k_local + c along one direction (theory section 14).
/// @param place  of the column, for messages.
double in_series(double local, double flexibility, const std::string& place) {
  if (local == 0.0 || flexibility == 0.0) return local;
  const double whole = 1.0 / local + flexibility;
  if (!(whole > 0.0)) {
    throw SceneError(
        place +
        fmt::format("{:g} m^3/N makes the contact stiffness not positive: 1/k_local is {:g}",
                    flexibility, 1.0 / local));
  }
  return 1.0 / whole;
}

/// Flexibility of omitted modes at the points, where the table has it, into their stiffness.
void add_residual(ModalModel& model, const CsvTable& table) {
  const std::array names{"residual_p", "residual_q", "residual_r"};
  if (std::none_of(names.begin(), names.end(),
                   [&](const char* name) { return table.find(name).has_value(); }))
    return;
  const Eigen::Index n = model.weights.size();
  model.residual = ResidualKind::stiffness;
  model.compliance = Eigen::MatrixX3d::Zero(n, 3);
  if (model.second_stiffness.size() == 0) {
    model.second_stiffness.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      model.second_stiffness[i] = model.points[static_cast<std::size_t>(i)].tangential_stiffness;
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto column = table.find(names[static_cast<std::size_t>(axis)]);
    if (!column) continue;
    for (std::size_t i = 0; i < table.n_rows(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      contact::PointParameters& point = model.points[i];
      double& stiffness = axis == 0   ? point.tangential_stiffness
                          : axis == 1 ? point.normal_stiffness
                                      : model.second_stiffness[row];
      model.compliance(row, axis) = table.at(i, *column);
      const double local = stiffness;
      stiffness = in_series(local, model.compliance(row, axis), table.place(i, *column));
      // A gap is −rest load over the stiffness of its row: the length stays.
      if (axis == 1 && point.rest_load < 0.0 && local > 0.0) point.rest_load *= stiffness / local;
    }
  }
}

}  // namespace

void set_points(ModalModel& model, const CsvTable& table, Eigen::Index n_modes) {
  if (table.n_rows() == 0) throw SceneError(table.name() + ": no contact points under the header");
  refuse_unknown_columns(table, n_modes);
  const std::size_t weight = table.require("weight");
  const std::size_t tangential = table.require("tangential_stiffness");
  const std::size_t normal = table.require("normal_stiffness");
  const std::size_t friction = table.require("friction_coefficient");
  const std::size_t preload = table.require("preload");
  model.weights.resize(static_cast<Eigen::Index>(table.n_rows()));
  for (std::size_t i = 0; i < table.n_rows(); ++i) {
    model.weights[static_cast<Eigen::Index>(i)] = not_negative(table, i, weight);
    model.points.push_back({not_negative(table, i, tangential), not_negative(table, i, normal),
                            not_negative(table, i, friction), table.at(i, preload)});
  }
  model.shapes = {shape_columns(table, "phi_u_", n_modes, true),
                  shape_columns(table, "phi_v_", n_modes, false),
                  shape_columns(table, "phi_w_", n_modes, false)};
  if (const auto second = table.find("tangential_stiffness_r")) {
    model.second_stiffness.resize(model.weights.size());
    for (std::size_t i = 0; i < table.n_rows(); ++i) {
      model.second_stiffness[static_cast<Eigen::Index>(i)] = not_negative(table, i, *second);
    }
  }
  add_residual(model, table);
  const auto p = table.find("p");
  const auto r = table.find("r");
  if (!p && !r) return;
  model.positions = Eigen::MatrixX2d::Zero(model.weights.size(), 2);
  for (std::size_t i = 0; i < table.n_rows(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (p) model.positions(row, 0) = table.at(i, *p);
    if (r) model.positions(row, 1) = table.at(i, *r);
  }
}

ModalModel read_modal(SectionReader section, const std::filesystem::path& folder) {
  ModalModel model;
  model.frequency_hz = natural_frequencies(section);
  const Eigen::Index n = model.frequency_hz.size();
  model.damping_ratio = per_mode(section, "damping_ratio", n);
  require_not_negative(section, "damping_ratio", model.damping_ratio);
  model.force_sine = per_mode(section, "force_sine", n);
  model.force_cosine = per_mode(section, "force_cosine", n);
  model.force_static = per_mode(section, "force_static", n);
  model.output = per_mode(section, "output", n);
  model.n_attachment = section.integer("attachment");
  if (model.n_attachment >= n) {
    section.fail("attachment",
                 fmt::format("{} of {} modes: at least one is free", model.n_attachment, n),
                 section.node("attachment"));
  }
  if (model.n_attachment > 0) model.residual = ResidualKind::attachment;
  const toml::node& points = *section.node("points");
  if (const auto file = points.value<std::string>(); file && points.is_string()) {
    const std::filesystem::path path =
        std::filesystem::path(*file).is_absolute() ? std::filesystem::path(*file) : folder / *file;
    set_points(model, CsvTable::read(path), n);
    section.complete("points", path.string());  // scene.toml stands elsewhere than the scene
  } else if (const toml::array* list = points.as_array()) {
    if (!list->empty()) set_points(model, inline_points(section, *list), n);
  } else {
    section.fail("points", "expected the name of a CSV file, or a list of tables", &points);
  }
  return model;
}

}  // namespace microslip::pipelines
