// Event-locating integration against CVODE of SUNDIALS, an independent third: its own integrator
// (Adams, relative tolerance 1e-12), its own root finding, and the contact law of theory section 3
// written down here once more, point by point, without any code of contact/ or solver/.
//
// Both start at rest with virgin sliders; q and q̇ are compared after a few periods, at θ = 0,
// while the transient with all its events lasts. Tolerance 1e-9 of the largest motion: both allow
// 1e-12 per step, over some thousand steps; 1e-10 is what is met.

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include <cvode/cvode.h>
#include <gtest/gtest.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "solver/time/time_stepper.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"
#include "tests/support/readable_patch.hpp"

namespace microslip::time_integration {
namespace {

constexpr double tolerance = 1e-9;
constexpr double cvode_tolerance = 1e-12;

enum class State { stick, positive, negative, open };

/// A scene read as numbers, with the law of theory sections 2, 3 on its own.
struct Referee {
  const solver::Scene& scene;
  const tests::ReadablePatch& patch;
  double omega;
  std::vector<State> state;
  std::vector<double> slider;
  long n_events = 0;

  Referee(const solver::Scene& a_scene, double frequency)
      : scene(a_scene),
        patch(dynamic_cast<const tests::ReadablePatch&>(*a_scene.contact)),
        omega(frequency),
        state(patch.patch().points().size(), State::stick),
        slider(state.size(), 0.0) {
    for (std::size_t i = 0; i < state.size(); ++i) {
      if (point(i).rest_load <= 0.0) state[i] = State::open;
    }
  }
  [[nodiscard]] const contact::PointParameters& point(std::size_t i) const {
    return patch.patch().points()[i];
  }
  /// u, v, u̇, v̇ of a point.
  [[nodiscard]] std::array<double, 4> motion(std::size_t i, const double* y) const {
    const Eigen::Index n = scene.n_modes();
    std::array<double, 4> m{};
    for (Eigen::Index k = 0; k < n; ++k) {
      const double phi_u = patch.shapes().u(static_cast<Eigen::Index>(i), k);
      const double phi_v = patch.shapes().v(static_cast<Eigen::Index>(i), k);
      m[0] += phi_u * y[k];
      m[1] += phi_v * y[k];
      m[2] += phi_u * y[n + k];
      m[3] += phi_v * y[n + k];
    }
    return m;
  }
  void right_side(double t, const double* y, double* rate) const {
    const Eigen::Index n = scene.n_modes();
    for (Eigen::Index k = 0; k < n; ++k) {
      const double wn = scene.natural_frequency[k];
      const auto& Q = scene.excitation.rows();
      rate[k] = y[n + k];
      rate[n + k] = Q(0, k) + Q(1, k) * std::sin(omega * t) + Q(2, k) * std::cos(omega * t) -
                    2.0 * scene.damping_ratio[k] * wn * y[n + k] - wn * wn * y[k];
    }
    for (std::size_t i = 0; i < state.size(); ++i) {
      const auto [u, v, du, dv] = motion(i, y);
      const contact::PointParameters& p = point(i);
      double load = p.rest_load + p.normal_stiffness * v;
      double f = 0.0;
      if (state[i] == State::open) load = 0.0;
      if (state[i] == State::stick) f = p.tangential_stiffness * (u - slider[i]);
      if (state[i] == State::positive) f = p.friction_coefficient * load;
      if (state[i] == State::negative) f = -p.friction_coefficient * load;
      const auto row = static_cast<Eigen::Index>(i);
      const double w = patch.patch().weights()[row];
      for (Eigen::Index k = 0; k < n; ++k) {
        rate[n + k] -= w * (patch.shapes().u(row, k) * f +
                            patch.shapes().v(row, k) * (load - std::max(p.rest_load, 0.0)));
      }
    }
  }
  /// Two per point; the state ends where one falls through zero.
  void guards(const double* y, double* g) const {
    for (std::size_t i = 0; i < state.size(); ++i) {
      const auto [u, v, du, dv] = motion(i, y);
      const contact::PointParameters& p = point(i);
      const double load = p.rest_load + p.normal_stiffness * v;
      const double limit = p.friction_coefficient * load;
      const double f = p.tangential_stiffness * (u - slider[i]);
      const double a = p.tangential_stiffness * du;
      const double b = p.friction_coefficient * p.normal_stiffness * dv;
      g[2 * i + 1] = load;
      switch (state[i]) {
        case State::stick:
          g[2 * i] = limit - f;
          g[2 * i + 1] = limit + f;
          break;
        case State::positive:
          g[2 * i] = a - b;
          break;
        case State::negative:
          g[2 * i] = -a - b;
          break;
        case State::open:
          g[2 * i] = -load;
          g[2 * i + 1] = 1.0;
          break;
      }
    }
  }
  void change(std::size_t i, bool second, const double* y) {
    const auto [u, v, du, dv] = motion(i, y);
    const contact::PointParameters& p = point(i);
    const double b = p.friction_coefficient * p.normal_stiffness * dv;
    const double a = p.tangential_stiffness * du;
    const double g =
        p.friction_coefficient * (p.rest_load + p.normal_stiffness * v) / p.tangential_stiffness;
    ++n_events;
    switch (state[i]) {
      case State::stick:
        state[i] = second ? State::negative : State::positive;
        break;
      case State::positive:
        slider[i] = u - g;
        state[i] = second ? State::open : State::stick;
        break;
      case State::negative:
        slider[i] = u + g;
        state[i] = second ? State::open : State::stick;
        break;
      case State::open:
        slider[i] = u;
        state[i] = a > b ? State::positive : (a < -b ? State::negative : State::stick);
        break;
    }
  }
};

int right_side(realtype t, N_Vector y, N_Vector rate, void* referee) {
  static_cast<Referee*>(referee)->right_side(t, N_VGetArrayPointer(y), N_VGetArrayPointer(rate));
  return 0;
}

int guards(realtype /*t*/, N_Vector y, realtype* g, void* referee) {
  static_cast<Referee*>(referee)->guards(N_VGetArrayPointer(y), g);
  return 0;
}

struct CvodeEnd {
  Eigen::VectorXd state;  // q, q̇
  double size = 0.0;      // largest ‖q‖ seen at events and period ends
  long n_events = 0;
};

/// CVODE, restarted after every event, over some periods.
CvodeEnd integrate_by_cvode(const solver::Scene& scene, double frequency, int n_periods) {
  Referee referee(scene, frequency);
  SUNContext context = nullptr;
  EXPECT_EQ(SUNContext_Create(nullptr, &context), 0);
  const Eigen::Index n = scene.n_modes();
  N_Vector y = N_VNew_Serial(2 * n, context);
  N_VConst(0.0, y);
  void* cvode = CVodeCreate(CV_ADAMS, context);
  EXPECT_EQ(CVodeInit(cvode, right_side, 0.0, y), CV_SUCCESS);
  // Absolute: far below any motion that matters here.
  EXPECT_EQ(CVodeSStolerances(cvode, cvode_tolerance, 1e-18), CV_SUCCESS);
  SUNNonlinearSolver solver = SUNNonlinSol_FixedPoint(y, 0, context);
  EXPECT_EQ(CVodeSetNonlinearSolver(cvode, solver), CV_SUCCESS);
  EXPECT_EQ(CVodeSetUserData(cvode, &referee), CV_SUCCESS);
  EXPECT_EQ(CVodeSetMaxNumSteps(cvode, 10'000'000), CV_SUCCESS);
  const auto n_guards = static_cast<int>(2 * referee.state.size());
  std::vector<int> falling(static_cast<std::size_t>(n_guards), -1);
  EXPECT_EQ(CVodeRootInit(cvode, n_guards, guards), CV_SUCCESS);
  EXPECT_EQ(CVodeSetRootDirection(cvode, falling.data()), CV_SUCCESS);
  EXPECT_EQ(CVodeSetNoInactiveRootWarn(cvode), CV_SUCCESS);
  const double end = n_periods * 2.0 * M_PI / frequency;
  CvodeEnd result;
  for (double t = 0.0; t < end;) {
    CVodeSetStopTime(cvode, end);
    const int flag = CVode(cvode, end, y, &t, CV_NORMAL);
    EXPECT_GE(flag, 0) << "at " << t;
    if (flag < 0) break;
    const double* state = N_VGetArrayPointer(y);
    result.size = std::max(result.size, Eigen::Map<const Eigen::VectorXd>(state, n).norm());
    if (flag != CV_ROOT_RETURN) continue;
    std::vector<int> found(static_cast<std::size_t>(n_guards));
    CVodeGetRootInfo(cvode, found.data());
    for (std::size_t i = 0; i < referee.state.size(); ++i) {
      const bool first = found[2 * i] != 0;
      if (first || found[2 * i + 1] != 0) referee.change(i, !first, state);
    }
    CVodeReInit(cvode, t, y);
  }
  result.state = Eigen::Map<const Eigen::VectorXd>(N_VGetArrayPointer(y), 2 * n);
  result.n_events = referee.n_events;
  SUNNonlinSolFree(solver);
  CVodeFree(&cvode);
  N_VDestroy(y);
  SUNContext_Free(&context);
  return result;
}

void expect_the_same(const char* name, solver::Scene scene, double frequency, int n_periods) {
  const CvodeEnd expected = integrate_by_cvode(scene, frequency, n_periods);
  tests::add_transient(scene);
  const solver::TimeSystem system(scene, frequency);
  solver::TimeOptions options;
  options.step_tolerance = 1e-12;
  const auto stepper = solver::make_stepper(system, options);
  solver::TimeState state = solver::state_at_rest(system);
  for (int i = 0; i < n_periods; ++i) stepper->advance_period(state, nullptr);
  const Eigen::Index n = scene.n_modes();
  const double displacement = (state.motion.q - expected.state.head(n)).norm() / expected.size;
  const double velocity =
      (state.motion.velocity - expected.state.tail(n)).norm() / (frequency * expected.size);
  std::printf("%-24s %3d periods, events %4ld (CVODE %4ld), difference q %.1e, velocity %.1e\n",
              name, n_periods, stepper->n_events(), expected.n_events, displacement, velocity);
  EXPECT_GT(expected.n_events, 0) << name;
  EXPECT_EQ(stepper->n_events(), expected.n_events) << name;
  EXPECT_LT(displacement, tolerance) << name;
  EXPECT_LT(velocity, tolerance) << name;
}

TEST(EventsAgainstCvode, OscillatorOfPaperBFigure6) {
  for (const double ratio : {0.75, 0.5, 0.25, 0.15}) {
    tests::SinglePoint single;
    single.damping_ratio = 0.05;
    single.point = {100.0, 0.0, 0.5, 1.0};
    expect_the_same("oscillator", tests::single_point_scene(single), ratio, 4);
  }
}

TEST(EventsAgainstCvode, ThreeDegreesOfFreedomWithSeparation) {
  for (const double preload : {-5.0, 10.0, 20.0, 30.0}) {
    expect_the_same("three degrees of freedom", tests::three_dof_scene(preload), 2.0 * M_PI * 20.5,
                    12);
  }
}

TEST(EventsAgainstCvode, RandomPatches) {
  for (const std::uint64_t seed : {6U, 8U, 16U, 23U, 29U, 53U}) {  // many points, all states
    solver::Scene scene = tests::random_scene(seed).scene;
    const double frequency = 1.02 * scene.natural_frequency[0];
    expect_the_same("random patch", std::move(scene), frequency, 4);
  }
}

}  // namespace
}  // namespace microslip::time_integration
