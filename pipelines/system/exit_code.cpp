#include "pipelines/system/exit_code.hpp"

#include <filesystem>
#include <new>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "fem/petsc_error.hpp"
#include "mesh/mesh_error.hpp"

namespace microslip::pipelines {
namespace {

template <typename Type>
bool is(const std::exception& error) {
  return dynamic_cast<const Type*>(&error) != nullptr;
}

/// The system has no memory left for a thread, a process or a mapping.
bool is_short_of_memory(const std::exception& error) {
  const auto* failure = dynamic_cast<const std::system_error*>(&error);
  return failure != nullptr && (failure->code() == std::errc::resource_unavailable_try_again ||
                                failure->code() == std::errc::not_enough_memory);
}

/// A name that no file can have: longer than the system allows, or a loop of links.
bool is_bad_name(const std::exception& error) {
  const auto* failure = dynamic_cast<const std::filesystem::filesystem_error*>(&error);
  return failure != nullptr && (failure->code() == std::errc::filename_too_long ||
                                failure->code() == std::errc::too_many_symbolic_link_levels);
}

}  // namespace

ExitCode exit_code_of(const std::exception& error) {
  if (is<InterruptedError>(error)) return ExitCode::incomplete;
  if (is<mesh::MeshRoomError>(error)) return ExitCode::exhausted;
  if (is_bad_name(error) || is<SceneError>(error) || is<mesh::MeshError>(error) ||
      is<std::invalid_argument>(error)) {
    return ExitCode::bad_input;
  }
  if (is<RefusedError>(error) || is<fem::EigenError>(error)) return ExitCode::refused;
  if (is<ExhaustedError>(error) || is<std::bad_alloc>(error) || is<fem::MemoryError>(error) ||
      is<std::filesystem::filesystem_error>(error) || is_short_of_memory(error)) {
    return ExitCode::exhausted;
  }
  return ExitCode::internal;
}

namespace {

/// A terminal would obey what a scene or a mesh has written into a name.
std::string printable(std::string_view text) {
  std::string shown;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_control = (byte < 0x20U && c != '\n' && c != '\t') || byte == 0x7FU;
    shown += is_control ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
  }
  return shown;
}

}  // namespace

std::string message_of(const std::exception& error) {
  const auto* failure = dynamic_cast<const std::filesystem::filesystem_error*>(&error);
  if (failure != nullptr) {
    return fmt::format("{}: {}; choose another folder with -o",
                       printable(failure->path1().string()), failure->code().message());
  }
  if (is<std::bad_alloc>(error)) return "out of memory";
  if (exit_code_of(error) == ExitCode::internal)
    return fmt::format("internal error: {}", printable(error.what()));
  return printable(error.what());
}

}  // namespace microslip::pipelines
