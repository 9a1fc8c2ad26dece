/// @file
/// Natural frequencies of a structure over the speed it rotates at,
/// and the speeds at which an engine order meets one.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "mesh/mesh.hpp"
#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

struct CampbellRequest {
  Eigen::VectorXd speeds;        ///< Ω [rad/s], ascending, ≥ 0
  int highest_engine_order = 0;  ///< lines ω = kΩ, k = 1 …
};

struct CampbellDiagram {
  Eigen::VectorXd speeds;  ///< Ω [rad/s]
  /// ω [rad/s], n_speeds × n_modes; each row ascending: modes are numbered anew at each speed.
  Eigen::MatrixXd frequency;
};

/// An engine order meets a mode: ω(Ω) = kΩ.
struct Crossing {
  int engine_order = 1;
  Eigen::Index mode = 0;  ///< from 0
  double speed = 0.0;     ///< Ω [rad/s]
};

/// One mesh for all speeds; each begins from the static equilibrium of the one before.
/// Without contact.
/// @param scene  has a mesh of elements and an axis.
/// @param tell   called with each speed and its frequencies [rad/s].
/// @throws SceneError  the scene has no elements or no axis; fem::EigenError  see
///         fem::Structure::rotate(); InterruptedError.
[[nodiscard]] CampbellDiagram campbell_diagram(
    const mesh::Mesh& mesh, const SceneDescription& scene, const Eigen::VectorXd& speeds,
    const std::function<void(double, const Eigen::VectorXd&)>& tell);

/// The part of the other MPI ranks in it (on_all_ranks.hpp).
inline constexpr std::string_view campbell_work = "campbell";
void take_part_in_campbell(std::string_view bytes);

/// @throws SceneError  as campbell_diagram().
void require_rotation(const SceneDescription& scene);

/// Between neighbouring speeds ω² is taken as linear in Ω², which stiffening and softening are to
/// first order. In order of engine order, then mode.
[[nodiscard]] std::vector<Crossing> crossings(const CampbellDiagram& diagram,
                                              int highest_engine_order);

}  // namespace microslip::pipelines
