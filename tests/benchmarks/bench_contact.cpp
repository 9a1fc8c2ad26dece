/// @file
/// Cost of a contact point: modal force and Jacobian of a patch together, ten modes, normal load
/// that varies and separates, so that stick, stick–slip and separation all occur. Time per point in
/// the counter `per_point`; BM_cycle and BM_kernels split it into its parts.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "contact/closed_form/cycle_force.hpp"
#include "contact/closed_form/friction_cycle.hpp"
#include "contact/force/block_kernels.hpp"
#include "contact/force/patch_force.hpp"
#include "contact/line/line_events.hpp"
#include "contact/line/surface_line_events.hpp"
#include "contact/patch/point_motions.hpp"

#include "contact/patch/preload_equilibrium.hpp"
#include "contact/surface/surface_law.hpp"
#include "tests/support/asked_force.hpp"

namespace {

using namespace microslip::contact;
namespace tests = microslip::tests;

constexpr Eigen::Index n_modes = 10;

// Smooth shapes over a strip; amplitudes chosen so that about a third of the points stays stuck or
// slips in contact and the rest separates during the period.
struct Setup {
  ContactPatch patch;
  ModalShapes shapes;
  Harmonics q;
};

ModalShapes shapes_of(Eigen::Index n) {
  ModalShapes shapes{Eigen::MatrixXd(n, n_modes), Eigen::MatrixXd(n, n_modes), {}};
  for (Eigen::Index i = 0; i < n; ++i) {
    const double x = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    for (Eigen::Index mode = 0; mode < n_modes; ++mode) {
      const auto m = static_cast<double>(mode + 1);
      shapes.u(i, mode) = std::cos(m * x + 0.3 * m);
      shapes.v(i, mode) = std::sin(2.0 * m * x + 0.7 * m);
    }
  }
  return shapes;
}

Setup setup(Eigen::Index n) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<PointParameters> points(static_cast<std::size_t>(n));
  for (PointParameters& point : points) {
    point = {1e12, 1e12, 0.4, 1e6 * (1.5 + uniform(random))};
  }
  Harmonics q(1, n_modes);
  for (Eigen::Index i = 0; i < q.vector().size(); ++i) {
    q.vector()[i] = 8e-7 * uniform(random);
  }
  return {ContactPatch(Eigen::VectorXd::Constant(n, 1e-4 / static_cast<double>(n)), points),
          shapes_of(n), q};
}

void count_points(benchmark::State& state, std::size_t n) {
  state.counters["per_point"] =
      benchmark::Counter(static_cast<double>(n), benchmark::Counter::kIsIterationInvariantRate |
                                                     benchmark::Counter::kInvert);
}

void patch_force(benchmark::State& state) {
  const Setup s = setup(state.range(0));
  PatchForce force(s.patch, s.shapes);
  const auto work = force.workspace();
  for (auto _ : state) {
    benchmark::DoNotOptimize(tests::evaluate(force, s.q, 1000.0, *work));
  }
  const CycleReport report = force.report(s.q, 1000.0, *work);
  state.counters["slip"] = report.slip_share;
  state.counters["separated"] = report.separated_share;
  count_points(state, static_cast<std::size_t>(state.range(0)));
}
BENCHMARK(patch_force)->Arg(30)->Arg(300)->Arg(3000)->Arg(30000);
// Patches side by side, as curves of a family are: the time per point of two against one is the
// gain.
BENCHMARK(patch_force)
    ->Name("patch_force_side_by_side")
    ->Arg(3000)
    ->Threads(1)
    ->Threads(2)
    ->UseRealTime();

void cycles_only(benchmark::State& state) {
  const Setup s = setup(state.range(0));
  const std::vector<PointMotion> motions = point_motions(s.shapes, s.q);
  for (auto _ : state) {
    for (std::size_t i = 0; i < motions.size(); ++i) {
      const PointParameters& point = s.patch.points()[i];
      const SlipFunctions w = slip_functions(point, motions[i]);
      const CycleRegime regime = cycle_regime(w);
      benchmark::DoNotOptimize(cycle_force(point, motions[i], w, regime, cycle_phases(w, regime)));
    }
  }
  count_points(state, motions.size());
}
BENCHMARK(cycles_only)->Arg(3000);

void whole_cycles(benchmark::State& state) {
  const Setup s = setup(state.range(0));
  const std::vector<PointMotion> motions = point_motions(s.shapes, s.q);
  for (auto _ : state) {
    for (std::size_t i = 0; i < motions.size(); ++i) {
      benchmark::DoNotOptimize(friction_cycle(s.patch.points()[i], motions[i]));
    }
  }
  count_points(state, motions.size());
}
BENCHMARK(whole_cycles)->Arg(3000);

void jacobian_only(benchmark::State& state) {
  const std::vector<double> phi(n_modes * block_points, 0.5);
  const std::vector<double> psi(n_modes * block_points, 0.25);
  const std::vector<double> entries(9 * block_points, 1e-3);
  std::vector<double> sum(9 * n_modes * n_modes);
  for (auto _ : state) {
    block_kernels().add_products_9(n_modes, block_points, phi.data(), psi.data(), entries.data(),
                                   sum.data());
    block_kernels().add_symmetric_products_7(n_modes, block_points, phi.data(), entries.data(),
                                             sum.data());
    block_kernels().add_symmetric_products_6(n_modes, block_points, psi.data(), entries.data(),
                                             sum.data());
    benchmark::ClobberMemory();
  }
  count_points(state, block_points);
}
BENCHMARK(jacobian_only);

