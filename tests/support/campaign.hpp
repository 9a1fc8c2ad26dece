/// @file
/// Campaigns: tests over many random states or scenes. Every run of the tests takes a tenth of
/// each, always the same one; all are taken where the environment says MICROSLIP_CAMPAIGNS=whole,
/// as share/scripts/campaigns.sh does, and beyond those as many times more as
/// MICROSLIP_CAMPAIGN_TIMES says.
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace microslip::tests {

[[nodiscard]] inline bool whole_campaigns() {
  const char* asked = std::getenv("MICROSLIP_CAMPAIGNS");
  if (asked == nullptr) return false;
  if (std::string(asked) == "whole") return true;
  throw std::invalid_argument(std::string("MICROSLIP_CAMPAIGNS is ") + asked + ", not whole");
}

/// Above 1: for a count that takes hours.
[[nodiscard]] inline int campaign_times() {
  const char* asked = std::getenv("MICROSLIP_CAMPAIGN_TIMES");
  const int times = asked == nullptr ? 1 : std::atoi(asked);
  if (times < 1) {
    throw std::invalid_argument(std::string("MICROSLIP_CAMPAIGN_TIMES is ") + asked +
                                ", not a number of times");
  }
  return times;
}

/// How many to take of the cases of a campaign, from the first on.
/// @param least  as many as it takes to meet every kind of case.
[[nodiscard]] inline int campaign_size(int whole, int least = 1) {
  const int n = whole_campaigns() ? whole * campaign_times() : std::clamp(whole / 10, least, whole);
  std::printf("campaign: cases 0 to %d of %d\n", n - 1, whole);
  return n;
}

struct Seeds {
  int first = 0;
  int n = 0;
};

/// Where each case has a seed of its own: those that MICROSLIP_CAMPAIGN_SEEDS="FIRST N" names, or
/// the first `whole` of a whole campaign; none in every run of the tests, which chooses its own.
[[nodiscard]] inline std::optional<Seeds> campaign_seeds(int whole) {
  Seeds seeds;
  const char* asked = std::getenv("MICROSLIP_CAMPAIGN_SEEDS");
  if (asked == nullptr) {
    return whole_campaigns() ? std::optional<Seeds>({0, whole * campaign_times()}) : std::nullopt;
  }
  if (std::sscanf(asked, "%d %d", &seeds.first, &seeds.n) == 2) return seeds;
  throw std::invalid_argument(std::string("MICROSLIP_CAMPAIGN_SEEDS is ") + asked +
                              ", not a seed and a number of seeds");
}

/// The parameters a study runs over: some of them in every run.
[[nodiscard]] inline std::vector<double> campaign_values(std::vector<double> whole,
                                                         std::vector<double> some) {
  return whole_campaigns() ? std::move(whole) : std::move(some);
}

}  // namespace microslip::tests
