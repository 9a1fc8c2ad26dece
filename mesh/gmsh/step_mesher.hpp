/// @file
/// STEP file → faces, or mesh, with gmsh's OpenCASCADE kernel.
/// Part of the program microslip-mesher.
#pragma once

#include <iosfwd>
#include <string>

namespace microslip::mesh {

/// Writes what StepGeometry holds as text: "volume V", then of every face "face NUMBER KIND AREA X
/// Y Z" and its triangles, nine coordinates a line between "triangles N".
/// @param job  "source FILE" in quotes, "scale S": metres times S.
/// @throws MeshError  no solid or several in it; a face that cannot be meshed.
void list_step_faces(std::istream& job, const std::string& file);

/// Meshes it as mesh_blade_with_gmsh() does.
/// @param job  as above; "element_size H", "name NAME N NUMBER …" of N faces, "size NUMBER H",
///             "edge_size NUMBER H" [m].
/// @throws MeshError  as above.
void mesh_step_with_gmsh(std::istream& job, const std::string& file);

}  // namespace microslip::mesh
