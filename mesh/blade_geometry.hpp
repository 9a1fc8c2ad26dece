/// @file
/// Parametric blade in the manner of paper A, figures 9 and 10: a twisted, tapered aerofoil on a
/// platform on a root block.
///
/// Axes: x circumferential, y radial (span), z axial. The foot of the root block lies in y = 0 and is
/// clamped. The right side face of the platform (largest x, normal +x) is the contact face, a plane.
///
/// Named surfaces: "root" (the foot, y = 0), "contact" (right side face of the platform).
/// Named points: "A" on the tip section at mid-chord (suction side, where the response is read),
/// "B" leading edge and "B'" trailing edge of the tip section, symmetric about the stacking axis
/// (where forces act). Lengths in m, angles in rad.
#pragma once

namespace microslip::mesh {

struct BladeGeometry {
  double root_width = 0.014;       ///< x
  double root_height = 0.030;      ///< y
  double root_length = 0.050;      ///< z
  double platform_width = 0.040;   ///< x
  double platform_height = 0.008;  ///< y
  double platform_length = 0.060;  ///< z
  double span = 0.100;             ///< aerofoil height above the platform
  double root_chord = 0.044;       ///< chord at the platform
  double tip_chord = 0.034;
  double root_thickness = 0.0050;  ///< largest thickness of the section
  double tip_thickness = 0.0030;
  double root_stagger = 0.10;      ///< angle of the chord to z about y, at the platform
  double tip_stagger = 0.60;       ///< at the tip: the difference is the twist
  double camber = 0.04;            ///< height of the camber line over the chord [-]
  double lean = 0.0;               ///< shift of the tip section along x
};

}  // namespace microslip::mesh
