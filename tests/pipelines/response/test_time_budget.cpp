// A curve ends with the points it has when its time is over.
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "pipelines/description/curve_request.hpp"
#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/response/harmonics_check.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "pipelines/system/deadline.hpp"

namespace microslip::pipelines::test_time_budget {
namespace {

constexpr const char* chain = R"toml([model]
kind = "chain"
masses = [1, 1]
springs = [4e4, 1e4]
[modes]
damping_ratio = 0.03
[contact]
points = [ { slip = "m2", tangential_stiffness = 1e5, friction_coefficient = 0.5 } ]
[excitation]
forces = [ { at = "m1", amplitude = 10 } ]
[response]
output = "m2"
frequency = [10, 60]
preload = [ 8 ]
points = 4
)toml";

CurveResult curve_of(const std::string& budget, const std::string& method,
                     const std::string& harmonics = "3") {
  const SceneDescription scene =
      parse_scene(chain, "scene.toml", "/nowhere",
                  {"response.time_budget=" + budget, "response.method=" + method,
                   "response.harmonics=" + harmonics});
  ReducedModel model = reduced_model(scene);
  model.effects = contact_effects(model, scene);
  return trace_curve(model, scene, curve_requests(scene).front(), [](const auto&) { return true; });
}

// Row 82. Hard: a curve that takes longer than anybody waits.
// Met in: random scenes of five harmonics.
// Right: `budget` after response.time_budget, with the points it has.
TEST(TimeBudget, EndsACurveByItsName) {
  for (const std::string method : {"harmonic_balance", "time"}) {
    const CurveResult whole = curve_of("off", method);
    const CurveResult cut = curve_of("1e-9 s", method);
    EXPECT_TRUE(whole.curve.complete) << whole.curve.message;
    EXPECT_FALSE(cut.curve.complete);
    EXPECT_EQ(cut.curve.diagnosis, solver::Diagnosis::budget) << method;
    EXPECT_NE(cut.curve.message.find("response.time_budget, 1e-09 s, is over"), std::string::npos)
        << cut.curve.message;
    EXPECT_LT(cut.curve.points.size(), whole.curve.points.size());
    if (method == "time") {
      EXPECT_TRUE(cut.curve.points.empty());  // over after the first period
      continue;
    }
    ASSERT_FALSE(cut.curve.points.empty());
    EXPECT_EQ(cut.curve.points.front().amplitude, whole.curve.points.front().amplitude);
  }
}

/// With a budget shared among so many that nothing is left for one.
CurveResult curve_without_share(HarmonicSettings harmonics) {
  SceneDescription scene = parse_scene(chain, "scene.toml", "/nowhere", {});
  scene.settings.harmonics = std::move(harmonics);
  ReducedModel model = reduced_model(scene);
  model.effects = contact_effects(model, scene);
  begin_deadline(1000.0);
  share_time_among(1e12);
  CurveResult result =
      trace_curve(model, scene, curve_requests(scene).front(), [](const auto&) { return true; });
  begin_deadline(std::numeric_limits<double>::infinity());
  return result;
}

TEST(TimeBudget, OfARunIsSharedByItsCurves) {
  const CurveResult given = curve_without_share({.highest = 3});
  EXPECT_FALSE(given.curve.complete);
  EXPECT_FALSE(given.lacks_time);  // harmonics of the user stay
  EXPECT_EQ(given.curve.diagnosis, solver::Diagnosis::budget);
  EXPECT_NE(given.curve.message.find("its share of accuracy.budget"), std::string::npos)
      << given.curve.message;
  const CurveResult lean = curve_without_share({.highest = 3, .or_one = true});
  EXPECT_TRUE(lean.curve.complete) << lean.curve.message;
  EXPECT_TRUE(lean.lacks_time);
  EXPECT_EQ(lean.curve.points.front().q.n_harmonics(), 1);
  EXPECT_NE(lean.curve.message.find("with one harmonic"), std::string::npos);
}

TEST(TimeBudget, EndsAChoiceOfHarmonics) {
  const CurveResult cut = curve_of("1e-9 s", "harmonic_balance", "auto");
  EXPECT_FALSE(cut.curve.complete);
  EXPECT_EQ(cut.curve.diagnosis, solver::Diagnosis::budget);
}

TEST(TimeBudget, EndsTheCheckOfHarmonics) {
  const SceneDescription scene = parse_scene(chain, "scene.toml", "/nowhere", {});
  ReducedModel model = reduced_model(scene);
  model.effects = contact_effects(model, scene);
  CurveResult result = curve_of("off", "harmonic_balance", "1");
  ASSERT_TRUE(result.richer && result.richer->change);
  SceneDescription checked = scene;
  checked.settings.harmonics.highest = 1;
  checked.settings.harmonics.orders.clear();
  checked.settings.harmonics.tolerance = 0.0;
  checked.settings.harmonics.checked = true;
  int questions = 0;
  check_harmonics(model, checked, std::get<double>(result.load), result, [&] {
    ++questions;
    return true;
  });
  EXPECT_GT(questions, 0);
  EXPECT_FALSE(result.richer);  // not known, where "not found" would ask for more harmonics
  EXPECT_TRUE(result.curve.complete);
  EXPECT_NE(result.curve.message.find("stopped before its harmonics were checked"),
            std::string::npos)
      << result.curve.message;
}

TEST(TimeBudget, IsAnHourUnlessItIsGiven) {
  EXPECT_EQ(parse_scene(chain, "scene.toml", "/nowhere", {}).response->time_budget, 3600.0);
}

}  // namespace
}  // namespace microslip::pipelines::test_time_budget
