#include "fem/blas_threads.hpp"

#include <filesystem>
#include <fstream>
#include <string>

#include <dlfcn.h>

extern "C" void dtrsm_(const char* side, const char* triangle, const char* transposed,
                       const char* diagonal, const int* m, const int* n, const double* factor,
                       const double* a, const int* lda, double* b, const int* ldb);

namespace microslip::fem {
namespace {

template <typename Function>
Function* symbol(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

// File of the library that answers for dgemm, links resolved: the alternatives system hides the
// name.
std::string library_of_dgemm() {
  void* address = dlsym(RTLD_DEFAULT, "dgemm_");
  Dl_info info{};
  if (address == nullptr || dladdr(address, &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code error;
  const std::filesystem::path file = std::filesystem::canonical(info.dli_fname, error);
  return error ? std::string(info.dli_fname) : file.string();
}

std::string second_word(const std::string& text) {
  const std::size_t start = text.find(' ');
  if (start == std::string::npos) return {};
  return text.substr(start + 1, text.find(' ', start + 1) - start - 1);
}

}  // namespace

void set_blas_threads(int n_ranks_here) {
  constexpr int threads_of_one = 2;  // all that was timed (share/doc/costs.md)
  auto* set_threads = symbol<void(int)>("openblas_set_num_threads");
  if (set_threads == nullptr) return;
  set_threads(n_ranks_here > 1 || has_little_address_space() ? 1 : threads_of_one);
}

void reserve_blas_memory() {
  const int one = 1;
  const double unit = 1.0;
  double solution = 1.0;
  // A product of small matrices may do without.
  dtrsm_("L", "L", "N", "N", &one, &one, &unit, &unit, &one, &solution, &one);
}

void use_one_blas_thread() {
  if (auto* set_threads = symbol<void(int)>("openblas_set_num_threads")) set_threads(1);
}

OneBlasThread::OneBlasThread() {
  if (auto* threads = symbol<int()>("openblas_get_num_threads")) n_threads_ = threads();
  use_one_blas_thread();
}

OneBlasThread::~OneBlasThread() {
  auto* set_threads = symbol<void(int)>("openblas_set_num_threads");
  if (set_threads != nullptr && n_threads_ > 0) set_threads(n_threads_);
}

std::string blas_description() {
  if (auto* config = symbol<char*()>("openblas_get_config")) {
    auto* threads = symbol<int()>("openblas_get_num_threads");
    const int n = threads == nullptr ? 1 : threads();
    return "OpenBLAS " + second_word(config()) + ", " + std::to_string(n) +
           (n == 1 ? " thread" : " threads");
  }
  const std::string file = library_of_dgemm();
  if (file.find("mkl") != std::string::npos) return "MKL";
  if (file.find("blis") != std::string::npos) return "BLIS";
  if (file.find("atlas") != std::string::npos) return "ATLAS";
  return "reference BLAS (slow: install libopenblas0-pthread)";
}

}  // namespace microslip::fem
