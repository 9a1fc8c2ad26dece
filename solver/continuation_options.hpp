/// @file
/// How a response curve is traced (theory section 16).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "contact/harmonics.hpp"

namespace microslip::solver {

struct Scene;

struct ContinuationOptions {
  double frequency_begin = 0.0;  ///< [rad/s], > 0
  double frequency_end = 0.0;    ///< [rad/s], > 0; may be below frequency_begin
  int n_harmonics = 1;           ///< highest harmonic of the unknowns, ≥ 1
  std::vector<int> orders;       ///< the only harmonics of the unknowns; empty: 1 … n_harmonics
  bool without_mean = false;     ///< beside `orders`: the mean is zero and no unknown
  /// Above 0: one set is chosen for the curve, so that those left out change its highest peaks by
  /// less than this share of the amplitude (enrichment/curve_harmonics.hpp); n_harmonics is the
  /// highest that may be added, `orders` is not used.
  double harmonic_tolerance = 0.0;
  /// Harmonics above n_harmonics, up to this one, are added where they resonate with a mode: to a
  /// set that is chosen, and to that which a given one is checked with (richer_peak.hpp).
  int highest_resonance = 0;
  /// Relative, see ResponsePoint::residual; > 0. Of every point;
  /// rounding of the residual bounds it below.
  double residual_tolerance = 1e-11;
  /// Forces alone may be several times cheaper than with derivatives: then steps are corrected with
  /// one Jacobian each (balance/few_jacobians.hpp).
  enum class Corrector { newton, few_jacobians } corrector = Corrector::newton;
  int max_points = 20000;
  /// Looks for a proof that the curve is linear (linear_certificate.hpp) before it is walked.
  bool linear_certificate = true;
  /// Whether points are told to be stable or not: a tenth of the time of a curve with several
  /// harmonics, much more in scenes of few modes. Where curves are traced for their peaks alone,
  /// nobody asks.
  bool judge_stability = true;
  /// Whether a step to a part of the branch beside the one walked is refused (branch_walker.hpp).
  /// False: to step over what has led the walk back.
  bool refuse_swerves = true;
  /// Whether a walk that was led back goes on beyond the place where that happened.
  bool leave_loops = false;
  /// Whether branches beside a curve are followed no further than the errors of sampled forces lead
  /// (sampled_walk.hpp): where what is found is looked for again with forces that have none.
  bool leave_sampled_walks = false;
  /// Solutions whose proof fails are no rows (curve/certificate.hpp). False: of curves that only a
  /// search reads.
  bool require_proof = true;
  /// Asked between the steps of choices, searches and followed peaks: true ends them with what
  /// there is. A curve itself is stopped by its observer.
  std::function<bool()> stop{};
  /// A motion near the solution at frequency_begin, of a poorer model say: Newton's method is tried
  /// from it before the linear limits, so that of several solutions there the curve begins with
  /// that one.
  std::optional<contact::Harmonics> near_begin{};
  /// Starts per frequency of a search for detached branches (branch_search.hpp); 0: none.
  int search_starts = 0;
  /// The same scene with forces that are cheaper and less exact, from whose solutions those of the
  /// scene are then looked for; nullptr: its own are cheap.
  std::shared_ptr<const Scene> search_scene{};
};

}  // namespace microslip::solver
