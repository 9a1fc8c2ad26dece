/// @file
/// States of a contact point, and what a period is made of.
#pragma once

#include <cstdint>

namespace microslip::contact {

/// Values as written to files (maps and tables); `slip` is slip in two directions.
enum class ContactState : std::uint8_t { stick, positive_slip, negative_slip, separated, slip };
enum class CycleRegime : std::uint8_t { full_stick, stick_slip, separation, separated };

/// start in [0, 2π), length in (0, 2π] [rad].
struct CycleSegment {
  ContactState state = ContactState::stick;
  double start = 0.0;
  double length = 0.0;
  double offset = 0.0;  ///< stick: c of f = k_u (u_s sin θ + u_c cos θ) + c [Pa]; else 0
};

}  // namespace microslip::contact
