/// @file
/// Which effects of contact are simulated, the same for all patches of a scene; what differs from
/// patch to patch stands in its SurfaceRules.
#pragma once

namespace microslip::contact {

struct ContactEffects {
  int n_harmonics = 1;        ///< highest that may occur
  bool normal_motion = true;  ///< false: the load stays that of rest, whatever the approach
  /// false: contact sees the vibration about the mean, whatever that is
  /// (force/vibration_alone.hpp); in harmonic balance alone
  bool mean_coupling = true;
  bool second_direction = false;  ///< friction along r beside p
  bool located = false;           ///< events are located of points that would else be sampled
  bool sampled = false;           ///< points are sampled that would else be located
  /// Of points that are sampled: what their force may err by, and how often the instants that
  /// usually do are doubled, or halved.
  double force_tolerance = 1e-3;
  int doublings = 0;
  double motion_ratio = 0.0;  ///< motion along r against that along p in the linear limits [-]

  /// The normal stiffness that is simulated. @param given  [N/m³].
  [[nodiscard]] double normal_stiffness(double given) const { return normal_motion ? given : 0.0; }
};

}  // namespace microslip::contact
