/// @file
/// What one point of a patch does over its period, as numbers that are cheap to compare: its state
/// at 32 instants, two bits each. Between two motions the share of the instants that differ is the
/// part of the period in which the point has changed its state.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "contact/contact_state.hpp"

namespace microslip::contact {

class PeriodStates {
 public:
  static constexpr int n_instants = 32;  ///< at θ = 2π (k + ½)/32

  /// The same state throughout.
  explicit PeriodStates(ContactState state = ContactState::stick) : bits_(pattern(state)) {}

  /// One phase of the period. Slip in two directions counts as positive slip.
  /// @param begin   [rad], ≥ −2π, finite.   @param length  [rad], ≥ 0.
  void set(ContactState state, double begin, double length) {
    constexpr double per_radian = n_instants / (2.0 * std::numbers::pi);
    const auto first = static_cast<int>(std::ceil(begin * per_radian - 0.5));
    const auto end = static_cast<int>(std::ceil((begin + length) * per_radian - 0.5));
    if (end <= first) return;
    const std::uint64_t ones =
        end - first >= n_instants ? ~std::uint64_t{0} : (std::uint64_t{1} << 2 * (end - first)) - 1;
    const std::uint64_t mask = std::rotl(ones, 2 * ((first + n_instants) % n_instants));
    bits_ = (bits_ & ~mask) | (pattern(state) & mask);
  }

  /// Share of the instants at which both differ, 0 … 1.
  [[nodiscard]] double changed(const PeriodStates& other) const {
    const std::uint64_t different = bits_ ^ other.bits_;
    return std::popcount((different | different >> 1) & odd) / static_cast<double>(n_instants);
  }

  /// Contact and separation alone: slip counts as stick.
  [[nodiscard]] PeriodStates without_slip() const {
    PeriodStates result;
    result.bits_ = 3 * (bits_ & bits_ >> 1 & odd);
    return result;
  }

 private:
  static_assert(static_cast<int>(ContactState::separated) == 3);
  static constexpr std::uint64_t odd = 0x5555555555555555U;

  static std::uint64_t pattern(ContactState state) {
    if (state == ContactState::slip) return odd;
    return odd * static_cast<std::uint64_t>(state);
  }

  std::uint64_t bits_;
};

struct CycleStates {
  CycleRegime regime = CycleRegime::separated;
  PeriodStates period{ContactState::separated};

  /// Of a point whose slip has no force.
  [[nodiscard]] CycleStates without_slip() const {
    const bool slips = regime == CycleRegime::stick_slip;
    return {slips ? CycleRegime::full_stick : regime, period.without_slip()};
  }
};

}  // namespace microslip::contact
