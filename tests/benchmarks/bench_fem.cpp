// Element matrices, assembly, and ten modes of the clamped default blade (curved tet10) at about 30
// 000, 115 000, 260 000 and 300 000 degrees of freedom, split into assembly, ordering,
// factorisation, search and inertia count. Goal: ten modes at 115 000 in ≤ 5 s on two cores, all of
// it.
//
// BENCH_FEM_SIZES=2 takes the first two meshes only. The same mesh as bench_calculix is number 2.

#include <cstdlib>
#include <vector>

#include <benchmark/benchmark.h>

#include "fem/assembly/fe_system.hpp"
#include "fem/blas_threads.hpp"
#include "fem/elements/element_matrices.hpp"
#include "fem/modal_analysis.hpp"
#include "fem/slepc_session.hpp"
#include "tests/benchmarks/blade_meshes.hpp"

namespace {

using namespace microslip;

const fem::Material steel{.youngs_modulus = 2.0e11, .poissons_ratio = 0.3, .density = 7800.0};
constexpr double element_sizes[] = {4.2e-3, 2.4e-3, 1.75e-3, 1.65e-3};
std::vector<mesh::Mesh> meshes;

const mesh::Mesh& mesh_of(const benchmark::State& state) {
  return meshes[static_cast<std::size_t>(state.range(0))];
}

void element_matrices(benchmark::State& state) {
  const mesh::Mesh& mesh = meshes.front();
  const mesh::ElementBlock& block = mesh.elements().front();
  fem::ElementMatrices result;
  Eigen::Index e = 0;
  for (auto _ : state) {
    const Eigen::MatrixX3d nodes = mesh.nodes()(block.connectivity.row(e).transpose(), Eigen::all);
    fem::element_matrices(block.type, nodes, steel, fem::Tet10Rule::accurate, result);
    benchmark::DoNotOptimize(result.stiffness.data());
    e = (e + 1) % block.connectivity.rows();
  }
  state.SetItemsProcessed(state.iterations());
}

void assembly(benchmark::State& state) {
  const mesh::Mesh& mesh = mesh_of(state);
  for (auto _ : state) {
    const fem::FeSystem system = fem::assemble(mesh, steel, {"root"});
    benchmark::DoNotOptimize(system.stiffness.get());
  }
  state.SetItemsProcessed(state.iterations() * mesh.n_elements());
}

void ten_modes(benchmark::State& state) {
  const mesh::Mesh& mesh = mesh_of(state);
  for (auto _ : state) {
    fem::Structure blade(mesh, steel, {"root"});
    const fem::ModalBasis basis = blade.solve_modes({.n_modes = 10});
    const fem::ModalTimings& t = blade.timings();
    state.counters["dofs"] = static_cast<double>(blade.n_dofs());
    state.counters["assembly_s"] = t.assembly;
    state.counters["ordering_s"] = t.ordering;
    state.counters["factor_s"] = t.factorisation;
    state.counters["search_s"] = t.eigensolve;
    state.counters["inertia_s"] = t.inertia;
    state.counters["residual"] = basis.residual.maxCoeff();
  }
}

void register_all() {
  const auto last = static_cast<int64_t>(meshes.size()) - 1;
  const auto add = [&](const char* name, auto function) {
    benchmark::RegisterBenchmark(name, function)
        ->DenseRange(0, last)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  };
  benchmark::RegisterBenchmark("element_matrices", element_matrices);
  add("assembly", assembly);
  add("ten_modes", ten_modes);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const char* wanted = std::getenv("BENCH_FEM_SIZES");
  const int n = wanted == nullptr ? 4 : std::atoi(wanted);
  for (int i = 0; i < n && i < 4; ++i) meshes.push_back(test::default_blade_mesh(element_sizes[i]));
  const fem::SlepcSession session;
  benchmark::AddCustomContext("BLAS", fem::blas_description());
  register_all();
  benchmark::RunSpecifiedBenchmarks();
}
