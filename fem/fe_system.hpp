/// @file
/// K and M of a mesh in PETSc: symmetric, upper triangle stored, blocks of three.
#pragma once

#include <petscmat.h>
#include <petscvec.h>

#include "fem/dof_map.hpp"
#include "fem/element_matrices.hpp"
#include "fem/handle.hpp"
#include "fem/material.hpp"
#include "mesh/mesh.hpp"

namespace microslip::fem {

using MatHandle = Handle<Mat, &MatDestroy>;
using VecHandle = Handle<Vec, &VecDestroy>;

/// Added to K: k_axis e_axisᵀ(N_c u) springs to ground at points of a surface.
struct SurfaceSprings {
  Eigen::SparseMatrix<double> interpolation;  ///< points × nodes of the mesh
  Eigen::MatrixX3d stiffness;                 ///< of each point along the frame's rows [N/m]
  Eigen::Matrix3d frame;                      ///< rows: directions
};

struct FeSystem {
  MatHandle stiffness;  ///< K [N/m], 3 n_free square, MATSBAIJ
  MatHandle mass;       ///< M [kg]
};

/// Collective over PETSC_COMM_WORLD: every rank holds the mesh and assembles a share of its elements.
/// @param springs  nullptr: none.
/// @throws std::invalid_argument  material out of range.
[[nodiscard]] FeSystem assemble(const mesh::Mesh& mesh, const DofMap& dofs, const Material& material,
                                StiffnessRule rule = StiffnessRule::accurate,
                                const SurfaceSprings* springs = nullptr);

/// A vector of the right size and distribution. @param like  K or M.
[[nodiscard]] VecHandle make_vector(Mat like);
/// All entries on every rank.
[[nodiscard]] Eigen::VectorXd gather(Vec vector);
/// Each rank sets its own part of a full vector.
void scatter(const Eigen::VectorXd& full, Vec vector);

}  // namespace microslip::fem
