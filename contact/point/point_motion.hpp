/// @file
/// Single-harmonic motion of one contact point in one tangential direction (theory section 0).
#pragma once

namespace microslip::contact {

/// Relative motion u = u₀ + u_s sin θ + u_c cos θ along p, v likewise along q (v > 0:
/// approach) [m].
struct PointMotion {
  double u_mean = 0.0;
  double u_sin = 0.0;
  double u_cos = 0.0;
  double v_mean = 0.0;
  double v_sin = 0.0;
  double v_cos = 0.0;
};

}  // namespace microslip::contact
