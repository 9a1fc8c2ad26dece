/// @file
/// One sweep along one branch: walks it, certifies every point, solves for peaks and folds between
/// points, ends exactly at the end of the range.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/balance/harmonic_balance.hpp"
#include "solver/branch/branch_walker.hpp"
#include "solver/branch/special_points.hpp"
#include "solver/continuation.hpp"
#include "solver/curve/certificate.hpp"
#include "solver/stability/stability.hpp"

namespace microslip::solver {

/// Of the residual: of a contact some 1e9 times stiffer than the modes rounding leaves more of
/// linear equations than elsewhere, as the residual of every row tells.
inline constexpr double linear_rounding = 1e-6;

class CurveTracer {
 public:
  /// @param scene  borrowed.
  CurveTracer(const Scene& scene, const ContinuationOptions& options, const PointObserver& observe);

  /// The curve; never throws for one that cannot be completed.
  [[nodiscard]] ResponseCurve run();
  /// The same of a scene whose contact is a spring, or that has none: one linear solve a frequency,
  /// points as dense as resonances are near.
  [[nodiscard]] ResponseCurve run_linear();
  /// One branch from a solution inside the range, to where it leaves the range or closes. A closed
  /// one ends with the diagnosis `loop`.
  /// @param set  of the unknowns of `start`.
  [[nodiscard]] ResponseCurve follow(NewtonResult start, const HarmonicSet& set);

 private:
  /// Where and which way a walk goes on.
  struct Restart {
    NewtonResult at;
    double way = 1.0;  ///< sign of the first change of the frequency
  };

  /// Within what a step in frequency may be [rad/s].
  [[nodiscard]] double step_within_range(double width, double frequency) const;
  [[nodiscard]] Scaling scaling_at(const NewtonResult& at);
  /// Of a linear scene, with its residual.
  [[nodiscard]] NewtonResult linear_response(double frequency);
  [[nodiscard]] bool add_peak_before(ResponsePoint& now);
  [[nodiscard]] StabilityReport stability_at(const NewtonResult& at);
  [[nodiscard]] StabilityReport judged(const NewtonResult& at, PointMark mark);
  [[nodiscard]] ResponsePoint certified(const NewtonResult& at, PointMark mark);
  [[nodiscard]] bool gains_from_closer(const NewtonResult& at, const ResponsePoint& point) const;
  /// What keeps it from being a row; empty: nothing.
  [[nodiscard]] std::string objection_to(const ResponsePoint& point);
  /// Where its proof fails the solution is solved closer, and left out if that does not help.
  /// False: the observer asked to stop, or too many were left out.
  /// @param held  while it is solved closer.
  [[nodiscard]] bool add(const NewtonResult& at, PointMark mark = PointMark::none,
                         Held held = Held::frequency);
  [[nodiscard]] bool add(ResponsePoint point);
  [[nodiscard]] bool add_certified(ResponsePoint point);
  [[nodiscard]] bool leave_out(const ResponsePoint& point, const std::string& why);
  /// True: the walker stalled; false: the curve has ended one way or another.
  [[nodiscard]] bool walk(BranchWalker& walker);
  /// @param way  sign of the first change of the frequency.
  [[nodiscard]] BranchWalker walker_from(NewtonResult start, double way);
  /// A solution a little way beyond a point at which the walker stalled; empty: none was found.
  [[nodiscard]] std::optional<Restart> restart(const BranchWalker& stalled);
  [[nodiscard]] std::optional<Restart> restart_against_the_range(const BranchWalker& stalled);
  [[nodiscard]] std::optional<Restart> restart_beyond_loop();
  [[nodiscard]] Eigen::VectorXd extrapolated(std::ptrdiff_t before, double frequency,
                                             double way) const;
  [[nodiscard]] NewtonResult corrected_at(const Eigen::VectorXd& guess, double frequency);
  void take_stock(const BranchWalker& walker);
  void use(const HarmonicSet& set);
  [[nodiscard]] ResponseCurve finished();
  void tell_left_out();
  [[nodiscard]] bool endless() const;
  [[nodiscard]] bool closed(const BranchWalker& walker, int n_steps) const;
  /// @param n_before  points of the curve that were there before the last step.
  /// @return  the fold that was met again, of the points of the curve; empty: none was.
  [[nodiscard]] std::optional<std::size_t> came_back(std::size_t n_before) const;
  void note_unsolved(double frequency, PointMark mark);
  /// Peaks and folds up to a share of the last step. False: as for add().
  [[nodiscard]] bool add_specials(BranchWalker& walker, double share_of_segment);
  /// What the last step has up to an end of the range, and the point there. False:
  /// diagnosis says why.
  [[nodiscard]] bool reach(BranchWalker& walker, double edge);
  [[nodiscard]] std::string too_many_points() const;
  [[nodiscard]] static std::string at_hertz(const std::string& text, double frequency);
  void stop(Diagnosis diagnosis, const std::string& message);
  [[nodiscard]] double progress(double frequency) const;  ///< 0 at the begin, 1 at the end
  [[nodiscard]] double forward() const;  ///< sign of the way from the begin to the end

  using Clock = std::chrono::steady_clock;

  struct Entry {
    Harmonics q;
    double frequency = 0.0;
  };

  const Scene& scene_;
  ContinuationOptions options_;
  std::unique_ptr<HarmonicBalance> balance_;
  std::optional<double>
      unbounded_;  ///< undamped resonance of the free structure in the range [rad/s]
  const PointObserver& observe_;
  ResponseCurve curve_;
  double range_;
  StabilityReport last_stability_;
  Eigen::VectorXd last_x_;           ///< of last_stability_
  std::optional<Entry> entry_;       ///< where a jump entered the branch walked now
  std::optional<std::size_t> loop_;  ///< the fold that a walk came back to
  bool is_linear_ = false;           ///< solved by run_linear()
  /// Solutions that are no rows.
  struct LeftOut {
    int rows = 0;
    int peaks = 0;
    int folds = 0;
    int in_succession = 0;  ///< since the last row
    std::string why;        ///< of the first
  };
  LeftOut left_out_;
  std::size_t n_remedies_ = 0;   ///< of the walker, in the log already
  long walker_evaluations_ = 0;  ///< of the walker, counted already
  long walker_iterations_ = 0;
  long walker_readings_ = 0;
  long walker_cuts_ = 0;
  long point_evaluations_ = 0;  ///< of the curve when the last point was added
  Clock::time_point last_time_ = Clock::now();
};

}  // namespace microslip::solver
