/// @file
/// How the modes move the places of a contact face: displacements of its elements, or of a field
/// fitted to them, along the axes of the face or of every place (theory section 1).
#pragma once

#include <Eigen/Core>

#include "contact/patch.hpp"
#include "mesh/face_frame.hpp"
#include "mesh/mesh.hpp"
#include "pipelines/description/discretisation.hpp"

namespace microslip::pipelines {

/// A face of a mesh, cut into the cells of its patch. Borrowed.
struct SampledFace {
  const mesh::Mesh& mesh;
  const mesh::Surface& surface;
  const mesh::SurfaceSampling& sampling;
  const mesh::FaceFrame& frame;
};

/// A field fitted to the shapes errs by more than 5 % of one of them.
[[nodiscard]] bool is_fit_poor(const contact::Patch& patch);

/// Shapes at the cells and vertices of a patch, and with them its own axes of places,
/// or degree and error of the fit. A poor fit that nobody asked for is not taken, the degree is −1
/// then: elements are interpolated.
/// @param settings  of the fit, which a face with axes at every place does not have.
/// @param shapes    3 n_nodes × n_modes [1/√kg].
void set_shapes(contact::Patch& patch, const SampledFace& face, const PatchSettings& settings,
                const Eigen::MatrixXd& shapes);

}  // namespace microslip::pipelines
