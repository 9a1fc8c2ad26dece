#include "solver/optimum/common_harmonics.hpp"

#include "solver/balance/first_harmonics.hpp"
#include "solver/continuation.hpp"
#include "solver/enrichment/curve_harmonics.hpp"
#include "solver/enrichment/peak_harmonics.hpp"

namespace microslip::solver {

ContinuationOptions with_common_harmonics(const SceneFamily& family,
                                          const std::vector<double>& values,
                                          const ContinuationOptions& range, PeakWork& work) {
  if (!(range.harmonic_tolerance > 0.0)) return range;
  HarmonicSet set(1);
  for (const double value : values) {
    const Scene scene = family(value);
    const HarmonicSet least = least_harmonics(scene);
    const auto trace = [&](const HarmonicSet& harmonics) {
      ContinuationOptions given = with_harmonics(range, harmonics);
      given.search_starts = 0;
      return trace_response(scene, given, until_stopped(range));
    };
    const ResponseCurve curve = trace(least);
    const CurveHarmonics chosen = choose_harmonics(scene, range, least, curve, trace);
    set = set.united(chosen.set.orders());
    work.iterations += curve.iterations + chosen.iterations;
    work.contact_evaluations += curve.contact_evaluations + chosen.contact_evaluations;
  }
  return with_harmonics(range, set);
}

double left_out_at(const Scene& scene, const ResponsePoint& peak,
                   const ContinuationOptions& range) {
  const HarmonicSet set(peak.orders);
  HarmonicBalance balance(scene, set);
  const auto place = local_peak(balance, peak);
  return place ? PeakHarmonicsChoice(scene, range).left_out(set, *place) : 0.0;
}

}  // namespace microslip::solver
