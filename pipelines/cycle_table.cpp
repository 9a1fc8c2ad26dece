#include "pipelines/cycle_table.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "contact/friction_cycle.hpp"
#include "pipelines/cycle_harmonics.hpp"
#include "pipelines/scene_error.hpp"

namespace microslip::pipelines {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 9> required_columns{"tangential_stiffness",
                                                           "normal_stiffness",
                                                           "friction_coefficient",
                                                           "preload",
                                                           "u_sin",
                                                           "u_cos",
                                                           "v_mean",
                                                           "v_sin",
                                                           "v_cos"};

const char* name_of(contact::CycleRegime regime) {
  switch (regime) {
    case contact::CycleRegime::full_stick:
      return "full_stick";
    case contact::CycleRegime::stick_slip:
      return "stick_slip";
    case contact::CycleRegime::separation:
      return "separation";
    case contact::CycleRegime::separated:
      return "separated";
  }
  return "";
}

const char* name_of(contact::ContactState state) {
  switch (state) {
    case contact::ContactState::stick:
      return "stick";
    case contact::ContactState::positive_slip:
      return "positive_slip";
    case contact::ContactState::negative_slip:
      return "negative_slip";
    case contact::ContactState::slip:
      return "slip";
    case contact::ContactState::separated:
      return "separated";
  }
  return "";
}

/// u_sin2, v_cos3, w_sin, …: motions of laws that come later.
bool is_later_motion(std::string_view column) {
  if (column.starts_with("w_")) return true;
  for (const std::string_view stem : {"u_sin", "u_cos", "v_sin", "v_cos"}) {
    if (!column.starts_with(stem) || column.size() == stem.size()) continue;
    const std::string_view number = column.substr(stem.size());
    return std::all_of(number.begin(), number.end(),
                       [](unsigned char c) { return std::isdigit(c) != 0; });
  }
  return false;
}

/// A later law may be named with zeros everywhere: then it says nothing that is not simulated.
void check_columns(const CsvTable& table) {
  std::vector<std::string_view> known(required_columns.begin(), required_columns.end());
  known.insert(known.end(), {"id", "u_mean"});
  for (std::size_t column = 0; column < table.columns().size(); ++column) {
    const std::string& name = table.columns()[column];
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    if (!is_later_motion(name)) {
      throw SceneError(unknown_column(table, name, known));
    }
    for (std::size_t row = 0; row < table.n_rows(); ++row) {
      if (table.at(row, column) == 0.0) continue;
      throw SceneError(table.place(row, column) +
                       "several harmonics and two tangential directions are not available in this "
                       "version");
    }
  }
}

/// @param higher  harmonics 2, 3, …
Json force_json(const contact::ForceCoefficients& force, const HarmonicSeries& higher) {
  Json sines = Json::array({force.sin});
  Json cosines = Json::array({force.cos});
  for (const double value : higher.sin) sines.push_back(value);
  for (const double value : higher.cos) cosines.push_back(value);
  return {{"mean", force.mean}, {"sin", std::move(sines)}, {"cos", std::move(cosines)}};
}

Json jacobian_json(const contact::CycleJacobian& jacobian) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < jacobian.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 1; j < jacobian.cols(); ++j) row.push_back(jacobian(i, j));  // no u_mean
    rows.push_back(std::move(row));
  }
  return rows;
}

Json cycle_json(const std::string& id, const contact::FrictionCycle& cycle,
                const CycleHarmonics& higher) {
  Json segments = Json::array();
  for (const contact::CycleSegment& segment : cycle.segments()) {
    segments.push_back(
        {{"state", name_of(segment.state)}, {"start", segment.start}, {"length", segment.length}});
  }
  return {{"id", id},
          {"regime", name_of(cycle.regime)},
          {"segments", std::move(segments)},
          {"friction", force_json(cycle.friction, higher.friction)},
          {"normal", force_json(cycle.normal, higher.normal)},
          {"dissipated_energy", cycle.dissipated_energy},
          {"slip_distance", cycle.slip_distance},
          {"jacobian", jacobian_json(cycle.jacobian)}};
}

bool is_finite(const contact::FrictionCycle& cycle) {
  const auto finite = [](const contact::ForceCoefficients& force) {
    return std::isfinite(force.mean) && std::isfinite(force.sin) && std::isfinite(force.cos);
  };
  return finite(cycle.friction) && finite(cycle.normal) && cycle.jacobian.allFinite() &&
         std::isfinite(cycle.dissipated_energy) && std::isfinite(cycle.slip_distance);
}

/// Whether every byte belongs to a character: JSON can hold nothing else.
bool is_utf8(const std::string& text) {
  try {
    static_cast<void>(Json(text).dump());
    return true;
  } catch (const Json::exception&) {
    return false;
  }
}

class Rows {
 public:
  explicit Rows(const CsvTable& table) : table_(table), u_mean_(table.find("u_mean")) {
    for (std::size_t i = 0; i < required_columns.size(); ++i) {
      column_[i] = table.require(required_columns[i]);
    }
  }

  [[nodiscard]] contact::PointParameters point(std::size_t row) const {
    for (std::size_t i = 0; i < 3; ++i) {
      if (get(row, i) < 0.0) {
        throw SceneError(table_.place(row, column_[i]) +
                         fmt::format("{:g} is negative", get(row, i)));
      }
    }
    return {get(row, 0), get(row, 1), get(row, 2), get(row, 3)};
  }

  /// "file:line: " of a row.
  [[nodiscard]] std::string place(std::size_t row) const { return table_.row_place(row) + ": "; }

  [[nodiscard]] contact::PointMotion motion(std::size_t row) const {
    return {u_mean_ ? table_.at(row, *u_mean_) : 0.0,
            get(row, 4),
            get(row, 5),
            get(row, 6),
            get(row, 7),
            get(row, 8)};
  }

 private:
  [[nodiscard]] double get(std::size_t row, std::size_t i) const {
    return table_.at(row, column_[i]);
  }

  const CsvTable& table_;
  std::array<std::size_t, required_columns.size()> column_{};
  std::optional<std::size_t> u_mean_;
};

}  // namespace

std::string cycles_as_json(const CsvTable& table, int n_harmonics) {
  if (n_harmonics < 1 || n_harmonics > largest_harmonic) {
    throw std::invalid_argument(fmt::format("cycles_as_json: {} harmonics; expected 1 to {}",
                                            n_harmonics, largest_harmonic));
  }
  const Rows rows(table);
  check_columns(table);
  Json list = Json::array();
  for (std::size_t row = 0; row < table.n_rows(); ++row) {
    const std::string id = table.id(row).empty() ? std::to_string(row + 1) : table.id(row);
    if (!is_utf8(id)) throw SceneError(rows.place(row) + "id: not a text in UTF-8");
    const contact::PointParameters point = rows.point(row);
    const contact::PointMotion motion = rows.motion(row);
    const contact::FrictionCycle cycle = contact::friction_cycle(point, motion);
    if (!is_finite(cycle)) {
      throw SceneError(rows.place(row) + "forces or energy beyond the range of double precision");
    }
    list.push_back(cycle_json(id, cycle, higher_harmonics(cycle, point, motion, n_harmonics)));
  }
  return list.dump(1) + "\n";
}

}  // namespace microslip::pipelines
