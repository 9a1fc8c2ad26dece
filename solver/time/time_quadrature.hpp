/// @file
/// Gauss–Legendre rule of five points on [0, 1], exact for polynomials of degree nine.
#pragma once

#include <array>

namespace microslip::solver {

struct QuadraturePoint {
  double at;
  double weight;
};

inline constexpr std::array<QuadraturePoint, 5> gauss_five{{
    {0.04691007703066800, 0.11846344252809454},
    {0.23076534494715845, 0.23931433524968324},
    {0.5, 0.28444444444444444},
    {0.76923465505284155, 0.23931433524968324},
    {0.95308992296933200, 0.11846344252809454},
}};

}  // namespace microslip::solver
