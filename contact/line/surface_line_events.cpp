#include "contact/line/surface_line_events.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "contact/line/band_force.hpp"
#include "contact/line/band_quadrature.hpp"
#include "contact/line/band_walk.hpp"
#include "contact/line/slider_band.hpp"
#include "contact/point/cycle_segments.hpp"

namespace microslip::contact {
namespace {

/// Storage of one thread, so that an evaluation allocates little once it has grown.
struct Workshop {
  SliderBand band;
  BandCycle cycle;
  BandTraction traction;
};

Workshop& workshop() {
  thread_local Workshop shop;
  return shop;
}

/// The same without w.
Harmonics along_p(const Harmonics& motion) {
  if (motion.n_signals() != n_point_signals || motion.n_harmonics() < 1) {
    throw std::invalid_argument("SurfaceLineEvents: a motion of " +
                                std::to_string(motion.n_signals()) + " signals and " +
                                std::to_string(motion.n_harmonics()) +
                                " harmonics; expected 3 signals and at least 1 harmonic");
  }
  Harmonics straight = motion;
  straight.rows().col(2).setZero();
  return straight;
}

/// As short as this, a phase is that of a rounded angle.
constexpr double shortest_segment = 1e-12;

std::vector<CycleSegment> segments_of(const BandCycle& cycle) {
  std::vector<CycleSegment> phases;
  for (const BandPiece& piece : cycle.pieces) {
    phases.push_back({piece.state, piece.begin, piece.end - piece.begin, 0.0});
  }
  return joined_segments(phases, shortest_segment);
}

/// The motion is left to the caller.
PointInstant instant_of(SliderBand& band, const BandCycle& cycle, double phase) {
  const double begin = cycle.pieces.front().begin;
  const double turn = begin + wrapped_phase(phase - begin);
  const auto covers = [turn](const BandPiece& piece) {
    return piece.begin <= turn && turn < piece.end;
  };
  const auto found = std::find_if(cycle.pieces.begin(), cycle.pieces.end(), covers);
  const BandPiece& piece = found != cycle.pieces.end() ? *found : cycle.pieces.back();
  const BandInstant now = band.at(turn);
  const double mean = band.position_mean();
  PointInstant result;
  result.state = piece.state;
  const bool touches = piece.state != ContactState::separated;
  const double limit = now.surface.friction_coefficient * now.surface.load;
  result.traction = {std::clamp(band_friction(band, piece, now), -limit, limit),
                     touches ? now.surface.load : 0.0, 0.0};
  double slider = now.position;
  if (piece.state == ContactState::positive_slip) slider = now.lower();
  if (piece.state == ContactState::negative_slip) slider = now.upper();
  if (piece.state == ContactState::stick) slider = piece.slider;
  result.slider[0] = band.has_spring() ? slider + mean : 0.0;
  return result;
}

}  // namespace

void SurfaceLineEvents::traction(const Harmonics& motion, double frequency,
                                 PointTraction& result) const {
  Workshop& shop = workshop();
  shop.band.set(law_, along_p(motion), frequency);
  walk_band(shop.band, shop.cycle);
  shop.traction.set(shop.band, shop.cycle, result);
}

void SurfaceLineEvents::states(const Harmonics& motion, double frequency,
                               PointTraction& result) const {
  Workshop& shop = workshop();
  shop.band.set(law_, along_p(motion), frequency);
  walk_band(shop.band, shop.cycle);
  set_states(shop.cycle, result);
}

PointHistory SurfaceLineEvents::history(const Harmonics& motion, double frequency,
                                        const Eigen::VectorXd& phases, int n_harmonics) const {
  Workshop& shop = workshop();
  shop.band.set(law_, along_p(motion), frequency);
  walk_band(shop.band, shop.cycle);
  const BandWork work = band_work(shop.band, shop.cycle);
  PointHistory result;
  result.regime = shop.cycle.regime;
  result.segments = segments_of(shop.cycle);
  result.force = band_force(shop.band, shop.cycle, n_harmonics);
  result.dissipated_energy = work.dissipated_energy;
  result.slip_distance = work.slip_distance;
  result.normal_slip = work.normal_slip;
  result.instants.reserve(static_cast<std::size_t>(phases.size()));
  for (const double phase : phases) {
    result.instants.push_back(instant_of(shop.band, shop.cycle, phase));
  }
  for (std::size_t i = 0; i < result.instants.size(); ++i) {
    PointInstant& instant = result.instants[i];
    instant.motion = motion.at(phases[static_cast<Eigen::Index>(i)]);
    instant.slider[1] = instant.motion[2];
  }
  return result;
}

Eigen::Vector3d SurfaceLineEvents::stuck_stiffness() const {
  const SurfaceState rest = law_.at(0.0, 0.0);
  const double normal = law_.is_smooth() ? law_.point().normal_stiffness : rest.load_by_approach;
  return {law_.has_friction() ? law_.first_stiffness() * rest.stiffness_ratio : 0.0, normal, 0.0};
}

std::optional<LinearRange> SurfaceLineEvents::linear_range() const {
  std::optional<LinearRange> range = law_.linear_range();
  if (range) range->stiffness[2] = 0.0;
  return range;
}

}  // namespace microslip::contact
