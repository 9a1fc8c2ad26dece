/// @file
/// Does the mesh fill its body once? Found by looking out of the body: just outside a face that has
/// one element only there must be no element.
///
/// Where every inner face has one element on each side (face_map.hpp) and no Jacobian is negative
/// (mesh_quality.hpp), the number of elements over a point of space changes only across outer
/// faces, from 0 outside. Elements that overlap, and faces that touch without being joined (a
/// quadrilateral against two triangles, nodes in the middle of a neighbour's face), therefore put
/// an element in front of some outer face.
#pragma once

#include <vector>

#include "mesh/element_block.hpp"
#include "mesh/elements/face_map.hpp"

namespace microslip::mesh {

/// Looks 1e-4 of a face's size out of it, at its middle and near its corners: gaps narrower than
/// that count as contact, overlaps of less than about a fifth of a face or 1e-4 of its size may
/// pass.
/// @throws MeshError  an outer face inside another element, or on one: which elements, and where.
void check_outer_faces(const Eigen::MatrixX3d& nodes, const std::vector<ElementBlock>& elements,
                       const FaceMap& faces);

}  // namespace microslip::mesh
