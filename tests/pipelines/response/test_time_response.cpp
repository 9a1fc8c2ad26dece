// Curves integrated in time: what is told of motions that do not repeat with the excitation, and
// fixed steps.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/curve_requirements.hpp"
#include "pipelines/response/solver_scenes.hpp"
#include "pipelines/response/time_response.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines::test_time_response {
namespace {

using Overrides = std::vector<std::string>;

// A mass that rests on a one-sided spring: driven at twice the frequency of its free motion it
// answers at half of the excitation's.
constexpr const char* bilinear = R"toml([model]
kind = "modal"
[modal]
frequency = [20]
damping_ratio = 0.01
force_sine = [1]
output = [1]
[[modal.points]]
weight = 1
tangential_stiffness = 0
normal_stiffness = 5e4
friction_coefficient = 0
preload = 0
phi_u_1 = 0
phi_v_1 = 1
[response]
frequency = 26.9
method = "time"
)toml";

solver::ResponseCurve curve_of(const Overrides& overrides, const std::function<bool()>& stop = {}) {
  const SceneDescription scene = parse_scene(bilinear, "scene.toml", "/nowhere", overrides);
  ReducedModel model = reduced_model(scene);
  model.effects = contact_effects(model, scene);
  solver::Scene problem = solver_scene(model, 1.0);
  problem.transient = contact_of(model, 1.0).transient_force();
  return integrate_curve(problem, scene, {}, stop);
}

TEST(TimeResponse, AMotionOfTwicePeriodIsTold) {
  const solver::ResponseCurve plain = curve_of({});
  ASSERT_EQ(plain.points.size(), 1U);
  EXPECT_TRUE(plain.complete);
  EXPECT_TRUE(plain.message.empty()) << plain.message;
  EXPECT_EQ(plain.points[0].stability, solver::Stability::stable);
  const solver::ResponseCurve doubled = curve_of({"response.frequency=53.8"});
  ASSERT_EQ(doubled.points.size(), 1U);
  EXPECT_TRUE(doubled.complete);
  EXPECT_NE(doubled.message.find("53.8 Hz, the motion repeats after several periods"),
            std::string::npos)
      << doubled.message;
  EXPECT_EQ(doubled.points[0].stability, solver::Stability::not_assessed);
}

// Row 82. Hard: one point of a motion in time may take longer than anybody waits.
// Met in: motions of little damping.
// Right: stopped within the point, those before are kept.
TEST(TimeResponse, IsStoppedWithinAPointAndKeepsThoseBefore) {
  const Overrides sweep{"response.frequency=[25.0, 26.9]", "response.points=3",
                        "modal.damping_ratio=0.05"};
  const solver::ResponseCurve whole = curve_of(sweep);
  ASSERT_EQ(whole.points.size(), 3U);
  const int before = whole.points[0].iterations + whole.points[1].iterations;
  int periods = 0;
  const solver::ResponseCurve cut = curve_of(sweep, [&] { return ++periods == before + 5; });
  EXPECT_EQ(periods, before + 5);  // none is integrated after that
  EXPECT_FALSE(cut.complete);
  EXPECT_EQ(cut.diagnosis, solver::Diagnosis::interrupted);
  EXPECT_NE(cut.message.find("stopped at 26.9 Hz"), std::string::npos) << cut.message;
  ASSERT_EQ(cut.points.size(), 2U);
  for (std::size_t i = 0; i < cut.points.size(); ++i) {
    EXPECT_EQ(cut.points[i].amplitude, whole.points[i].amplitude);
  }
}

TEST(TimeResponse, FixedStepsConvergeToLocatedEvents) {
  const double exact = curve_of({}).points.at(0).amplitude;
  const double coarse = curve_of({"response.steps_per_period=200"}).points.at(0).amplitude;
  const double fine = curve_of({"response.steps_per_period=3200"}).points.at(0).amplitude;
  EXPECT_GT(std::abs(coarse - exact), 1e-9 * exact);  // another way, indeed
  EXPECT_LT(std::abs(fine - exact), 1e-5 * exact);
  EXPECT_LT(std::abs(fine - exact), 0.1 * std::abs(coarse - exact));  // first order would give 1/16
}

TEST(TimeResponse, TooFewStepsAreRefusedWithTheNumberNeeded) {
  try {
    static_cast<void>(curve_of({"response.steps_per_period=2"}));
    ADD_FAILURE() << "2 steps were taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("needs at least"), std::string::npos) << error.what();
  }
}

TEST(TimeResponse, TooFewStepsAreKnownBeforeACurveIsTraced) {
  const auto complaint = [](const Overrides& overrides) -> std::string {
    const SceneDescription scene = parse_scene(bilinear, "scene.toml", "/nowhere", overrides);
    ReducedModel model = reduced_model(scene);
    model.effects = contact_effects(model, scene);
    try {
      require_curves(model, scene);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  };
  // The stuck mass moves at √(40²π² + 5e4)/2π = 40.8 Hz: π·40.8/13 = 9.85 steps at 13 Hz, 3.2 at 40
  // Hz.
  const std::string few = complaint({"response.frequency=[40, 13]", "response.steps_per_period=9"});
  EXPECT_NE(few.find("--set response.steps_per_period=9: response.steps_per_period: 9 steps"),
            std::string::npos)
      << few;
  EXPECT_NE(few.find("40.8"), std::string::npos) << few;
  EXPECT_NE(few.find("at 13 Hz excitation that takes at least 10"), std::string::npos) << few;
  EXPECT_EQ(complaint({"response.frequency=[40, 13]", "response.steps_per_period=10"}), "");
  EXPECT_EQ(complaint({"response.frequency=[40, 13]"}), "");
}

TEST(TimeResponse, StepsAreForIntegrationInTime) {
  const Overrides overrides{"response.steps_per_period=500", "response.method=harmonic_balance"};
  EXPECT_THROW(static_cast<void>(parse_scene(bilinear, "scene.toml", "/nowhere", overrides)),
               SceneError);
}

}  // namespace
}  // namespace microslip::pipelines::test_time_response
