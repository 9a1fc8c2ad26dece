/// @file
/// Parametric blade in the manner of paper A, figures 9 and 10: a twisted, tapered aerofoil on a
/// platform on a root block.
///
/// Axes: x circumferential, y radial (span), z axial. The foot of the root block lies in y = 0 and
/// is clamped. The right side face of the platform (largest x, normal +x) is the contact face,
/// a plane.
///
/// Named surfaces: "root" (the foot, y = 0), "contact" (right side face of the platform).
/// Named points: "A" on the tip section at mid-chord (suction side, where the response is read),
/// "B" leading edge and "B'" trailing edge of the tip section, the ends of its chord and symmetric
/// about mid-chord (where forces act). Lengths in m, angles in rad.
#pragma once

#include <optional>

namespace microslip::mesh {

struct BladeGeometry {
  double root_width = 0.0066;      ///< x
  double root_height = 0.025;      ///< y
  double root_length = 0.050;      ///< z
  double platform_width = 0.060;   ///< x
  double platform_height = 0.010;  ///< y
  double platform_length = 0.060;  ///< z
  double span = 0.1141;            ///< aerofoil height above the platform
  double root_chord = 0.044;       ///< chord at the platform
  double tip_chord = 0.034;
  double root_thickness = 0.0050;  ///< largest thickness of the section
  double tip_thickness = 0.0030;
  double root_stagger = 0.10;  ///< angle of the chord to z about y, at the platform
  double tip_stagger = 0.60;   ///< at the tip: the difference is the twist
  double camber = 0.04;        ///< height of the camber line over the chord [-]
  double lean = -0.003;        ///< shift of the tip section along x
};

/// Target edge lengths of the elements [m].
struct ElementSizes {
  double element_size = 0.004;  ///< > 0
  /// At the edges where stresses are singular and the mesh errs most: the outline of the clamped
  /// foot, and the re-entrant edges where root block and aerofoil meet the platform. None:
  /// as everywhere.
  std::optional<double> edge_size{};
};

/// @throws MeshError  a length, angle or ratio out of its range; names it.
void check_geometry(const BladeGeometry& geometry, const ElementSizes& sizes);

struct SectionPoint {
  double x, y, z;
};

/// A point on the outline of the aerofoil [m].
/// @param height       0 at the platform, 1 at the tip; linear in between.
/// @param chord_share  0 leading edge, 1 trailing edge.
/// @param side         1 suction side, −1 pressure side. Half thickness t √(s(1−s)): an ellipse.
[[nodiscard]] SectionPoint section_point(const BladeGeometry& geometry, double height,
                                         double chord_share, double side);

}  // namespace microslip::mesh
