/// @file
/// A contact point with one tangential direction and any surface law under periodic motion of any
/// number of harmonics: the steady friction cycle found event by event.
///
///   n = N(v),   f = k_u g (u − s),   |f| ≤ μ(ω|u'|) n,   s moves only where |f| = μ n          (1)
///
/// with rough surfaces, a load-dependent stiffness and a coefficient that depends on the rate
/// (surface_law.hpp). The slider lives in a band (slider_band.hpp), one walk gives its cycle
/// (band_walk.hpp), coefficients and their derivatives are integrals over its pieces
/// (band_force.hpp).
///
/// w is ignored and f_r = 0. A point that never slips nor separates has a virgin slider, pushed
/// into its admissible band (theory section 4.2). A point without tangential stiffness carries no
/// friction and counts as stuck; μ = 0 slips without force. With smooth surfaces and a constant
/// coefficient this is the cycle of line_events.hpp, which is faster.
///
/// Accuracy: force coefficients within about 1e-14 of k_u |u| + μ n, where |·| sums the amplitudes
/// of the harmonics and n is the largest load, however thin the layers are in which the coefficient
/// changes; derivatives within about 1e-11 as long as a layer is not thinner than 1e-4 of the
/// period, one-sided where they jump. Of an event the phase is rounded, in a layer 1/R as thin a
/// derivative loses R times as much.
///
/// Source: theory sections 3–8, 10, 11.
#pragma once

#include <optional>

#include "contact/point/point_method.hpp"
#include "contact/surface/surface_law.hpp"

namespace microslip::contact {

class SurfaceLineEvents final : public PointMethod {
 public:
  explicit SurfaceLineEvents(const SurfaceLaw& law) : law_(law) {}

  /// @throws std::invalid_argument  a motion of other than 3 signals, or without harmonics.
  void traction(const Harmonics& motion, double frequency, PointTraction& result) const override;
  void states(const Harmonics& motion, double frequency, PointTraction& result) const override;
  [[nodiscard]] PointHistory history(const Harmonics& motion, double frequency,
                                     const Eigen::VectorXd& phases, int n_harmonics) const override;
  [[nodiscard]] Eigen::Vector3d stuck_stiffness() const override;
  [[nodiscard]] double reference_load() const override { return law_.reference_load(); }
  /// That of the surfaces, without motion along r. Rough surfaces: only where open.
  [[nodiscard]] std::optional<LinearRange> linear_range() const override;

 private:
  SurfaceLaw law_;
};

}  // namespace microslip::contact
