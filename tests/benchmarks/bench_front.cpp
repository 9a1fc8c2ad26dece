/// @file
/// Error against time of every method in the tree, for each kind of point and for the rule over the
/// patch: what stands on no front in the range a user reads (1e-2 to 1e-6 of the force) does not
/// pay.
///
///   bench_front [--quick] [--csv FILE]
///
/// A patch of 24 × 16 points with ten smooth modes, and random motions that leave a part of it
/// stuck, a part slipping and a part open. Error: ‖G − G_ref‖ over the larger of ‖G_ref‖ and the
/// force of the stuck patch, root mean square over the motions and largest; of ∂G/∂q the same over
/// the larger of the norms. Time: force and Jacobian, median over the motions, µs per point, of
/// this thread. A reference is judged by another method.
/// --quick: two motions, to see that it runs. Picture: share/scripts/plot_front.py.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "contact/force/patch_force.hpp"
#include "contact/force/point_method_force.hpp"
#include "contact/line/line_events.hpp"
#include "contact/line/surface_line_events.hpp"
#include "contact/plane/planar_cycle.hpp"
#include "contact/sampled/patch_force.hpp"
#include "tests/benchmarks/plain_return.hpp"
#include "tests/support/asked_force.hpp"

namespace {

using namespace microslip::contact;
namespace tests = microslip::tests;

constexpr Eigen::Index n_modes = 10;
constexpr double frequency = 1.0;

/// Of this thread: a busy machine does not show.
double seconds_spent() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The patch at the centres of rows × columns cells of a square.
struct Samples {
  Eigen::VectorXd weights;
  ModalShapes shapes;
  std::vector<PointParameters> points;
};

Samples samples_of(Eigen::Index rows, Eigen::Index columns, bool second_direction) {
  const Eigen::Index n = rows * columns;
  Eigen::MatrixXd powers(n, 10);  // x^i y^j, i + j ≤ 3
  Samples samples{Eigen::VectorXd::Constant(n, 4.0 / static_cast<double>(n)), {}, {}};
  for (Eigen::Index i = 0; i < n; ++i) {
    const double x = (2.0 * static_cast<double>(i % columns) + 1.0) / static_cast<double>(columns);
    const double y = (2.0 * static_cast<double>(i / columns) + 1.0) / static_cast<double>(rows);
    Eigen::Index k = 0;
    for (int p = 0; p <= 3; ++p) {
      for (int q = 0; p + q <= 3; ++q) powers(i, k++) = std::pow(x - 1.0, p) * std::pow(y - 1.0, q);
    }
    // From a gap to a load that most motions do not lift.
    samples.points.push_back({1.0, 0.5, 0.4, 1.0 + 0.8 * (x - 1.0) + 0.4 * (y - 1.0)});
  }
  std::mt19937_64 random(1);
  std::normal_distribution<double> gauss(0.0, 0.4);
  const auto shape = [&]() -> Eigen::MatrixXd {
    return powers * Eigen::MatrixXd::NullaryExpr(10, n_modes, [&] { return gauss(random); });
  };
  samples.shapes.u = shape();
  samples.shapes.v = shape();
  if (second_direction) samples.shapes.w = shape();
  return samples;
}

/// Amplitudes over a decade and a half: nearly stuck to mostly apart.
std::vector<Harmonics> motions_of(int n_harmonics, int n) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> gauss(0.0, 0.5);
  std::uniform_real_distribution<double> decades(-1.2, 0.3);
  std::vector<Harmonics> motions;
  for (int i = 0; i < n; ++i) {
    const double size = std::pow(10.0, decades(random));
    Harmonics q(n_harmonics, n_modes);
    for (Eigen::Index k = 0; k < q.rows().rows(); ++k) {
      const double h = std::max(1.0, std::ceil(static_cast<double>(k) / 2.0));
      for (Eigen::Index m = 0; m < n_modes; ++m) {
        q.rows()(k, m) = (k == 0 ? 0.2 : 1.0) * size * gauss(random) / (h * h);
      }
    }
    motions.push_back(std::move(q));
  }
  return motions;
}

