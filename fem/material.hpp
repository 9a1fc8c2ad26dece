/// @file
/// Isotropic linear elastic material.
#pragma once

namespace microslip::fem {

struct Material {
  double youngs_modulus = 0.0;  ///< E [Pa], > 0
  double poissons_ratio = 0.0;  ///< ν [-], −1 < ν < 0.5
  double density = 0.0;         ///< ρ [kg/m³], > 0
};

/// Lamé's constants of a material.
struct LameConstants {
  double lambda;  ///< λ = Eν/((1+ν)(1−2ν)) [Pa]
  double mu;      ///< μ = E/(2(1+ν)) [Pa]
  explicit LameConstants(const Material& m)
      : lambda(m.youngs_modulus * m.poissons_ratio /
               ((1.0 + m.poissons_ratio) * (1.0 - 2.0 * m.poissons_ratio))),
        mu(0.5 * m.youngs_modulus / (1.0 + m.poissons_ratio)) {}
};

}  // namespace microslip::fem
