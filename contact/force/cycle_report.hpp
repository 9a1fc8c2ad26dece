/// @file
/// What the points of a patch did over one period, in shares of (area × period).
#pragma once

#include <array>
#include <memory>
#include <span>

#include "contact/contact_state.hpp"
#include "contact/modal_force.hpp"

namespace microslip::contact {

/// Adds up points, by whatever method: shares by the lengths of the segments; the largest
/// coexistence of the three states by a sweep over all transition angles, between which the area
/// fractions do not change; slip work ∬∮μn|ds|dA. Shares are 0 if all weights are. Events are in
/// order where each segment begins where the one before ends, once round the period.
class ReportSum {
 public:
  ReportSum();
  ~ReportSum();
  ReportSum(const ReportSum&) = delete;
  ReportSum& operator=(const ReportSum&) = delete;
  ReportSum(ReportSum&&) = delete;
  ReportSum& operator=(ReportSum&&) = delete;

  /// @param segments  of one period; lengths sum to 2π.   @param weight  area of the point, ≥ 0.
  void add(std::span<const CycleSegment> segments, double dissipated_energy, double weight);
  [[nodiscard]] CycleReport result() const;

 private:
  class PhaseSweep;
  std::unique_ptr<PhaseSweep> sweep_;
  std::array<double, 3> share_{};  // stick, slip, separated: area × phase
  double area_ = 0.0;
  double slip_work_ = 0.0;
  double event_gap_ = 0.0;
};

}  // namespace microslip::contact
