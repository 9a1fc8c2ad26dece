/// @file
/// A patch in lanes (contact/sampled) beside methods that find their cycles point by point: error
/// of the modal force and of the Jacobian, relative to the larger of the norm and that of the stuck
/// patch, against µs per awake point, ten modes, on one core:
///
///   line   one direction, against located events    (line_events.hpp)
///   plane  two directions, against planar events    (planar_cycle.hpp)
///
/// for 1, 3, 9 harmonics and n = 32 … 2048 instants. Prints a table; no argument.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "contact/force/point_method_force.hpp"
#include "contact/line/line_events.hpp"
#include "contact/plane/planar_cycle.hpp"
#include "contact/sampled/patch_force.hpp"
#include "tests/support/asked_force.hpp"

namespace {

using namespace microslip::contact;
namespace tests = microslip::tests;
using sampled::PatchForce;

constexpr Eigen::Index n_modes = 10;

/// Of this thread: a busy machine does not show.
double seconds_spent() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Shapes like those of a blade: each mode smooth over the patch, the first along p largest.
ModalShapes shapes_of(Eigen::Index n, bool second_direction) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto shape = [&] {
    return Eigen::MatrixXd::NullaryExpr(n, n_modes, [&] { return uniform(random); });
  };
  ModalShapes shapes{shape(), shape(), {}};
  if (second_direction) shapes.w = shape();
  return shapes;
}

Harmonics motion_of(int n_harmonics) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> gauss(0.0, 0.5);
  Harmonics q(n_harmonics, n_modes);
  for (Eigen::Index k = 1; k < q.rows().rows(); ++k) {
    const auto h = static_cast<double>((k + 1) / 2);
    for (Eigen::Index m = 0; m < n_modes; ++m) q.rows()(k, m) = gauss(random) / (h * h);
  }
  return q;
}

/// Loads from a gap to twice what the motion needs to part: all states.
std::vector<SurfaceLaw> surfaces_of(Eigen::Index n) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> load(-0.3, 2.0);
  std::vector<SurfaceLaw> surfaces;
  for (Eigen::Index i = 0; i < n; ++i) {
    surfaces.emplace_back(PointParameters{1.0, 0.5, 0.4, load(random)}, 1.0);
  }
  return surfaces;
}

struct Timed {
  ForceAndJacobian value;
  double whole = 0.0;  // µs per point
  double force = 0.0;
};

Timed timed(const ModalForce& force, const Harmonics& q, Eigen::Index n) {
  Timed result;
  const auto work = force.workspace();
  result.value = tests::evaluate(force, q, 1.0, *work);
  const auto measure = [&](const std::function<void()>& run) {
    double best = 1e30;
    for (int round = 0; round < 3; ++round) {
      int repeats = 0;
      const double begin = seconds_spent();
      double spent = 0.0;
      for (; spent < 0.05; ++repeats, spent = seconds_spent() - begin) run();
      best = std::min(best, spent / repeats);
    }
    return 1e6 * best / static_cast<double>(n);
  };
  result.whole = measure([&] { static_cast<void>(tests::evaluate(force, q, 1.0, *work)); });
  result.force = measure([&] { static_cast<void>(force.evaluate(q, 1.0, {}, *work)); });
  return result;
}

void print(const std::string& name, int H, const Timed& row, const Timed& exact, PatchForce& patch,
           const Harmonics& q) {
  const Eigen::MatrixXd K = patch.stuck_stiffness();
  const double scale = std::max(exact.value.force.rows().norm(), (q.rows() * K).norm());
  const double stiffness = std::max(exact.value.jacobian.norm(), K.norm());
  std::printf("%-18s %2d  %9.2e %9.2e  %8.3f %8.3f\n", name.c_str(), H,
              (row.value.force.rows() - exact.value.force.rows()).norm() / scale,
              (row.value.jacobian - exact.value.jacobian).norm() / stiffness, row.whole, row.force);
  std::fflush(stdout);
}

void compare(int H, bool second_direction, Eigen::Index n) {
  const ModalShapes shapes = shapes_of(n, second_direction);
  const std::vector<SurfaceLaw> surfaces = surfaces_of(n);
  const Harmonics q = motion_of(H);
  const Eigen::VectorXd weights = Eigen::VectorXd::Ones(n);
  std::vector<std::shared_ptr<const PointMethod>> methods;
  for (const SurfaceLaw& surface : surfaces) {
    if (second_direction) {
      methods.push_back(std::make_shared<PlaneEvents>(surface));
    } else {
      methods.push_back(std::make_shared<LineEvents>(surface.point()));
    }
  }
  PointMethodForce reference(weights, methods, shapes);
  const Timed exact = timed(reference, q, n);
  const std::string name = second_direction ? "plane" : "line";
  PatchForce first(weights, surfaces, shapes, {32});
  const CycleReport report = tests::report(first, q, 1.0);
  std::printf("%s: awake %.2f, stick %.2f, slip %.2f, apart %.2f\n", name.c_str(),
              report.awake_share, report.stick_share, report.slip_share, report.separated_share);
  for (int instants = 32; instants <= 2048; instants *= 2) {
    if (instants < 8 * (H + 1)) continue;
    PatchForce patch(weights, surfaces, shapes, instants);
    print(name + " n = " + std::to_string(instants), H, timed(patch, q, n), exact, first, q);
  }
  print(second_direction ? "planar events" : "located events", H, exact, exact, first, q);
}

}  // namespace

int main() {
  std::printf("%-18s %2s  %9s %9s  %8s %8s\n", "", "H", "G", "dG/dq", "us/point", "force");
  for (const int H : {1, 3, 9}) compare(H, false, 384);
  for (const int H : {1, 3, 9}) compare(H, true, 64);
}
