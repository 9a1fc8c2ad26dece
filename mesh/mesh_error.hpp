/// @file
/// A geometry, mesh file or mesh that cannot be used: what, where (file, entity), what to try.
#pragma once

#include <stdexcept>
#include <string>

namespace microslip::mesh {

class MeshError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// No fault of the geometry or the file: disk or memory gave out.
class MeshRoomError : public MeshError {
 public:
  using MeshError::MeshError;
};

}  // namespace microslip::mesh
