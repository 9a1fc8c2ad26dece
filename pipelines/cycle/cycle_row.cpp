#include "pipelines/cycle/cycle_row.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include "contact/point_cycle.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

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
  contact::PointCycle solved = contact::point_cycle(
      columns.point(row), columns.second_stiffness(row), columns.motion(row), n_harmonics, phases);
  CycleRow cycle{id, std::move(solved.history), solved.jacobian};
  if (!is_finite(cycle)) {
    throw SceneError(place + "forces or energy beyond the range of double precision");
  }
  return cycle;
}

}  // namespace microslip::pipelines
