#include "pipelines/system/exit_code.hpp"

#include <filesystem>
#include <new>
#include <stdexcept>

#include "fem/petsc_error.hpp"
#include "mesh/mesh_error.hpp"

namespace microslip::pipelines {
namespace {

template <typename Type>
bool is(const std::exception& error) {
  return dynamic_cast<const Type*>(&error) != nullptr;
}

}  // namespace

ExitCode exit_code_of(const std::exception& error) {
  if (is<InterruptedError>(error)) return ExitCode::incomplete;
  if (is<SceneError>(error) || is<mesh::MeshError>(error) || is<std::invalid_argument>(error)) {
    return ExitCode::bad_input;
  }
  if (is<RefusedError>(error) || is<fem::EigenError>(error)) return ExitCode::refused;
  if (is<ExhaustedError>(error) || is<std::bad_alloc>(error) || is<fem::MemoryError>(error) ||
      is<std::filesystem::filesystem_error>(error)) {
    return ExitCode::exhausted;
  }
  return ExitCode::internal;
}

}  // namespace microslip::pipelines
