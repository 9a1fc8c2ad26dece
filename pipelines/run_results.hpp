/// @file
/// What a run has found, as the writers see it: plain values, no solver objects behind them.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "contact/contact_map.hpp"
#include "contact/contact_patch.hpp"
#include "fem/modal_basis.hpp"
#include "mesh/mesh.hpp"
#include "pipelines/scene_description.hpp"
#include "solver/peak.hpp"
#include "solver/response_curve.hpp"

namespace microslip::pipelines {

class PatchFields;

/// Effects of contact that are simulated beyond one-sided Coulomb friction along p.
struct ContactEffects {
  int n_harmonics = 1;  ///< highest that may occur
  bool normal_motion = true;  ///< false: the load stays that of rest, whatever the approach
  bool second_direction = false;
  double motion_ratio = 0.0;  ///< motion along r against that along p in the linear limits [-]
  std::optional<contact::FrictionLaw> friction_law;
  std::optional<contact::RoughSurface> roughness;
  /// With rough surfaces: stiffness of the surfaces in full contact, bodies not included [N/m³].
  std::optional<double> local_tangential_stiffness, local_normal_stiffness;

  /// The normal stiffness that is simulated. @param given  [N/m³].
  [[nodiscard]] double normal_stiffness(double given) const { return normal_motion ? given : 0.0; }
  /// One direction, constant friction, smooth surfaces.
  [[nodiscard]] bool simple_laws() const {
    return !second_direction && !friction_law && !roughness;
  }
  /// The closed form of one harmonic and one direction does.
  [[nodiscard]] bool closed_form() const { return n_harmonics == 1 && simple_laws(); }
};

/// What the response stage needs, and model.h5 holds. Contact arrays have n_points rows.
struct ReducedModel {
  Eigen::VectorXd frequency;      ///< ω_n [rad/s], N
  Eigen::Index n_attachment = 0;  ///< so many of the N, the last, are attachment shapes (theory 14.1)
  Eigen::VectorXd damping_ratio;  ///< N
  Eigen::VectorXd force_sine, force_cosine, force_static;  ///< modal force [N/√kg], N
  Eigen::VectorXd output;         ///< y = output · q [1/√kg], N
  Eigen::MatrixX3d points;        ///< contact points [m]
  Eigen::VectorXd weights;        ///< [m²]
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();  ///< rows p, q (outward normal), r
  contact::ModalShapes shapes;    ///< at the points
  Eigen::VectorXd tangential_stiffness;  ///< along p [N/m³], residual part included
  Eigen::VectorXd second_stiffness;      ///< along r [N/m³], likewise
  Eigen::VectorXd normal_stiffness;
  Eigen::VectorXd friction_coefficient;
  Eigen::VectorXd preload;        ///< [Pa] at unit load: total 1 N, or as given where the load is a scale
  LoadMeasure load_measure = LoadMeasure::force;
  std::vector<TiltedArea> tilted_areas;  ///< where moments act beside the load
  int fit_degree = -1;            ///< −1: no fit
  Eigen::VectorXd fit_error;      ///< per mode; empty without a fit
  /// Cells of the patch for pictures: cell c belongs to point c. No cells: points only.
  Eigen::MatrixX3d vertices;
  mesh::Connectivity cells;       ///< n_points × 3 or 4
  contact::ModalShapes vertex_shapes;
  Eigen::VectorXd vertex_tangential_stiffness, vertex_second_stiffness, vertex_normal_stiffness;
  Eigen::VectorXd vertex_friction_coefficient, vertex_preload;
  /// Compliance of the omitted modes along p, q, r [m³/N]; without rows where there is none.
  Eigen::MatrixX3d compliance, vertex_compliance;
  ContactEffects effects;
  /// The patch as functions of position where its quadrature is fitted, else none. Shared: it does not change,
  /// and the forces of all curves refer to it. Not in model.h5.
  std::shared_ptr<const PatchFields> fields;
};

struct NamedMap {
  std::string name;           ///< e.g. "preload_1000_peak": stem of the files
  double frequency_hz = 0.0;
  double amplitude = 0.0;     ///< of the output, half peak-to-peak [m]
  solver::Stability stability = solver::Stability::not_assessed;
  contact::ContactMap points;    ///< at the contact points (cells)
  contact::ContactMap vertices;  ///< at the vertices of the cells; empty without cells
};

struct CurveResult {
  std::string name;  ///< stem of the CSV
  std::variant<double, LimitName> preload;  ///< [N] (modal scenes: the scale)
  solver::ResponseCurve curve;
  std::vector<NamedMap> maps;
  std::optional<double> gap = {};  ///< the preload was given as this length [m]
  bool integrated = false;  ///< in time: to the tolerance of integration, not to rounding
};

/// The best value when one uncertain number of the contact is multiplied.
struct OptimumOfFactor {
  std::string parameter;  ///< friction_coefficient | contact_stiffness
  double factor = 1.0;
  solver::Optimum optimum;
  std::array<double, 2> range{};  ///< searched, in SI
  bool widened = false;           ///< beyond what the scene asks for
};

struct OptimumBracket {
  std::vector<OptimumOfFactor> entries;
  std::vector<std::string> left_out;  ///< what is not varied and why
};

struct StageRecord {
  std::string name;
  double seconds = 0.0;
  double peak_memory_mb = 0.0;
};

}  // namespace microslip::pipelines
