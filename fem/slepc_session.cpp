#include "fem/slepc_session.hpp"

#include <dlfcn.h>
#include <petscsys.h>
#include <slepceps.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "fem/petsc_check.hpp"

namespace microslip::fem {
namespace {

template <typename Function>
Function* find_symbol(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

/// A thread count from the environment, as OpenBLAS reads it; 0 or rubbish counts as not given.
bool user_chose_threads() {
  for (const char* name : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"}) {
    const char* value = std::getenv(name);
    if (value != nullptr && std::atoi(value) > 0) return true;
  }
  return false;
}

/// The factorisation lives on dense blocks: all cores of the machine, shared by the ranks on it.
void use_all_cores(int n_ranks) {
  const auto set_threads = find_symbol<void(int)>("openblas_set_num_threads");
  if (set_threads == nullptr || user_chose_threads()) return;
  const auto cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  set_threads(std::max(1, cores / n_ranks));
}

}  // namespace

SlepcSession::SlepcSession() {
  check(PetscOptionsSetValue(nullptr, "-no_signal_handler", "true"));
  check(SlepcInitializeNoArguments());
  check(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));  // codes only, nothing printed
  use_all_cores(n_ranks());
}

SlepcSession::~SlepcSession() { SlepcFinalize(); }

int SlepcSession::rank() const {
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  return rank;
}

int SlepcSession::n_ranks() const {
  int size = 1;
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  return size;
}

std::string blas_description() {
  const auto config = find_symbol<char*()>("openblas_get_config");
  const auto threads = find_symbol<int()>("openblas_get_num_threads");
  if (config != nullptr && threads != nullptr) {
    std::string text = config();
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text + ", " + std::to_string(threads()) + " threads";
  }
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    for (const char* library : {"libmkl_rt", "libblis", "libatlas"}) {
      if (line.find(library) != std::string::npos) return library;
    }
  }
  return "reference BLAS, 1 thread (3 to 8 times slower: install libopenblas0-pthread)";
}

std::string petsc_versions() {
  char petsc[256] = {};
  char slepc[256] = {};
  check(PetscGetVersion(petsc, sizeof petsc));
  check(SlepcGetVersion(slepc, sizeof slepc));
  return std::string(petsc) + "; " + slepc;
}

}  // namespace microslip::fem
