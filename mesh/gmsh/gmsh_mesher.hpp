/// @file
/// Geometry → mesh with gmsh's OpenCASCADE kernel. Part of the program microslip-mesher, the only
/// thing that links gmsh.
#pragma once

#include <string>

#include "mesh/blade_geometry.hpp"

namespace microslip::mesh {

/// Meshes the blade into `file`: format 4.1, binary, second order, curved on the surface. A name
/// that ends in .step takes the geometry itself, in millimetres.
/// @throws MeshError or std::runtime_error  gmsh failed; its message.
void mesh_blade_with_gmsh(const BladeGeometry& geometry, const ElementSizes& sizes,
                          const std::string& file);

}  // namespace microslip::mesh
