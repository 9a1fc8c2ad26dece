/// @file
/// Cost of a contact point that moves in two tangential directions: traction and Jacobian of one
/// point at the tolerance of scenes, over random states of each stratum. The spread matters as much
/// as the mean, so that every state is timed by itself: counters give median, 99 % and worst in µs.
/// planar_curve traces a whole curve: two modes, two points that move along p, q and r, a static
/// load that gives them means.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "contact/force/point_method_force.hpp"
#include "contact/plane/planar_cycle.hpp"
#include "solver/continuation.hpp"
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
  const contact::PlaneEvents method(contact::SurfaceLaw(c.point, c.second_stiffness), tolerance);
  contact::PointTraction result;
  const double begin = seconds_spent();
  method.traction(c.motion, 1.0, result);
  benchmark::DoNotOptimize(result.jacobian.data());
  return 1e6 * (seconds_spent() - begin);
}

void planar_events(benchmark::State& state, const test::PlanarStratum& stratum) {
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

solver::Scene two_points(double preload, int n_harmonics) {
  solver::Scene scene;
  scene.natural_frequency = Eigen::Vector2d(1.0, 1.6);
  scene.damping_ratio = Eigen::Vector2d(0.003, 0.003);
  scene.output = Eigen::Vector2d(1.0, 0.5);
  scene.excitation = contact::Harmonics(n_harmonics, 2);
  scene.excitation.rows().row(0) << 0.02, -0.03;
  scene.excitation.rows().row(1) << 0.03, 0.0;
  scene.excitation.rows().row(2) << 0.0, 0.02;
  const contact::PointParameters point{0.5, 0.4, 0.4, preload};
  const auto method =
      std::make_shared<contact::PlaneEvents>(contact::SurfaceLaw(point, 0.3), tolerance);
  contact::ModalShapes shapes;
  shapes.u = (Eigen::Matrix2d() << 1.0, 0.3, 0.8, -0.4).finished();
  shapes.v = (Eigen::Matrix2d() << 0.2, 0.1, -0.3, 0.2).finished();
  shapes.w = (Eigen::Matrix2d() << 0.4, 0.9, -0.2, 0.7).finished();
  scene.contact = std::make_unique<contact::PointMethodForce>(
      Eigen::Vector2d(0.5, 0.5),
      std::vector<std::shared_ptr<const contact::PointMethod>>{method, method}, shapes);
  return scene;
}

/// Preload in hundredths, harmonics.
void planar_curve(benchmark::State& state) {
  const solver::Scene scene =
      two_points(0.01 * static_cast<double>(state.range(0)), static_cast<int>(state.range(1)));
  solver::ContinuationOptions options;
  options.frequency_begin = 0.7;
  options.frequency_end = 2.0;
  options.n_harmonics = static_cast<int>(state.range(1));
  double n = 0.0;
  bool complete = true;
  for (auto _ : state) {
    const double begin = seconds_spent();
    const solver::ResponseCurve curve = solver::trace_response(scene, options);
    state.SetIterationTime(seconds_spent() - begin);
    n = static_cast<double>(curve.points.size());
    complete = complete && curve.complete;
  }
  state.counters["points"] = n;
  state.counters["complete"] = complete ? 1.0 : 0.0;
}
BENCHMARK(planar_curve)
    ->Args({15, 1})
    ->Args({30, 1})
    ->Args({60, 1})
    ->Args({30, 3})
    ->Args({60, 3})
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  for (const test::PlanarStratum& stratum : test::planar_strata()) {
    benchmark::RegisterBenchmark(
        ("planar_events/" + std::string(stratum.name)).c_str(),
        [&stratum](benchmark::State& state) { planar_events(state, stratum); })
        ->Iterations(n_states)
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond);
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
