#include "pipelines/accuracy/effect_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

namespace microslip::pipelines {
namespace {

std::optional<double> largest_change(const std::vector<ErrorRow>& rows, const std::string& source) {
  std::optional<double> largest;
  for (const ErrorRow& row : rows) {
    if (row.source != source) continue;
    largest = std::max(std::abs(row.effect), largest.value_or(0.0));
  }
  return largest;
}

std::string objection_of(double bound) {
  if (std::isinf(bound)) {
    return "left out, and with it the highest peak is not found from that without";
  }
  return fmt::format("left out, and having it changes the highest peaks by up to {:.2g} %",
                     100.0 * bound);
}

}  // namespace

void tell_bounds(const std::vector<ErrorRow>& rows, double tolerance,
                 std::vector<EffectRecord>& effects) {
  for (EffectRecord& effect : effects) {
    if (effect.simulated == Simulated::yes) continue;
    const bool harmonics = effect.name == "higher_harmonics";
    const auto change = largest_change(rows, harmonics ? "harmonics" : effect.name);
    if (!change) continue;
    effect.bound = change;
    effect.objection = *change > tolerance ? objection_of(*change) : "";
  }
}

}  // namespace microslip::pipelines
