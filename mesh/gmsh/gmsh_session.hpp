/// @file
/// What every job of microslip-mesher does with gmsh: open and close it, name entities,
/// mesh a volume.
#pragma once

#include <string>
#include <vector>

namespace microslip::mesh {

/// gmsh, silent and with one thread: the same mesh every time.
class GmshSession {
 public:
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
  GmshSession(GmshSession&&) = delete;
  GmshSession& operator=(GmshSession&&) = delete;
};

/// Names entities of a dimension. @throws MeshError  there are none.
void add_group(int dimension, const std::vector<int>& tags, const std::string& name);

/// Meshes the model into `file`: gmsh 4.1, binary, second order, curved on the surface, elements
/// that curving turned inside out mended.
/// @param element_size  longest edges [m].  @param least_size  the smallest size asked for anywhere
///                      [m].
void write_volume_mesh(double element_size, double least_size, const std::string& file);

}  // namespace microslip::mesh
