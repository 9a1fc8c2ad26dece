#include "contact/contact_map.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "contact/point_motions.hpp"

namespace microslip::contact {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

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
  map.dissipated_energy.setZero(n);
  map.slip_distance.setZero(n);
  map.wear_depth.setZero(n);
  return map;
}

}  // namespace

ContactMap contact_map(const std::vector<PointParameters>& points, const ModalShapes& shapes,
                       const Harmonics& q, int n_phases, double wear_coefficient) {
  const auto n = static_cast<Eigen::Index>(points.size());
  require(shapes.u.rows() == n && shapes.v.rows() == n,
          std::to_string(n) + " points, but mode shapes at " + std::to_string(shapes.u.rows()) +
              " and " + std::to_string(shapes.v.rows()));
  require(n_phases >= 1, "n_phases = " + std::to_string(n_phases) + ", must be at least 1");
  require(
      std::isfinite(wear_coefficient) && wear_coefficient >= 0.0,
      "wear_coefficient = " + std::to_string(wear_coefficient) + ", must be finite and at least 0");
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
    map.dissipated_energy[i] = cycle.dissipated_energy;
    map.slip_distance[i] = cycle.slip_distance;
    map.wear_depth[i] = wear_coefficient * cycle.normal_slip;
  }
  return map;
}

}  // namespace microslip::contact
