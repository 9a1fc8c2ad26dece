#include "fem/petsc/petsc_check.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include <petscsys.h>

#include "fem/petsc_error.hpp"

namespace microslip::fem {
namespace {

// Words of the error being unwound. PETSc is called from one thread only.
std::string& last_message() {
  static std::string message;
  return message;
}

// PETSc 3.18 gives the line of its caller as the code where malloc fails.
bool is_allocation(const char* function) {
  return function != nullptr && std::string_view(function) == "PetscMallocAlign";
}

PetscErrorCode keep_message(MPI_Comm /*comm*/, int line, const char* function, const char* /*file*/,
                            PetscErrorCode code, PetscErrorType type, const char* message,
                            void* /*context*/) {
  if (type == PETSC_ERROR_INITIAL) {
    last_message() = std::string(message == nullptr ? "" : message) + " [" +
                     (function == nullptr ? "?" : function) + ':' + std::to_string(line) + ']';
  }
  return is_allocation(function) ? PETSC_ERR_MEM : code;
}

std::string words_of(int code) {
  std::string words = std::exchange(last_message(), {});
  if (!words.empty()) return words;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  return text == nullptr ? "unknown error" : text;
}

}  // namespace

void check(int code, std::source_location where) {
  if (code == 0) return;
  const std::string place = std::filesystem::path(where.file_name()).filename().string() + ':' +
                            std::to_string(where.line());
  const std::string text =
      "PETSc error " + std::to_string(code) + " at " + place + ": " + words_of(code);
  if (code == PETSC_ERR_MEM) throw MemoryError("out of memory: " + text);
  throw PetscError(text);
}

void install_error_handler() { check(PetscPushErrorHandler(keep_message, nullptr)); }

}  // namespace microslip::fem
