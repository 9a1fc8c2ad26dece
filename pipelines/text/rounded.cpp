#include "pipelines/text/rounded.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace microslip::pipelines {
namespace {

/// To so many decimals; fewer than none: to tens, hundreds …
std::string fixed(double value, int decimals) {
  const double unit = std::pow(10.0, -decimals);
  return fmt::format("{:.{}f}", std::round(value / unit) * unit, std::max(decimals, 0));
}

struct Rounded {
  std::string value;
  std::string half_width;    // empty: none is known
  std::string power_of_ten;  // "e7", of both
};

Rounded rounded(double value, double bar) {
  constexpr double exact = 1e-8;  // amplitudes are solved for to no more
  const double half_width = std::abs(value) * bar;
  if (!(bar > exact && half_width > 0.0) || !std::isfinite(half_width)) {
    return {fmt::format("{:.8g}", value), "", ""};
  }
  const double decade = std::floor(std::log10(half_width));
  constexpr double one = 1.95;  // what is a one when rounded
  const int more = half_width / std::pow(10.0, decade) < one ? 1 : 0;
  const int decimals = more - static_cast<int>(decade);
  const int size = static_cast<int>(std::floor(std::log10(std::abs(value))));
  constexpr int smallest = -5;
  constexpr int largest = 6;
  if (size >= smallest && size <= largest) {
    return {fixed(value, decimals), fixed(half_width, decimals), ""};
  }
  const double scale = std::pow(10.0, size);
  return {fixed(value / scale, decimals + size), fixed(half_width / scale, decimals + size),
          fmt::format("e{}", size)};
}

}  // namespace

std::string with_half_width(double value, double bar) {
  const Rounded text = rounded(value, bar);
  if (text.half_width.empty()) return text.value;
  if (text.power_of_ten.empty()) return fmt::format("{} ± {}", text.value, text.half_width);
  return fmt::format("({} ± {}){}", text.value, text.half_width, text.power_of_ten);
}

std::string with_digits_of(double value, double bar) {
  const Rounded text = rounded(value, bar);
  return text.value + text.power_of_ten;
}

std::string percent_text(double share) {
  constexpr double whole = 10.0;  // from here two digits need no decimals
  const double percent = 100.0 * share;
  return std::abs(percent) < whole ? fmt::format("{:.2g} %", percent)
                                   : fmt::format("{:.0f} %", percent);
}

std::string signed_percent_text(double share) {
  return (std::signbit(share) ? "-" : "+") + percent_text(std::abs(share));
}

}  // namespace microslip::pipelines
