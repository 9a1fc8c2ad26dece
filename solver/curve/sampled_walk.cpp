#include "solver/sampled_walk.hpp"

#include <cmath>

namespace microslip::solver {
namespace {

// Of random cantilevers with 256 instants: pairs of folds that located events do not have are up to
// 2e-5 of the frequency apart.
constexpr double close_frequency = 3e-5;
constexpr double close_amplitude = 0.03;
constexpr std::size_t usual_points = 500;  // a curve takes some hundred

}  // namespace

void SampledWalk::add(const ResponsePoint& point) {
  ++n_points_;
  if (point.mark != PointMark::fold) return;
  if (last_) {
    const double way = std::abs(point.frequency - last_->frequency);
    const double rise = std::abs(point.amplitude - last_->amplitude);
    const bool close =
        way < close_frequency * point.frequency && rise < close_amplitude * point.amplitude;
    close_folds_ = close_folds_ || close;
  }
  last_ = Fold{point.frequency, point.amplitude};
}

bool SampledWalk::is_led_by_errors() const { return close_folds_ || n_points_ > usual_points; }

bool is_led_by_errors(std::span<const ResponsePoint> branch) {
  SampledWalk walk;
  for (const ResponsePoint& point : branch) walk.add(point);
  return walk.is_led_by_errors();
}

}  // namespace microslip::solver