using Force = std::shared_ptr<ModalForce>;

struct Kind {
  std::string name;
  int n_harmonics = 1;
  bool second_direction = false;
  std::function<SurfaceLaw(const PointParameters&)> surface;
};

struct Method {
  std::string name;
  double setting = 0.0;  // instants, tolerance, cells; 0: none
  Force force;
};

struct Row {
  std::string kind;
  std::string method;
  double setting = 0.0;
  double force_error = 0.0;
  double largest_error = 0.0;
  double jacobian_error = 0.0;
  double microseconds = 0.0;
};

using MethodMaker = std::function<std::shared_ptr<const PointMethod>(const SurfaceLaw&)>;

Force by_methods(const Samples& samples, const Kind& kind, const MethodMaker& make) {
  std::vector<std::shared_ptr<const PointMethod>> methods;
  for (const PointParameters& point : samples.points) methods.push_back(make(kind.surface(point)));
  return std::make_shared<PointMethodForce>(samples.weights, std::move(methods), samples.shapes);
}

Force in_lanes(const Samples& samples, const Kind& kind, int instants) {
  std::vector<SurfaceLaw> surfaces;
  for (const PointParameters& point : samples.points) surfaces.push_back(kind.surface(point));
  return std::make_shared<sampled::PatchForce>(samples.weights, std::move(surfaces), samples.shapes,
                                               instants);
}

MethodMaker located() {
  return [](const SurfaceLaw& s) { return std::make_shared<LineEvents>(s.point()); };
}
MethodMaker band() {
  return [](const SurfaceLaw& s) { return std::make_shared<SurfaceLineEvents>(s); };
}
MethodMaker planar(double tolerance) {
  return [=](const SurfaceLaw& s) { return std::make_shared<PlaneEvents>(s, tolerance); };
}

/// The first is the reference of the others, the second that of the first.
std::vector<Method> methods_of(const Kind& kind, const Samples& samples) {
  std::vector<Method> methods;
  const auto add = [&](const std::string& name, double setting, Force force) {
    methods.push_back({name, setting, std::move(force)});
  };
  const bool plain = kind.surface(samples.points[0]).is_smooth() &&
                     !kind.surface(samples.points[0]).is_rate_dependent();
  const auto add_lanes = [&] {
    for (int n = 16; n <= 4096; n *= 2) {
      if (n >= 8 * (kind.n_harmonics + 1)) add("lanes", n, in_lanes(samples, kind, n));
    }
  };
  const auto add_plain_return = [&] {
    for (const int n : {128, 512}) {
      if (!plain) return;
      add("plain return", n,
          std::make_shared<microslip::benchmarks::PlainReturn>(samples.weights, samples.points,
                                                               samples.shapes, n));
    }
  };
  if (kind.second_direction) {
    for (const double tolerance : {1e-13, 1e-11, 1e-8, 1e-6, 1e-4, 1e-2}) {
      add("planar events", tolerance, by_methods(samples, kind, planar(tolerance)));
    }
    add_lanes();
    add_plain_return();
    return methods;
  }
  if (plain) add("located events", 0.0, by_methods(samples, kind, located()));
  add("slider band", 0.0, by_methods(samples, kind, band()));
  const double tolerance = plain ? 1e-6 : 1e-12;
  add("planar events", tolerance, by_methods(samples, kind, planar(tolerance)));
  if (plain && kind.n_harmonics == 1) {
    add("closed form", 0.0,
        std::make_shared<PatchForce>(ContactPatch(samples.weights, samples.points),
                                     samples.shapes));
  }
  add_lanes();
  add_plain_return();
  return methods;
}

