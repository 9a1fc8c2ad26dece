#include "pipelines/response/harmonics_effect.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipelines/model/effects.hpp"

namespace microslip::pipelines {

void tell_harmonics(const SceneDescription& scene, const std::vector<CurveSummary>& curves,
                    std::vector<EffectRecord>& effects) {
  if (!scene.response || !scene.settings.harmonics.chosen()) return;
  std::set<int> orders;
  std::size_t most = 0;
  double left_out = 0.0;
  for (const CurveSummary& curve : curves) {
    orders.insert(curve.harmonic_orders.begin(), curve.harmonic_orders.end());
    most = std::max(most, curve.most_harmonics);
    left_out = std::max(left_out, curve.largest_left_out);
  }
  if (orders.empty()) return;
  for (EffectRecord& effect : effects) {
    if (effect.name != "higher_harmonics") continue;
    effect.simulated = *orders.rbegin() > 1;
    effect.reason =
        fmt::format("{}: {}, of the orders {}; those left out change them by {:.2g} % at most",
                    harmonics_text(scene), most, fmt::join(orders, ", "), 100.0 * left_out);
  }
}

}  // namespace microslip::pipelines
