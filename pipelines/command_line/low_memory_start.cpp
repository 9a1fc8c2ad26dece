/// @file
/// OpenBLAS starts its threads while it is loaded, before main, and each wants address space of its
/// own: where that is limited (`ulimit -v`) they fail, or the process hangs when it ends. malloc
/// wants 64 MB of it for each thread: where they are refused it asks for them again at every
/// allocation. So the program starts itself once more there, with one thread of OpenBLAS and one
/// heap, before any library is initialised; what it starts inherits both.

#include <alloca.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "fem/blas_threads.hpp"

namespace microslip {
namespace {

struct Setting {
  std::string_view variable;
  char* entry;
};

constinit std::array one_thread = std::to_array("OPENBLAS_NUM_THREADS=1");
constinit std::array one_heap = std::to_array("MALLOC_ARENA_MAX=1");
constexpr std::array settings{Setting{"OPENBLAS_NUM_THREADS=", one_thread.data()},
                              Setting{"MALLOC_ARENA_MAX=", one_heap.data()}};

bool is_replaced(std::string_view entry) {
  return std::ranges::any_of(
      settings, [&](const Setting& setting) { return entry.starts_with(setting.variable); });
}

bool is_set(char** environment, std::size_t n) {
  return std::ranges::all_of(settings, [&](const Setting& setting) {
    return std::any_of(environment, environment + n,
                       [&](std::string_view entry) { return entry == setting.entry; });
  });
}

/// Returns where there is nothing to do, or it cannot be done.
void start_with_one_thread(int /*argc*/, char** arguments, char** environment) {
  if (!fem::has_little_address_space()) return;
  std::size_t n = 0;
  while (environment[n] != nullptr) ++n;
  if (is_set(environment, n)) return;
  // Neither malloc nor setenv: no library has been initialised yet.
  auto** changed = static_cast<char**>(alloca((n + settings.size() + 1) * sizeof(char*)));
  char** end = std::copy_if(environment, environment + n, changed,
                            [](const char* entry) { return !is_replaced(entry); });
  for (const Setting& setting : settings) *end++ = setting.entry;
  *end = nullptr;
  execve("/proc/self/exe", arguments, changed);
}

/// Called by the dynamic loader ahead of the initialisers of all libraries.
[[gnu::section(".preinit_array"),
  gnu::used]] void (*const before_libraries)(int, char**, char**) = start_with_one_thread;

}  // namespace
}  // namespace microslip
