/// @file
/// Mesh files → Mesh. The one place that knows foreign tags and node orders.
#pragma once

#include <filesystem>
#include <string>

#include "mesh/mesh.hpp"

namespace microslip::mesh {

/// Reads gmsh 2.2 and 4.1 (ASCII or binary) with the elements of element_type.hpp; physical groups
/// of dimension 2 become surfaces, of dimension 0 and 1 (and 2) node sets.
/// Unused nodes are dropped.
/// @param length_unit  metres per unit of the file (1e-3 for mm).
/// @param name         what messages call the mesh; empty: the file.
/// @throws MeshError  missing, truncated or foreign file, unknown element; file and line or byte.
[[nodiscard]] Mesh read_gmsh(const std::filesystem::path& file, double length_unit = 1.0,
                             const std::string& name = {}, Joined joined = Joined::by_nodes);

}  // namespace microslip::mesh
