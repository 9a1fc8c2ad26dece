/// @file
/// One sweep along one branch: walks it, certifies every point, solves for peaks and folds between
/// points, ends exactly at the end of the range.
#pragma once

#include "solver/branch_walker.hpp"
#include "solver/continuation.hpp"
#include "solver/harmonic_balance.hpp"
#include "solver/stability.hpp"

namespace microslip::solver {

class CurveTracer {
 public:
  /// @param scene  borrowed.
  CurveTracer(const Scene& scene, const ContinuationOptions& options, const PointObserver& observe);

  /// The curve; never throws for one that cannot be completed.
  [[nodiscard]] ResponseCurve run();

 private:
  [[nodiscard]] Scaling scaling_at(const NewtonResult& at);
  [[nodiscard]] StabilityReport stability_at(const NewtonResult& at);
  [[nodiscard]] ResponsePoint certified(const NewtonResult& at, PointMark mark);
  /// False: the observer asked to stop.
  [[nodiscard]] bool add(const NewtonResult& at, PointMark mark = PointMark::none);
  void walk(BranchWalker& walker);
  /// Peaks and folds up to a share of the last step. False: as for add().
  [[nodiscard]] bool add_specials(const BranchWalker& walker, double share_of_segment);
  [[nodiscard]] bool finish(const BranchWalker& walker);
  void stop(const std::string& diagnosis, const std::string& message);
  [[nodiscard]] double progress(double frequency) const;  ///< 0 at the begin, 1 at the end

  HarmonicBalance balance_;
  ContinuationOptions options_;
  const PointObserver& observe_;
  ResponseCurve curve_;
  double range_;
  StabilityReport last_stability_;
  Eigen::VectorXd last_x_;  ///< of last_stability_
};

}  // namespace microslip::solver
