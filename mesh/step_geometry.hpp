/// @file
/// A STEP file (ISO 10303-21) as far as naming its faces needs it: one solid, its faces with
/// numbers, and triangles on them. Lengths in metres.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "mesh/surface.hpp"

namespace microslip::mesh {

/// A unit of length that the file says its coordinates are in.
struct StepUnit {
  std::string name;     ///< "millimetre", "inch", …
  double metres = 1.0;  ///< per unit
  [[nodiscard]] bool operator==(const StepUnit&) const = default;
};

/// @return  the units of length in the file, each once; empty: it says none.
/// @throws MeshError  the file cannot be read, is no STEP file, ends before its end mark, or has
///                    statements that refer to none or are not as the standard has them.
[[nodiscard]] std::vector<StepUnit> step_length_units(const std::filesystem::path& file);

struct StepFace {
  int number = 0;     ///< from 1, the same every time the file is read
  std::string kind;   ///< of surface: "plane", "cylinder", "cone", "sphere", "torus", "spline", …
  double area = 0.0;  ///< [m²]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< centroid of the area [m]
  Eigen::Vector3d normal =
      Eigen::Vector3d::Zero();  ///< outward, mean; 0: the face goes round and has none
};

struct StepGeometry {
  double volume = 0.0;          ///< [m³]
  std::vector<StepFace> faces;  ///< in order of their numbers
  Eigen::MatrixX3d nodes;       ///< of the triangles [m]
  Connectivity triangles;       ///< n × 3, outward, from the first face to the last
  std::vector<int> owner;       ///< number of the face of each triangle
};

}  // namespace microslip::mesh
