/// @file
/// Local law of the two rubbing surfaces at one point, without memory: what approach and speed make
/// of the load, the tangential stiffness and the friction coefficient. The memory, a slider,
/// belongs to the cycles that call this (event, sampled, planar).
///
///   n = N(v),   k_p = k_u g_p(v),   k_r = k_w g_r(v),   μ = μ(σ),   |f| ≤ μ n               (1)
///
/// Smooth contact: N = max(0, n₀' + k_v v), g = 1. σ is the imposed relative tangential speed in
/// physical time, ω hypot(u', w') (theory section 10).
///
/// Rough contact (rough_surface.hpp) with approach u, in series with a compliance c of the bodies:
///
///   v + v_rest = u + c_v N,      N = k_v δ(u)                                                 (2)
///   k_u g_p = 1/(1/(k_T h*(u)) + c_u),   k_u = 1/(1/k_T + c_u),   g_r likewise                (3)
///
/// n₀' > 0 is the pressure at rest: v_rest = δ⁻¹(n₀'/k_v) + c_v n₀'. n₀' ≤ 0 is a gap: v_rest =
/// n₀'(1/k_v + c_v), the same gap as between smooth surfaces of the same stiffness, counted to the
/// first touch of (2) in rough_surface.hpp. R → 0 returns smooth contact.
///
/// Gaussian heights have no first touch. Here they end nine deviations from their mean (theory
/// section 11): farther apart the surfaces are separated,
/// and the load begins with 1e-20 of k_v times the deviation.
///
/// Source: theory sections 2, 3, 10, 11, 14.
#pragma once

#include <optional>
#include <vector>

#include "contact/surface/friction_law.hpp"
#include "contact/surface/linear_range.hpp"
#include "contact/surface/point_parameters.hpp"
#include "contact/surface/rough_surface.hpp"

namespace microslip::contact {

/// (1) at one instant, with its derivatives.
struct SurfaceState {
  double load = 0.0;              ///< n [Pa]
  double load_by_approach = 0.0;  ///< dn/dv [N/m³]; 0 where separated
  /// `load` in contact, where separated what smooth surfaces of the same stiffness would pull [Pa]:
  /// negative. Rough surfaces start with u³, or less: find their touch-down by kinks(), not by the
  /// size of this.
  double gap_load = 0.0;
  double stiffness_ratio = 1.0;               ///< g_p [-]
  double stiffness_ratio_by_approach = 0.0;   ///< dg_p/dv [1/m]
  double friction_coefficient = 0.0;          ///< μ(σ) [-]
  double friction_coefficient_by_rate = 0.0;  ///< dμ/dσ [s/m]
  double second_stiffness_ratio =
      1.0;  ///< g_r [-]: differs from g_p only where c k_T along r and p do
  double second_stiffness_ratio_by_approach = 0.0;  ///< dg_r/dv [1/m]
  /// n/g_p [Pa] and n/g_r, finite where both vanish: μ/k_u of the first is the slider's half-width.
  double load_per_ratio = 0.0;
  double load_per_ratio_by_approach = 0.0;  ///< [N/m³]
  double second_load_per_ratio = 0.0;
  double second_load_per_ratio_by_approach = 0.0;
  /// g_r/g_p [-], finite where both vanish, and its derivative [1/m].
  double ratio_of_stiffness = 1.0;
  double ratio_of_stiffness_by_approach = 0.0;
};

/// Compliance of the bodies in series with the surfaces, per area: displacement by pressure. May be
/// negative (theory section 14) as long as the sum with the local compliance is above 0.
struct SeriesCompliance {
  double p = 0.0;  ///< c_u [m³/N]
  double q = 0.0;  ///< c_v [m³/N]
  double r = 0.0;  ///< c_w [m³/N]
};

class SurfaceLaw {
 public:
  /// Smooth surfaces with a constant coefficient.
  /// @param point             constants, in the ranges of ContactPatch.
  /// @param second_stiffness  k_w along r [N/m³], ≥ 0.
  SurfaceLaw(const PointParameters& point, double second_stiffness);

  /// Any friction law, rough surfaces, bodies in series.
  /// @param point      local constants, in the ranges of ContactPatch: stiffness of the surfaces in
  ///                   full contact without the compliance; its friction coefficient is not used.
  /// @param second_stiffness  k_T along r [N/m³], ≥ 0.
  /// @param friction   μ(σ).
  /// @param roughness  none, or height 0: smooth.
  /// @param series     compliance of the bodies; 0 where `point` has it already.
  /// @throws std::invalid_argument  rough surfaces without normal stiffness; 1/k + c ≤ 0 in a
  ///                   direction; a value not finite. Names it.
  SurfaceLaw(const PointParameters& point, double second_stiffness, const FrictionLaw& friction,
             const std::optional<RoughSurface>& roughness = std::nullopt,
             const SeriesCompliance& series = {});

  /// Derivatives are exact; at a kink they are those of the open side.
  /// @param approach  v, mean included [m].   @param rate  σ [m/s], ≥ 0.
  [[nodiscard]] SurfaceState at(double approach, double rate) const;

  /// k_u of (1) and (3): in full contact, bodies included [N/m³].
  [[nodiscard]] double first_stiffness() const { return point_.tangential_stiffness; }
  /// k_w, likewise [N/m³].
  [[nodiscard]] double second_stiffness() const { return second_stiffness_; }
  /// n_ref = N(0) [Pa]. Gaussian heights over a gap: the little they carry there, if any.
  [[nodiscard]] double reference_load() const { return reference_load_; }
  /// Whether μ is above 0 at any σ.
  [[nodiscard]] bool has_friction() const { return friction_.has_friction(); }
  /// Whether μ depends on σ: then forces depend on ω.
  [[nodiscard]] bool is_rate_dependent() const { return friction_.is_rate_dependent(); }
  /// Whether g is 1 and N is piecewise linear.
  [[nodiscard]] bool is_smooth() const { return !roughness_.has_value(); }
  /// Where (1) is linear. Rough surfaces: only where open.
  [[nodiscard]] LinearRange linear_range() const;
  /// Approaches at which (1) has a kink: where contact begins, and where rough surfaces are all in
  /// contact [m]; ascending.
  [[nodiscard]] std::vector<double> kinks() const;
  /// Smooth surfaces of the same stiffness, bodies included, μ that of rest.
  [[nodiscard]] const PointParameters& point() const { return point_; }
  [[nodiscard]] const FrictionLaw& friction() const { return friction_; }

 private:
  void start_at_rest(double pressure);
  /// u of (2) at v + v_rest [m].
  [[nodiscard]] double surface_approach(double closure) const;
  void add_rough_state(double approach, SurfaceState& state) const;
  /// g_r/g_p of (3) for the share h* and dh*/dv.
  void add_ratio_of_stiffness(double share, double share_by_approach, SurfaceState& state) const;

  PointParameters point_;    // in full contact, series included
  double second_stiffness_;  // likewise
  FrictionLaw friction_;
  std::optional<RoughSurface> roughness_;
  double local_stiffness_ = 0.0;   // k_v of (2) [N/m³]
  double compliance_ratio_ = 0.0;  // c_v k_v of (2), > −1
  double first_ratio_ = 0.0;       // c_u k_T of (3) along p, > −1
  double second_ratio_ = 0.0;      // along r
  double rest_ = 0.0;              // v_rest of (2) [m]
  double first_touch_ = 0.0;       // v + v_rest where contact begins [m]
  double reference_load_ = 0.0;
};

}  // namespace microslip::contact
