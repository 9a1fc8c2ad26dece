#include "pipelines/cycle/cycle_table.hpp"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "contact/point_cycle.hpp"
#include "pipelines/cycle/cycle_columns.hpp"
#include "pipelines/cycle/cycle_row.hpp"

namespace microslip::pipelines {
namespace {

using Json = nlohmann::ordered_json;

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

Json force_json(const contact::Harmonics& force, Eigen::Index signal) {
  Json sines = Json::array();
  Json cosines = Json::array();
  for (int h = 1; h <= force.n_harmonics(); ++h) {
    sines.push_back(force.sine(h)[signal]);
    cosines.push_back(force.cosine(h)[signal]);
  }
  return {{"mean", force.mean()[signal]}, {"sin", std::move(sines)}, {"cos", std::move(cosines)}};
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

Json cycle_json(const CycleRow& row, bool two_directions) {
  const contact::PointHistory& cycle = row.history;
  Json segments = Json::array();
  for (const contact::CycleSegment& segment : cycle.segments) {
    segments.push_back({{"state", state_name(segment.state)},
                        {"start", segment.start},
                        {"length", segment.length}});
  }
  Json json{{"id", row.id}, {"regime", name_of(cycle.regime)}, {"segments", std::move(segments)}};
  json["friction"] = force_json(cycle.force, 0);
  if (two_directions) json["friction_w"] = force_json(cycle.force, 2);
  json["normal"] = force_json(cycle.force, 1);
  json["dissipated_energy"] = cycle.dissipated_energy;
  json["slip_distance"] = cycle.slip_distance;
  if (cycle.defect > 0.0) json["defect"] = cycle.defect;  // the search ended before its tolerance
  if (row.jacobian) json["jacobian"] = jacobian_json(*row.jacobian);
  return json;
}

}  // namespace

std::string cycles_as_json(const CsvTable& table, std::optional<int> n_harmonics) {
  if (n_harmonics && (*n_harmonics < 1 || *n_harmonics > largest_harmonic)) {
    throw std::invalid_argument(fmt::format("cycles_as_json: {} harmonics; expected 1 to {}",
                                            *n_harmonics, largest_harmonic));
  }
  const CycleColumns columns(table);
  Json list = Json::array();
  for (std::size_t row = 0; row < table.n_rows(); ++row) {
    const CycleRow cycle =
        solve_row(table, columns, row, n_harmonics.value_or(columns.n_harmonics()));
    list.push_back(cycle_json(cycle, columns.has_second_direction()));
  }
  return list.dump(1) + "\n";
}

}  // namespace microslip::pipelines
