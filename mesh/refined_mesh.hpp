/// @file
/// The same body in other elements: each cut once along each edge, half the size and eight times as
/// many; or each with nodes in the middle of its edges, which makes linear ones quadratic.
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

/// Of linear elements quadratic ones, with the faces they have; a quadratic mesh stays as it is.
/// Sets of nodes as in refined(). @throws MeshError  the same.
[[nodiscard]] Mesh quadratic(const Mesh& mesh);

/// All elements are quadratic.
[[nodiscard]] bool has_midside_nodes(const Mesh& mesh);

}  // namespace microslip::mesh
