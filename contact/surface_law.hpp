/// @file
/// Local law of the two rubbing surfaces at one point, without memory: what approach and speed make of
/// the load, the tangential stiffness and the friction coefficient. The memory, a slider, belongs to the
/// cycles that call this (event, sampled, planar).
///
///   n = N(v),   k_p = k_u g(v),   k_r = k_w g(v),   μ = μ(σ),   |f| ≤ μ n             (1)
///
/// Smooth contact: N = max(0, n₀' + k_v v), g = 1. σ is the imposed relative tangential speed in physical
/// time, ω hypot(u', w') (theory section 10).
///
/// Source: theory sections 2, 3, 10, 11.
#pragma once

#include <vector>

#include "contact/contact_patch.hpp"

namespace microslip::contact {

/// (1) at one instant, with its derivatives.
struct SurfaceState {
  double load = 0.0;              ///< n [Pa]
  double load_by_approach = 0.0;  ///< dn/dv [N/m³]; 0 where separated
  double gap_load = 0.0;          ///< load without its one-sidedness [Pa]: negative where separated
  double stiffness_ratio = 1.0;   ///< g [-]
  double stiffness_ratio_by_approach = 0.0;   ///< dg/dv [1/m]
  double friction_coefficient = 0.0;          ///< μ(σ) [-]
  double friction_coefficient_by_rate = 0.0;  ///< dμ/dσ [s/m]
};

class SurfaceLaw {
 public:
  /// Smooth surfaces with a constant coefficient.
  /// @param point             constants, in the ranges of ContactPatch.
  /// @param second_stiffness  k_w along r [N/m³], ≥ 0.
  SurfaceLaw(const PointParameters& point, double second_stiffness)
      : point_(point), second_stiffness_(second_stiffness) {}

  /// @param approach  v, mean included [m].   @param rate  σ [m/s], ≥ 0.
  [[nodiscard]] SurfaceState at(double approach, double rate) const;

  [[nodiscard]] double first_stiffness() const { return point_.tangential_stiffness; }
  [[nodiscard]] double second_stiffness() const { return second_stiffness_; }
  /// n_ref [Pa].
  [[nodiscard]] double load_at_rest() const;
  /// Whether μ depends on σ: then forces depend on ω.
  [[nodiscard]] bool is_rate_dependent() const { return false; }
  /// Whether g is 1 and N is piecewise linear.
  [[nodiscard]] bool is_smooth() const { return true; }
  /// Approaches at which (1) has a kink: where contact begins, and those of a rough law [m].
  [[nodiscard]] std::vector<double> kinks() const;
  [[nodiscard]] const PointParameters& point() const { return point_; }

 private:
  PointParameters point_;
  double second_stiffness_;
};

}  // namespace microslip::contact
