/// @file
/// A patch by alternating frequency and time, as contact is treated elsewhere: every point a spring
/// with a return to the cone of friction at equally spaced instants, derivatives carried along,
/// Fourier sums by the rectangle rule. Smooth surfaces and a constant coefficient of friction. What
/// the methods of the product are measured against.
///
///   n = max(0, n₀ + k_v v),   f* = f_{i−1} + k_u (x_i − x_{i−1}),   f = f* min(1, μ n/|f*|)
///
/// with x = u or (u, w).
///
/// A point that closes between two instants starts to stick where the straight line between them
/// closes.
#pragma once

#include <vector>

#include "contact/patch.hpp"
#include "contact/surface/point_parameters.hpp"
#include "tests/support/full_force.hpp"

namespace microslip::benchmarks {

class PlainReturn final : public tests::FullForce {
 public:
  /// @param weights  areas of the points [m²].
  /// @param shapes   along p, q and, for friction in a plane, r; points × modes.
  /// @param instants  of a period, ≥ 2.
  PlainReturn(Eigen::VectorXd weights, std::vector<contact::PointParameters> points,
              contact::ModalShapes shapes, int instants);

  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override;
  [[nodiscard]] contact::CycleReport report(const contact::Harmonics& /*q*/, double /*frequency*/,
                                            Workspace& /*work*/) const override {
    return {};
  }

 private:
  [[nodiscard]] contact::ForceAndJacobian by_all(const contact::Harmonics& q,
                                                 double frequency) const override;

  Eigen::VectorXd weights_;
  std::vector<contact::PointParameters> points_;
  std::vector<Eigen::MatrixXd> shapes_;  ///< along p, q (and r)
  int instants_;
};

}  // namespace microslip::benchmarks