struct Effort {
  int n_motions = 40;
  double seconds = 0.002;  // of one timing at least
  Eigen::Index rows = 16;  // of points of the patch
  int n_levels = 8;        // of its cells
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

/// What a method gives for all motions, and the median of its time.
struct Trial {
  std::vector<ForceAndJacobian> values;
  double microseconds = 0.0;  // of one evaluation
};

Trial tried(const ModalForce& force, const std::vector<Harmonics>& motions, const Effort& effort) {
  Trial trial;
  const auto work = force.workspace();
  std::vector<double> times;
  for (const Harmonics& q : motions) {
    int repeats = 1;
    const double begin = seconds_spent();
    trial.values.push_back(tests::evaluate(force, q, frequency, *work));
    for (; seconds_spent() - begin < effort.seconds; ++repeats) {
      static_cast<void>(tests::evaluate(force, q, frequency, *work));
    }
    times.push_back(1e6 * (seconds_spent() - begin) / repeats);
  }
  trial.microseconds = median(times);
  return trial;
}

/// Errors of the values against exact ones; the time is the caller's.
Row judged(const std::vector<ForceAndJacobian>& values, const std::vector<ForceAndJacobian>& exact,
           const Eigen::MatrixXd& K, const std::vector<Harmonics>& motions) {
  Row row;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const double stuck = (motions[i].rows() * K).norm();
    const double force = (values[i].force.rows() - exact[i].force.rows()).norm() /
                         std::max(exact[i].force.rows().norm(), stuck);
    const double jacobian = (values[i].jacobian - exact[i].jacobian).norm() /
                            std::max(exact[i].jacobian.norm(), K.norm());
    row.force_error += force * force;
    row.jacobian_error += jacobian * jacobian;
    row.largest_error = std::max(row.largest_error, force);
  }
  row.force_error = std::sqrt(row.force_error / static_cast<double>(motions.size()));
  row.jacobian_error = std::sqrt(row.jacobian_error / static_cast<double>(motions.size()));
  return row;
}

void print(const Row& row) {
  char setting[32] = "";
  if (row.setting != 0.0) std::snprintf(setting, sizeof setting, "%g", row.setting);
  std::printf("%-16s %7s  %9.1e %9.1e %9.1e %10.3f\n", row.method.c_str(), setting, row.force_error,
              row.largest_error, row.jacobian_error, row.microseconds);
  std::fflush(stdout);
}

void title(const std::string& text, const char* unit) {
  std::printf("\n%s\n%-16s %7s  %9s %9s %9s %10s\n", text.c_str(), "", "setting", "G", "largest",
              "dG/dq", unit);
}

std::string shares(const ModalForce& force, const std::vector<Harmonics>& motions) {
  const auto work = force.workspace();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Harmonics& q : motions) {
    const CycleReport report = force.report(q, frequency, *work);
    sum += Eigen::Vector3d(report.stick_share, report.slip_share, report.separated_share);
  }
  sum /= static_cast<double>(motions.size());
  char text[80];
  std::snprintf(text, sizeof text, ": stick %.2f, slip %.2f, apart %.2f", sum[0], sum[1], sum[2]);
  return text;
}

void compare(const Kind& kind, const Effort& effort, std::vector<Row>& rows) {
  const Samples samples = samples_of(effort.rows, effort.rows * 3 / 2, kind.second_direction);
  const std::vector<Harmonics> motions = motions_of(kind.n_harmonics, effort.n_motions);
  const std::vector<Method> methods = methods_of(kind, samples);
  const Eigen::MatrixXd K = methods[0].force->stuck_stiffness();
  title(kind.name + shares(*methods[0].force, motions), "us/point");
  const Trial reference = tried(*methods[0].force, motions, effort);
  const auto add = [&](const Method& method, const Trial& trial, const Trial& exact) {
    Row row = judged(trial.values, exact.values, K, motions);
    row.kind = kind.name;
    row.method = method.name;
    row.setting = method.setting;
    row.microseconds = trial.microseconds / static_cast<double>(samples.weights.size());
    rows.push_back(row);
    print(row);
  };
  for (std::size_t i = 1; i < methods.size(); ++i) {
    const Trial trial = tried(*methods[i].force, motions, effort);
    if (i == 1) add(methods[0], reference, trial);
    add(methods[i], trial, reference);
  }
}

