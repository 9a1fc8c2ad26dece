#include "solver/optimum/common_harmonics.hpp"

#include <algorithm>
#include <cmath>

#include "solver/balance/first_harmonics.hpp"
#include "solver/continuation.hpp"
#include "solver/enrichment/curve_harmonics.hpp"
#include "solver/enrichment/peak_harmonics.hpp"

namespace microslip::solver {

namespace {

constexpr double worth_another_search =
    0.01;  // of an amplitude: a valley is as level over some per cent

void add(PeakWork& sum, const PeakWork& work) {
  sum.iterations += work.iterations;
  sum.contact_evaluations += work.contact_evaluations;
}

/// Those that the highest peaks of the curve at a value need.
CurveHarmonics chosen_at(const SceneFamily& family, double value, const ContinuationOptions& range,
                         PeakWork& work) {
  const Scene scene = family(value);
  const HarmonicSet least = least_harmonics(scene);
  const auto trace = [&](const HarmonicSet& harmonics) {
    ContinuationOptions given = with_harmonics(range, harmonics);
    given.search_starts = 0;
    return trace_response(scene, given, until_stopped(range));
  };
  const ResponseCurve curve = trace(least);
  CurveHarmonics chosen = choose_harmonics(scene, range, least, curve, trace);
  add(work, {curve.iterations, curve.contact_evaluations});
  add(work, {chosen.iterations, chosen.contact_evaluations});
  return chosen;
}

/// Those that a peak needs beside the ones it has.
std::optional<CurveHarmonics> chosen_from(const Scene& scene, const ResponsePoint& peak,
                                          const ContinuationOptions& range, PeakWork& work) {
  const HarmonicSet set(peak.orders);
  HarmonicBalance balance(scene, set);
  const auto place = local_peak(balance, peak);
  if (peak.mark != PointMark::peak || !place) return std::nullopt;
  PeakHarmonicsChoice choice(scene, range);
  const PeakHarmonics found = choice.choose(set, *place, set);
  add(work, choice.work());
  if (!found.peak) return std::nullopt;
  CurveHarmonics chosen{found.set};
  chosen.highest = found.richest;
  return chosen;
}

}  // namespace

ContinuationOptions with_common_harmonics(const SceneFamily& family,
                                          const std::vector<double>& values,
                                          const ContinuationOptions& range, PeakWork& work) {
  if (!(range.harmonic_tolerance > 0.0)) return range;
  HarmonicSet set(1);
  for (const double value : values) {
    set = set.united(chosen_at(family, value, range, work).set.orders());
  }
  return with_harmonics(range, set);
}

std::optional<LackedHarmonics> lacked_harmonics(const SceneFamily& family,
                                                const PeakOfParameter& best,
                                                const ResponsePoint* highest,
                                                const ContinuationOptions& given,
                                                const ContinuationOptions& range, PeakWork& work) {
  if (!(range.harmonic_tolerance > 0.0)) return std::nullopt;
  const double same = std::max(range.harmonic_tolerance, worth_another_search);
  std::optional<CurveHarmonics> near;
  if (highest != nullptr) near = chosen_from(family(best.parameter), *highest, range, work);
  const CurveHarmonics own = near ? *near : chosen_at(family, best.parameter, range, work);
  const double amplitude = own.highest.amplitude;
  const bool agrees = std::abs(best.amplitude - amplitude) <= same * amplitude;
  const HarmonicSet now(given.orders);
  const HarmonicSet all = now.united(own.set.orders());
  if (!(amplitude > 0.0) || agrees || all == now) return std::nullopt;
  return LackedHarmonics{with_harmonics(range, all), amplitude};
}

double left_out_at(const Scene& scene, const ResponsePoint& peak,
                   const ContinuationOptions& range) {
  const HarmonicSet set(peak.orders);
  HarmonicBalance balance(scene, set);
  const auto place = local_peak(balance, peak);
  return place ? PeakHarmonicsChoice(scene, range).left_out(set, *place) : 0.0;
}

}  // namespace microslip::solver
