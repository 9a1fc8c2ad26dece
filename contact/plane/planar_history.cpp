#include "contact/plane/planar_history.hpp"

#include <algorithm>

#include "contact/point/cycle_segments.hpp"

namespace microslip::contact {
namespace {

const PlanarPiece& piece_at(const PlanarOrbit& orbit, double phase) {
  const auto covers = [phase](const PlanarPiece& piece) {
    return piece.begin <= phase && phase < piece.end;
  };
  const auto found = std::find_if(orbit.pieces.begin(), orbit.pieces.end(), covers);
  return found != orbit.pieces.end() ? *found : orbit.pieces.back();
}

/// Slider / L₀ and K (x − s) / F₀ of a piece in contact. In slip the latter lies along the
/// direction of the collocation: of little friction x − s is rounding.
struct Held {
  Eigen::Vector2d slider = Eigen::Vector2d::Zero();
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
};

Held held_at(const PlanarMotion& motion, const PlanarPiece& piece, const PlanarInstant& now) {
  constexpr int last = n_stages - 1;
  for (const SlipStep& step : piece.steps) {
    if (now.phase >= step.end()) continue;
    if (now.phase <= step.begin)
      return {step.slider, now.limit * step.direction_at(0.0).normalized()};
    SlipStep part;
    part.begin = step.begin;
    part.slider = step.slider;
    part.length = now.phase - step.begin;
    // Where a shorter step does not converge its successive returns stand in, as in the walk.
    static_cast<void>(solve_slip(motion, 0.0, part));
    return {part.end_slider(), now.limit * part.direction.col(last)};
  }
  if (piece.steps.empty()) return {piece.slider, now.held_force(piece.slider)};
  const SlipStep& step = piece.steps.back();
  return {step.end_slider(), now.limit * step.direction.col(last)};
}

}  // namespace

std::vector<CycleSegment> planar_segments(const PlanarOrbit& orbit) {
  std::vector<CycleSegment> phases;
  for (const PlanarPiece& piece : orbit.pieces) {
    phases.push_back({piece.state, piece.begin, piece.end - piece.begin, 0.0});
  }
  constexpr double shortest = 1e-11;  // the shortest step of a walk
  return joined_segments(phases, shortest);
}

PointInstant planar_instant(const PlanarMotion& motion, const PlanarOrbit& orbit, double phase) {
  const double begin = orbit.pieces.front().begin;
  const double turn = begin + wrapped_phase(phase - begin);
  const PlanarPiece& piece = piece_at(orbit, turn);
  const PlanarInstant now = motion.at(turn);
  const Eigen::VectorXd signals = motion.harmonics().at(phase);
  PointInstant result;
  result.state = piece.state;
  result.motion = signals;
  const Eigen::Vector2d moving = now.position * motion.length_scale();
  const Eigen::Vector2d mean = Eigen::Vector2d(signals[0], signals[2]) - moving;
  if (piece.state == ContactState::separated || !motion.has_friction()) {
    if (piece.state != ContactState::separated) result.traction[1] = now.surface.load;
    if (piece.state != ContactState::stick) result.slider = {signals[0], signals[2]};
    return result;
  }
  const Held held = held_at(motion, piece, now);
  const Eigen::Vector2d force = held.force * (now.surface.stiffness_ratio * motion.force_scale());
  result.traction = {force[0], now.surface.load, force[1]};
  result.slider = mean + held.slider * motion.length_scale();
  return result;
}

}  // namespace microslip::contact
