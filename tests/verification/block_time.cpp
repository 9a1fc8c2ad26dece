// The rigid block on rough cells (theory section 20.6, share/scenes/block_rough.toml) by harmonic
// balance and by event-located integration in time: cells stick, slip in ellipses and part, normal
// force and moments vary. Half peak-to-peak of the output; the named tolerance is 0.2 % of the
// peak, with 9 harmonics. Both methods know the same laws by different code: collocation over given
// harmonics there, an ordinary differential equation for the direction of slip here.
//
// Integration starts from rest, so cells that never slip may keep a mean friction of their own
// (theory section 4.2): first harmonics and amplitudes are compared, means are not.
//
// The same for smooth surfaces, for friction that falls with the speed, and by the return map with
// fixed steps, which is of first order: 2000 steps a period keep it within the tolerance too.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/response/solver_scenes.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "solver/continuation.hpp"
#include "solver/time_integration.hpp"
#include "tests/support/campaign.hpp"
#include "tests/support/steady_states.hpp"

namespace microslip::pipelines::block_time {
namespace {

constexpr double named_tolerance = 2e-3;

struct Block {
  SceneDescription scene;
  ReducedModel model;
};

Block block(std::vector<std::string> settings) {
  settings.emplace_back("response.harmonics=9");
  Block result{read_scene(MICROSLIP_SCENES "/block_rough.toml", settings), {}};
  result.model = reduced_model(result.scene);
  result.model.effects = contact_effects(result.model, result.scene);
  return result;
}

/// Far below the named tolerance.
solver::TimeOptions close_enough() {
  solver::TimeOptions options;
  options.step_tolerance = 1e-8;
  options.periodicity_tolerance = 1e-6;
  return options;
}

struct Pair {
  solver::ResponsePoint balance;
  solver::TimePoint time;
};

Pair solve(const Block& block, double load, double frequency_hz,
           const solver::TimeOptions& time_options = close_enough()) {
  const double omega = 2.0 * std::numbers::pi * frequency_hz;
  solver::ContinuationOptions options = continuation_options(block.scene, block.model);
  solver::Scene scene = solver_scene(block.model, load);
  scene.transient = contact_of(block.model, load).transient_force();
  const auto curve = solver::solve_at_frequency(scene, omega, options);
  EXPECT_TRUE(curve.complete) << curve.message;
  Pair pair{curve.points.at(0), tests::steady_state(scene, omega, time_options)};
  EXPECT_EQ(pair.time.period_multiple, 1);
  return pair;
}

double difference(const Pair& pair) {
  const auto& a = pair.balance.q.rows();
  const auto& b = pair.time.response.q.rows();
  return std::max(std::abs(pair.balance.amplitude - pair.time.response.amplitude) /
                      pair.time.response.amplitude,
                  (a.middleRows(1, 2) - b.middleRows(1, 2)).norm() / b.middleRows(1, 2).norm());
}

void print(const char* name, double load, double hz, const Pair& pair) {
  const auto& report = pair.time.response.report;
  std::printf(
      "%-12s %3g N %5.1f Hz: %.6e m, in time %.6e m; stick %.2f slip %.2f open %.2f; %ld "
      "events, %d periods\n",
      name, load, hz, pair.balance.amplitude, pair.time.response.amplitude, report.stick_share,
      report.slip_share, report.separated_share, pair.time.n_events, pair.time.n_periods);
}

TEST(BlockInTime, AgreesWithHarmonicBalanceOnRoughCells) {
  const Block rough = block({});
  std::vector<Pair> pairs;
  double peak = 0.0;
  // 27.7 Hz: the highest peak at 20 N
  for (const double hz : tests::campaign_values({22.0, 27.7, 33.0}, {22.0, 27.7})) {
    pairs.push_back(solve(rough, 20.0, hz));
    print("rough", 20.0, hz, pairs.back());
    peak = std::max(peak, pairs.back().balance.amplitude);
  }
  for (const Pair& pair : pairs) {
    EXPECT_LT(std::abs(pair.balance.amplitude - pair.time.response.amplitude),
              named_tolerance * peak);
  }
  // What the surfaces dissipate is not the work of the contact's force, whose stiffness follows the
  // load.
  const double in_time = pairs[1].time.response.energy.friction;
  EXPECT_NEAR(pairs[1].balance.energy.friction, in_time, 4.0 * named_tolerance * in_time);
  EXPECT_GT(pairs[1].time.response.report.slip_share, 0.3);
  // At 22 Hz most cells stick: on the history of the balance both are nearer than from rest.
  solver::Scene scene = solver_scene(rough.model, 20.0);
  scene.transient = contact_of(rough.model, 20.0).transient_force();
  Pair same = pairs[0];
  same.time =
      tests::steady_state_from(scene, same.balance.frequency, same.balance.q, close_enough());
  print("its history", 20.0, 22.0, same);
  EXPECT_LT(difference(same), 0.5 * difference(pairs[0]));
}

TEST(BlockInTime, AgreesWhereCellsPart) {
  const Pair pair = solve(block({}), 6.0, 22.0);
  print("rough", 6.0, 22.0, pair);
  EXPECT_GT(pair.time.response.report.separated_share, 0.3);
  EXPECT_LT(difference(pair), named_tolerance);
}

TEST(BlockInTime, AgreesOnSmoothCells) {
  const Block smooth = block({"contact.roughness={ law = \"cubic\", height = 0 }"});
  for (const double load : tests::campaign_values({6.0, 20.0}, {6.0})) {
    const Pair pair = solve(smooth, load, load < 10.0 ? 22.0 : 27.7, {});
    print("smooth", load, load < 10.0 ? 22.0 : 27.7, pair);
    EXPECT_LT(difference(pair), named_tolerance);
    EXPECT_LT(pair.time.response.energy_imbalance, 1e-7);  // periodicity 1e-7
  }
}

TEST(BlockInTime, AgreesWithFrictionThatFallsWithTheSpeed) {
  const Pair pair = solve(block({"contact.friction_coefficient={ law = \"exponential\", static = "
                                 "0.6, kinetic = 0.3, rate = \"20 s/m\" }"}),
                          20.0, 27.7);
  print("by speed", 20.0, 27.7, pair);
  EXPECT_LT(difference(pair), named_tolerance);
}

TEST(BlockInTime, TheReturnMapFindsTheSameToFirstOrder) {
  solver::TimeOptions options;
  options.method = solver::TimeMethod::rk4;
  options.steps_per_period = 2000;
  const Pair pair = solve(block({}), 20.0, 27.7, options);
  print("return map", 20.0, 27.7, pair);
  EXPECT_LT(difference(pair), named_tolerance);
}

}  // namespace
}  // namespace microslip::pipelines::block_time
