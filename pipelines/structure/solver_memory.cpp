#include "pipelines/structure/solver_memory.hpp"

#include <string_view>

#include <fmt/format.h>

#include "fem/memory_forecast.hpp"
#include "fem/petsc_error.hpp"
#include "fem/ranks.hpp"

namespace microslip::pipelines {
namespace {

constexpr double at_least = 0.7;  // of the forecast

std::string gigabytes(double megabytes) { return fmt::format("{:.1f} GB", 1e-3 * megabytes); }

bool fits(const SolverMemory& memory) {
  return at_least * memory.needed_mb() <= memory.available.megabytes;
}

// Of each element cut along each edge: eight times the unknowns take at least so many times as much
// memory, and a factor about n^1.25 (memory_before_mesh.hpp).
constexpr double at_least_when_cut = 8.0;
constexpr double usual_when_cut = 13.5;

SolverMemory when_cut(SolverMemory memory, double times) {
  memory.direct_mb *= times;
  memory.iterative_mb *= times;
  return memory;
}

}  // namespace

fem::AvailableMemory available_memory() {
  fem::AvailableMemory memory = fem::available_memory_here();
  memory.megabytes *= static_cast<double>(fem::n_ranks()) / fem::n_ranks_here();
  return memory;
}

SolverMemory solver_memory(const mesh::Mesh& mesh, fem::SolverKind solver) {
  return {solver, fem::direct_memory(mesh).total(), fem::iterative_memory(mesh).total(),
          available_memory()};
}

std::string memory_warning(const SolverMemory& memory) {
  const double available = memory.available.megabytes;
  if (memory.needed_mb() <= available) return {};
  const bool direct = memory.solver == fem::SolverKind::direct;
  std::string text = fmt::format("modes.solver = \"{}\" needs about {}, {} are available ({})",
                                 direct ? "direct" : "iterative", gigabytes(memory.needed_mb()),
                                 gigabytes(available), memory.available.limited_by);
  if (direct && memory.iterative_mb < available) {
    text += fmt::format("; use the iterative solver: modes.solver = \"iterative\" needs about {}",
                        gigabytes(memory.iterative_mb));
  }
  return text + "; or take a coarser mesh or a machine with more memory";
}

void require_memory(const mesh::Mesh& mesh, fem::SolverKind solver) {
  const SolverMemory memory = solver_memory(mesh, solver);
  if (!fits(memory)) throw fem::MemoryError("out of memory: " + memory_warning(memory));
}

void require_memory_when_cut(const mesh::Mesh& mesh, fem::SolverKind solver) {
  const SolverMemory memory = when_cut(solver_memory(mesh, solver), at_least_when_cut);
  if (fits(memory)) return;
  throw fem::MemoryError("out of memory: of elements cut in eight " + memory_warning(memory));
}

int cuts_in_memory(const mesh::Mesh& mesh, fem::SolverKind solver, int most) {
  SolverMemory memory = solver_memory(mesh, solver);
  for (int cuts = 0; cuts < most; ++cuts) {
    memory = when_cut(memory, usual_when_cut);
    if (!fits(memory)) return cuts;
  }
  return most;
}

std::string with_iterative_way(std::string text) {
  constexpr std::string_view key = "modes.solver = \"iterative\"";
  if (text.find(key) != std::string::npos) return text;
  if (text.ends_with('.')) text.pop_back();
  const bool is_named = text.find("iterative solver") != std::string::npos;
  return text.append(is_named ? "; the iterative solver is " : "; use the iterative solver: ")
      .append(key);
}

}  // namespace microslip::pipelines
