/// @file
/// The door between a contact point and the patch it belongs to: harmonics of the motion of one
/// point go in, harmonics of its tractions and their derivatives come out; how a method finds them,
/// in closed form, event by event or sampled in time, is not seen from outside.
///
/// A `Harmonics` of a point has three signals, in this order:
///
///   motion    u along p, v along q (positive approach), w along r                    [m]
///   traction  f_p resists u, n ≥ 0 the whole load, f_r resists w                      [Pa]
///
/// both with the same number H of harmonics, so that derivatives are square in the order of
/// Harmonics::vector(): [u₀ v₀ w₀ u_s1 v_s1 w_s1 u_c1 …].
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "contact/contact_state.hpp"
#include "contact/harmonics.hpp"
#include "contact/point/period_states.hpp"
#include "contact/surface/linear_range.hpp"

namespace microslip::contact {

inline constexpr Eigen::Index n_point_signals = 3;

/// What an iterate of the solver needs; m = 3 (2H+1).
struct PointTraction {
  Harmonics force;           ///< f_p, n, f_r [Pa]
  Eigen::MatrixXd jacobian;  ///< ∂force/∂motion [N/m³], m × m
  Eigen::VectorXd
      frequency_derivative;  ///< ∂force/∂ω at fixed motion [Pa·s], m; 0 unless rate-dependent
  CycleRegime regime = CycleRegime::separated;
  PeriodStates period{ContactState::separated};
  /// What the force may be off by because the search for the steady cycle ended before its
  /// tolerance, in any coefficient [Pa]; 0 where the method met it.
  double defect = 0.0;
};

/// One point at one instant, both tangential directions.
struct PointInstant {
  ContactState state = ContactState::stick;
  Eigen::Vector3d motion = Eigen::Vector3d::Zero();    ///< u, v, w, means included [m]
  Eigen::Vector3d traction = Eigen::Vector3d::Zero();  ///< f_p, n, f_r [Pa]
  Eigen::Vector2d slider = Eigen::Vector2d::Zero();    ///< position of the slider along p, r [m]
};

/// The steady cycle in full, for maps, reports and tables.
struct PointHistory {
  CycleRegime regime = CycleRegime::separated;
  std::vector<CycleSegment>
      segments;                    ///< in order of time from the smallest start; lengths sum to 2π
  Harmonics force;                 ///< as many harmonics as were asked for
  double dissipated_energy = 0.0;  ///< ∮ μ n |ds| over the slip phases [J/m² per period]
  double slip_distance = 0.0;      ///< ∮ |ds| in contact [m per period]
  double normal_slip = 0.0;        ///< ∮ n |ds| [Pa·m]: Archard depth is K times this
  std::vector<PointInstant> instants;  ///< at the phases asked for
  double defect = 0.0;                 ///< as of PointTraction [Pa]
};

class PointMethod {
 public:
  PointMethod() = default;
  PointMethod(const PointMethod&) = delete;
  PointMethod& operator=(const PointMethod&) = delete;
  PointMethod(PointMethod&&) = delete;
  PointMethod& operator=(PointMethod&&) = delete;
  virtual ~PointMethod() = default;

  /// @param motion     three signals, H ≥ 1 harmonics, finite.
  /// @param frequency  ω [rad/s]; matters where friction depends on the slip rate.
  /// @param result     written whole; storage of the right size is used again.
  virtual void traction(const Harmonics& motion, double frequency, PointTraction& result) const = 0;
  /// The same without derivatives, which are left as they are where that is cheaper.
  virtual void traction_alone(const Harmonics& motion, double frequency,
                              PointTraction& result) const {
    traction(motion, frequency, result);
  }
  /// `regime` and `period` alone, of a motion near a solution: events as close as the control of a
  /// step asks for, 1e-4 rad where they are not tangent.
  virtual void states(const Harmonics& motion, double frequency, PointTraction& result) const {
    traction_alone(motion, frequency, result);
  }
  /// Forces alone, with harmonics that the motion does not have.
  /// @param n_harmonics  of the result, those of the motion at least.
  [[nodiscard]] virtual Harmonics force_up_to(const Harmonics& motion, double frequency,
                                              int n_harmonics) const {
    Harmonics wide(n_harmonics, n_point_signals);
    wide.rows().topRows(motion.rows().rows()) = motion.rows();
    PointTraction result;
    traction_alone(wide, frequency, result);
    return std::move(result.force);
  }
  /// @param phases       instants asked for [rad], any.
  /// @param n_harmonics  of `force` in the result, ≥ 0.
  [[nodiscard]] virtual PointHistory history(const Harmonics& motion, double frequency,
                                             const Eigen::VectorXd& phases,
                                             int n_harmonics) const = 0;
  /// Stiffness along p, q, r while the point sticks, at the load of rest [N/m³]; 0 along p and r
  /// where μ = 0.
  [[nodiscard]] virtual Eigen::Vector3d stuck_stiffness() const = 0;
  /// n_ref: the load that is in balance before vibration begins [Pa].
  [[nodiscard]] virtual double reference_load() const = 0;
  /// What `dissipated_energy` and the work of the force may differ by beyond rounding, relative to
  /// the smaller of what springs would store and friction would do (pointwise_force.hpp).
  [[nodiscard]] virtual double work_precision() const { return 0.0; }
  /// Where traction() is linear and need not be asked; none: unknown, evaluate.
  [[nodiscard]] virtual std::optional<LinearRange> linear_range() const { return std::nullopt; }
};

}  // namespace microslip::contact
