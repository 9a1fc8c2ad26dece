/// @file
/// One set of harmonics for a response curve: what its highest points need (peak_harmonics.hpp),
/// found on a curve with the least set first, and what may resonate along it
/// (resonances_along.hpp). Points away from the peaks have the same set; what else it leaves out
/// there is not asked.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "solver/balance/harmonic_set.hpp"
#include "solver/continuation_options.hpp"
#include "solver/enrichment/peak_harmonics.hpp"
#include "solver/response_curve.hpp"
#include "solver/scene.hpp"

namespace microslip::solver {

/// The curve of a scene with a given set, or its solution at one frequency.
using CurveOfSet = std::function<ResponseCurve(const HarmonicSet& set)>;

struct CurveHarmonics {
  HarmonicSet set{1};
  /// Σ |δA| / A of harmonics left out, the largest of the high points; A of the highest, of the
  /// place that is told its own.
  double left_out = 0.0;
  bool settled = true;  ///< false: a high point may need harmonics beyond those
  long iterations = 0;
  long contact_evaluations = 0;
  SettledPeak highest{};                  ///< the curve's highest peak, else end; amplitude 0: lost
  bool is_peak = false;                   ///< and not an end
  std::vector<SettledPeak> known{};       ///< high points solved for with more than the set has
  std::optional<ResponseCurve> traced{};  ///< with the set, where the choice has needed it
};

/// @param range  with `harmonic_tolerance` > 0.
/// @param curve  solved with `set`.
/// @param trace  where the richer equations are not solved from the peak, the curve with a few
///               harmonics more is, and at last with all that the peak was to have.
[[nodiscard]] CurveHarmonics choose_harmonics(const Scene& scene, const ContinuationOptions& range,
                                              const HarmonicSet& set, const ResponseCurve& curve,
                                              const CurveOfSet& trace);

/// What a set leaves out at the high points of its curve; the peaks of the curve keep their own.
/// @param known  peaks with more harmonics: a peak of the curve that is one of them is compared
///               with it, of others it is estimated; the highest is solved for with more then.
[[nodiscard]] CurveHarmonics check_harmonics(const Scene& scene, const ContinuationOptions& range,
                                             const HarmonicSet& set,
                                             const std::vector<SettledPeak>& known,
                                             ResponseCurve& curve);

/// The whole way: a curve with the least set, the choice, the curve with what was chosen, traced
/// once more where its own peaks ask for more. Stopped, it is the last one that is complete.
/// @param first  traces the curves that the choice needs;
///               the last is the result where its set is enough.
/// @param trace  traces the curve that is given.
[[nodiscard]] ResponseCurve trace_with_chosen(const Scene& scene, const ContinuationOptions& range,
                                              const CurveOfSet& first, const CurveOfSet& trace);

/// Observes nothing and ends a curve where the options ask for it.
[[nodiscard]] inline PointObserver until_stopped(const ContinuationOptions& options) {
  return [stop = options.stop](const ResponsePoint&) { return !(stop && stop()); };
}

/// The options with a set given in the place of the tolerance.
[[nodiscard]] ContinuationOptions with_harmonics(const ContinuationOptions& range,
                                                 const HarmonicSet& set);

}  // namespace microslip::solver
