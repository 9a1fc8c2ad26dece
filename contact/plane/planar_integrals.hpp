/// @file
/// Fourier coefficients of the forces of a planar orbit, and its work: Gauss quadrature where the
/// point sticks and for the load, the rule of the collocation, of its full order, where it slips.
///
/// Source: theory sections 5, 7, 9.
#pragma once

#include <vector>

#include "contact/plane/planar_orbit.hpp"

namespace microslip::contact {

/// f_p, n, f_r [Pa] with n_harmonics harmonics.
[[nodiscard]] Harmonics planar_force(const PlanarMotion& motion,
                                     const std::vector<PlanarInterval>& intervals,
                                     const PlanarOrbit& orbit, int n_harmonics);

/// ∂n / ∂v, in the order of Harmonics::vector() of v alone, (2H+1) × (2H+1) [N/m³].
[[nodiscard]] Eigen::MatrixXd load_derivative(const PlanarMotion& motion,
                                              const std::vector<PlanarInterval>& intervals);

/// Over one period, in contact.
struct PlanarWork {
  double dissipated_energy = 0.0;  ///< ∮ μ n |ds| [J/m²]
  double slip_distance = 0.0;      ///< ∮ |ds| [m]
  double normal_slip = 0.0;        ///< ∮ n |ds| [Pa·m]
};
[[nodiscard]] PlanarWork planar_work(const PlanarMotion& motion, const PlanarOrbit& orbit);

}  // namespace microslip::contact
