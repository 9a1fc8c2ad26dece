#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include "fem/module/fem_module.hpp"
#include "fem/petsc_error.hpp"

namespace microslip::fem {
namespace {

namespace fs = std::filesystem;

constexpr const char* file_name = "microslip-fem.so";

[[noreturn]] void refuse(const std::string& words) {
  // glibc has no other way to tell.
  if (words.find("annot allocate memory") != std::string::npos ||
      words.find("failed to map segment") != std::string::npos) {
    throw MemoryError("out of memory while PETSc and SLEPc are loaded: " + words);
  }
  throw std::runtime_error("finite elements cannot be solved: " + words);
}

/// Beside the program, or where both were built: a copy of the program alone finds it there.
fs::path module_file() {
  std::error_code error;
  const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& folder : {here, fs::path(MICROSLIP_BUILT_IN)}) {
    if (fs::exists(folder / file_name, error)) return folder / file_name;
  }
  throw std::runtime_error(std::string(file_name) + " is not beside microslip; build all targets");
}

/// It stays open to the end, and its libraries with it.
const FemModule& opened() {
  const fs::path file = module_file();
  void* library = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr) refuse(dlerror());
  void* shown = dlsym(library, fem_module_symbol);
  if (shown == nullptr) refuse(dlerror());
  const FemModule& module = *reinterpret_cast<const FemModule* (*)()>(shown)();
  if (std::string_view(module.headers) != MICROSLIP_FEM_HEADERS) {
    refuse(file.string() + " is of another build than this program");
  }
  return module;
}

}  // namespace

const FemModule& fem_module() {
  static const FemModule& module = opened();
  return module;
}

}  // namespace microslip::fem
