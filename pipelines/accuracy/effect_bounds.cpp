#include "pipelines/accuracy/effect_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

namespace microslip::pipelines {
namespace {

std::optional<double> largest_change(const std::vector<ErrorRow>& budget,
                                     const std::string& source) {
  std::optional<double> largest;
  for (const ErrorRow& row : budget) {
    if (row.source != source) continue;
    largest = std::max(std::abs(row.effect), largest.value_or(0.0));
  }
  return largest;
}

}  // namespace

void tell_bounds(const std::vector<ErrorRow>& budget, std::vector<EffectRecord>& effects) {
  constexpr double percent = 100.0;
  for (EffectRecord& effect : effects) {
    const bool harmonics = effect.name == "higher_harmonics";
    if (effect.simulated || (!harmonics && effect.name != "second_direction")) continue;
    const auto change = largest_change(budget, harmonics ? "harmonics" : effect.name);
    if (!change) continue;
    effect.reason += fmt::format("; having it would change the highest peaks by {:.2g} % at most",
                                 percent * *change);
  }
}

}  // namespace microslip::pipelines
