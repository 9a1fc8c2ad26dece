/// @file
/// Cost of a contact point that moves in two tangential directions: traction and Jacobian of one point at
/// the tolerance of scenes, over random states of each stratum. The spread matters as much as the mean, so
/// that every state is timed by itself: counters give median, 99 % and worst in µs.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <random>
#include <string>
#include <vector>

#include "contact/planar_cycle.hpp"
#include "support/planar_cases.hpp"

namespace {

using namespace microslip;

constexpr double tolerance = 1e-11;
constexpr int n_states = 2000;

/// Of this thread: a busy machine does not show.
double seconds_spent() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double microseconds(const test::PlanarCase& c) {
  const contact::PlanarLaw law(contact::SurfaceLaw(c.point, c.second_stiffness), tolerance);
  contact::PointTraction result;
  const double begin = seconds_spent();
  law.traction(c.motion, 1.0, result);
  benchmark::DoNotOptimize(result.jacobian.data());
  return 1e6 * (seconds_spent() - begin);
}

void planar_law(benchmark::State& state, const test::PlanarStratum& stratum) {
  std::mt19937_64 random(11);
  std::vector<double> spent;
  for (auto _ : state) {
    const test::PlanarCase c = stratum.draw(random);
    spent.push_back(microseconds(c));
    state.SetIterationTime(1e-6 * spent.back());
  }
  std::sort(spent.begin(), spent.end());
  const std::size_t last = spent.size() - 1;
  state.counters["median_us"] = spent[last / 2];
  state.counters["p99_us"] = spent[last * 99 / 100];
  state.counters["worst_us"] = spent[last];
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  for (const test::PlanarStratum& stratum : test::planar_strata()) {
    benchmark::RegisterBenchmark(("planar_law/" + std::string(stratum.name)).c_str(),
                                 [&stratum](benchmark::State& state) { planar_law(state, stratum); })
        ->Iterations(n_states)
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond);
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
