/// @file
/// Isotropic linear elastic material.
#pragma once

namespace microslip::fem {

struct Material {
  double youngs_modulus = 0.0;  ///< E [Pa], > 0
  double poissons_ratio = 0.0;  ///< ν [-], −1 < ν < 0.5
  double density = 0.0;         ///< ρ [kg/m³], > 0
};

}  // namespace microslip::fem
