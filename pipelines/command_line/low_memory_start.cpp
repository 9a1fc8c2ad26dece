/// @file
/// OpenBLAS starts its threads while it is loaded, before main, and each wants address space of its
/// own: where that is limited (`ulimit -v`) they fail, or the process hangs when it ends. So the
/// program starts itself once more there, with one thread, before any library is initialised.

#include <alloca.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <string_view>

#include "fem/blas_threads.hpp"

namespace microslip {
namespace {

constexpr std::string_view variable = "OPENBLAS_NUM_THREADS=";
constinit std::array one_thread = std::to_array("OPENBLAS_NUM_THREADS=1");

/// Returns where there is nothing to do, or it cannot be done.
void start_with_one_thread(int /*argc*/, char** arguments, char** environment) {
  if (!fem::has_little_address_space()) return;
  std::size_t n = 0;
  while (environment[n] != nullptr) ++n;
  // Neither malloc nor setenv: no library has been initialised yet.
  auto** changed = static_cast<char**>(alloca((n + 2) * sizeof(char*)));
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::string_view entry(environment[i]);
    if (entry == one_thread.data()) return;
    if (!entry.starts_with(variable)) changed[kept++] = environment[i];
  }
  changed[kept++] = one_thread.data();
  changed[kept] = nullptr;
  execve("/proc/self/exe", arguments, changed);
}

/// Called by the dynamic loader ahead of the initialisers of all libraries.
[[gnu::section(".preinit_array"),
  gnu::used]] void (*const before_libraries)(int, char**, char**) = start_with_one_thread;

}  // namespace
}  // namespace microslip
