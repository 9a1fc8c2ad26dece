/// @file
/// Resonances of the two linear limits of two models of one structure, every contact point free or
/// stuck: where a peak goes with an effect that is left out, and whether there is another with it.
#pragma once

#include <Eigen/Core>

#include "pipelines/description/curve_request.hpp"
#include "solver/richer_peak.hpp"
#include "solver/scene.hpp"

namespace microslip::pipelines {

/// [rad/s], of a curve.
struct Range {
  double low, high;
  [[nodiscard]] bool is_point() const { return low == high; }
  [[nodiscard]] bool has(double place) const { return place > low && place < high; }
};

[[nodiscard]] Range range_of(const solver::ContinuationOptions& options);

/// Of the resonance of a limit that is nearest to the middle of a range, relative.
[[nodiscard]] double resonance_change(const solver::Scene& own, const solver::OtherModel& with,
                                      const Range& range, LimitName limit);

/// Of both limits the one that moves more.
[[nodiscard]] double resonance_change(const solver::Scene& own, const solver::OtherModel& with,
                                      const Range& range);

/// Of the resonance of either limit that is nearest to a peak [rad/s], the other model's over the
/// own.
[[nodiscard]] double factor_of_nearest(const solver::Scene& own, const solver::OtherModel& with,
                                       double peak);

/// A resonance of the stuck limit answers above an amplitude [m] with the other model, and hardly
/// without it: contact that only that model has drives a mode. It counts where it passes through
/// the range while contact sticks or is free.
[[nodiscard]] bool resonates_only_with(const solver::Scene& own, const solver::OtherModel& with,
                                       const Range& range, double amplitude);

}  // namespace microslip::pipelines
