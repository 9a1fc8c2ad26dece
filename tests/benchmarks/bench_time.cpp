// One period in time, slip and separation on: the oscillator of paper B figure 6 and a patch of 10
// modes and 300 points, by events and by Runge–Kutta with 1000 steps. `events` counts changes of
// state per period.

#include <cmath>

#include <benchmark/benchmark.h>

#include "solver/time/time_stepper.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"

namespace {

using namespace microslip;

void advance(benchmark::State& state, solver::Scene scene, double frequency,
             solver::TimeMethod method) {
  tests::add_transient(scene);
  const solver::TimeSystem system(scene, frequency);
  solver::TimeOptions options;
  options.method = method;
  const auto stepper = solver::make_stepper(system, options);
  solver::TimeState motion = solver::state_at_rest(system);
  for (int i = 0; i < 10; ++i) stepper->advance_period(motion, nullptr);  // slip has begun
  const long before = stepper->n_events();
  for (auto _ : state) {
    stepper->advance_period(motion, nullptr);
    benchmark::DoNotOptimize(motion.motion.q.data());
  }
  state.counters["events"] =
      static_cast<double>(stepper->n_events() - before) / static_cast<double>(state.iterations());
}

void oscillator(benchmark::State& state, solver::TimeMethod method) {
  tests::SinglePoint single;
  single.damping_ratio = 0.05;
  single.point = {100.0, 0.0, 0.5, 1.0};
  advance(state, tests::single_point_scene(single), 0.5, method);
}

void patch(benchmark::State& state, solver::TimeMethod method) {
  tests::PatchScene size;
  size.n_points = static_cast<int>(state.range(0));
  advance(state, tests::patch_scene(size, 0.3), 2.0 * M_PI * 310.0, method);
}

BENCHMARK_CAPTURE(oscillator, events, solver::TimeMethod::events)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(oscillator, rk4, solver::TimeMethod::rk4)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(patch, events, solver::TimeMethod::events)
    ->Arg(30)
    ->Arg(300)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(patch, rk4, solver::TimeMethod::rk4)
    ->Arg(30)
    ->Arg(300)
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
