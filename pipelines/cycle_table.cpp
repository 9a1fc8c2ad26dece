#include "pipelines/cycle_table.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "contact/event_law.hpp"
#include "contact/friction_cycle.hpp"
#include "contact/planar_cycle.hpp"
#include "pipelines/scene_error.hpp"

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

/// Of planar cycles, relative to their force scale: near the tightest there is, a table is no hot path.
constexpr double planar_tolerance = 1e-12;

/// The steady cycle of one row, by the law that serves its motion.
struct RowCycle {
  contact::PointHistory history;
  std::optional<contact::CycleJacobian> jacobian;  ///< single-harmonic motion only
};

bool has_higher_harmonics(const contact::Harmonics& motion) {
  return (motion.rows().bottomRows(motion.rows().rows() - 3).array() != 0.0).any();
}

/// Regime, segments, first harmonic and Jacobian in closed form.
void use_closed_form(const contact::PointParameters& point, const contact::Harmonics& motion,
                     RowCycle& row) {
  const auto& y = motion.rows();
  const contact::FrictionCycle cycle =
      friction_cycle(point, {y(0, 0), y(1, 0), y(2, 0), y(0, 1), y(1, 1), y(2, 1)});
  const auto segments = cycle.segments();
  row.history.regime = cycle.regime;
  row.history.segments.assign(segments.begin(), segments.end());
  row.history.force.rows().topRows(3) << cycle.friction.mean, cycle.normal.mean, 0.0,  //
      cycle.friction.sin, cycle.normal.sin, 0.0,                                       //
      cycle.friction.cos, cycle.normal.cos, 0.0;
  row.history.dissipated_energy = cycle.dissipated_energy;
  row.history.slip_distance = cycle.slip_distance;
  row.history.normal_slip = cycle.normal_slip;
  row.jacobian = cycle.jacobian;
}

bool has_second_direction(const contact::Harmonics& motion) {
  return (motion.rows().col(2).array() != 0.0).any();
}

/// Where the law is chosen.
RowCycle solve(const contact::PointParameters& point, double second_stiffness,
               const contact::Harmonics& motion, int n_harmonics) {
  if (has_second_direction(motion)) {
    const contact::PlanarLaw law(contact::SurfaceLaw(point, second_stiffness), planar_tolerance);
    return {law.history(motion, 0.0, {}, n_harmonics), std::nullopt};
  }
  RowCycle row{contact::EventLaw(point).history(motion, 0.0, {}, n_harmonics), std::nullopt};
  if (!has_higher_harmonics(motion)) use_closed_form(point, motion, row);
  return row;
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

Json cycle_json(const std::string& id, const RowCycle& row, bool two_directions) {
  const contact::PointHistory& cycle = row.history;
  Json segments = Json::array();
  for (const contact::CycleSegment& segment : cycle.segments) {
    segments.push_back(
        {{"state", name_of(segment.state)}, {"start", segment.start}, {"length", segment.length}});
  }
  Json json{{"id", id}, {"regime", name_of(cycle.regime)}, {"segments", std::move(segments)}};
  json["friction"] = force_json(cycle.force, 0);
  if (two_directions) json["friction_w"] = force_json(cycle.force, 2);
  json["normal"] = force_json(cycle.force, 1);
  json["dissipated_energy"] = cycle.dissipated_energy;
  json["slip_distance"] = cycle.slip_distance;
  if (row.jacobian) json["jacobian"] = jacobian_json(*row.jacobian);
  return json;
}

bool is_finite(const RowCycle& row) {
  return row.history.force.rows().allFinite() && (!row.jacobian || row.jacobian->allFinite()) &&
         std::isfinite(row.history.dissipated_energy) && std::isfinite(row.history.slip_distance);
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

}  // namespace

std::string cycles_as_json(const CsvTable& table, std::optional<int> n_harmonics) {
  if (n_harmonics && (*n_harmonics < 1 || *n_harmonics > largest_harmonic)) {
    throw std::invalid_argument(fmt::format("cycles_as_json: {} harmonics; expected 1 to {}",
                                            *n_harmonics, largest_harmonic));
  }
  const CycleColumns columns(table);
  Json list = Json::array();
  for (std::size_t row = 0; row < table.n_rows(); ++row) {
    const std::string id = table.id(row).empty() ? std::to_string(row + 1) : table.id(row);
    const std::string place = table.row_place(row) + ": ";
    if (!is_utf8(id)) throw SceneError(place + "id: not a text in UTF-8");
    const RowCycle cycle =
        solve(columns.point(row), columns.second_stiffness(row), columns.motion(row),
              n_harmonics.value_or(columns.n_harmonics()));
    if (!is_finite(cycle)) {
      throw SceneError(place + "forces or energy beyond the range of double precision");
    }
    list.push_back(cycle_json(id, cycle, columns.has_second_direction()));
  }
  return list.dump(1) + "\n";
}

}  // namespace microslip::pipelines
