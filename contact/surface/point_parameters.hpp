/// @file
/// Constants of one contact point.
#pragma once

namespace microslip::contact {

/// Constants of one contact point, per unit of its weight (theory sections 2, 3).
struct PointParameters {
  double tangential_stiffness = 0.0;  ///< k_u [N/m³], ≥ 0
  double normal_stiffness = 0.0;      ///< k_v [N/m³], ≥ 0; 0 keeps the load constant
  double friction_coefficient = 0.0;  ///< μ [-], ≥ 0
  double rest_load = 0.0;             ///< n₀' [Pa]; negative is a gap of −n₀'/k_v

  [[nodiscard]] bool has_friction() const { return friction_coefficient > 0.0; }
  /// Friction, and a spring to act through.
  [[nodiscard]] bool rubs() const { return has_friction() && tangential_stiffness > 0.0; }
};

}  // namespace microslip::contact