// ---- many harmonics: exact, event by event

// Motions of H harmonics that fall as 1/h², states as in setup().
struct MethodSetup {
  std::vector<PointParameters> points;
  std::vector<Harmonics> motions;
};

MethodSetup method_setup(int n_harmonics) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  MethodSetup s;
  for (int i = 0; i < 1000; ++i) {
    s.points.push_back({1e12, 1e12, 0.4, 1e6 * (1.5 + uniform(random))});
    Harmonics motion(n_harmonics, n_point_signals);
    for (Eigen::Index row = 0; row < motion.rows().rows(); ++row) {
      const double h = row == 0 ? 1.0 : 0.5 * static_cast<double>(row + 1);
      for (Eigen::Index k = 0; k < 2; ++k) {
        motion.rows()(row, k) = 2e-6 * uniform(random) / (std::floor(h) * std::floor(h));
      }
    }
    s.motions.push_back(motion);
  }
  return s;
}

void line_events(benchmark::State& state) {
  const MethodSetup s = method_setup(static_cast<int>(state.range(0)));
  PointTraction result;
  for (auto _ : state) {
    for (std::size_t i = 0; i < s.points.size(); ++i) {
      LineEvents(s.points[i]).traction(s.motions[i], 1000.0, result);
      benchmark::DoNotOptimize(result.jacobian.data());
    }
  }
  count_points(state, s.points.size());
}
BENCHMARK(line_events)->Arg(1)->Arg(3)->Arg(5);

// Surfaces without a closed form, events located exactly. Harmonics.
void surface_line_events(benchmark::State& state, const FrictionLaw& friction,
                         const std::optional<RoughSurface>& roughness) {
  const MethodSetup s = method_setup(static_cast<int>(state.range(0)));
  PointTraction result;
  std::vector<SurfaceLaw> surfaces;
  for (const PointParameters& point : s.points) {
    surfaces.emplace_back(point, 0.0, friction, roughness);
  }
  for (auto _ : state) {
    for (std::size_t i = 0; i < s.points.size(); ++i) {
      SurfaceLineEvents(surfaces[i]).traction(s.motions[i], 1000.0, result);
      benchmark::DoNotOptimize(result.jacobian.data());
    }
  }
  count_points(state, s.points.size());
}
BENCHMARK_CAPTURE(surface_line_events, rate, FrictionLaw::exponential(0.4, 0.3, 500.0),
                  std::nullopt)
    ->Arg(1)
    ->Arg(3)
    ->Arg(5);
BENCHMARK_CAPTURE(surface_line_events, cubic, FrictionLaw::constant(0.4), RoughSurface::cubic(2e-6))
    ->Arg(1)
    ->Arg(3)
    ->Arg(5);
BENCHMARK_CAPTURE(surface_line_events, gaussian, FrictionLaw::constant(0.4),
                  RoughSurface::matching_gaussian(2e-6))
    ->Arg(1)
    ->Arg(3)
    ->Arg(5);

// One call of a surface law, approaches that sweep from separation through the heights to full
// contact; with bodies in series an equation is solved in every call.
void surface_law(benchmark::State& state, const std::optional<RoughSurface>& roughness,
                 double compliance) {
  const SurfaceLaw law({1e12, 1e12, 0.4, 5e5}, 1e12, FrictionLaw::exponential(0.4, 0.3, 10.0),
                       roughness, {0.0, compliance, 0.0});
  std::vector<double> approaches(1024);
  for (std::size_t i = 0; i < approaches.size(); ++i) {
    approaches[i] = 3e-6 * std::sin(2.0 * std::numbers::pi * static_cast<double>(i) / 1024.0);
  }
  for (auto _ : state) {
    for (const double approach : approaches) {
      benchmark::DoNotOptimize(law.at(approach, 0.01));
    }
  }
  count_points(state, approaches.size());
}
BENCHMARK_CAPTURE(surface_law, smooth, std::nullopt, 0.0);
BENCHMARK_CAPTURE(surface_law, cubic, RoughSurface::cubic(2e-6), 0.0);
BENCHMARK_CAPTURE(surface_law, gaussian, RoughSurface::matching_gaussian(2e-6), 0.0);
BENCHMARK_CAPTURE(surface_law, cubic_in_series, RoughSurface::cubic(2e-6), 1e-12);
BENCHMARK_CAPTURE(surface_law, gaussian_in_series, RoughSurface::matching_gaussian(2e-6), 1e-12);

// Pressure at rest under force and moment, a third of the cells lifted off.
void preload_equilibrium_of_area(benchmark::State& state) {
  const auto side = static_cast<int>(state.range(0));
  const ContactArea area(rectangle_cells(0.1, 0.1, side, side));
  const CellSprings springs = one_sided_springs(Eigen::VectorXd::Constant(area.n_cells(), 1e12));
  for (auto _ : state) {
    benchmark::DoNotOptimize(preload_equilibrium(area, springs, {1000.0, 28.0, 0.0}));
  }
  count_points(state, static_cast<std::size_t>(area.n_cells()));
}
BENCHMARK(preload_equilibrium_of_area)->Arg(4)->Arg(32)->Arg(128);

}  // namespace

BENCHMARK_MAIN();
