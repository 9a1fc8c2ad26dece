/// @file
/// Runs microslip-mesher as a child with time and memory limits and turns its end into a file or a
/// MeshError: gmsh can crash or hang on bad geometry, and the caller lives on.
#pragma once

#include <filesystem>
#include <functional>

#include "mesh/blade_geometry.hpp"

namespace microslip::mesh {

struct MesherLimits {
  double seconds = 300.0;      ///< wall time
  double memory_mb = 8192.0;   ///< address space
  std::function<bool()> stop;  ///< asked every few milliseconds: true ends the mesher; empty: never
};

/// Meshes the blade into `file` (gmsh 4.1), second order, curved.
/// @param element_size  target edge length [m], > 0.
/// @throws MeshError  the mesher failed, crashed, was stopped, ran out of time or memory; names which, with the
///         last lines it said.
void mesh_blade(const BladeGeometry& geometry, double element_size,
                const std::filesystem::path& file, const MesherLimits& limits = {});

}  // namespace microslip::mesh
