#include "contact/plane/planar_cycle.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact/plane/planar_history.hpp"
#include "contact/plane/planar_integrals.hpp"
#include "contact/plane/planar_quadrature.hpp"
#include "contact/plane/planar_steady.hpp"

namespace microslip::contact {
namespace {

using Intervals = std::vector<PlanarInterval>;

CycleRegime regime_of_contact(const Intervals& intervals) {
  const auto touches = [](const PlanarInterval& x) { return x.in_contact; };
  if (std::none_of(intervals.begin(), intervals.end(), touches)) return CycleRegime::separated;
  return std::all_of(intervals.begin(), intervals.end(), touches) ? CycleRegime::full_stick
                                                                  : CycleRegime::separation;
}

/// Whether the point would slide if nothing held it: μ = 0 with stiffness and tangential motion.
bool slides_freely(const PlanarMotion& motion) {
  const SurfaceLaw& law = motion.law();
  const Harmonics& x = motion.harmonics();
  const Eigen::Index moving = x.rows().rows() - 1;
  const bool along_p = law.first_stiffness() > 0.0 && !x.rows().col(0).tail(moving).isZero(0.0);
  const bool along_r = law.second_stiffness() > 0.0 && !x.rows().col(2).tail(moving).isZero(0.0);
  return !law.has_friction() && (along_p || along_r);
}

/// An orbit without friction: the states alone.
PlanarOrbit frictionless_orbit(const PlanarMotion& motion, const Intervals& intervals) {
  const ContactState held = slides_freely(motion) ? ContactState::slip : ContactState::stick;
  PlanarOrbit orbit;
  for (const PlanarInterval& interval : intervals) {
    PlanarPiece piece;
    piece.state = interval.in_contact ? held : ContactState::separated;
    piece.begin = interval.begin;
    piece.end = interval.end;
    orbit.pieces.push_back(std::move(piece));
  }
  return orbit;
}

/// The cycle of a point, with or without friction.
SteadyOrbit cycle_of(const PlanarMotion& motion, const Intervals& intervals,
                     const OrbitOptions& options) {
  if (motion.has_friction()) {
    SteadyOrbit steady = steady_orbit(motion, intervals, options);
    if (!steady.orbit.pieces.empty()) return steady;
  }
  SteadyOrbit steady;
  steady.orbit = frictionless_orbit(motion, intervals);
  steady.regime = regime_of_contact(intervals);
  if (steady.regime == CycleRegime::full_stick && slides_freely(motion)) {
    steady.regime = CycleRegime::stick_slip;
  }
  return steady;
}

/// Of an orbit, whose forces are counted in k a + max μn,
/// for friction of the size of the smaller of both.
double tolerance_of(const PlanarMotion& motion, double tolerance) {
  constexpr double rounding = 1e-15;  // of a slider of order one
  return std::max(tolerance * motion.friction_share(), rounding);
}

/// In units of force; 0 where the search met its tolerance or has nothing left to do.
double defect_of(const PlanarMotion& motion, const SteadyOrbit& steady, double tolerance) {
  const bool met = steady.closes || steady.defect <= tolerance;
  return met ? 0.0 : steady.defect * motion.force_scale();
}

void check_motion(const Harmonics& motion) {
  if (motion.n_signals() == n_point_signals && motion.n_harmonics() >= 1) return;
  throw std::invalid_argument("PlaneEvents: a motion of " + std::to_string(motion.n_signals()) +
                              " signals and " + std::to_string(motion.n_harmonics()) +
                              " harmonics; expected 3 signals and at least 1 harmonic");
}

/// Slip without friction covers the whole way while in contact.
void add_free_slip(const PlanarMotion& motion, const Intervals& intervals, PointHistory& result) {
  const SurfaceLaw& law = motion.law();
  const double p = law.first_stiffness() > 0.0 ? 1.0 : 0.0;
  const double r = law.second_stiffness() > 0.0 ? 1.0 : 0.0;
  constexpr int finest = 16;  // the speed has kinks where the motion turns back
  for (const PlanarInterval& interval : intervals) {
    if (!interval.in_contact) continue;
    visit_nodes(motion, interval.begin, interval.end, finest * motion.n_harmonics(),
                [&](const PlanarInstant& now, double weight) {
                  const double way = weight * std::hypot(p * now.velocity[0], r * now.velocity[1]);
                  result.slip_distance += way;
                  result.normal_slip += way * now.surface.load;
                });
  }
}

void set_states(const SteadyOrbit& steady, PointTraction& result) {
  result.regime = steady.regime;
  for (const PlanarPiece& piece : steady.orbit.pieces) {
    result.period.set(piece.state, piece.begin, piece.end - piece.begin);
  }
}

/// Force and states of a cycle, without derivatives.
SteadyOrbit found(const PlanarMotion& motion, const Intervals& intervals, int n_harmonics,
                  double tolerance, PointTraction& result) {
  const OrbitOptions options{tolerance_of(motion, tolerance), static_cast<double>(n_harmonics)};
  SteadyOrbit steady = cycle_of(motion, intervals, options);
  set_states(steady, result);
  result.defect = defect_of(motion, steady, options.tolerance);
  result.force = planar_force(motion, intervals, steady.orbit, n_harmonics);
  return steady;
}

}  // namespace

PlaneEvents::PlaneEvents(SurfaceLaw law, double tolerance) : law_(law), tolerance_(tolerance) {
  if (!(tolerance >= 1e-13 && tolerance <= 1e-2)) {
    throw std::invalid_argument("PlaneEvents: tolerance " + std::to_string(tolerance) +
                                "; expected 1e-13 to 1e-2");
  }
}

void PlaneEvents::traction_alone(const Harmonics& motion, double frequency,
                                 PointTraction& result) const {
  check_motion(motion);
  const PlanarMotion planar(law_, motion, frequency);
  static_cast<void>(
      found(planar, planar_intervals(planar), motion.n_harmonics(), tolerance_, result));
}

void PlaneEvents::states(const Harmonics& motion, double frequency, PointTraction& result) const {
  check_motion(motion);
  const PlanarMotion planar(law_, motion, frequency);
  const double tolerance = std::max(tolerance_, states_tolerance);
  const OrbitOptions options{tolerance_of(planar, tolerance),
                             static_cast<double>(motion.n_harmonics())};
  set_states(cycle_of(planar, planar_intervals(planar), options), result);
}

void PlaneEvents::traction(const Harmonics& motion, double frequency, PointTraction& result) const {
  check_motion(motion);
  const PlanarMotion planar(law_, motion, frequency);
  const Intervals intervals = planar_intervals(planar);
  const int H = motion.n_harmonics();
  const SteadyOrbit steady = found(planar, intervals, H, tolerance_, result);
  const Eigen::Index m = n_point_signals * (2 * H + 1);
  result.jacobian.setZero(m, m);
  result.frequency_derivative.setZero(m);
  const Eigen::MatrixXd load = load_derivative(planar, intervals);
  for (Eigen::Index i = 0; i < load.rows(); ++i) {
    for (Eigen::Index j = 0; j < load.cols(); ++j) {
      result.jacobian(3 * i + 1, 3 * j + 1) = load(i, j);
    }
  }
  if (!planar.has_friction() || steady.regime == CycleRegime::separated) return;
  const SteadyDerivative friction = steady_derivative(planar, steady);
  for (Eigen::Index i = 0; i < load.rows(); ++i) {
    result.jacobian.row(3 * i) = friction.first.row(i).head(m);
    result.jacobian.row(3 * i + 2) = friction.second.row(i).head(m);
    result.frequency_derivative[3 * i] = friction.first(i, m);
    result.frequency_derivative[3 * i + 2] = friction.second(i, m);
  }
}

PointHistory PlaneEvents::history(const Harmonics& motion, double frequency,
                                  const Eigen::VectorXd& phases, int n_harmonics) const {
  check_motion(motion);
  const PlanarMotion planar(law_, motion, frequency);
  const Intervals intervals = planar_intervals(planar);
  const double highest = std::max(n_harmonics, motion.n_harmonics());
  const OrbitOptions options{tolerance_of(planar, tolerance_), highest};
  const SteadyOrbit steady = cycle_of(planar, intervals, options);
  PointHistory result;
  result.regime = steady.regime;
  result.defect = defect_of(planar, steady, options.tolerance);
  result.segments = planar_segments(steady.orbit);
  result.force = planar_force(planar, intervals, steady.orbit, n_harmonics);
  if (planar.has_friction()) {
    const PlanarWork work = planar_work(planar, steady.orbit);
    result.dissipated_energy = work.dissipated_energy;
    result.slip_distance = work.slip_distance;
    result.normal_slip = work.normal_slip;
  } else if (slides_freely(planar)) {
    add_free_slip(planar, intervals, result);
  }
  result.instants.reserve(static_cast<std::size_t>(phases.size()));
  for (const double phase : phases) {
    result.instants.push_back(planar_instant(planar, steady.orbit, phase));
  }
  return result;
}

Eigen::Vector3d PlaneEvents::stuck_stiffness() const {
  const SurfaceState rest = law_.at(0.0, 0.0);
  if (law_.is_smooth()) {
    const bool rubs = law_.has_friction();
    return {rubs ? law_.first_stiffness() : 0.0, law_.point().normal_stiffness,
            rubs ? law_.second_stiffness() : 0.0};
  }
  const double rubs = law_.has_friction() ? 1.0 : 0.0;
  return {rubs * rest.stiffness_ratio * law_.first_stiffness(), rest.load_by_approach,
          rubs * rest.second_stiffness_ratio * law_.second_stiffness()};
}

}  // namespace microslip::contact
