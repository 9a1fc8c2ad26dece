/// @file
/// Geometry → mesh: runs microslip-mesher as a child with time and memory limits and turns its end
/// into a file or a MeshError: gmsh can crash or hang on bad geometry, and the caller lives on.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "mesh/blade_geometry.hpp"
#include "mesh/step_geometry.hpp"

namespace microslip::mesh {

struct MesherLimits {
  double seconds = 300.0;      ///< wall time
  double memory_mb = 8192.0;   ///< address space
  std::function<bool()> stop;  ///< asked every few milliseconds: true ends the mesher; empty: never
};

/// The program that does it: beside the running one, or one level up in bin/ (tests);
/// MICROSLIP_MESHER overrides.
/// @throws MeshError  it is not there.
[[nodiscard]] std::filesystem::path mesher_program();

/// Meshes the blade into `file` (gmsh 4.1), second order, curved;
/// a name that ends in .step takes its geometry.
/// @throws MeshError  the mesher failed, crashed, was stopped, ran out of time or memory; names
///         which, with the last lines it said.
void mesh_blade(const BladeGeometry& geometry, const ElementSizes& sizes,
                const std::filesystem::path& file, const MesherLimits& limits = {});

/// The solid of a STEP file.
struct StepSource {
  std::filesystem::path file;
  double scale = 1.0;  ///< its lengths, by the unit the file says, are so many times as long
};

/// Reads the solid of a STEP file. @param list  a file that is written on the way.
/// @throws MeshError  as above; no solid in the file, or several.
[[nodiscard]] StepGeometry read_step(const StepSource& source, const std::filesystem::path& list,
                                     const MesherLimits& limits = {});

/// How a STEP file is meshed; faces are called by their numbers.
struct StepMeshing {
  double element_size = 0.004;                      ///< longest edges [m], > 0
  std::map<std::string, std::vector<int>> names{};  ///< of surfaces
  std::map<int, double> face_size{};  ///< where elements are smaller: near these faces [m]
  std::map<int, double> edge_size{};  ///< … and near the edges of these [m]
};

/// Meshes the solid of a STEP file into `file`, as mesh_blade() does. @throws MeshError  as above.
void mesh_step(const StepSource& source, const StepMeshing& meshing,
               const std::filesystem::path& file, const MesherLimits& limits = {});

}  // namespace microslip::mesh
