/// @file
/// Modal force of a friction patch sampled in time, all points going through the instants together
/// in the lanes of the processor (theory section 23): any number of harmonics,
/// any surfaces (surface_law.hpp).
///
///   G^(k)_m = Σ_i w_i [ φ_u f_p + φ_v (n − n_ref δ_k0) + φ_w f_r ]^(k)_im                      (1)
///
/// with sums over n instants. The error falls with n³ along one direction on smooth surfaces
/// (kinks.hpp), else with n²; derivatives are those of the sums, so that Newton's method converges
/// on them. In two directions the slider is marched until it repeats (plane_block.hpp); what has
/// not settled is the defect.
///
/// Points are summed in parts, by as many cores as are to spare (spare_cores.hpp); the parts depend
/// on the number of points alone, and so do the bits of their sum.
///
/// Cost and error: tests/benchmarks/bench_lanes.cpp. Located events (line_events.hpp) are exact and
/// slower.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "contact/force/pointwise_force.hpp"
#include "contact/patch.hpp"
#include "contact/sampled/line_block.hpp"
#include "contact/sampled/plane_block.hpp"
#include "contact/sampled/projection.hpp"
#include "contact/surface/surface_law.hpp"

namespace microslip::contact::sampled {

class PatchForce final : public PointwiseForce {
 public:
  /// @param weights   area of each point [m²], n_points ≥ 1, ≥ 0.
  /// @param surfaces  one per point.
  /// @param shapes    relative mode shapes, n_points × n_modes; w empty: no motion along r,
  ///                  friction along p alone.
  /// @param instants  n ≥ 16 per period; doubled until 8 (H + 1) at least.
  /// @throws std::invalid_argument  sizes differ, a value is not finite, too few instants.
  PatchForce(Eigen::VectorXd weights, std::vector<SurfaceLaw> surfaces, ModalShapes shapes,
             int instants);

  [[nodiscard]] std::unique_ptr<Workspace> workspace() const override;

 private:
  /// Of the awake points that are summed by one core.
  struct Part {
    std::span<const Eigen::Index> points;
    LineBlock line;
    PlaneBlock plane;
    Projection projection;
    double defect = 0.0;
  };
  struct Work : PointwiseWork {
    explicit Work(const PatchForce& force) : PointwiseWork(force) {}
    void divide();

    std::map<std::pair<int, int>, Instants> tables;  ///< by (instants, harmonics)
    std::vector<Part> parts{1};
    std::size_t n_parts = 1;  ///< of the evaluation under way
  };
  struct Grid {
    const Instants* of_motion;
    const Instants* of_force;
  };
  [[nodiscard]] ForceAndJacobian awake_force(double frequency, const Asked& asked,
                                             PointwiseWork& work) const override;
  void add_cycles(std::span<const Eigen::Index> points, double frequency, PointwiseWork& work,
                  ReportSum& sum) const override;
  [[nodiscard]] WorkPrecision work_precision(Eigen::Index point, int n_harmonics) const override;
  [[nodiscard]] int instants_for(int n_harmonics, int force_harmonics) const;
  [[nodiscard]] Grid grid(int n_harmonics, int force_harmonics, Work& work) const;
  /// @param work  shared by the parts: each keeps what its own points do.
  void sum_line(Part& part, double frequency, bool derivatives, const Grid& grid, Work& work) const;
  void sum_plane(Part& part, double frequency, bool derivatives, const Grid& grid,
                 Work& work) const;

  std::vector<SurfaceLaw> surfaces_;
  int instants_;
};

}  // namespace microslip::contact::sampled
