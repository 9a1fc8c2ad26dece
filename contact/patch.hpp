/// @file
/// A contact patch as the contact room knows it: a frame (p, q, r), and what two bodies that rub
/// have at places of their face: stiffness, friction, pressure, relative motion of every mode.
/// Plain arrays; where they come from (finite elements, another code, a formula) is not known here.
///
/// A patch is sampled twice: at the centres of its cells, where forces are summed with their
/// weights, and at the vertices of these cells, for pictures.
/// Whoever computes something takes a PatchSamples.
#pragma once

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "contact/surface/friction_law.hpp"
#include "contact/surface/point_parameters.hpp"
#include "contact/surface/rough_surface.hpp"

namespace microslip::contact {

/// Relative mode shapes (A minus B) at points of a patch in its frame, each n_points × n_modes
/// [1/√kg]: u along p, v along q (positive approach), w along r. `w` may be empty (no motion).
struct ModalShapes {
  Eigen::MatrixXd u;
  Eigen::MatrixXd v;
  Eigen::MatrixXd w;
};

/// A patch at n places.
struct PatchSamples {
  Eigen::MatrixX3d points;  ///< positions [m], n; at will 0 where a scene gives none
  Eigen::VectorXd weights;  ///< area [m²] (or 1 for lumped points), n; without elements at vertices
  ModalShapes shapes;       ///< n × n_modes
  Eigen::MatrixX3d stiffness;  ///< along p, q, r [N/m³], flexibility of omitted modes included, n
  Eigen::VectorXd friction;  ///< coefficient μ, that at rest where it depends on the speed [-], n
  /// Rest load of each place at a curve load of one [Pa]: 1 N in all,
  /// or as given where loads are scales, n.
  Eigen::VectorXd preload_field;
  Eigen::MatrixX3d
      compliance;  ///< of omitted modes along p, q, r [m³/N], n; without rows where there is none

  /// Of a face that is curved: p and q of each place, n;
  /// without rows where they are those of the patch.
  Eigen::MatrixX3d slip_directions, normals;

  [[nodiscard]] Eigen::Index size() const { return friction.size(); }
  [[nodiscard]] bool has_friction(Eigen::Index place) const { return friction[place] > 0.0; }
};

/// What the load of a curve is: a factor on the preload field as it is given, or the preload [N].
enum class LoadMeasure { scale, force };

/// Points of two plane stiff bodies that are pressed together by a force and moments and tilt
/// against each other (theory section 12): some of them may lift off.
struct TiltedArea {
  std::string key;                         ///< that gives the moments, for messages
  Eigen::Index begin = 0;                  ///< its first point; the others follow
  Eigen::VectorXd p, r;                    ///< of its points, from where the moments turn [m]
  double share = 1.0;                      ///< of the load of its patch [-]
  std::array<double, 2> moment{0.0, 0.0};  ///< about p and r [N m], the same under every load
};

/// What the constants of a point do not say about the two surfaces that rub.
struct SurfaceRules {
  std::optional<FrictionLaw> friction;    ///< in place of the coefficient of points that rub
  std::optional<RoughSurface> roughness;  ///< none: smooth
  /// With rough surfaces: stiffness of the surfaces in full contact, bodies not included [N/m³].
  /// None: that of the samples.
  std::optional<double> local_tangential_stiffness, local_normal_stiffness;

  /// Constant friction, smooth surfaces.
  [[nodiscard]] bool plain() const { return !friction && !roughness; }
};

struct Patch {
  std::string name;  ///< of columns and files where a scene has several
  /// Rows p, q (outward normal), r: of places without axes of their own,
  /// and of coordinates p and r along the patch.
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  double off_plane =
      0.0;  ///< the largest distance of a place from the plane of that frame, over the size [-]
  PatchSamples cells;     ///< at their centres: the contact points
  PatchSamples vertices;  ///< without elements: points only
  /// Vertices of each cell, n_cells × 3 or 4; cell c belongs to contact point c. No rows:
  /// points only.
  Eigen::Matrix<Eigen::Index, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> connectivity;
  int fit_degree = -1;        ///< of the mode shapes; −1: they are interpolated
  Eigen::VectorXd fit_error;  ///< per mode; empty where none was tried
  LoadMeasure load_measure = LoadMeasure::force;
  double load_share = 1.0;               ///< relative to the other patches: of a load that presses
  std::vector<TiltedArea> tilted_areas;  ///< where moments act beside the load
  SurfaceRules rules;
  double wear_coefficient = 0.0;  ///< Archard [m²/N]: depth per (pressure × slip distance)
};

/// Area-weighted mean of the contact points [m].
[[nodiscard]] Eigen::Vector3d centroid(const Patch& patch);

/// A load that a patch cannot have: a gap without normal stiffness, moments that nothing balances.
/// The message says why, and which force would do.
class LoadError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace microslip::contact
