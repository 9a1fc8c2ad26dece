/// @file
/// Located events in a plane: elastic Coulomb friction in two tangential directions under varying
/// load, with separation, any number of harmonics, different stiffness along p and r,
/// and a round cone.
///
///   n = N(v),   f = diag(k_u g_p, k_w g_r) (x − s),   |f| ≤ μ n,   s' = λ f                    (1)
///
/// with λ ≥ 0, x = (u, w).
///
/// The period is cut at touch-down, lift-off and kinks of the surface law; within, events are
/// located and slip is integrated by collocation of order nine (planar_slip.hpp, planar_orbit.hpp);
/// the slider is made periodic by Newton's method on the period map (planar_steady.hpp);
/// derivatives are those of the converged cycle (planar_variation.hpp).
///
/// A point that never slips nor separates keeps the slider it was left with: virgin, s = 0, and
/// pushed by one period after another, beginning at θ = 0, until nothing moves it.
///
/// Where the search for the periodic slider ends before the tolerance,
/// the result says so by its defect.
///
/// A direction without stiffness carries no friction. μ = 0 slips without force.
///
/// Source: theory sections 3, 4.2, 6, 7, 8, 9, 10, 11.
#pragma once

#include "contact/point/point_method.hpp"
#include "contact/surface/surface_law.hpp"

namespace microslip::contact {

class PlaneEvents final : public PointMethod {
 public:
  /// Small enough that Newton's method on a structure converges to the accuracy of its own
  /// tolerances.
  static constexpr double default_tolerance = 1e-9;

  /// @param tolerance  of force coefficients, relative to twice the smaller of k a and max μn, both
  ///                   summed over directions and harmonics; 1e-13 to 1e-2. Rounding leaves 1e-14
  ///                   of the larger. Cost doubles at most from 1e-6 to 1e-10.
  /// @throws std::invalid_argument  tolerance out of its range.
  explicit PlaneEvents(SurfaceLaw law, double tolerance = default_tolerance);

  void traction(const Harmonics& motion, double frequency, PointTraction& result) const override;
  void traction_alone(const Harmonics& motion, double frequency,
                      PointTraction& result) const override;
  void states(const Harmonics& motion, double frequency, PointTraction& result) const override;
  [[nodiscard]] PointHistory history(const Harmonics& motion, double frequency,
                                     const Eigen::VectorXd& phases, int n_harmonics) const override;
  [[nodiscard]] Eigen::Vector3d stuck_stiffness() const override;
  [[nodiscard]] double reference_load() const override { return law_.reference_load(); }
  [[nodiscard]] double work_precision() const override { return work_per_tolerance * tolerance_; }
  [[nodiscard]] std::optional<LinearRange> linear_range() const override {
    return law_.linear_range();
  }

 private:
  static constexpr double states_tolerance = 1e-6;
  static constexpr double work_per_tolerance = 10.0;  // seldom one (test_work_error.cpp)

  SurfaceLaw law_;
  double tolerance_;
};

}  // namespace microslip::contact
