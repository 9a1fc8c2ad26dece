/// @file
/// Modal force of a friction patch sampled in time, all points going through the instants together in the
/// lanes of the processor (theory section 23): any number of harmonics, any surfaces (surface_law.hpp).
///
///   G^(k)_m = Σ_i w_i [ φ_u f_p + φ_v (n − n_ref δ_k0) + φ_w f_r ]^(k)_im,   sums over n instants         (1)
///
/// The error falls with n²; derivatives are those of the sums, so that Newton's method converges on them. n is
/// a constant of the object: whoever solves chooses it between solutions (estimated_error, with_instants).
/// In two directions the slider is marched until it repeats (plane_block.hpp); what has not settled is the defect.
/// Points proved stuck or open cost next to nothing (sleeping_laws.hpp), and are exact.
///
/// Cost and error: tests/benchmarks/bench_lanes.cpp. Located events (event_law.hpp) are exact and slower.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "contact/contact_patch.hpp"
#include "contact/force/sleeping_laws.hpp"
#include "contact/modal_force.hpp"
#include "contact/sampled/line_block.hpp"
#include "contact/sampled/plane_block.hpp"
#include "contact/sampled/projection.hpp"
#include "contact/surface/surface_law.hpp"

namespace microslip::contact::sampled {

struct Options {
  int instants = 128;  ///< n ≥ 16 per period; doubled until 8 (H + 1) at least
};

class PatchForce final : public ModalForce {
 public:
  /// @param weights   area of each point [m²], n_points ≥ 1, ≥ 0.
  /// @param surfaces  one per point.
  /// @param shapes    relative mode shapes, n_points × n_modes; w empty: no motion along r, friction along p
  ///                  alone.
  /// @throws std::invalid_argument  sizes differ, a value is not finite, too few instants.
  PatchForce(Eigen::VectorXd weights, std::vector<SurfaceLaw> surfaces, ModalShapes shapes,
             const Options& options = {});

  [[nodiscard]] Eigen::Index n_modes() const override { return shapes_.u.cols(); }
  /// Equal input gives equal bits, whatever was asked before. Not for two threads at a time.
  /// @throws std::invalid_argument  another number of modes, or no harmonic.
  [[nodiscard]] ForceAndJacobian evaluate(const Harmonics& q, double frequency) const override;
  /// No rows: the force alone, much cheaper.
  /// @throws std::invalid_argument  as evaluate().
  [[nodiscard]] ForceAndJacobian evaluate_rows(
      const Harmonics& q, double frequency, const std::vector<Eigen::Index>& rows) const override;
  /// @throws std::invalid_argument  as evaluate().
  [[nodiscard]] Harmonics force_up_to(const Harmonics& q, double frequency,
                                      int n_harmonics) const override;
  /// @throws std::invalid_argument  as evaluate().
  [[nodiscard]] CycleReport report(const Harmonics& q, double frequency) const override;
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override;
  void states(const Harmonics& q, double frequency, ContactStates& result) const override;
  [[nodiscard]] LinearState linear_state(const Harmonics& centre, double radius) const override;

  [[nodiscard]] int instants() const { return options_.instants; }
  /// ‖G_n − G_2n‖ relative to the larger of ‖G_2n‖ and the force of the stuck patch [-].
  /// @throws std::invalid_argument  as evaluate().
  [[nodiscard]] double estimated_error(const Harmonics& q, double frequency) const;
  /// The same patch, sampled otherwise.
  /// @throws std::invalid_argument  as the constructor.
  [[nodiscard]] std::unique_ptr<PatchForce> with_instants(int n) const;
  /// The n ≥ 32, a power of two, of which the estimated error at this motion is below the tolerance.
  /// @param tolerance  > 0 [-].   @param most  the largest n tried.
  [[nodiscard]] int instants_for(const Harmonics& q, double frequency, double tolerance,
                                 int most = 4096) const;

 private:
  struct Grid {
    const Instants* of_motion;
    const Instants* of_force;
  };
  [[nodiscard]] Grid grid(int instants, int n_harmonics, int force_harmonics) const;
  [[nodiscard]] ForceAndJacobian sum(const Harmonics& q, double frequency,
                                     const std::vector<Eigen::Index>& rows, const Grid& grid) const;
  void sum_line(double frequency, bool derivatives, const Grid& grid) const;
  void sum_plane(double frequency, bool derivatives, const Grid& grid) const;
  void keep_states(const Harmonics& q, double frequency) const;
  [[nodiscard]] bool is_frictionless(Eigen::Index point) const;

  Eigen::VectorXd weights_;
  std::vector<SurfaceLaw> surfaces_;
  ModalShapes shapes_;
  Options options_;
  // Storage, and sums that depend on who sleeps alone.
  mutable std::map<std::pair<int, int>, Instants> tables_;
  mutable SleepingLaws sleep_;
  mutable PatchMotion motion_;
  mutable LineBlock line_;
  mutable PlaneBlock plane_;
  mutable double defect_ = 0.0;
  mutable Projection projection_;
  mutable std::vector<CycleStates> cycles_;  // of the motion evaluated last
  mutable Harmonics states_q_;
  mutable double states_frequency_ = 0.0;
};

}  // namespace microslip::contact::sampled
