#include "solver/enrichment/carried_peak.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

#include "solver/enrichment/enrichment.hpp"
#include "solver/enrichment/level_point.hpp"

namespace microslip::solver {

std::optional<LocalPeak> carried_peak(const Scene& scene, const ContinuationOptions& range,
                                      const LocalPeak& peak, const HarmonicSet& from,
                                      const HarmonicSet& to, PeakWork& work) {
  constexpr double farthest = 4.0;  // amplitudes or widths along the branch
  const HarmonicBalance coarse(scene, from);
  HarmonicBalance richer(scene, to);
  const LocalPeak start = embedded(peak, coarse, richer);
  if (auto found = level_point(richer, start, range, work, farthest)) return found;
  std::vector<int> missing;
  std::ranges::set_difference(to.orders(), from.orders(), std::back_inserter(missing));
  if (missing.size() < 2) return std::nullopt;
  missing.resize(missing.size() / 2);
  const HarmonicSet between = from.united(missing);
  const auto half = carried_peak(scene, range, peak, from, between, work);
  return half ? carried_peak(scene, range, *half, between, to, work) : std::nullopt;
}

}  // namespace microslip::solver
