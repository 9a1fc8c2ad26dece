// Ten modes of mesh number 2 of bench_fem by CalculiX (one thread), to stand beside
// `bench_fem --benchmark_filter=ten_modes/2`. Goal: five times slower or more.

#include <cstdio>

#include <benchmark/benchmark.h>

#include "tests/benchmarks/blade_meshes.hpp"
#include "tests/support/calculix.hpp"

namespace {

using namespace microslip;

void ten_modes_by_calculix(benchmark::State& state) {
  const mesh::Mesh mesh = test::default_blade_mesh(1.75e-3);
  const fem::Material steel{.youngs_modulus = 2.0e11, .poissons_ratio = 0.3, .density = 7800.0};
  for (auto _ : state) {
    const Eigen::VectorXd frequency = test::calculix_frequencies(mesh, steel, {"root"}, 10);
    benchmark::DoNotOptimize(frequency.data());
  }
  state.counters["nodes"] = static_cast<double>(mesh.n_nodes());
}
BENCHMARK(ten_modes_by_calculix)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (!test::has_calculix()) {
    std::puts("ccx is not on PATH (apt: calculix-ccx)");
    return 1;
  }
  benchmark::RunSpecifiedBenchmarks();
}
