/// @file
/// A mesh with each element cut once along each edge: half the size, eight times as many.
///
/// The nodes that join lie where the shape functions of the elements have them: the body is the
/// given one, curved as its elements are, and not nearer to the geometry these were made from.
/// With tetrahedra, hexahedra and wedges the given mesh has no motion that the refined one lacks,
/// so that natural frequencies do not rise.
#pragma once

#include "mesh/mesh.hpp"

namespace microslip::mesh {

/// Surfaces are the same places. A set of nodes gains those on outer edges and faces all of whose
/// nodes it has: a point stays one node, a line a line, and a face a face.
/// @throws MeshError  a finding of the checks of Mesh.
[[nodiscard]] Mesh refined(const Mesh& mesh);

}  // namespace microslip::mesh
