#include "contact/contact_map.hpp"

#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact/closed_form/friction_cycle.hpp"
#include "contact/map/transition_guards.hpp"
#include "contact/patch/point_motions.hpp"
#include "contact/phase.hpp"

namespace microslip::contact {
namespace {

constexpr Eigen::Index n_states = 5;  // of ContactState
constexpr double none = std::numeric_limits<double>::quiet_NaN();

void require(bool condition, const std::string& message) {
  if (!condition) {
    throw std::invalid_argument("contact_map: " + message);
  }
}

ContactMap empty_map(Eigen::Index n, int n_phases) {
  ContactMap map;
  map.phase = Eigen::VectorXd::LinSpaced(n_phases, 0.0, two_pi * (n_phases - 1) / n_phases);
  map.state.setZero(n, n_phases);
  for (Eigen::MatrixXd* field : {&map.normal_traction, &map.friction_traction,
                                 &map.relative_displacement, &map.approach, &map.slip}) {
    field->setZero(n, n_phases);
  }
  for (Eigen::VectorXd* field : {&map.dissipated_energy, &map.slip_distance, &map.wear_depth,
                                 &map.slip_duration, &map.separation_duration}) {
    field->setZero(n);
  }
  map.state_start.setConstant(n, n_states, none);
  map.state_starts.setConstant(n, n_states, none);
  map.state_share.setZero(n, n_states);
  return map;
}

void check_request(int n_phases, double wear_coefficient) {
  require(n_phases >= 1, "n_phases = " + std::to_string(n_phases) + ", must be at least 1");
  require(
      std::isfinite(wear_coefficient) && wear_coefficient >= 0.0,
      "wear_coefficient = " + std::to_string(wear_coefficient) + ", must be finite and at least 0");
}

// One more start per state.
void widen(ContactMap& map) {
  const Eigen::Index m = map.state_starts.cols() / n_states;
  Eigen::MatrixXd wider =
      Eigen::MatrixXd::Constant(map.state_starts.rows(), n_states * (m + 1), none);
  for (Eigen::Index state = 0; state < n_states; ++state) {
    wider.middleCols(state * (m + 1), m) = map.state_starts.middleCols(state * m, m);
  }
  map.state_starts = std::move(wider);
}

// Segments come in order of time, so that starts do.
void add_start(ContactMap& map, Eigen::Index point, const CycleSegment& segment) {
  const auto state = static_cast<Eigen::Index>(segment.state);
  const Eigen::Index m = map.state_starts.cols() / n_states;
  Eigen::Index k = 0;
  while (k < m && !std::isnan(map.state_starts(point, state * m + k))) ++k;
  if (k == m) widen(map);
  const Eigen::Index wide = map.state_starts.cols() / n_states;
  map.state_starts(point, state * wide + k) = segment.start;
  if (k == 0) map.state_start(point, state) = segment.start;
}

void set_segments(ContactMap& map, Eigen::Index point, std::span<const CycleSegment> segments) {
  for (const CycleSegment& segment : segments) {
    if (segments.size() > 1) add_start(map, point, segment);
    map.state_share(point, static_cast<Eigen::Index>(segment.state)) += segment.length / two_pi;
    if (segment.state == ContactState::separated) {
      map.separation_duration[point] += segment.length / two_pi;
    } else if (segment.state != ContactState::stick) {
      map.slip_duration[point] += segment.length / two_pi;
    }
  }
}

void set_instant(ContactMap& map, Eigen::Index i, Eigen::Index j, const PointInstant& now) {
  map.state(i, j) = static_cast<std::uint8_t>(now.state);
  map.friction_traction(i, j) = now.traction[0];
  map.normal_traction(i, j) = now.traction[1];
  map.relative_displacement(i, j) = now.motion[0];
  map.approach(i, j) = now.motion[1];
  map.slip(i, j) = now.slider[0];
  if (map.slip_r.cols() > 0) {
    map.friction_traction_r(i, j) = now.traction[2];
    map.relative_displacement_r(i, j) = now.motion[2];
    map.slip_r(i, j) = now.slider[1];
  }
}

void make_guards(ContactMap& map, Eigen::Index n) {
  for (Eigen::VectorXd* field : {&map.slip_guard, &map.smallest_load, &map.largest_load}) {
    field->setZero(n);
  }
}

void set_guards(ContactMap& map, Eigen::Index point, const TransitionGuards& guards) {
  map.slip_guard[point] = guards.slip;
  map.smallest_load[point] = guards.smallest_load;
  map.largest_load[point] = guards.largest_load;
}

}  // namespace

ContactMap contact_map(const std::vector<PointParameters>& points, const ModalShapes& shapes,
                       const Harmonics& q, int n_phases, double wear_coefficient) {
  const auto n = static_cast<Eigen::Index>(points.size());
  require(shapes.u.rows() == n && shapes.v.rows() == n,
          std::to_string(n) + " points, but mode shapes at " + std::to_string(shapes.u.rows()) +
              " and " + std::to_string(shapes.v.rows()));
  check_request(n_phases, wear_coefficient);
  const std::vector<PointMotion> motions = point_motions(shapes, q);
  ContactMap map = empty_map(n, n_phases);
  make_guards(map, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto point = static_cast<std::size_t>(i);
    set_guards(map, i, transition_guards(points[point], motions[point]));
    const FrictionCycle cycle = friction_cycle(points[point], motions[point]);
    for (Eigen::Index j = 0; j < n_phases; ++j) {
      const CycleInstant now = at_phase(cycle, points[point], motions[point], map.phase[j]);
      map.state(i, j) = static_cast<std::uint8_t>(now.state);
      map.normal_traction(i, j) = now.normal;
      map.friction_traction(i, j) = now.friction;
      map.relative_displacement(i, j) = now.u;
      map.approach(i, j) = now.v;
      map.slip(i, j) = now.slider;
    }
    set_segments(map, i, cycle.segments());
    map.dissipated_energy[i] = cycle.dissipated_energy;
    map.slip_distance[i] = cycle.slip_distance;
    map.wear_depth[i] = wear_coefficient * cycle.normal_slip;
  }
  return map;
}

ContactMap contact_map(const std::vector<std::shared_ptr<const PointMethod>>& methods,
                       const ModalShapes& shapes, const Harmonics& q, double frequency,
                       int n_phases, double wear_coefficient) {
  const auto n = static_cast<Eigen::Index>(methods.size());
  require(shapes.u.rows() == n && shapes.v.rows() == n &&
              (shapes.w.size() == 0 || shapes.w.rows() == n),
          std::to_string(n) + " methods, but mode shapes at " + std::to_string(shapes.u.rows()) +
              " points");
  check_request(n_phases, wear_coefficient);
  const std::vector<Harmonics> motions = general_motions(shapes, q);
  ContactMap map = empty_map(n, n_phases);
  if (shapes.w.size() > 0) {
    for (Eigen::MatrixXd* field :
         {&map.friction_traction_r, &map.relative_displacement_r, &map.slip_r}) {
      field->setZero(n, n_phases);
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto point = static_cast<std::size_t>(i);
    const PointHistory history = methods[point]->history(motions[point], frequency, map.phase, 0);
    for (Eigen::Index j = 0; j < n_phases; ++j) {
      set_instant(map, i, j, history.instants[static_cast<std::size_t>(j)]);
    }
    set_segments(map, i, history.segments);
    map.dissipated_energy[i] = history.dissipated_energy;
    map.slip_distance[i] = history.slip_distance;
    map.wear_depth[i] = wear_coefficient * history.normal_slip;
  }
  return map;
}

void add_guards(ContactMap& map, const std::vector<SurfaceLaw>& surfaces, const ModalShapes& shapes,
                const Harmonics& q, double frequency) {
  const auto n = static_cast<Eigen::Index>(surfaces.size());
  require(shapes.u.rows() == n && map.state.rows() == n,
          std::to_string(n) + " surfaces, but mode shapes at " + std::to_string(shapes.u.rows()) +
              " points and a map of " + std::to_string(map.state.rows()));
  const std::vector<Harmonics> motions = general_motions(shapes, q);
  make_guards(map, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto point = static_cast<std::size_t>(i);
    set_guards(map, i,
               transition_guards(surfaces[point], motions[point], frequency, shapes.w.size() > 0));
  }
}

}  // namespace microslip::contact
