/// @file
/// Random states of a contact point that moves in two tangential directions, by stratum: every
/// regime, and the limits at which the search for the periodic slider is hard.
#pragma once

#include <random>
#include <string_view>
#include <vector>

#include "support/planar_reference.hpp"

namespace microslip::test {

struct PlanarStratum {
  std::string_view name;
  PlanarCase (*draw)(std::mt19937_64&);
};

/// 1 to 3 harmonics, means, different stiffness along p and r, gaps.
[[nodiscard]] PlanarCase generic_planar(std::mt19937_64& random);
/// Never separated, amplitudes from the limit of friction to twenty times it.
[[nodiscard]] PlanarCase slipping_planar(std::mt19937_64& random);
/// Never separated; means that drag the virgin slider, amplitudes that leave the point stuck.
[[nodiscard]] PlanarCase dragged_planar(std::mt19937_64& random);
/// The same with larger amplitudes: a little slip somewhere in the period,
/// or stuck after a long way.
[[nodiscard]] PlanarCase creeping_planar(std::mt19937_64& random);
/// The same with the amplitude at the onset of slip, closer than 10 % and down to 1e-9 on either
/// side: a straight or elliptic motion under constant load, of which the onset is known.
[[nodiscard]] PlanarCase onset_planar(std::mt19937_64& random);
/// All strata, the generic one first.
[[nodiscard]] const std::vector<PlanarStratum>& planar_strata();

}  // namespace microslip::test
