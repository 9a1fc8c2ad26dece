#include "pipelines/command_line/processor_kernels.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace microslip::pipelines {
namespace {

constexpr const char* variable = "OPENBLAS_CORETYPE";
constexpr std::string_view unfit = "Prescott";

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

/// A function of the BLAS that is loaded, whichever the system's alternatives chose.
template <typename Function>
Function* loaded(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

/// Empty if the BLAS is not OpenBLAS.
std::string_view kernels_in_use() {
  auto* name = loaded<char*()>("openblas_get_corename");
  const char* found = name != nullptr ? name() : nullptr;
  return found != nullptr ? found : "";
}

/// What OpenBLAS does first of all while it is loaded; nothing it has set up since depends on it.
/// @return false: this OpenBLAS cannot, or has chosen as before.
bool choose_again() {
  auto* forget = loaded<void()>("gotoblas_dynamic_quit");
  auto* choose = loaded<void()>("gotoblas_dynamic_init");
  if (forget == nullptr || choose == nullptr) return false;
  forget();
  choose();
  return kernels_in_use() != unfit;
}

}  // namespace

void use_kernels_of_processor(char** arguments) {
  if (std::getenv(variable) != nullptr || kernels_in_use() != unfit) return;
  const char* kernels = kernels_of_processor();
  if (kernels == nullptr || setenv(variable, kernels, 1) != 0) return;
  if (choose_again()) return;
  execv("/proc/self/exe", arguments);
  unsetenv(variable);  // what is used is what is told
}

}  // namespace microslip::pipelines
