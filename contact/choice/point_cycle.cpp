#include "contact/point_cycle.hpp"

#include "contact/line/line_events.hpp"
#include "contact/plane/planar_cycle.hpp"

namespace microslip::contact {
namespace {

/// Of planar cycles, relative to their force scale: near the tightest there is,
/// a table is no hot path.
constexpr double planar_tolerance = 1e-12;

bool has_second_direction(const Harmonics& motion) {
  return (motion.rows().col(2).array() != 0.0).any();
}

bool has_higher_harmonics(const Harmonics& motion) {
  return (motion.rows().bottomRows(motion.rows().rows() - 3).array() != 0.0).any();
}

/// Regime, segments, first harmonic and Jacobian in closed form.
void use_closed_form(const PointParameters& point, const Harmonics& motion, PointCycle& result) {
  const auto& y = motion.rows();
  const FrictionCycle cycle =
      friction_cycle(point, {y(0, 0), y(1, 0), y(2, 0), y(0, 1), y(1, 1), y(2, 1)});
  const auto segments = cycle.segments();
  PointHistory& history = result.history;
  history.regime = cycle.regime;
  history.segments.assign(segments.begin(), segments.end());
  history.force.rows().topRows(3) << cycle.friction.mean, cycle.normal.mean, 0.0,  //
      cycle.friction.sin, cycle.normal.sin, 0.0,                                   //
      cycle.friction.cos, cycle.normal.cos, 0.0;
  history.dissipated_energy = cycle.dissipated_energy;
  history.slip_distance = cycle.slip_distance;
  history.normal_slip = cycle.normal_slip;
  result.jacobian = cycle.jacobian;
}

}  // namespace

PointCycle point_cycle(const PointParameters& point, double second_stiffness,
                       const Harmonics& motion, int n_harmonics, const Eigen::VectorXd& phases) {
  if (has_second_direction(motion)) {
    const PlaneEvents method(SurfaceLaw(point, second_stiffness), planar_tolerance);
    return {method.history(motion, 0.0, phases, n_harmonics), std::nullopt};
  }
  PointCycle result{LineEvents(point).history(motion, 0.0, phases, n_harmonics), std::nullopt};
  if (!has_higher_harmonics(motion)) use_closed_form(point, motion, result);
  return result;
}

}  // namespace microslip::contact
