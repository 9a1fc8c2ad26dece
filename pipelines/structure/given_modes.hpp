/// @file
/// Modes of another code → a modal basis on the mesh of the scene. share/scripts/convert_modes.py
/// reads the file; here its nodes are found in the mesh by their places, whatever their order, and
/// its shapes are checked against the mass that mesh and density give.
#pragma once

#include <filesystem>

#include <Eigen/Core>

#include "mesh/mesh.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/structure/structure_stage.hpp"

namespace microslip::pipelines {

/// A file as it is, in its own units.
struct ModesOfFile {
  Eigen::MatrixX3d nodes;        ///< n_nodes × 3
  Eigen::VectorXd frequency_hz;  ///< ascending, ≥ 0; then those of the attachment shapes
  Eigen::MatrixXd shapes;        ///< (3 · n_nodes) × n_modes, x y z per node
  Eigen::Index n_attachment = 0;
};

/// @param deck  of the modes: has the places of nodes that a punched file (.pch) tells by their
///              numbers.
/// @throws SceneError  a damaged file, one without modes: what is there, where.
[[nodiscard]] ModesOfFile read_modes_of(const std::filesystem::path& file,
                                        const std::filesystem::path& deck);

/// The basis of a scene of kind "modes", and what is to be said about it.
/// @throws SceneError  a node of the mesh without modes, fewer modes than asked for, no attachment
///         shapes where they are asked for, shapes that are not mass-normalised.
[[nodiscard]] StructureModes given_structure(const mesh::Mesh& mesh, const SceneDescription& scene);

}  // namespace microslip::pipelines
