#include "contact/planar_history.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace microslip::contact {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// In [0, 2π).
double wrapped(double phase) {
  const double turn = phase - two_pi * std::floor(phase / two_pi);
  return turn < two_pi ? turn : 0.0;
}

const PlanarPiece& piece_at(const PlanarOrbit& orbit, double phase) {
  const auto covers = [phase](const PlanarPiece& piece) {
    return piece.begin <= phase && phase < piece.end;
  };
  const auto found = std::find_if(orbit.pieces.begin(), orbit.pieces.end(), covers);
  return found != orbit.pieces.end() ? *found : orbit.pieces.back();
}

Eigen::Vector2d slider_at(const PlanarMotion& motion, const PlanarPiece& piece, double phase) {
  for (const SlipStep& step : piece.steps) {
    if (phase >= step.end()) continue;
    if (phase <= step.begin) return step.slider;
    SlipStep part;
    part.begin = step.begin;
    part.slider = step.slider;
    part.length = phase - step.begin;
    // Where a shorter step does not converge its successive returns stand in, as in the walk.
    static_cast<void>(solve_slip(motion, 0.0, part));
    return part.end_slider();
  }
  return piece.steps.empty() ? piece.slider : piece.steps.back().end_slider();
}

}  // namespace

std::vector<CycleSegment> planar_segments(const PlanarOrbit& orbit) {
  std::vector<CycleSegment> segments;
  constexpr double shortest = 1e-11;  // the shortest step of a walk
  for (const PlanarPiece& piece : orbit.pieces) {
    const double length = piece.end - piece.begin;
    if (!segments.empty() && (segments.back().state == piece.state || length <= shortest)) {
      segments.back().length += length;
    } else if (length > shortest) {
      segments.push_back({piece.state, wrapped(piece.begin), length, 0.0});
    }
  }
  if (segments.size() > 1 && segments.front().state == segments.back().state) {
    segments.back().length += segments.front().length;
    segments.erase(segments.begin());
  }
  const auto earlier = [](const CycleSegment& a, const CycleSegment& b) {
    return a.start < b.start;
  };
  std::rotate(segments.begin(), std::min_element(segments.begin(), segments.end(), earlier),
              segments.end());
  return segments;
}

PointInstant planar_instant(const PlanarMotion& motion, const PlanarOrbit& orbit, double phase) {
  const double begin = orbit.pieces.front().begin;
  const double turn = begin + wrapped(phase - begin);
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
  const Eigen::Vector2d slider = slider_at(motion, piece, turn);
  Eigen::Vector2d force = now.force(slider);
  const double size = force.norm();
  if (size > now.radius) force *= now.radius / size;
  force *= now.surface.stiffness_ratio * motion.force_scale();
  result.traction = {force[0], now.surface.load, force[1]};
  result.slider = mean + slider * motion.length_scale();
  return result;
}

}  // namespace microslip::contact