/// The rule over the patch: centres of cells, halved again and again,
/// alone and extrapolated from two.
void compare_cells(const Effort& effort, std::vector<Row>& rows) {
  const std::vector<Harmonics> motions = motions_of(1, effort.n_motions);
  std::vector<Trial> trials;
  Eigen::MatrixXd K;
  for (int level = 0; level < effort.n_levels; ++level) {
    const Samples samples = samples_of(Eigen::Index{4} << level, Eigen::Index{6} << level, false);
    PatchForce force(ContactPatch(samples.weights, samples.points), samples.shapes);
    trials.push_back(tried(force, motions, effort));
    K = force.stuck_stiffness();
  }
  const auto extrapolated = [&](std::size_t level) {
    std::vector<ForceAndJacobian> values = trials[level].values;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const ForceAndJacobian& coarse = trials[level - 1].values[i];
      values[i].force.rows() += (values[i].force.rows() - coarse.force.rows()) / 3.0;
      values[i].jacobian += (values[i].jacobian - coarse.jacobian) / 3.0;
    }
    return values;
  };
  const std::string kind = "rule over the patch";
  title(kind, "us/patch");
  const std::vector<ForceAndJacobian> exact = extrapolated(trials.size() - 1);
  const auto add = [&](const char* method, std::size_t level, Row row, double microseconds) {
    row.kind = kind;
    row.method = method;
    row.setting = 24.0 * std::pow(4.0, static_cast<double>(level));
    row.microseconds = microseconds;
    rows.push_back(row);
    print(row);
  };
  for (std::size_t level = 0; level + 1 < trials.size(); ++level) {
    const double time = trials[level].microseconds;
    add("centres of cells", level, judged(trials[level].values, exact, K, motions), time);
    if (level == 0) continue;
    add("extrapolated", level, judged(extrapolated(level), exact, K, motions),
        time + trials[level - 1].microseconds);
  }
}

std::vector<Kind> kinds() {
  const auto smooth = [](const PointParameters& point) { return SurfaceLaw(point, 0.8); };
  // Of the plain return, which knows one stiffness.
  const auto equal = [](const PointParameters& point) {
    return SurfaceLaw(point, point.tangential_stiffness);
  };
  const auto rough = [](const PointParameters& point) {
    return SurfaceLaw(point, 0.8, FrictionLaw::constant(0.4), RoughSurface::matching_gaussian(1.0));
  };
  const auto falling = [](const PointParameters& point) {
    return SurfaceLaw(point, 0.8, FrictionLaw::exponential(0.4, 0.25, 1.0));
  };
  return {{"1 harmonic", 1, false, smooth},
          {"3 harmonics", 3, false, smooth},
          {"9 harmonics", 9, false, smooth},
          {"rough surfaces, 3 harmonics", 3, false, rough},
          {"friction by speed, 3 harmonics", 3, false, falling},
          {"two directions, 1 harmonic", 1, true, equal},
          {"two directions, 3 harmonics", 3, true, equal},
          {"two directions, 9 harmonics", 9, true, equal},
          {"two directions, rough, 3 harmonics", 3, true, rough},
          {"two directions, friction by speed, 3 harmonics", 3, true, falling}};
}

void write(const std::string& path, const std::vector<Row>& rows) {
  std::ofstream file(path);
  file << "kind;method;setting;force_error;largest_error;jacobian_error;microseconds\n";
  for (const Row& row : rows) {
    file << row.kind << ';' << row.method << ';' << row.setting << ';' << row.force_error << ';'
         << row.largest_error << ';' << row.jacobian_error << ';' << row.microseconds << '\n';
  }
  if (!file.flush()) std::cerr << "bench_front: " << path << " cannot be written\n";
}

}  // namespace

int main(int argc, char** argv) {
  Effort effort;
  std::optional<std::string> csv;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--quick") {
      effort = {2, 0.0, 4, 4};
    } else if (word == "--csv" && i + 1 < argc) {
      csv = argv[++i];
    } else {
      std::cerr << "usage: bench_front [--quick] [--csv FILE]\n";
      return 1;
    }
  }
  std::vector<Row> rows;
  for (const Kind& kind : kinds()) compare(kind, effort, rows);
  compare_cells(effort, rows);
  if (csv) write(*csv, rows);
}
