// One frequency point and one whole curve of harmonic balance: 10 modes, 300 contact points,
// varying load with separation, mean and first harmonic. Goals: a point ≤ 1 ms, a curve of 250
// points ≤ 0.3 s, on one core; the peak against 30 preloads over three decades ≤ 3 s.

#include <cmath>
#include <ctime>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

#include "solver/branch/start_point.hpp"
#include "solver/continuation.hpp"
#include "solver/optimum/peak_trace.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/readable_patch.hpp"
#include "tests/support/traced_peaks.hpp"

namespace {

using namespace microslip;

constexpr Eigen::Index n_modes = 10;

/// A strip of n points under modes that bend along it: some stick, some slip, some separate.
solver::Scene strip(Eigen::Index n_points, double preload = 0.2) {
  solver::Scene s;
  s.natural_frequency.resize(n_modes);
  s.output = Eigen::VectorXd::LinSpaced(n_modes, 1.0, 0.1);
  s.damping_ratio = Eigen::VectorXd::Constant(n_modes, 0.002);
  s.excitation = contact::Harmonics(1, n_modes);
  Eigen::VectorXd weights =
      Eigen::VectorXd::Constant(n_points, 1.0 / static_cast<double>(n_points));
  std::vector<contact::PointParameters> points(static_cast<std::size_t>(n_points),
                                               {0.3, 0.4, 0.4, preload});
  contact::ModalShapes shapes{
      Eigen::MatrixXd(n_points, n_modes), Eigen::MatrixXd(n_points, n_modes), {}};
  for (Eigen::Index k = 0; k < n_modes; ++k) {
    s.natural_frequency[k] = static_cast<double>((k + 1) * (k + 1));
    s.excitation.rows()(1, k) = 0.02 / static_cast<double>(k + 1);
    for (Eigen::Index i = 0; i < n_points; ++i) {
      const double x = static_cast<double>(i) / static_cast<double>(n_points);
      shapes.u(i, k) = std::cos(static_cast<double>(k) * 1.3 * x + 0.2);
      shapes.v(i, k) = 0.7 * std::sin(static_cast<double>(k) * 1.7 * x + 0.4);
    }
  }
  s.contact = std::make_unique<tests::ReadablePatch>(
      contact::ContactPatch(std::move(weights), std::move(points)), std::move(shapes));
  return s;
}

solver::ContinuationOptions range() {
  solver::ContinuationOptions options;
  options.frequency_begin = 0.8;
  options.frequency_end = 1.5;
  return options;
}

void one_frequency_point(benchmark::State& state) {
  const solver::Scene scene = strip(state.range(0));
  solver::HarmonicBalance balance(scene, 1);
  const auto curve = solver::trace_response(scene, range());
  const auto& start = curve.points[curve.points.size() / 2];
  const double omega = start.frequency * 1.001;  // as far as a step of continuation
  int iterations = 0;
  for (auto _ : state) {
    const auto solution = solver::solve_at(balance, start.q.vector(), omega, {});
    iterations = solution.iterations;
    benchmark::DoNotOptimize(solution.residual);
  }
  state.counters["iterations"] = iterations;
}

void whole_curve(benchmark::State& state) {
  const solver::Scene scene = strip(state.range(0));
  double n = 0.0;
  for (auto _ : state) {
    const auto curve = solver::trace_response(scene, range());
    n = static_cast<double>(curve.points.size());
    if (!curve.complete) state.SkipWithError(to_string(curve.diagnosis));
  }
  state.counters["points"] = n;
  state.counters["seconds_per_250"] = benchmark::Counter(
      n / 250.0, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

solver::PeakTraceOptions preloads() {
  solver::PeakTraceOptions options;
  options.lower = 0.01;
  options.upper = 10.0;
  options.n_values = 30;
  return options;
}

void peak_against_preload(benchmark::State& state) {
  const auto family = [&](double preload) { return strip(state.range(0), preload); };
  solver::PeakTrace trace;
  for (auto _ : state) trace = tests::traced_peaks(family, range(), preloads());
  state.counters["peaks"] = static_cast<double>(trace.peaks.size());
  state.counters["curves"] = trace.n_curves;
  state.counters["evaluations"] = static_cast<double>(trace.contact_evaluations);
}

/// What peak_against_preload saves: the same peaks from one whole curve each.
void peak_on_whole_curves(benchmark::State& state) {
  const auto family = [&](double preload) { return strip(state.range(0), preload); };
  auto options = preloads();
  options.n_checks = options.n_values;
  solver::PeakTrace trace;
  for (auto _ : state) trace = tests::traced_peaks(family, range(), options);
  state.counters["peaks"] = static_cast<double>(trace.peaks.size());
  state.counters["curves"] = trace.n_curves;
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The curve with harmonics chosen for it, the choice included, against the same with these given,
/// in processor time; 100 points, preload in hundredths.
void chosen_harmonics(benchmark::State& state) {
  solver::Scene scene = strip(100, 0.01 * static_cast<double>(state.range(0)));
  tests::use_event_cycles(scene);
  solver::ContinuationOptions options = range();
  options.n_harmonics = 21;
  options.harmonic_tolerance = 1e-2;
  solver::ResponseCurve chosen;
  double spent = 0.0;
  for (auto _ : state) {
    const double begin = processor_seconds();
    chosen = solver::trace_response(scene, options);
    spent += processor_seconds() - begin;
    if (!chosen.complete) state.SkipWithError(to_string(chosen.diagnosis));
  }
  solver::HarmonicSet used(1);
  double n_orders = 0.0;
  for (const auto& point : chosen.points) {
    used = used.united(point.orders);
    n_orders += static_cast<double>(point.orders.size());
  }
  options.harmonic_tolerance = 0.0;
  options.orders = used.orders();
  const double begin = processor_seconds();
  const auto fixed = solver::trace_response(scene, options);
  const double fixed_spent = processor_seconds() - begin;
  const auto per = [](double sum, const solver::ResponseCurve& curve) {
    return sum / static_cast<double>(curve.points.size());
  };
  state.counters["chosen_ms_per_point"] =
      1e3 * per(spent / static_cast<double>(state.iterations()), chosen);
  state.counters["fixed_ms_per_point"] = 1e3 * per(fixed_spent, fixed);
  state.counters["mean_orders"] = per(n_orders, chosen);
  state.counters["fixed_orders"] = used.count();
}

BENCHMARK(one_frequency_point)->Arg(300)->Unit(benchmark::kMicrosecond);
BENCHMARK(whole_curve)->Arg(300)->Arg(3000)->Unit(benchmark::kMillisecond);
BENCHMARK(chosen_harmonics)->Arg(50)->Arg(10)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(peak_against_preload)->Arg(300)->Unit(benchmark::kMillisecond);
BENCHMARK(peak_on_whole_curves)->Arg(300)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
