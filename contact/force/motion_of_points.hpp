/// @file
/// The coordinates in which few contact points move: a structure of a hundred modes that rubs at
/// one point is seen by it through two or three numbers (theory 14.2).
#pragma once

#include "contact/motion_coordinates.hpp"
#include "contact/patch.hpp"

namespace microslip::contact {

/// Orthonormal coordinates of all motions that the shapes have: exact, what is left out moves no
/// point. All modes where these are few, or not many more than the coordinates: then equations in
/// fewer unknowns gain nothing.
/// @param shapes  n_points × n_modes each, or empty.
[[nodiscard]] MotionCoordinates motion_of_points(const ModalShapes& shapes);

}  // namespace microslip::contact
