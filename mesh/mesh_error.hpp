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

}  // namespace microslip::mesh
