/// @file
/// Points of a patch, by any method, that are proved stuck, or open, for the whole cycle
/// (linear_range.hpp): one matrix stands for all of them, only the others are evaluated one by one.
///
///   G^(k)_sleeping = K q^(k) + δ_k0 g
///   K = Σ_stuck w (φ_u k_u φ_uᵀ + φ_v k_v φ_vᵀ + φ_w k_w φ_wᵀ)
///   g = Σ_stuck w φ_v (n₀' − n_ref) − Σ_open w φ_v n_ref                                      (1)
///
/// Who sleeps depends on the motion asked for and on nothing else. K is kept in sums over groups of
/// points; a group is added up anew when one of its points has changed its state, so that equal
/// sets give equal bits, whatever was asked before. A decision costs some 10 ns per point and
/// harmonic.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "contact/modal_force.hpp"
#include "contact/patch.hpp"
#include "contact/surface/linear_range.hpp"

namespace microslip::contact {

/// Motion of all points, harmonics row by row as they lie in `Harmonics`:
/// n_points × (2H+1) each [m].
struct PatchMotion {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Rows u;
  Rows v;
  Rows w;  ///< empty: no motion along r

  /// Storage of the right size is used again.
  /// @throws std::invalid_argument  H = 0, or another number of modes than the shapes.
  void set(const ModalShapes& shapes, const Harmonics& q);
  [[nodiscard]] PointRows of(Eigen::Index point) const;
  [[nodiscard]] int n_harmonics() const { return static_cast<int>(u.cols() / 2); }
  /// The three signals of a point. @param result  written whole.
  void copy(Eigen::Index point, Harmonics& result) const;
};

/// (1): the same linear force on every harmonic, and a constant mean.
struct SleepingPart {
  Eigen::MatrixXd stiffness;  ///< K [1/s²], n_modes × n_modes
  Eigen::VectorXd mean;  ///< g: of rest loads that are gone, and of gaps that are closed [N/√kg]
};

/// What is known of the points of a patch before they move; n of each.
struct RestingPoints {
  Eigen::VectorXd weights;                         ///< area [m²], ≥ 0
  Eigen::VectorXd reference_load;                  ///< n_ref [Pa]
  Eigen::MatrixX3d stuck_stiffness;                ///< along p, q, r [N/m³]
  std::vector<std::optional<LinearRange>> ranges;  ///< none: always evaluated
};

/// Whether the patch answers every motion of a set like a linear spring through the origin: all
/// points stuck with n₀' ≥ 0, or all of them open with n₀' ≤ 0. A rest load that the mean motion
/// takes away, or a gap that it closes, leaves a constant force: unknown. Points that exert no
/// dynamic force at all (k_v = 0 with μ = 0 or k_u = 0) do not count.
[[nodiscard]] LinearState linear_state(const RestingPoints& points, const ModalShapes& shapes,
                                       const MotionSet& motions);

/// Of one patch, in a workspace: its points and shapes are those of the constructor,
/// here and below.
class SleepingSet {
 public:
  SleepingSet(const RestingPoints& points, const ModalShapes& shapes);

  /// Decides for this motion.
  void look_at(const PatchMotion& motion, double frequency, const RestingPoints& points,
               const ModalShapes& shapes);
  /// After look_at(): points to be evaluated, ascending.
  [[nodiscard]] const std::vector<Eigen::Index>& awake() const { return awake_; }
  /// After look_at().
  [[nodiscard]] SleepState state(Eigen::Index point) const {
    return state_[static_cast<std::size_t>(point)];
  }
  /// After look_at(): (1); nullptr: none sleeps.
  [[nodiscard]] const SleepingPart* part() const;

 private:
  void decide(const PatchMotion& motion, double frequency, const RestingPoints& points);
  void add_up(Eigen::Index group, const RestingPoints& points, const ModalShapes& shapes);
  void add_point(Eigen::Index point, const RestingPoints& points, const ModalShapes& shapes,
                 SleepingPart& part);

  PhaseTable table_;        // for the harmonics of the motion
  Eigen::Index group_ = 0;  // points of a group
  std::vector<SleepState> state_;
  std::vector<SleepState> next_;
  std::vector<Eigen::Index> awake_;
  std::vector<SleepingPart> part_;  // of each group
  SleepingPart sum_;
  Eigen::MatrixXd rows_;     // √(w k) φ of one group
  Eigen::Index n_rows_ = 0;  // of them in use
};

}  // namespace microslip::contact
