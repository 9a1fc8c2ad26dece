/// @file
/// A sampled cycle in full: segments, work and slip between the samples, and any instant.
///
/// Phases at which states change are found between two samples by the guard that decides: approach at
/// touch-down and lift-off, the end of the slider's band at the onset of slip, the speed of the slider
/// at its end; each interpolated linearly, to O(1/M²) (theory section 7).
#pragma once

#include <vector>

#include "contact/point/point_law.hpp"
#include "tests/support/sampled/sampled_slider.hpp"

namespace microslip::contact {

/// States in order of time from the smallest start; neighbours differ, lengths sum to 2π.
/// @param has_spring  k_u > 0; otherwise the point counts as stuck wherever it is in contact.
[[nodiscard]] std::vector<CycleSegment> sampled_segments(const SampledMotion& motion,
                                                         const SampledSlider& slider,
                                                         bool has_spring);

struct SampledWork {
  double dissipated_energy = 0.0;  ///< ∮ μ n |ds| [J/m²]
  double normal_slip = 0.0;        ///< ∮ n |ds| [Pa·m]
  double slip_distance = 0.0;      ///< ∮ |ds| in contact [m]
};

/// Trapezoidal sums along the slider's way in contact.
[[nodiscard]] SampledWork sampled_work(const SampledMotion& motion, const SampledSlider& slider);

/// The state at any phase: one more step of the slider, from the sample before it.
[[nodiscard]] PointInstant sampled_instant(const SurfaceLaw& law, const Harmonics& motion,
                                           const SampledMotion& samples,
                                           const SampledSlider& slider, double phase);

}  // namespace microslip::contact
