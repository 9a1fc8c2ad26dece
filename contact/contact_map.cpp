#include "contact/contact_map.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>

#include "contact/point_motions.hpp"

namespace microslip::contact {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr Eigen::Index n_states = 5;  // of ContactState

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
  map.state_start.setConstant(n, n_states, std::numeric_limits<double>::quiet_NaN());
  return map;
}

void check_request(int n_phases, double wear_coefficient) {
  require(n_phases >= 1, "n_phases = " + std::to_string(n_phases) + ", must be at least 1");
  require(
      std::isfinite(wear_coefficient) && wear_coefficient >= 0.0,
      "wear_coefficient = " + std::to_string(wear_coefficient) + ", must be finite and at least 0");
}

void set_segments(ContactMap& map, Eigen::Index point, std::span<const CycleSegment> segments) {
  for (const CycleSegment& segment : segments) {
    double& start = map.state_start(point, static_cast<Eigen::Index>(segment.state));
    if (std::isnan(start) && segments.size() > 1) start = segment.start;
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
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto point = static_cast<std::size_t>(i);
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

ContactMap contact_map(const std::vector<std::shared_ptr<const PointLaw>>& laws,
                       const ModalShapes& shapes, const Harmonics& q, double frequency,
                       int n_phases, double wear_coefficient) {
  const auto n = static_cast<Eigen::Index>(laws.size());
  require(shapes.u.rows() == n && shapes.v.rows() == n && (shapes.w.size() == 0 || shapes.w.rows() == n),
          std::to_string(n) + " laws, but mode shapes at " + std::to_string(shapes.u.rows()) +
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
    const PointHistory history = laws[point]->history(motions[point], frequency, map.phase, 0);
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

}  // namespace microslip::contact
