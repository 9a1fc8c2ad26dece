#include "pipelines/system/machine.hpp"

#include <H5public.h>
#include <dlfcn.h>
#include <fmt/core.h>
#include <sys/resource.h>
#include <unistd.h>
#include <vtkVersionMacros.h>

#include <algorithm>
#include <fstream>
#include <string_view>

#include <spdlog/version.h>
#include <toml++/toml.h>
#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "fem/ranks.hpp"
#include "fem/slepc_session.hpp"

namespace microslip::pipelines {
namespace {

std::string processor_name() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

/// A function of the BLAS that is loaded, whichever the system's alternatives chose; none if the
/// BLAS is not OpenBLAS.
template <typename Function>
Function* loaded_function(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

/// Largest resident size of the children waited for so far [KiB].
long largest_child() {
  rusage children{};
  getrusage(RUSAGE_CHILDREN, &children);
  return children.ru_maxrss;
}

/// VmHWM of this process [KiB].
long high_water_mark() {
  std::ifstream status("/proc/self/status");
  constexpr std::string_view key = "VmHWM:";
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(key)) return std::stol(line.substr(key.size()));
  }
  rusage self{};
  getrusage(RUSAGE_SELF, &self);
  return self.ru_maxrss;
}

std::string version(int major, int minor, int patch) {
  return fmt::format("{}.{}.{}", major, minor, patch);
}

}  // namespace

Machine describe_machine() {
  Machine machine;
  machine.processor = processor_name();
  machine.cores = static_cast<unsigned>(fem::usable_cores());
  constexpr double megabyte = 1e6;
  machine.memory_mb = static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                      static_cast<double>(sysconf(_SC_PAGESIZE)) / megabyte;
  const auto configuration = loaded_function<char*()>("openblas_get_config");
  const auto threads = loaded_function<int()>("openblas_get_num_threads");
  machine.blas = configuration != nullptr ? configuration() : "unknown (not OpenBLAS)";
  machine.blas_threads = threads != nullptr ? threads() : 1;
  return machine;
}

std::vector<std::pair<std::string, std::string>> library_versions() {
  std::vector<std::pair<std::string, std::string>> versions{
      {"Eigen", version(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"HDF5", version(H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE)},
      {"VTK", version(VTK_MAJOR_VERSION, VTK_MINOR_VERSION, VTK_BUILD_VERSION)},
      {"fmt", version(FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"nlohmann-json", version(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                                NLOHMANN_JSON_VERSION_PATCH)},
      {"spdlog", version(SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH)},
      {"toml++", version(TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH)},
  };
  for (auto& library : fem::library_versions()) versions.push_back(std::move(library));
  return versions;
}

MemoryGauge::MemoryGauge() : children_before_(largest_child()) {
  std::ofstream("/proc/self/clear_refs") << "5";  // resets VmHWM; see proc(5)
}

double MemoryGauge::peak_mb() const {
  const long children = largest_child();
  const long largest = std::max(high_water_mark(), children > children_before_ ? children : 0);
  constexpr double megabytes_per_kibibyte = 1.024e-3;
  return static_cast<double>(largest) * megabytes_per_kibibyte;
}

}  // namespace microslip::pipelines
