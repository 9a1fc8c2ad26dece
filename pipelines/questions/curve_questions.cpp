#include <algorithm>
#include <array>
#include <string>
#include <variant>

#include <fmt/format.h>

#include "pipelines/questions/question.hpp"

namespace microslip::pipelines {
namespace {

/// Beside other curves the limits do not count: no blade moves like that.
Findings amplitude(const Facts& facts) {
  Finding largest{"excitation.forces", 0.0};
  const auto is_limit = [](const CurveResult& result) {
    return std::holds_alternative<LimitName>(result.load);
  };
  const bool limits_alone = std::ranges::all_of(*facts.curves, is_limit);
  for (const CurveResult& result : *facts.curves) {
    if (is_limit(result) && !limits_alone) continue;
    for (const solver::ResponsePoint& point : result.curve.points) {
      const double share = percent * point.amplitude / facts.mesh->longest_side();
      if (share <= largest.value) continue;
      largest.value = share;
      largest.where = fmt::format("of the longest side of the mesh ({:.3g} m, curve {})",
                                  point.amplitude, result.name);
    }
  }
  return {largest};
}

constexpr std::array about_response{
    Question{"the largest amplitude is", "%", 0.0, 3.0, "",
             "vibrations are taken as small; are force, damping and units right?", amplitude},
};

}  // namespace

std::span<const Question> curve_questions() { return about_response; }

}  // namespace microslip::pipelines
