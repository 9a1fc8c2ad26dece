#include "pipelines/effects/beside_bar.hpp"

#include <cmath>

#include <fmt/format.h>

#include "pipelines/text/rounded.hpp"

namespace microslip::pipelines {
namespace {

std::string change_text(double change) {
  if (std::isnan(change)) return "what it would change is not known";
  if (std::isinf(change)) return "with it the highest peak is not found";
  return "would change peaks by up to " + percent_text(change);
}

}  // namespace

void keep_larger(const BesideBar& one, BesideBar& of_all) {
  for (const auto& [effect, change] : one) {
    const auto [known, is_new] = of_all.try_emplace(effect, change);
    if (!is_new && (std::isnan(change) || change > known->second)) known->second = change;
  }
}

std::string beside_bar_text(const BesideBar& left_out) {
  constexpr double least = 1e-5;  // what no bar needs
  std::string text;
  for (const auto& [effect, change] : left_out) {
    if (change < least) continue;
    text +=
        fmt::format("{} {} ({})", text.empty() ? "left out:" : ",", effect, change_text(change));
  }
  return text;
}

std::string after_bar(const BesideBar& left_out) {
  const std::string text = beside_bar_text(left_out);
  return text.empty() ? text : "; " + text;
}

}  // namespace microslip::pipelines
