// What a run is expected to take follows what it does. The seconds themselves:
// verification/forecasts.py.
#include "pipelines/effects/curve_cost.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "pipelines/effects/effect_choice.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/scene/scene_file.hpp"

namespace microslip::pipelines::test_curve_cost {
namespace {

using Overrides = std::vector<std::string>;

constexpr const char* chain = R"toml([model]
kind = "chain"
masses = [1, 1]
springs = [41339, 41328]
[modes]
damping_ratio = 0.02
[contact]
points = [ { slip = "m1", tangential_stiffness = 4e4, friction_coefficient = 0.5 } ]
[excitation]
forces = [ { at = "m2", amplitude = 10 } ]
[response]
output = "m2"
frequency = [18, 28]
harmonics = 3
preload = ["free", 10, 30, "stuck"]
)toml";

ResponseSeconds seconds(const Overrides& overrides, bool along_r = false) {
  const SceneDescription scene = parse_scene(chain, "scene.toml", "/nowhere", overrides);
  return response_seconds(scene, curve_effects(scene, along_r));
}

TEST(CurveCost, LinearLimitsCostNothing) {
  EXPECT_EQ(seconds({"response.preload=[\"free\", \"stuck\"]"}).curves, 0.0);
  EXPECT_DOUBLE_EQ(seconds({}).curves, 2.0 * seconds({"response.preload=[10]"}).curves);
}

/// As decided on the model.
double decided_seconds(const Overrides& overrides) {
  const SceneDescription scene = parse_scene(chain, "scene.toml", "/nowhere", overrides);
  std::vector<std::string> warnings;
  const ReducedModel model = model_of(scene, nullptr, warnings);
  return response_seconds(scene, decided_curve_effects(scene, model)).curves;
}

TEST(CurveCost, OfLoadsThatHoldWhateverTheLimitsDoIsNothing) {
  EXPECT_EQ(decided_seconds({"response.preload=[1e6]"}), 0.0);
  const double one = decided_seconds({"response.preload=[10]"});
  EXPECT_GT(one, 0.0);
  EXPECT_DOUBLE_EQ(decided_seconds({"response.preload=[\"free\", 10, 1e6, 2e6]"}), one);
  EXPECT_GT(decided_seconds({"response.preload=[1e6]", "effects.nonlinearity=on"}), 0.0);
}

// Nothing opens: no other solution is near by, and none is searched.
TEST(CurveCost, OfOneFrequencyIsASearchWhereOneIsMade) {
  const Overrides one{"response.preload=[10]", "response.frequency=[22, 22]"};
  Overrides searched = one;
  searched.emplace_back("effects.coexistence=on");
  EXPECT_GT(decided_seconds(searched), 2.0 * decided_seconds(one));
}

TEST(CurveCost, MoreEffectsCostMore) {
  const double one = seconds({"response.harmonics=1"}).curves;
  const double three = seconds({}).curves;
  EXPECT_GT(three, one);
  EXPECT_GT(seconds({"response.harmonics=9"}).curves, three);
  EXPECT_GT(seconds({"response.harmonics=1"}, true).curves, one);
}

TEST(CurveCost, EveryEffectOfTheMethodCosts) {
  const SceneDescription scene = parse_scene(
      chain, "scene.toml", "/nowhere",
      {"contact.points=[{ slip = \"m1\", tangential_stiffness = 4e4, friction_coefficient = 0.5, "
       "cells = [3, 3], size = [0.1, 0.1] }]"});
  const CurveEffects given = curve_effects(scene, false);
  EXPECT_TRUE(given.areas && given.stability);
  EXPECT_FALSE(given.roughness || given.rate_dependence || given.residual);
  const double seconds = response_seconds(scene, given).total();
  for (bool CurveEffects::*effect : {&CurveEffects::roughness, &CurveEffects::rate_dependence}) {
    CurveEffects more = given;
    more.*effect = true;
    EXPECT_GT(response_seconds(scene, more).total(), seconds);
  }
  for (bool CurveEffects::*effect : {&CurveEffects::areas, &CurveEffects::stability}) {
    CurveEffects less = given;
    less.*effect = false;
    EXPECT_LT(response_seconds(scene, less).total(), seconds);
    EXPECT_GT(response_seconds(scene, less).total(), 0.0);
  }
}

/// What judging the curve of one point costs.
double stability_seconds(const Overrides& overrides) {
  const auto of_curve = [&](const char* setting) {
    Overrides all = overrides;
    all.insert(all.end(), {"response.harmonics=9", "response.preload=[30]",
                           std::string("effects.stability=") + setting});
    const SceneDescription scene = read_scene(MICROSLIP_SCENES "/chain_3dof_normal.toml", all);
    return response_seconds(scene, curve_effects(scene, false)).curves;
  };
  return of_curve("auto") - of_curve("off");
}

// Measured, processor seconds of a point of a curve with nine harmonics: 1.2 to 3.3 ms under a
// constant load, which has odd ones alone, 4.4 to 6.6 ms under one that varies.
TEST(CurveCost, JudgingAPointWhoseLoadVariesCostsMore) {
  const double varies = stability_seconds({});
  const double constant = stability_seconds({"effects.normal_motion=off"});
  EXPECT_GT(constant, 0.0);
  EXPECT_GT(varies, 2.0 * constant);  // 9/5 by the harmonics alone
}

// What a run does to tell what the effects that are off would change.
TEST(CurveCost, TheCheckOfWhatIsOffIsPartOfTheErrors) {
  const Overrides block{"response.preload=[20]", "response.maps=[]"};
  const auto errors = [&](const Overrides& more) {
    Overrides overrides = block;
    overrides.insert(overrides.end(), more.begin(), more.end());
    const SceneDescription scene = read_scene(MICROSLIP_SCENES "/block_rough.toml", overrides);
    const bool along_r = scene.settings.second_direction != Discretisation::Choice::off;
    return response_seconds(scene, curve_effects(scene, along_r)).errors;
  };
  EXPECT_EQ(errors({}), 0.0);
  const double rough = errors({"effects.roughness=off"});
  const double along_r = errors({"effects.second_direction=off"});
  EXPECT_GT(rough, 0.0);
  EXPECT_GT(along_r, 0.0);
  EXPECT_GT(errors({"effects.roughness=off", "effects.second_direction=off"}),
            along_r);  // both too
  EXPECT_EQ(errors({"effects.roughness=off", "accuracy.error_budget=off"}), 0.0);
  const auto in_time = [](const Overrides& more) {
    Overrides overrides{"response.method=time", "response.points=4"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    return seconds(overrides);
  };
  const ResponseSeconds off = in_time({"effects.normal_motion=off"});
  EXPECT_EQ(off.errors, off.curves);  // as many integrations
  EXPECT_EQ(in_time({}).errors, 0.0);
}

TEST(CurveCost, ABestValueIsToldApart) {
  EXPECT_EQ(seconds({}).best_value, 0.0);
  const ResponseSeconds searched =
      seconds({"response.optimum=preload", "response.optimum_range=[10, 100]"});
  EXPECT_EQ(searched.curves, seconds({}).curves);
  EXPECT_GT(searched.best_value, 0.0);
  EXPECT_GT(searched.bracket, searched.best_value);
}

TEST(CurveCost, OneFrequencyIsNoCurveButASearchThere) {
  const double alone = seconds({"response.frequency=20", "response.search_starts=0"}).curves;
  EXPECT_LT(alone, 0.1 * seconds({}).curves);
  EXPECT_GT(seconds({"response.frequency=20"}).curves, 2.0 * alone);
}

TEST(CurveCost, ASearchOverARangeIsPartOfTheCurves) {
  const double alone = seconds({}).curves;
  EXPECT_EQ(seconds({"response.search_starts=0"}).curves, alone);
  const double few = seconds({"effects.coexistence=on"}).curves;  // twelve starts
  EXPECT_GT(few, 1.1 * alone);
  const double many = seconds({"response.search_starts=120"}).curves;
  EXPECT_NEAR((many - alone) / (few - alone), 10.0, 1e-6);
}

TEST(CurveCost, AMotionInTimeCostsByItsFrequencies) {
  const auto in_time = [](const std::string& points) {
    return seconds({"response.method=time", "response.points=" + points}).curves;
  };
  EXPECT_GT(in_time("40"), seconds({"response.harmonics=1"}).curves);
  EXPECT_GT(in_time("80"), 1.5 * in_time("40"));
}

// What decays slowly takes long to become periodic, up to as many periods as are waited for.
TEST(CurveCost, AMotionInTimeCostsByItsDamping) {
  const auto with = [](const std::string& ratio) {
    return seconds({"response.method=time", "modes.damping_ratio=" + ratio}).curves;
  };
  EXPECT_DOUBLE_EQ(with("0.005"), 4.0 * with("0.02"));
  EXPECT_DOUBLE_EQ(with("1e-6"), with("1e-9"));
  EXPECT_DOUBLE_EQ(with("1e-6"), with("0"));
}

}  // namespace
}  // namespace microslip::pipelines::test_curve_cost
