/// @file
/// One set of harmonics for a peak, chosen by what leaving harmonics out does to it.
///
///   estimate   all harmonics that the set lacks, up to the highest allowed, by one step in the
///              model that has them (enrichment.hpp): their effects are added up by size, no sign
///              may hide another
///   add        those whose effects together pass a quarter of the tolerance, and all that may
///              resonate: kω within a few half bandwidths of a mode, free, stuck or held as at the
///              peak, whose response to the force already there would be more than the tolerance.
///              They are solved for together: next to a resonance one harmonic alone tells nothing
///              of its neighbours
///   solve      the peak again, by Newton's method from the embedding; then estimate anew
///   confirm    once what is left out does less than half the tolerance, the largest few of it are
///              solved for too. Only a peak that stays where it was, to the tolerance, is believed
///   prune      as many go again as the other half of the tolerance allows, the peak being solved
///              without them: what they do together is known then, their signs included. All but
///              the first few, or, where more can go so, those that do least
#pragma once

#include <optional>
#include <vector>

#include "solver/enrichment/dropped_harmonics.hpp"
#include "solver/enrichment/enrichment.hpp"
#include "solver/peak/local_peak.hpp"
#include "solver/response_curve.hpp"

namespace microslip::solver {

struct PeakHarmonics {
  HarmonicSet set{1};
  /// Solved with the set, in its unknowns. Empty: it was not found there by Newton's method.
  std::optional<LocalPeak> peak;
  double left_out =
      0.0;  ///< |δA| / A of pruned harmonics, solved, and Σ |δA| / A of the others, estimated
  SettledPeak richest{};   ///< before pruning, with the block that confirms it
  double confirmed = 0.0;  ///< |δA| / A by the block that was solved for last
  bool settled = false;  ///< false: the peak is not found, or the highest order allowed is reached
};

class PeakHarmonicsChoice {
 public:
  /// @param scene  borrowed.
  /// @param range  `harmonic_tolerance` > 0 and `n_harmonics`, the highest that may be added;
  ///               borrowed.
  /// @throws std::invalid_argument  tolerance or highest out of range.
  PeakHarmonicsChoice(const Scene& scene, const ContinuationOptions& range);

  /// @param peak  solved with `set`.
  /// @param more  orders that the result is to have at least.
  [[nodiscard]] PeakHarmonics choose(const HarmonicSet& set, const LocalPeak& peak,
                                     const HarmonicSet& more);
  /// Σ |δA| / A of harmonics that a set lacks.
  [[nodiscard]] double left_out(const HarmonicSet& set, const LocalPeak& peak);

  [[nodiscard]] const PeakWork& work() const { return work_; }

 private:
  struct Estimate {
    std::vector<RicherShare> shares;  ///< of orders left out, the largest first
    double sum = 0.0;                 ///< of their sizes
    std::vector<int> resonant;

    /// Of the sum, without some orders.
    [[nodiscard]] double beyond(const std::vector<int>& orders) const;
  };

  [[nodiscard]] Estimate estimate(const HarmonicSet& set, const LocalPeak& peak);
  [[nodiscard]] std::vector<int> wanted(const Estimate& estimate) const;
  [[nodiscard]] std::vector<int> block(const Estimate& estimate) const;
  [[nodiscard]] bool same(const LocalPeak& a, const LocalPeak& b, double tolerance) const;
  [[nodiscard]] std::optional<LocalPeak> solved(const HarmonicSet& from, const LocalPeak& peak,
                                                const HarmonicSet& to, double farthest);
  [[nodiscard]] std::optional<LocalPeak> solved_one_by_one(HarmonicSet set, LocalPeak peak,
                                                           std::vector<int> orders);
  [[nodiscard]] SettledPeak told(const HarmonicSet& set, const LocalPeak& peak, double left_out);
  void settle(PeakHarmonics& result);
  void try_first_ones(PeakHarmonics& result, const std::vector<DroppedHarmonic>& dropped,
                      const HarmonicSet& least);
  void prune(PeakHarmonics& result, const PeakHarmonics& rich,
             const std::vector<DroppedHarmonic>& dropped, const HarmonicSet& least);
  [[nodiscard]] std::optional<PeakHarmonics> without(const PeakHarmonics& rich,
                                                     const HarmonicSet& fewer);

  const Scene& scene_;
  const ContinuationOptions& range_;
  HarmonicSet least_;
  PeakWork work_;
};

}  // namespace microslip::solver
