// Curves that fold by the dozen take many times what constants say of one: beginning them tells.
// The seconds themselves: verification/forecasts.py.
#include "pipelines/response/curve_trial.hpp"

#include <gtest/gtest.h>

#include <ctime>
#include <string>
#include <vector>

#include "pipelines/description/curve_request.hpp"
#include "pipelines/effects/effect_choice.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/scene/scene_file.hpp"

namespace microslip::pipelines::test_curve_trial {
namespace {

constexpr const char* folded = R"toml([model]
kind = "chain"
masses = [0.39, 4.5, 0.217]
springs = [5.9e5, 1.95e5, 4.35e5]
[modes]
damping_ratio = 0.0027
[contact]
points = [ { slip = { m1 = 1, m2 = -1 }, tangential_stiffness = 2.7e6, friction_coefficient = 0.22 } ]
[excitation]
forces = [ { at = "m1", amplitude = 0.43 } ]
[response]
output = "m2"
frequency = [15, 82]
harmonics = 5
preload = [0.36]
)toml";

struct Study {
  SceneDescription scene;
  ReducedModel model;
  CurveEffects effects;
};

Study study(const std::vector<std::string>& overrides = {}) {
  std::vector<std::string> warnings;
  Study one{.scene = parse_scene(folded, "scene.toml", "/nowhere", overrides)};
  one.model = model_of(one.scene, nullptr, warnings);
  one.effects = decided_curve_effects(one.scene, one.model);
  return one;
}

ResponseSeconds tried(const Study& one, double seconds) {
  return tried_seconds(one.model, one.scene, one.effects, seconds);
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double taken(const Study& one) {
  const double begin = processor_seconds();
  const auto all = [](const auto&) { return true; };
  for (const CurveRequest& request : curve_requests(one.scene)) {
    static_cast<void>(trace_curve(one.model, one.scene, request, all));
  }
  return processor_seconds() - begin;
}

TEST(CurveTrial, OfACurveToItsEndIsWhatItTakes) {
  const Study one = study();
  const double truth = taken(one);
  constexpr double others = 3.0;  // what other programs make of the same work
  EXPECT_LT(response_seconds(one.scene, one.effects).curves, truth / others);
  const double told = tried(one, 1e3).curves;
  EXPECT_LT(told, others * truth);
  EXPECT_GT(told, truth / others);
}

TEST(CurveTrial, OfABeginningIsMoreThanIt) {
  const Study one = study();
  const double begin = processor_seconds();
  constexpr double begun = 0.05;
  const double told = tried(one, begun).curves;
  EXPECT_LT(processor_seconds() - begin, 20.0 * begun);
  EXPECT_GT(told, begun);
  EXPECT_GT(told, response_seconds(one.scene, one.effects).curves);
}

TEST(CurveTrial, MultipliesWhatIsMadeOfEvaluations) {
  const Study one = study({"response.optimum=preload", "response.optimum_range=[0.1, 10]"});
  const ResponseSeconds told = response_seconds(one.scene, one.effects);
  const ResponseSeconds measured = tried(one, 1e3);
  ASSERT_GT(told.best_value, 0.0);
  EXPECT_NE(measured.best_value, told.best_value);
  EXPECT_NEAR(measured.best_value / told.best_value, measured.bracket / told.bracket, 1e-9);
}

TEST(CurveTrial, MotionsInTimeAreNotBegun) {
  const Study one = study({"response.method=time", "response.points=4"});
  const double begin = processor_seconds();
  const double told = tried(one, 1e3).curves;
  EXPECT_NEAR(told / response_seconds(one.scene, one.effects).curves, 1.0, 1e-12);
  EXPECT_LT(processor_seconds() - begin, 0.5 * told);
}

}  // namespace
}  // namespace microslip::pipelines::test_curve_trial
