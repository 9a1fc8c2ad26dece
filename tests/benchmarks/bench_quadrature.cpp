/// @file
/// What a fitted rule is worth: error of the modal force against the number of points, for square
/// midpoint cells and for the rule fitted to the lines between stick, slip and separation, on a 40 × 20 mm
/// patch under three modes. Prints a table per scene and the ratio of points at 1e-6, then times a refit.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "contact/force/fitted_patch_force.hpp"
#include "contact/force/patch_force.hpp"

namespace {

using namespace microslip::contact;

constexpr double length_p = 0.04;
constexpr double length_r = 0.02;

// Bending, twisting and tilting of the patch, smooth but not polynomial.
ModalShapes shapes_at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) {
  const Eigen::ArrayXd x = p.array() / length_p;
  const Eigen::ArrayXd y = r.array() / length_r;
  ModalShapes shapes{Eigen::MatrixXd(p.size(), 3), Eigen::MatrixXd(p.size(), 3), {}};
  shapes.u << 0.3 + x + 0.2 * y, (2.0 * x).cos() - 0.4 * y, 0.5 + 0.3 * (x * y).sin();
  shapes.v << 0.2 - 0.5 * x, 0.4 * (1.5 * y).sin(), (1.0 + x).log() + 0.3 * y;
  return shapes;
}

struct Scene {
  const char* name;
  double preload;   // at p = 0 [Pa]
  double gradient;  // relative change to p = 40 mm
  double normal;    // share of the normal motion
};

const std::vector<Scene> scenes{
    {"one stick/slip line, constant load", 4.5e5, 0.3, 0.0},
    {"one stick/slip line, variable load", 4.5e5, 0.3, 0.25},
    {"stick and slip, strongly varying load", 2.5e5, 0.9, 1.0},
    {"stick, slip and separation", 0.5e5, -1.0, 1.5},
};

ParameterField parameters_of(const Scene& scene) {
  return [scene](const Eigen::VectorXd& p, const Eigen::VectorXd& /*r*/) {
    std::vector<PointParameters> points;
    for (const double x : p) {
      points.push_back({1e12, 1e12, 0.4, scene.preload * (1.0 + scene.gradient * x / length_p)});
    }
    return points;
  };
}

ShapeField shapes_of(const Scene& scene) {
  return [scene](const Eigen::VectorXd& p, const Eigen::VectorXd& r) {
    ModalShapes shapes = shapes_at(p, r);
    shapes.v *= scene.normal;
    return shapes;
  };
}

Harmonics motion() {
  Harmonics q(1, 3);
  q.rows() << 0.0, 1e-8, 2e-8,  //
      2.0e-7, 0.6e-7, -0.5e-7,  //
      0.5e-7, -0.7e-7, 1.2e-7;
  return q;
}

PatchForce patch_force(const Scene& scene, const PatchRule& rule) {
  return {ContactPatch(rule.weights, parameters_of(scene)(rule.p, rule.r)),
          shapes_of(scene)(rule.p, rule.r)};
}

Eigen::VectorXd force_on(const Scene& scene, const PatchRule& rule) {
  return patch_force(scene, rule).evaluate(motion(), 1.0).force.vector();
}

CycleReport report_on(const Scene& scene, const PatchRule& rule) {
  return patch_force(scene, rule).report(motion(), 1.0);
}

PatchCells patch(int n_p, int n_r) {
  return rectangle_cells({0.0, 0.0}, {length_p, length_r}, n_p, n_r);
}

PatchRule fitted(const Scene& scene, int order, double line_tolerance) {
  return fitted_rule(patch(1, 1), regime_guards(shapes_of(scene), parameters_of(scene), {motion()}),
                     {.order = order, .line_tolerance = line_tolerance});
}

struct Row {
  Eigen::Index n_points;
  double error;
};

// Points needed so that no finer rule of the ladder is worse than the target.
Eigen::Index points_for(double target, const std::vector<Row>& rows) {
  Eigen::Index n = -1;
  for (auto row = rows.rbegin(); row != rows.rend() && row->error <= target; ++row) {
    n = row->n_points;
  }
  return n;
}

void print(const char* kind, const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    std::printf("  %-10s %9td points   relative error %.2e\n", kind, row.n_points, row.error);
  }
}

void print_ladders(const Scene& scene) {
  const Eigen::VectorXd exact = force_on(scene, fitted(scene, 24, 1e-13));
  const auto row = [&](const PatchRule& rule) {
    return Row{rule.n_points(), (force_on(scene, rule) - exact).norm() / exact.norm()};
  };
  std::vector<Row> midpoint;
  for (const int n : {4, 8, 16, 32, 64, 128, 256, 512}) {
    midpoint.push_back(row(midpoint_rule(patch(2 * n, n))));
  }
  std::vector<Row> fit;
  for (const int order : {2, 3, 4, 5, 6, 8, 10, 12, 16}) {
    fit.push_back(row(fitted(scene, order, std::pow(10.0, -std::min(1.0 + order, 12.0)))));
  }
  const CycleReport share = report_on(scene, fitted(scene, 6, 1e-6));
  std::printf("%s: stick %.2f, slip %.2f, separated %.2f of area and period\n", scene.name,
              share.stick_share, share.slip_share, share.separated_share);
  print("midpoint", midpoint);
  print("fitted", fit);
  const auto n_midpoint = points_for(1e-6, midpoint);
  const auto n_fitted = points_for(1e-6, fit);
  std::printf("  at 1e-6: midpoint %td, fitted %td points, ratio %.0f\n\n", n_midpoint, n_fitted,
              static_cast<double>(n_midpoint) / static_cast<double>(n_fitted));
}

void refit(benchmark::State& state) {
  const Scene& scene = scenes[static_cast<std::size_t>(state.range(0))];
  Eigen::Index n = 0;
  for (auto _ : state) {
    n = fitted(scene, 6, 1e-8).n_points();
  }
  state.counters["points"] = static_cast<double>(n);
}
BENCHMARK(refit)->DenseRange(0, 3)->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  for (const Scene& scene : scenes) {
    print_ladders(scene);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
