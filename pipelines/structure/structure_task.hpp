/// @file
/// What is solved of a structure as plain values: everything its modes, residual flexibility and
/// attachment shapes follow from, and nothing else. As bytes it is what ranks tell each other, and
/// what a result is known by.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "contact/patch/elastic_rest.hpp"
#include "fem/given_matrices.hpp"
#include "fem/material.hpp"
#include "fem/modal_analysis.hpp"
#include "fem/rotation.hpp"
#include "mesh/face_frame.hpp"
#include "mesh/mesh.hpp"
#include "pipelines/description/discretisation.hpp"

namespace microslip::pipelines {

struct StructureModes {
  Eigen::Index n_dofs = 0;  ///< free degrees of freedom
  double mass = 0.0;        ///< [kg]
  fem::ModalBasis basis;
  std::vector<fem::ResidualFlexibility>
      residuals;  ///< of the contact surfaces, one each; empty: none
  /// How the attachment shapes of `basis` were chosen, "" without them.
  std::string attachment_text;
  std::vector<std::string> notes, warnings;  ///< about modes of another code, or rotation
  fem::ModalTimings timings;                 ///< 0: taken from an earlier run
  std::optional<fem::RicherBasis> richer;    ///< with attachment shapes of one degree more
  Eigen::VectorXd rotated;  ///< displacement of the rotating body, 3 n_nodes [m]; empty: at rest
  /// Where static loads make the preload; solved for beside the task.
  std::optional<contact::ElasticFace> static_face;
};

/// A contact face.
struct TaskFace {
  mesh::Surface surface;
  mesh::FaceFrame frame;
  Eigen::Vector3d local_stiffness;  ///< along them [N/m³]; 0 where no degree is chosen by it
};

struct StructureTask {
  mesh::Mesh mesh;
  std::vector<std::string> clamped;  ///< names in it
  fem::Material material;
  std::optional<fem::GivenMatrices> matrices;  ///< in place of supports and material
  std::optional<fem::Rotation> rotation;       ///< speed > 0
  BasisSettings basis;
  std::vector<TaskFace> faces;
  Eigen::MatrixXd
      forces;  ///< whose static shapes are wanted, 3 n_nodes × m; scaled, see loads_as_shapes()
};

/// Columns of loads by their shape alone: the largest component is 1, the last digits are cut off.
/// The same whatever the amplitude was; columns that are zero go.
[[nodiscard]] Eigen::MatrixXd loads_as_shapes(const Eigen::MatrixXd& loads);

/// Two tasks with the same bytes have the same solution. Of names nothing is in them.
[[nodiscard]] std::string bytes_of(const StructureTask& task);
[[nodiscard]] StructureTask structure_task(std::string_view bytes);

/// Collective over the MPI ranks: see on_all_ranks.hpp, under this name.
/// @throws what fem::Structure does.
[[nodiscard]] StructureModes solve(const StructureTask& task);
inline constexpr std::string_view modes_work = "modes";

}  // namespace microslip::pipelines
