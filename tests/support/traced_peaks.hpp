/// @file
/// Peak against parameter, all values at once.
#pragma once

#include "solver/optimum/peak_trace.hpp"

namespace microslip::tests {

inline solver::PeakTrace traced_peaks(const solver::SceneFamily& family,
                                      const solver::ContinuationOptions& range,
                                      const solver::PeakTraceOptions& options) {
  solver::PeakFamilies families(family, range, options);
  families.trace();
  return families.result();
}

}  // namespace microslip::tests
