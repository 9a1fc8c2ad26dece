#include "pipelines/cycle/cycle_row.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "contact/line/event_law.hpp"
#include "contact/plane/planar_cycle.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

/// Of planar cycles, relative to their force scale: near the tightest there is, a table is no hot path.
constexpr double planar_tolerance = 1e-12;

bool has_higher_harmonics(const contact::Harmonics& motion) {
  return (motion.rows().bottomRows(motion.rows().rows() - 3).array() != 0.0).any();
}

/// Regime, segments, first harmonic and Jacobian in closed form.
void use_closed_form(const contact::PointParameters& point, const contact::Harmonics& motion,
                     CycleRow& row) {
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
CycleRow solve(const contact::PointParameters& point, double second_stiffness,
               const contact::Harmonics& motion, int n_harmonics, const Eigen::VectorXd& phases) {
  if (has_second_direction(motion)) {
    const contact::PlanarLaw law(contact::SurfaceLaw(point, second_stiffness), planar_tolerance);
    return {"", law.history(motion, 0.0, phases, n_harmonics), std::nullopt};
  }
  CycleRow row{"", contact::EventLaw(point).history(motion, 0.0, phases, n_harmonics),
               std::nullopt};
  if (!has_higher_harmonics(motion)) use_closed_form(point, motion, row);
  return row;
}

bool is_finite(const CycleRow& row) {
  const auto& instants = row.history.instants;
  return row.history.force.rows().allFinite() && (!row.jacobian || row.jacobian->allFinite()) &&
         std::isfinite(row.history.dissipated_energy) && std::isfinite(row.history.slip_distance) &&
         std::ranges::all_of(instants, [](const contact::PointInstant& at) {
           return at.motion.allFinite() && at.traction.allFinite() && at.slider.allFinite();
         });
}

/// Whether every byte belongs to a character: JSON can hold nothing else.
bool is_utf8(const std::string& text) {
  try {
    static_cast<void>(nlohmann::json(text).dump());
    return true;
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

}  // namespace

const char* state_name(contact::ContactState state) {
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

CycleRow solve_row(const CsvTable& table, const CycleColumns& columns, std::size_t row,
                   int n_harmonics, const Eigen::VectorXd& phases) {
  const std::string id = table.id(row).empty() ? std::to_string(row + 1) : table.id(row);
  const std::string place = table.row_place(row) + ": ";
  if (!is_utf8(id)) throw SceneError(place + "id: not a text in UTF-8");
  CycleRow cycle = solve(columns.point(row), columns.second_stiffness(row), columns.motion(row),
                         n_harmonics, phases);
  if (!is_finite(cycle)) {
    throw SceneError(place + "forces or energy beyond the range of double precision");
  }
  cycle.id = id;
  return cycle;
}

}  // namespace microslip::pipelines
