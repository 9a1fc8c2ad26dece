/// @file
/// Pressure of a contact area at rest under a force and two moments: two stiff bodies tilt against
/// each other until the cells, which cannot pull, carry the load.
///
///   u_i = u₀ + z_i φ_y − y_i φ_z,     n_i = N_i(u_i)                                          (1)
///   Σ w_i n_i = F_N,     Σ w_i z_i n_i = M_y,     −Σ w_i y_i n_i = M_z                         (2)
///
/// (2) is the gradient of a convex potential of (u₀, φ_y, φ_z). It has a solution if and only if
/// the resultant (y, z) = (−M_z, M_y)/F_N lies inside the hull of the cell centres. Linear cells
/// that all stay loaded carry, on a grid of n cells of one weight w,
/// n_i w = F_N/n + M_y z_i/Σz² − M_z y_i/Σy².
///
/// Letters and moments as in contact_area.hpp: M_y about r, M_z about p.
///
/// Source: theory section 12, "Preload".
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

#include <Eigen/Core>

#include "contact/patch/contact_area.hpp"

namespace microslip::contact {

/// What presses the two bodies together, about the origin of the cells.
struct PreloadRequest {
  double force = 0.0;     ///< F_N ≥ 0 [N]
  double moment_y = 0.0;  ///< M_y, about r [N m]
  double moment_z = 0.0;  ///< M_z, about p [N m]
};

/// Load of one cell per weight and its slope.
struct NormalResponse {
  double load = 0.0;       ///< n ≥ 0 [Pa]
  double stiffness = 0.0;  ///< dn/du ≥ 0 [N/m³]
};

/// N_i(u) of any cell: not negative, continuous, never falling, without upper bound, 0 (or nothing
/// to speak of) far apart. A SurfaceLaw without rest load is one.
using CellSprings = std::function<NormalResponse(Eigen::Index cell, double approach)>;

/// max(0, k_i u).   @param stiffness  k_i per weight [N/m³], n_cells, > 0 where there is weight.
[[nodiscard]] CellSprings one_sided_springs(Eigen::VectorXd stiffness);

struct PreloadEquilibrium {
  Eigen::VectorXd pressures;   ///< n_i per weight [Pa], n_cells, ≥ 0
  Eigen::VectorXd approaches;  ///< u_i [m], n_cells
  double approach = 0.0;       ///< u₀ at the origin [m]
  double rotation_y = 0.0;     ///< φ_y [rad]
  double rotation_z = 0.0;     ///< φ_z [rad]
  Eigen::Index n_loaded = 0;   ///< cells with n_i > 0
  /// Of (2), relative to F_N and to F_N times the extent of the area, along its flat side too.
  double imbalance = 0.0;
};

/// The two bodies cannot be in equilibrium. The message has the request; of a resultant outside the
/// hull of the cells also where it acts, how far outside, and the force that its moments need.
class PreloadError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Solves (2). No force and no moment leave every cell without load at approach 0.
/// @throws PreloadError  a pull, a resultant outside or on the edge of the hull of the cell
///         centres, or an imbalance left above 1e-9.
/// @throws std::invalid_argument  a value not finite; springs that do not reach the force.
/// @note The imbalance is that of rounding, below 1e-12 as a rule and in any units; it grows where
///       cells of 1e-6 of the weight of the others have to carry the load alone.
[[nodiscard]] PreloadEquilibrium preload_equilibrium(const ContactArea& area,
                                                     const CellSprings& springs,
                                                     const PreloadRequest& request);

}  // namespace microslip::contact
