/// @file
/// What every point of a patch does over one period: states, tractions, slip, and per cycle
/// dissipated energy, slip distance and wear depth (theory section 7).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "contact/harmonics.hpp"
#include "contact/patch.hpp"
#include "contact/point/point_method.hpp"
#include "contact/surface/surface_law.hpp"

namespace microslip::contact {

/// Fields over n points at m phases; matrices are n × m.
struct ContactMap {
  Eigen::VectorXd phase;                                              ///< θ [rad], m
  Eigen::Matrix<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic> state;  ///< ContactState values
  Eigen::MatrixXd normal_traction;                                    ///< n [Pa]
  Eigen::MatrixXd friction_traction;                                  ///< f [Pa], along p
  Eigen::MatrixXd relative_displacement;  ///< u [m], along p, mean included
  Eigen::MatrixXd approach;               ///< v [m], along q, mean included
  Eigen::MatrixXd slip;                   ///< s, position of the slider along p [m]
  /// The same along r; without columns where motion along r is not simulated.
  Eigen::MatrixXd friction_traction_r, relative_displacement_r, slip_r;
  /// Transition angles: where in [0, 2π) each ContactState first begins, NaN where it never does or
  /// lasts the whole period [rad], n × 5. A boundary between states at θ is a level line of these.
  /// With several harmonics a state may begin several times; this is the first after θ = 0.
  Eigen::MatrixXd state_start;
  /// All of them in order [rad], n × 5m: columns m k … m (k + 1) − 1 belong to state k, m the most
  /// that one state begins at one point; NaN beyond its last.
  Eigen::MatrixXd state_starts;
  Eigen::MatrixXd state_share;  ///< of the period in each ContactState [-], n × 5
  /// Guards of the period (transition_guards.hpp) [Pa], n: boundaries between points of another
  /// kind are their zero lines. Empty where methods alone were given, until add_guards().
  Eigen::VectorXd slip_guard, smallest_load, largest_load;
  Eigen::VectorXd
      friction_coefficient;       ///< of the points at rest [-], n; empty where it was not told
  Eigen::VectorXd slip_duration;  ///< share of the period in slip [-], n
  Eigen::VectorXd separation_duration;  ///< share of the period without contact [-], n
  Eigen::VectorXd dissipated_energy;    ///< [J/m² per period], n
  Eigen::VectorXd slip_distance;        ///< [m per period], n
  Eigen::VectorXd wear_depth;           ///< [m per period], n; zero when no coefficient is given
};

/// @param points            constants of the points, n.
/// @param shapes            mode shapes at the points, n × n_modes.
/// @param q                 solution, H = 1 [m√kg].
/// @param n_phases          ≥ 1, at θ = 2πj/n_phases.
/// @param wear_coefficient  Archard K [m²/N]: depth per (pressure × slip distance), ≥ 0.
[[nodiscard]] ContactMap contact_map(const std::vector<PointParameters>& points,
                                     const ModalShapes& shapes, const Harmonics& q, int n_phases,
                                     double wear_coefficient);

/// The same for points by any method and motion of any number of harmonics.
/// @param methods    one per point, n.
/// @param shapes     at the points, n × n_modes; fields along r are filled where w is not empty.
/// @param frequency  ω [rad/s].
[[nodiscard]] ContactMap contact_map(const std::vector<std::shared_ptr<const PointMethod>>& methods,
                                     const ModalShapes& shapes, const Harmonics& q,
                                     double frequency, int n_phases, double wear_coefficient);

/// Guards of the period for points of any surface law.
/// @param surfaces   one per point, n.
/// @param shapes  as for contact_map(): w is empty without friction along r.
/// @param frequency  ω [rad/s].
void add_guards(ContactMap& map, const std::vector<SurfaceLaw>& surfaces, const ModalShapes& shapes,
                const Harmonics& q, double frequency);

}  // namespace microslip::contact
