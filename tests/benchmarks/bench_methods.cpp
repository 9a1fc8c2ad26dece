/// @file
/// Cost of a patch whose points follow a method of their own (point_method_force.hpp), ten modes,
/// force and Jacobian:
///
///   event_patch     488 points that slip, H = 1, 3, 5: ns per point, and of these `ns_of_cycle`
///                   for the cycles of the points alone
///   sleeping_event  488 points, H = 5, and
///   sleeping_planar 300 points in two tangential directions, H = 1: every `awake`-th point slips,
///   the
///                   others stick. `ratio` is the time of the same patch with every point evaluated
///                   over that with sleeping points.
#include <benchmark/benchmark.h>

#include <ctime>
#include <memory>
#include <random>
#include <vector>

#include "contact/force/point_method_force.hpp"
#include "contact/line/line_events.hpp"
#include "contact/plane/planar_cycle.hpp"
#include "tests/support/asked_force.hpp"
#include "tests/support/sleepless_method.hpp"

namespace {

using namespace microslip::contact;
namespace tests = microslip::tests;

constexpr Eigen::Index n_modes = 10;

/// Of this thread: a busy machine does not show.
double seconds_spent() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

using Methods = std::vector<std::shared_ptr<const PointMethod>>;

/// Displacements of size one: a preload of 1 slips, one of 40 sticks.
PointParameters point_of(Eigen::Index i, int awake) {
  return {1.0, 0.5, 0.3, i % awake == 0 ? 1.0 : 40.0};
}

ModalShapes shapes_of(Eigen::Index n, bool second_direction) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const auto shape = [&] {
    return Eigen::MatrixXd::NullaryExpr(n, n_modes, [&] { return u(random); });
  };
  ModalShapes shapes{shape(), shape(), {}};
  if (second_direction) shapes.w = shape();
  return shapes;
}

Harmonics motion_of(int n_harmonics) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> g(0.0, 0.5);
  Harmonics q(n_harmonics, n_modes);
  for (Eigen::Index k = 1; k < q.rows().rows(); ++k) {
    const auto h = static_cast<double>((k + 1) / 2);
    for (Eigen::Index m = 0; m < n_modes; ++m) q.rows()(k, m) = g(random) / (h * h);
  }
  return q;
}

Methods by_line_events(Eigen::Index n, int awake) {
  Methods methods;
  for (Eigen::Index i = 0; i < n; ++i)
    methods.push_back(std::make_shared<LineEvents>(point_of(i, awake)));
  return methods;
}

Methods by_planar_events(Eigen::Index n, int awake) {
  Methods methods;
  for (Eigen::Index i = 0; i < n; ++i) {
    methods.push_back(std::make_shared<PlaneEvents>(SurfaceLaw(point_of(i, awake), 0.8)));
  }
  return methods;
}

Methods sleepless(const Methods& methods) {
  Methods bare;
  for (const auto& method : methods)
    bare.push_back(std::make_shared<microslip::tests::SleeplessMethod>(method));
  return bare;
}

void event_patch(benchmark::State& state) {
  const int H = static_cast<int>(state.range(0));
  constexpr Eigen::Index n = 488;
  const Methods methods = by_line_events(n, 1);
  const ModalShapes shapes = shapes_of(n, false);
  PointMethodForce force(Eigen::VectorXd::Ones(n), methods, shapes);
  const Harmonics q = motion_of(H);
  const auto work = force.workspace();
  for (auto _ : state) benchmark::DoNotOptimize(tests::evaluate(force, q, 1.0, *work));
  state.counters["ns_per_point"] = benchmark::Counter(
      1e-9 * n, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  PatchMotion motion;
  motion.set(shapes, q);
  Harmonics one;
  PointTraction traction;
  const double begin = seconds_spent();
  constexpr int repeats = 20;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    for (Eigen::Index i = 0; i < n; ++i) {
      motion.copy(i, one);
      methods[static_cast<std::size_t>(i)]->traction(one, 1.0, traction);
    }
  }
  state.counters["ns_of_cycle"] = 1e9 * (seconds_spent() - begin) / (repeats * n);
}
BENCHMARK(event_patch)->Arg(1)->Arg(3)->Arg(5)->Unit(benchmark::kMicrosecond);

void compare(benchmark::State& state, const Methods& methods, const ModalShapes& shapes,
             const Harmonics& q) {
  const Eigen::VectorXd weights = Eigen::VectorXd::Ones(shapes.u.rows());
  PointMethodForce force(weights, methods, shapes);
  PointMethodForce all(weights, sleepless(methods), shapes);
  const auto work = force.workspace();
  const auto work_of_all = all.workspace();
  benchmark::DoNotOptimize(tests::evaluate(all, q, 1.0, *work_of_all));
  const double begin = seconds_spent();
  constexpr int repeats = 3;
  for (int i = 0; i < repeats; ++i) {
    benchmark::DoNotOptimize(tests::evaluate(all, q, 1.0, *work_of_all));
  }
  const double whole = (seconds_spent() - begin) / repeats;
  double spent = 0.0;
  // Another motion each time, as in an iteration: every decision is made anew.
  double nudge = 1e-9;
  for (auto _ : state) {
    Harmonics moved = q;
    moved.vector() *= 1.0 + (nudge = -nudge);
    const double start = seconds_spent();
    benchmark::DoNotOptimize(tests::evaluate(force, moved, 1.0, *work));
    spent += seconds_spent() - start;
  }
  state.counters["all_us"] = 1e6 * whole;
  state.counters["ratio"] = whole / (spent / static_cast<double>(state.iterations()));
  state.counters["awake_share"] = force.report(q, 1.0, *work).awake_share;
}

void sleeping_event(benchmark::State& state) {
  constexpr Eigen::Index n = 488;
  compare(state, by_line_events(n, static_cast<int>(state.range(0))), shapes_of(n, false),
          motion_of(5));
}
BENCHMARK(sleeping_event)->Arg(1)->Arg(10)->Arg(100)->Unit(benchmark::kMicrosecond);

void sleeping_planar(benchmark::State& state) {
  constexpr Eigen::Index n = 300;
  compare(state, by_planar_events(n, static_cast<int>(state.range(0))), shapes_of(n, true),
          motion_of(1));
}
BENCHMARK(sleeping_planar)->Arg(1)->Arg(10)->Arg(100)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
