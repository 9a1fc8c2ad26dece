#include "pipelines/command_line/processor_kernels.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace microslip::pipelines {
namespace {

constexpr const char* variable = "OPENBLAS_CORETYPE";

/// As OpenBLAS names them; none for a processor that has no better ones.
const char* kernels_of_processor() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  const bool has_avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                          __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  if (has_avx512) return "SkylakeX";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "Haswell";
#endif
  return nullptr;
}

/// Whichever BLAS the system's alternatives chose: empty if it is not OpenBLAS.
std::string_view kernels_in_use() {
  using Name = char*();
  auto* name = reinterpret_cast<Name*>(dlsym(RTLD_DEFAULT, "openblas_get_corename"));
  const char* found = name != nullptr ? name() : nullptr;
  return found != nullptr ? found : "";
}

}  // namespace

void start_with_kernels_of_processor(char** arguments) {
  if (std::getenv(variable) != nullptr || kernels_in_use() != "Prescott") return;
  const char* kernels = kernels_of_processor();
  if (kernels == nullptr || setenv(variable, kernels, 1) != 0) return;
  execv("/proc/self/exe", arguments);
  unsetenv(variable);  // what is used is what is told
}

}  // namespace microslip::pipelines
