/// @file
/// Scene kind `chain`: a few coordinates with masses and springs, contacts between them and the
/// ground or each other (paper B, figures 6 to 10).
///
/// The system is one of
///   masses, springs                  ground–m1, m1–m2, …, and, if one more spring is given,
///                                    mn–ground
///   mass_matrix, stiffness_matrix    K x = ω² M x is solved
///   frequency, mode_shapes           mass-normalised modes as they are
///
/// A contact rubs along `slip` and closes along `approach`, both coordinates or sums of them. Its
/// load is its share of the total preload N of the curve. Cells divide it into an area:
/// with axes p (slip), q (normal), r,
///
///   n_i = N share/(n m) + M_r p_i/Σp² − M_p r_i/Σr²        (theory section 12)
///
/// for the preload moments M_p, M_r as long as every cell stays loaded; else some lift off and the
/// others carry (tilted_area.hpp). The cells move as one:
/// only the coordinates of the chain turn nothing.
#pragma once

#include <string>

#include "pipelines/sections/modes_section.hpp"

namespace microslip::pipelines {

/// @param output  coordinate that is told; "": none.
/// @return modes and one point per cell: stiffness [N/m] and load [N] of the cell, weight 1. The
///         load of a curve is the total normal force.
/// @throws SceneError  none or several of the three systems, sizes that do not fit, a matrix that
///         is not symmetric or not positive, an unknown coordinate.
[[nodiscard]] ModalModel read_chain(LeanSections sections, const std::string& output);

}  // namespace microslip::pipelines
