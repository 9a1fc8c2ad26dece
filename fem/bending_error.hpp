/// @file
/// How much too stiff linear elements are where a body bends: told before anything is solved.
///
/// An element that can only stretch and shear bends by a shear that is not there. Of a plate of
/// thickness t and elements of edge a, in part shear and in part the volume that cannot change
/// freely,
///
///   f²/f₀² = 1 + c (a/t)²,   c = 0.55 hexahedra and wedges,  1.75 tetrahedra               (1)
///
/// a is the mean of the longest sides of the outer faces, weighted by area, and t the smaller side
/// of the rectangle b × t along the body's length L that has its volume V and surface A,
///
///   b t = V/L,   b + t = A/(2 L);   b = t = √(V/L) where no rectangle has so little surface   (2)
///
/// Source: MacNeal, Finite Elements: Their Design and Performance (1994), section 6.3, of shear
/// locking: the parasitic energy of n elements over t goes with (a/t)², whatever n. The factors are
/// measured: cantilevers of both sorts, one to four elements over the thickness, ν = 0.3.
/// @note  Of a square plate ten times as wide as thick it tells 1.1 to 1.9 times what is wrong
///        (test_questions.cpp): the surface of its ends makes t too small.
#pragma once

#include "mesh/mesh.hpp"

namespace microslip::fem {

/// By how much the frequencies of bending may be too high, f/f₀ − 1 [-], by (1);
/// 0: the first block of elements is quadratic, or there is none.
[[nodiscard]] double bending_error(const mesh::Mesh& mesh);

}  // namespace microslip::fem
