// Motions integrated in time: what is told of their steps and of the frequencies between.
#include "pipelines/accuracy/errors_in_time.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "pipelines/accuracy/error_budget.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/scene/scene_file.hpp"

namespace microslip::pipelines::test_errors_in_time {
namespace {

struct Told {
  CurveResult curve;
  CurveBudget budget;
};

Told oscillator(const std::vector<std::string>& settings) {
  const SceneDescription scene = read_scene(MICROSLIP_SCENES "/oscillator_1dof.toml", settings);
  std::vector<std::string> warnings;
  const ReducedModel model = model_of(scene, nullptr, warnings);
  Told told;
  told.curve = trace_curve(model, scene, {"preload_1", 1.0}, [](const auto&) { return true; });
  told.budget = error_budget(model, scene, {}, told.curve);
  return told;
}

double amplitude_of(const Told& told) { return highest_peak(told.curve.curve)->amplitude; }

// Against events that are located.
TEST(ErrorsInTime, TellsWhatStepsDo) {
  const double exact = amplitude_of(oscillator({}));
  for (const char* steps : {"200", "250", "500"}) {
    const Told told = oscillator({std::string("response.steps_per_period=") + steps});
    const double bar = bar_of(told.budget.rows, "preload_1", peak_amplitude_goal);
    const double wrong = std::abs(exact / amplitude_of(told) - 1.0);
    EXPECT_NEAR(bar, wrong, 0.01 * wrong) << steps;
    EXPECT_EQ(told.budget.rows.front().source, "steps");
    EXPECT_TRUE(told.budget.unknown.empty()) << "one frequency has none beside it";
  }
}

TEST(ErrorsInTime, LocatedEventsLeaveTheApproachToTheSteadyStateAlone) {
  EXPECT_LT(bar_of(oscillator({}).budget.rows, "preload_1", peak_amplitude_goal), 1e-6);
}

// Against a sweep with ten times as many frequencies.
TEST(ErrorsInTime, TellsWhatLiesBetweenFrequencies) {
  const std::string range = "response.frequency=[0.8, 1.3]";
  const Told few = oscillator({range, "response.points=11"});
  const solver::ResponsePoint exact =
      *highest_peak(oscillator({range, "response.points=101"}).curve.curve);
  const solver::ResponsePoint& own = *highest_peak(few.curve.curve);
  const double shift = std::abs(exact.frequency / own.frequency - 1.0);
  EXPECT_GT(bar_of(few.budget.rows, "preload_1", peak_amplitude_goal),
            0.5 * (exact.amplitude / own.amplitude - 1.0));
  EXPECT_NEAR(bar_of(few.budget.rows, "preload_1", peak_frequency_goal), shift,
              0.01 / exact.frequency);
}

solver::ResponseCurve curve_of(const std::vector<std::pair<double, double>>& points) {
  solver::ResponseCurve curve;
  for (const auto& [frequency, amplitude] : points) {
    solver::ResponsePoint point;
    point.frequency = frequency;
    point.amplitude = amplitude;
    curve.points.push_back(point);
  }
  curve.complete = true;
  return curve;
}

// 3 - (ω - 2.1)², of unequal steps, swept upwards and downwards.
TEST(ErrorsInTime, FindsTheTopOfAParabola) {
  const auto at = [](double w) { return std::pair(w, 3.0 - (w - 2.1) * (w - 2.1)); };
  for (const auto& points : {std::vector{at(1.0), at(2.0), at(2.5), at(3.0)},
                             std::vector{at(3.0), at(2.5), at(2.0), at(1.0)}}) {
    const auto top = top_between(curve_of(points));
    ASSERT_TRUE(top.has_value());
    EXPECT_NEAR(2.0 * (1.0 + top->frequency), 2.1, 1e-12);
    EXPECT_NEAR(2.99 * (1.0 + top->amplitude), 3.0, 1e-12);
  }
}

TEST(ErrorsInTime, SaysNothingBesideAJumpAndAtAnEnd) {
  EXPECT_FALSE(top_between(curve_of({{1.0, 1.0}, {2.0, 3.0}, {3.0, 0.4}})).has_value());
  EXPECT_FALSE(top_between(curve_of({{1.0, 3.0}, {2.0, 2.9}, {3.0, 2.0}})).has_value());
  const auto flat = top_between(curve_of({{1.0, 3.0}, {2.0, 3.0}, {3.0, 3.0}}));
  EXPECT_TRUE(!flat || (flat->amplitude == 0.0 && flat->frequency == 0.0));
}

}  // namespace
}  // namespace microslip::pipelines::test_errors_in_time
