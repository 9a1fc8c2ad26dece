// Effects that a scene leaves out: what is simulated then, and what is told of it.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "contact/harmonics.hpp"
#include "pipelines/description/effects_left_out.hpp"
#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/effects/effect_choice.hpp"
#include "pipelines/effects/effect_indicators.hpp"
#include "pipelines/effects/effects.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/effects/simulated_scene.hpp"
#include "pipelines/files/model_file.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/model/scene_warnings.hpp"
#include "pipelines/response/effects_of_curves.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/effect_table.hpp"
#include "tests/support/asked_force.hpp"

namespace microslip::pipelines::test_effects {
namespace {

using Overrides = std::vector<std::string>;

// One point that lifts off, one with a gap.
constexpr const char* text = R"toml([model]
kind = "modal"
[modal]
frequency = [10, 20]
damping_ratio = 0.01
force_sine = [1, 0]
output = [1, 0]
[[modal.points]]
weight = 1
tangential_stiffness = 2e3
normal_stiffness = 3e3
friction_coefficient = 0.4
preload = 20
phi_u_1 = 1
phi_u_2 = 0.3
phi_v_1 = 0.5
phi_v_2 = -1
[[modal.points]]
weight = 2
tangential_stiffness = 1e3
normal_stiffness = 1e3
friction_coefficient = 0.4
preload = -5
phi_u_1 = 1
phi_u_2 = 0.1
phi_v_1 = 0.2
phi_v_2 = 1
[response]
frequency = 12
)toml";

ReducedModel model_in(const SceneDescription& scene) {
  ReducedModel model = reduced_model(scene);
  model.effects = contact_effects(model, scene);
  return model;
}

ReducedModel model_of(const Overrides& overrides) {
  return model_in(parse_scene(text, "scene.toml", "/nowhere", overrides));
}

// Large enough for slip, separation and touching of the gap.
contact::ForceAndJacobian force_of(const ReducedModel& model, int n_harmonics) {
  contact::Harmonics q(n_harmonics, 2);
  for (Eigen::Index i = 0; i < q.rows().size(); ++i) {
    q.rows().data()[i] = 0.02 * (i % 2 == 0 ? 1.0 : -0.7) / (1.0 + static_cast<double>(i));
  }
  return tests::evaluate(*contact_of(model, 1.0).modal_force(), q, 70.0);
}

TEST(Effects, WithoutNormalMotionTheLoadStaysThatOfRest) {
  for (const int n_harmonics : {1, 3}) {
    const std::string harmonics = "response.harmonics=" + std::to_string(n_harmonics);
    const contact::ForceAndJacobian with = force_of(model_of({harmonics}), n_harmonics);
    const contact::ForceAndJacobian without =
        force_of(model_of({harmonics, "effects.normal_motion=off"}), n_harmonics);
    ReducedModel rigid = model_of({harmonics});
    rigid.patches[0].cells.stiffness.col(1).setZero();
    const contact::ForceAndJacobian expected = force_of(rigid, n_harmonics);
    EXPECT_EQ((without.force.vector() - expected.force.vector()).norm(), 0.0);
    EXPECT_EQ((without.jacobian - expected.jacobian).norm(), 0.0);
    EXPECT_GT((with.force.vector() - expected.force.vector()).norm(),
              0.01 * expected.force.vector().norm());
  }
}

TEST(Effects, LoadsAreThoseOfGapsStaticForcesAndSearchesToo) {
  SceneDescription scene = parse_scene(text, "scene.toml", "/nowhere", {});
  ReducedModel model = reduced_model(scene);
  model.static_preload = 7.0;
  scene.response->preload = {StaticPreload{}, UniformGap{1e-3}, 30.0, LimitName::free};
  scene.response->optimum = OptimumRequest{.key = "preload", .range = std::array{2.0, 9.0}};
  const double gap = -1e-3 * (3e3 + 2.0 * 1e3);
  EXPECT_EQ(loads_of(model, scene), (std::vector{7.0, gap, 30.0, 2.0, 9.0}));
}

TEST(Effects, ThoseLeftOutAreToldWithTheKeyThatDidIt) {
  const SceneDescription scene =
      parse_scene(text, "scene.toml", "/nowhere", {"effects.normal_motion=off"});
  const ReducedModel model = model_in(scene);
  int n_told = 0;
  for (const EffectRecord& effect : effects_of(scene, &model)) {
    if (effect.name != "normal_motion" && effect.name != "separation" &&
        effect.name != "mean_coupling") {
      continue;
    }
    ++n_told;
    EXPECT_EQ(effect.simulated, Simulated::no) << effect.name;
    EXPECT_NE(effect.reason.find("effects.normal_motion"), std::string::npos) << effect.reason;
  }
  EXPECT_EQ(n_told, 3);
}

// One mode, one point, at the resonance of the stuck limit: all numbers can be told by hand.
constexpr const char* one = R"toml([model]
kind = "modal"
[modal]
frequency = [10]
damping_ratio = 0.01
force_sine = [0]
force_cosine = [1]
output = [1]
[[modal.points]]
weight = 1
tangential_stiffness = 3e3
normal_stiffness = 2e3
friction_coefficient = 0.5
preload = 4
phi_u_1 = 1
phi_v_1 = 0.5
[response]
frequency = 12
harmonics = 1
)toml";

SceneDescription scene_of(const Overrides& overrides) {
  return parse_scene(one, "scene.toml", "/nowhere", overrides);
}

/// Amplitude of the one mode with stiffness k added.
double amplitude(double k, double frequency_hz) {
  const double omega = 2.0 * std::numbers::pi * frequency_hz;
  const double omega_n = 2.0 * std::numbers::pi * 10.0;
  return 1.0 / std::hypot(omega_n * omega_n + k - omega * omega, 0.02 * omega_n * omega);
}

TEST(Effects, WhatASceneCannotHaveHasNoCost) {
  const auto cost = [](const SceneDescription& scene, const char* name) {
    const ReducedModel model = model_in(scene);
    return effect_in(effects_of(scene, &model), name).seconds;
  };
  const SceneDescription chain = read_scene(MICROSLIP_SCENES "/chain_2dof.toml", {});
  for (const char* name : {"second_direction", "roughness", "rate_dependence", "moments"}) {
    EXPECT_FALSE(cost(chain, name).has_value()) << name;
  }
  EXPECT_GT(cost(chain, "higher_harmonics").value_or(0.0), 0.0);
  // One that moves along p alone, on a surface that may be rough; then along r as well.
  EXPECT_FALSE(cost(scene_of({}), "second_direction").has_value());
  EXPECT_GT(cost(scene_of({}), "roughness").value_or(0.0), 0.0);
  const SceneDescription across = scene_of({"modal.points[0].phi_w_1=0.2"});
  EXPECT_GT(cost(across, "second_direction").value_or(0.0), 0.0);
  EXPECT_FALSE(cost(scene_of({"modal.points[0].normal_stiffness=0"}), "roughness").has_value());
}

TEST(Effects, WhatASceneCannotHaveHasAShortReason) {
  const SceneDescription scene = read_scene(MICROSLIP_SCENES "/oscillator_1dof.toml", {});
  const ReducedModel model = model_in(scene);
  int n_forecast = 0;  // told of, of a motion in time
  for (const EffectRecord& effect : effects_of(scene, &model)) {
    const bool lacks = effect.name != "coexistence" && effect.simulated == Simulated::no;
    EXPECT_EQ(effect.reason.find("without it") == std::string::npos, lacks)
        << effect.name << ": " << effect.reason;
    if (effect.reason.find("no cost is told") != std::string::npos) ++n_forecast;
  }
  EXPECT_EQ(n_forecast, 1);
}

TEST(Effects, NothingIsSavedByALawThatNobodyGives) {
  const auto cost = [](const Overrides& overrides) {
    const SceneDescription scene = read_scene(MICROSLIP_SCENES "/block_rough.toml", overrides);
    const ReducedModel model = model_in(scene);
    return effect_in(effects_of(scene, &model), "rate_dependence").seconds;
  };
  EXPECT_FALSE(cost({}).has_value());
  EXPECT_TRUE(
      cost({"contact.friction_coefficient={ law = \"hyperbolic\", static = 0.4, rate = 1 }"})
          .has_value());
}

TEST(Effects, WhatIsAskedForCostsNoMoreThanTheCurvesThatHaveIt) {
  for (const char* harmonics : {"response.harmonics=5", "response.harmonics=auto"}) {
    const SceneDescription scene = scene_of({harmonics});
    const ReducedModel model = model_in(scene);
    const std::vector<EffectRecord> effects = effects_of(scene, &model);
    const double whole = effect_in(effects, "nonlinearity").seconds.value_or(0.0);
    const double higher = effect_in(effects, "higher_harmonics").seconds.value_or(0.0);
    EXPECT_GT(higher, 0.0) << harmonics;
    EXPECT_LT(higher, whole) << harmonics;
  }
}

TEST(Effects, ReachOfAPointIsThatOfItsLimits) {
  const SceneDescription scene = scene_of({});
  const ContactReach reach = contact_reach(model_in(scene), scene, 1.0);
  const double stiffness = 3e3 + 0.25 * 2e3;
  const double free = amplitude(0.0, 12.0);
  const double stuck = amplitude(stiffness, 12.0);
  EXPECT_NEAR(reach.load, 2e3 * 0.5 * std::max(free, stuck) / 4.0, 1e-12);
  EXPECT_NEAR(reach.slip, 3e3 * stuck / (0.5 * (4.0 - 2e3 * 0.5 * stuck)), 1e-12);
  EXPECT_EQ(reach.bias_load, 0.0);
  // The stuck resonance lies above, the free one below: contact bends both to 12 Hz.
  const double stuck_hz =
      std::sqrt(std::pow(2.0 * std::numbers::pi * 10.0, 2) + stiffness) / (2.0 * std::numbers::pi);
  EXPECT_NEAR(reach.nearby, 2e3 * 0.5 * amplitude(stiffness, stuck_hz) / 4.0, 1e-9);
}

TEST(Effects, OfAConstantLoadNeitherSlipNorOtherSolutionsComeFromItsVariation) {
  const SceneDescription scene = scene_of({"effects.normal_motion=off"});
  const ContactReach reach = contact_reach(model_in(scene), scene, 1.0);
  EXPECT_NEAR(reach.slip, 3e3 * amplitude(3e3, 12.0) / (0.5 * 4.0), 1e-12);
  EXPECT_EQ(reach.nearby, 0.0);
  EXPECT_EQ(reach.load, contact_reach(model_in(scene_of({})), scene_of({}), 1.0).load);
  // A load that varies by more than it is, and friction that holds all the same.
  const Overrides held{"effects.normal_motion=off", "modal.points[0].friction_coefficient=1e3",
                       "modal.force_cosine=[100]"};
  EXPECT_GT(contact_reach(model_in(scene_of(held)), scene_of(held), 1.0).load, 1.0);
  EXPECT_LT(contact_reach(model_in(scene_of(held)), scene_of(held), 1.0).slip, 1.0);
  EXPECT_EQ(n_linear_curves(model_in(scene_of(held)), scene_of(held)), 1);
}

TEST(Effects, AGapIsReachedByTheFreeLimit) {
  const SceneDescription scene = scene_of({"modal.points[0].preload=-4"});
  const ContactReach reach = contact_reach(model_in(scene), scene, 1.0);
  EXPECT_NEAR(reach.slip, 2e3 * 0.5 * amplitude(0.0, 12.0) / 4.0, 1e-12);
  EXPECT_NEAR(reach.nearby, 2e3 * 0.5 * amplitude(0.0, 10.0) / 4.0, 1e-9);
}

TEST(Effects, ADriftCountsThoughNothingVibrates) {
  const SceneDescription scene =
      scene_of({"modal.force_cosine=[1e-9]", "modal.force_static=[-40]"});
  const ContactReach reach = contact_reach(model_in(scene), scene, 1.0);
  const double drift = 40.0 / std::pow(2.0 * std::numbers::pi * 10.0, 2);  // free: the larger one
  EXPECT_NEAR(reach.load, 2e3 * 0.5 * drift / 4.0, 1e-6);
  EXPECT_GT(reach.bias_load, 1.0);
}

TEST(Effects, AResonanceWithoutDampingHasNoBound) {
  const SceneDescription scene = scene_of({"modal.damping_ratio=0", "response.frequency=10"});
  EXPECT_TRUE(std::isinf(contact_reach(model_in(scene), scene, 1.0).load));
}

TEST(Effects, NormalMotionIsLeftOutWhereNothingKnowsOfIt) {
  EXPECT_TRUE(model_in(scene_of({})).effects.normal_motion);
  EXPECT_FALSE(model_in(scene_of({"modal.points[0].phi_v_1=1e-6"})).effects.normal_motion);
  const Overrides asked{"modal.points[0].phi_v_1=1e-6", "effects.normal_motion=on"};
  EXPECT_TRUE(model_in(scene_of(asked)).effects.normal_motion);
  // A load so large that it hardly varies: the springs hold the structure all the same.
  EXPECT_TRUE(model_in(scene_of({"modal.points[0].preload=1e9"})).effects.normal_motion);
}

TEST(Effects, AMultipleOfTheFrequencyThatMeetsAModeIsSeen) {
  const auto answer = [](const char* second) {
    const SceneDescription scene = parse_scene(
        text, "scene.toml", "/nowhere",
        {"response.frequency=[9, 12]", std::string("modal.frequency=[10, ") + second + "]",
         "modal.points[0].normal_stiffness=0", "modal.points[1].normal_stiffness=0"});
    return harmonic_answer(model_in(scene), scene);
  };
  EXPECT_EQ(answer("30").order, 3);
  EXPECT_GT(answer("30").ratio, 5.0 * answer("35").ratio);
}

// Row 95. Hard: the curve is linear, a resonance beside the range reaches into it.
// Met in: ranges beside a resonance.
// Right: the search is made, or what it would tell is warned of.
TEST(Effects, OtherSolutionsAreLookedForWhereAResonanceNearByReachesThem) {
  const auto starts = [](const Overrides& overrides) {
    const SceneDescription scene = scene_of(overrides);
    return search_starts(scene, model_in(scene), 1.0);
  };
  const std::string gap = "modal.points[0].preload=-4";
  EXPECT_GT(starts({gap}), 0);
  EXPECT_EQ(starts({"modal.points[0].preload=-4e6"}), 0);     // out of reach
  EXPECT_GT(starts({gap, "response.frequency=[8, 12]"}), 0);  // that takes little
  // The curve passes the resonance, and a search with many harmonics takes long.
  EXPECT_EQ(starts({gap, "response.frequency=[8, 12]", "response.harmonics=99"}), 0);
  EXPECT_GT(starts({gap, "response.frequency=[10.3, 12]"}), 0);
  EXPECT_GT(starts({gap, "response.frequency=[8, 12]", "effects.coexistence=on"}), 0);
  EXPECT_EQ(starts({gap, "response.search_starts=3"}), 3);
  EXPECT_EQ(starts({gap, "response.search_starts=0"}), 0);
  EXPECT_EQ(starts({gap, "effects.coexistence=off"}), 0);
}

// Row 98. Hard: contact 1e84 times as stiff as the modes leaves nothing of them in a double.
// Met in: a scene that had no first solution in 40 s.
// Right: refused beyond 1e12, the keys named.
//
// The search for a first solution would not end, or end in rounding.
TEST(Effects, AContactBesideWhichNothingIsLeftOfTheModesIsRefused) {
  const auto model = [](const char* stiffness) {
    std::vector<std::string> warnings;
    return pipelines::model_of(
        scene_of({std::string("modal.points[0].tangential_stiffness=") + stiffness}), nullptr,
        warnings);
  };
  EXPECT_NO_THROW(model("1e13"));
  EXPECT_THROW(model("4e90"), RefusedError);
}

// A point that sticks may as well slip where slipping holds less: both solutions are there.
TEST(Effects, OtherSolutionsAreLookedForWhereFrictionFallsWithSpeed) {
  const auto starts = [](const Overrides& more) {
    Overrides all{"modal.points[0].normal_stiffness=0", "modal.points[0].preload=40"};
    all.insert(all.end(), more.begin(), more.end());
    const SceneDescription scene = scene_of(all);
    return search_starts(scene, model_in(scene), 1.0);
  };
  const auto law = [](const char* kinetic) {
    return std::string("contact.friction_law={ law = \"exponential\", static = 0.5, kinetic = ") +
           kinetic + ", rate = 20 }";
  };
  EXPECT_EQ(starts({}), 0);
  EXPECT_GT(starts({law("0.3")}), 0);
  EXPECT_EQ(starts({law("0.3"), "effects.rate_dependence=off"}), 0);
  EXPECT_EQ(starts({law("0.7")}), 0);                                 // it rises
  EXPECT_EQ(starts({law("0.499")}), 0);                               // hardly
  EXPECT_EQ(starts({law("0.3"), "modal.points[0].preload=4e6"}), 0);  // out of reach
}

TEST(Effects, SeparationThatIsOffIsObeyedWhereNothingOpens) {
  const SceneDescription scene =
      scene_of({"effects.separation=off", "effects.normal_motion=on", "modal.force_cosine=[1e-3]"});
  const ReducedModel model = model_in(scene);  // not refused
  const EffectRecord told = effect_in(effects_of(scene, &model), "separation");
  EXPECT_EQ(told.simulated, Simulated::no);
  EXPECT_LT(*told.indicator, 1.0);
  try {
    static_cast<void>(model_in(scene_of({"effects.separation=off", "modal.force_cosine=[1e6]"})));
    FAIL() << "contact opens, and is not to";
  } catch (const RefusedError& error) {
    const std::string why = error.what();
    EXPECT_TRUE(why.starts_with("--set effects.separation=off: effects.separation = \"off\""))
        << why;
    EXPECT_NE(why.find("effects.normal_motion"), std::string::npos) << why;
  }
}

TEST(Effects, MeanCouplingThatIsOffIsObeyedAndObjectedToWhereItMatters) {
  const auto scene_with = [](const char* force) {
    return scene_of({"modal.force_cosine=[1e-3]", "effects.mean_coupling=off",
                     "effects.normal_motion=on", std::string("modal.force_static=") + force});
  };
  for (const auto& [force, matters] : {std::pair{"[0]", false}, std::pair{"[-40]", true}}) {
    const SceneDescription scene = scene_with(force);
    const ReducedModel model = model_in(scene);
    EXPECT_FALSE(model.effects.mean_coupling);
    const EffectRecord told = effect_in(effects_of(scene, &model), "mean_coupling");
    EXPECT_EQ(told.simulated, Simulated::no);
    EXPECT_EQ(!told.objection.empty(), matters) << told.objection;
  }
}

TEST(Effects, MeanCouplingComesWithNormalMotionUnlessItIsOff) {
  EXPECT_TRUE(model_in(scene_of({})).effects.mean_coupling);
  const Overrides neither{"effects.mean_coupling=off", "effects.normal_motion=off"};
  EXPECT_TRUE(model_in(scene_of(neither)).effects.mean_coupling)
      << "normal motion that is put back brings it";
}

TEST(Effects, MeanCouplingThatCannotBeOffIsRefused) {
  const Overrides off{"effects.mean_coupling=off", "effects.normal_motion=on"};
  for (const Overrides& more :
       {Overrides{"response.method=time", "response.points=5", "modal.force_static=[-40]"},
        Overrides{"modal.frequency=[0]"}}) {
    Overrides all = off;
    all.insert(all.end(), more.begin(), more.end());
    try {
      static_cast<void>(model_in(scene_of(all)));
      ADD_FAILURE() << more[0];
    } catch (const RefusedError& error) {
      EXPECT_TRUE(std::string(error.what())
                      .starts_with("--set effects.mean_coupling=off: effects.mean_coupling"))
          << error.what();
    }
  }
}

TEST(Effects, PartsOfNormalMotionThatAreOnBringIt) {
  for (const char* part : {"effects.separation=on", "effects.mean_coupling=on"}) {
    const Overrides faint{"modal.force_cosine=[1e-3]", "modal.points[0].phi_v_1=1e-6"};
    EXPECT_FALSE(model_in(scene_of(faint)).effects.normal_motion);
    EXPECT_TRUE(model_in(scene_of({faint[0], faint[1], part})).effects.normal_motion) << part;
  }
}

TEST(Effects, ContactThatOpensThoughItWasNotToIsTold) {
  CurveResult curve;
  curve.load = 100.0;
  curve.curve.points.resize(2);
  std::vector<EffectRecord> effects{{"separation", "off", Simulated::no, "nothing opens"}};
  tell_opening(curve, effects);
  EXPECT_TRUE(effects[0].objection.empty());
  curve.curve.points[1].report.separated_share = 0.25;
  tell_opening(curve, effects);
  EXPECT_EQ(effects[0].simulated, Simulated::yes);
  EXPECT_NE(effects[0].objection.find("25 %"), std::string::npos) << effects[0].objection;
}

// Whether it is simulated or not.
TEST(Effects, TheForecastTellsWhatAnEffectCosts) {
  const std::string rough = "contact.roughness={ law = \"cubic\", height = 1e-3 }";
  const std::string along_r = "modal.points[0].phi_w_1=0.2";
  for (const Overrides& overrides :
       {Overrides{rough, along_r}, Overrides{rough, along_r, "effects.roughness=off"}}) {
    const SceneDescription scene = parse_scene(text, "scene.toml", "/nowhere", overrides);
    const ReducedModel model = model_in(scene);
    const std::vector<EffectRecord> told = effects_of(scene, &model);
    for (const char* name :
         {"nonlinearity", "second_direction", "higher_harmonics", "roughness", "coexistence"}) {
      EXPECT_GT(effect_in(told, name).seconds.value_or(0.0), 0.0) << name;
    }
    EXPECT_EQ(effect_in(told, "separation").seconds, 0.0);
    EXPECT_GT(effect_in(told, "maps").seconds.value_or(0.0), 0.0);  // of a map at each peak
    for (const char* name : {"moments", "residual", "static_preload", "centrifugal", "wear"}) {
      EXPECT_FALSE(effect_in(told, name).seconds) << name;
    }
  }
}

// Loads that vary are looked through for instants where the contact opens, and drive even
// harmonics; the mean is one unknown more.
TEST(Effects, TheForecastTellsWhatVaryingLoadsCost) {
  const auto told = [](const Overrides& overrides) {
    const SceneDescription scene = scene_of(overrides);
    const ReducedModel model = model_in(scene);
    return effects_of(scene, &model);
  };
  const std::vector<EffectRecord> varying = told({"response.harmonics=9"});
  const std::vector<EffectRecord> constant =
      told({"response.harmonics=9", "effects.normal_motion=off"});
  const double more = effect_in(varying, "normal_motion").seconds.value_or(0.0);
  EXPECT_GT(more, 0.0);
  const double saved = effect_in(constant, "normal_motion").seconds.value_or(0.0);
  EXPECT_GT(saved, 0.5 * more);  // with the proof that leaving it out was right
  EXPECT_LT(saved, 2.0 * more);
  EXPECT_LT(more, effect_in(varying, "nonlinearity").seconds.value_or(0.0));
  const Overrides none{"response.harmonics=9", "modal.points[0].normal_stiffness=0"};
  EXPECT_FALSE(effect_in(told(none), "normal_motion").seconds.has_value());
  EXPECT_FALSE(effect_in(told(none), "mean_coupling").seconds.has_value());
}

TEST(Effects, TheForecastTellsWhatIsDrawnAfterTheCurves) {
  const auto maps = [](const Overrides& overrides) {
    const SceneDescription scene = scene_of(overrides);
    const ReducedModel model = model_in(scene);
    return effect_in(effects_of(scene, &model), "maps").seconds;
  };
  const double at_peak = maps({"response.maps=[\"peak\"]"}).value_or(0.0);
  EXPECT_GT(at_peak, 0.0);
  EXPECT_DOUBLE_EQ(maps({}).value_or(0.0), at_peak);  // what they would take
  EXPECT_GT(maps({"response.maps=[\"peak\", \"folds\"]"}).value_or(0.0), at_peak);
}

// The point is compressed by 2 mm at rest; its friction falls with the speed of slip.
Overrides with_surfaces(double height, double rate) {
  return {fmt::format("contact.roughness={{ law = \"cubic\", height = {} }}", height),
          fmt::format("contact.friction_law={{ law = \"hyperbolic\", static = 0.5, rate = {} }}",
                      rate)};
}

std::vector<std::string> left_to_auto(const Overrides& surfaces, const Overrides& more = {}) {
  Overrides all = surfaces;
  all.insert(all.end(), more.begin(), more.end());
  const SceneDescription scene = scene_of(all);
  return to_leave_out(scene, model_in(scene));
}

using Names = std::vector<std::string>;

TEST(Effects, SurfacesThatMatterTooLittleAreLeftOut) {
  EXPECT_EQ(left_to_auto(with_surfaces(5e-5, 1e-6)), (Names{"roughness", "rate_dependence"}));
  EXPECT_EQ(left_to_auto(with_surfaces(1e-3, 1e-6)), Names{"rate_dependence"});
  EXPECT_EQ(left_to_auto(with_surfaces(5e-5, 1.0)), Names{"roughness"});
  EXPECT_EQ(left_to_auto(with_surfaces(1e-3, 1.0)), Names{});
}

TEST(Effects, SurfacesAreLeftOutWhereThatIsAskedForAndCanBeProved) {
  const Overrides little = with_surfaces(5e-5, 1e-6);
  EXPECT_EQ(left_to_auto(little, {"effects.roughness=on"}), Names{"rate_dependence"});
  EXPECT_EQ(left_to_auto(little, {"effects.rate_dependence=off"}), Names{"roughness"});
  EXPECT_EQ(left_to_auto(little, {"response.method=time"}), Names{});
  EXPECT_EQ(left_to_auto(little, {"accuracy.error_budget=off"}), Names{});
  EXPECT_EQ(
      left_to_auto(little, {"response.frequency=[11, 13]", "response.optimum=modal.damping_ratio",
                            "response.optimum_range=[5e-3, 2e-2]"}),
      Names{});
  EXPECT_EQ(left_to_auto(little, {"accuracy.tolerance=0.5 %"}).size(), 2U);  // half of the limits
  EXPECT_EQ(left_to_auto(little, {"accuracy.tolerance=0.1 %"}), Names{"rate_dependence"});
}

// Of plane contact with the stiffness of full contact, the coefficient that of rest.
TEST(Effects, AModelWithoutThemIsThatOfAnotherScene) {
  const SceneDescription scene = scene_of(with_surfaces(5e-5, 1e-6));
  const SimulatedScene one_less = simulated(scene, model_in(scene), nullptr);
  EXPECT_FALSE(is_rough(one_less.scene));
  EXPECT_FALSE(is_rough(one_less.model));
  EXPECT_EQ(arrays_of(one_less.model), arrays_of(model_in(scene_of({}))));
  const std::vector<EffectRecord> told = effects_of(one_less.scene, &one_less.model);
  for (const char* name : {"roughness", "rate_dependence"}) {
    const EffectRecord& effect = effect_in(told, name);
    EXPECT_EQ(effect.simulated, Simulated::no) << name;
    EXPECT_EQ(effect.setting, "auto") << name;
    EXPECT_LT(effect.indicator.value(), effect.threshold.value()) << name;
    EXPECT_TRUE(effect.objection.empty()) << effect.objection;
    EXPECT_GT(effect.seconds.value_or(0.0), 0.0) << name;
    EXPECT_TRUE(is_given(with_effect(one_less.scene, name), name));
  }
  const SceneDescription at_another_load =
      with_value(one_less.scene, "modal.points[0].preload", 40.0);
  EXPECT_FALSE(is_rough(at_another_load));
  EXPECT_FALSE(is_rate_dependent(at_another_load));
}

// Above its limit an effect that is given is missed.
TEST(Effects, ACostBelowZeroIsToldAsWhatIsSaved) {
  EffectRecord effect;
  effect.name = "moments";
  effect.seconds = -10.4;
  const std::string line = effect_lines({effect}).back();
  EXPECT_NE(line.find(" saves 10 s"), std::string::npos) << line;
  EXPECT_EQ(line.find("-10"), std::string::npos) << line;
}

TEST(Effects, WhatIsOffThoughItIsGivenIsObjectedTo) {
  const auto told = [](const char* height) {
    const SceneDescription scene =
        scene_of({std::string("contact.roughness={ law = \"cubic\", height = ") + height + " }",
                  "effects.roughness=off"});
    const ReducedModel model = model_in(scene);
    return effect_in(effects_of(scene, &model), "roughness");
  };
  const EffectRecord high = told("1e-3");  // 0.5 of the compression, 4 Pa over 2e3 N/m^3
  EXPECT_EQ(high.simulated, Simulated::no);
  EXPECT_NEAR(*high.indicator, 0.5, 1e-12);
  EXPECT_NE(high.objection.find("0.5, above 0.1"), std::string::npos) << high.objection;
  EXPECT_NE(high.reason.find("contact.roughness"), std::string::npos) << high.reason;
  EXPECT_EQ(told("1e-5").objection, "");
}

// Two points of 4 N, half a metre on both sides of the middle, whose loads change unequally.
TEST(Effects, TurningIsWhatMomentsAreFor) {
  const Overrides area{
      "modal.points=[{ weight = 1, tangential_stiffness = 3e3, normal_stiffness = "
      "2e3, friction_coefficient = 0.5, preload = 4, phi_u_1 = 1, phi_v_1 = 0.5, "
      "p = 0, r = 0 }, { weight = 1, tangential_stiffness = 3e3, normal_stiffness "
      "= 2e3, friction_coefficient = 0.5, preload = 4, phi_u_1 = 1, phi_v_1 = 0.1, "
      "p = 1, r = 0 }]"};
  const auto told = [&](const char* setting, const Overrides& more) {
    Overrides all = area;
    all.insert(all.end(), more.begin(), more.end());
    all.push_back(std::string("effects.moments=") + setting);
    const SceneDescription scene = scene_of(all);
    const ReducedModel model = model_in(scene);
    return effect_in(effects_of(scene, &model), "moments");
  };
  const double stuck = amplitude(2.0 * 3e3 + 2e3 * (0.25 + 0.01), 12.0);
  const double moment = 2e3 * (0.5 - 0.1) * 0.5 * stuck;
  EXPECT_NEAR(*told("auto", {}).indicator, moment / (8.0 * 0.5), 1e-12);
  EXPECT_EQ(told("off", {}).indicator, told("auto", {}).indicator);
  EXPECT_FALSE(told("off", {"modal.force_cosine=[100]"}).objection.empty());
  EXPECT_EQ(told("auto", {"effects.normal_motion=off"}).indicator, 0.0);
}

// 4 and 0.8 N: the pressure varies by 2/3 of its mean, and no moment of it is asked for.
TEST(Effects, APressureThatIsUnevenIsWhatMomentsAreFor) {
  const auto told = [](const char* setting) {
    const SceneDescription scene =
        scene_of({"modal.points=[{ weight = 1, tangential_stiffness = 3e3, normal_stiffness = 0, "
                  "friction_coefficient = 0.5, preload = 4, phi_u_1 = 1, p = 0, r = 0 }, "
                  "{ weight = 1, tangential_stiffness = 3e3, normal_stiffness = 0, "
                  "friction_coefficient = 0.5, preload = 0.8, phi_u_1 = 1, p = 1, r = 0 }]",
                  std::string("effects.moments=") + setting});
    const ReducedModel model = model_in(scene);
    return effect_in(effects_of(scene, &model), "moments");
  };
  EXPECT_NEAR(*told("auto").indicator, 2.0 / 3.0 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(*told("off").indicator, 2.0 / 3.0 / std::sqrt(3.0), 1e-12);
  EXPECT_FALSE(told("off").objection.empty());
}

// Points that move by 1.8 and 0.2 of their mean slip one after the other; that of one in the middle
// alone slips at once.
TEST(Effects, AFaceThatMovesUnevenlyIsWhatMomentsAreFor) {
  const auto told = [](double other, const char* setting) {
    const SceneDescription scene = scene_of(
        {fmt::format("modal.points=[{{ weight = 1, tangential_stiffness = 3e3, normal_stiffness = "
                     "0, friction_coefficient = 0.5, preload = 4, phi_u_1 = 1.8, p = 0, r = 0 }}, "
                     "{{ weight = 1, tangential_stiffness = 3e3, normal_stiffness = 0, "
                     "friction_coefficient = 0.5, preload = 4, phi_u_1 = {}, p = 1, r = 0 }}]",
                     other),
         std::string("effects.moments=") + setting});
    const ReducedModel model = model_in(scene);
    return effect_in(effects_of(scene, &model), "moments");
  };
  EXPECT_NEAR(*told(0.2, "auto").indicator, 0.8 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(*told(0.2, "off").indicator, 0.8 / std::sqrt(3.0), 1e-12);
  EXPECT_FALSE(told(0.2, "off").objection.empty());
  EXPECT_NEAR(*told(1.8, "off").indicator, 0.0, 1e-7);
  EXPECT_TRUE(told(1.8, "off").objection.empty());
}

TEST(Effects, OfAPlaneFaceNothingIsLostWithoutLocalFrames) {
  const SceneDescription scene = read_scene(MICROSLIP_SCENES "/blade_to_ground.toml", {});
  ReducedModel model;
  model.patches.resize(1);
  EffectFacts facts{.scene = scene, .model = &model};
  facts.has_contact = true;
  const EffectRow& row = effect_row("local_frames");
  const EffectDecision plane = decide(row, facts);
  EXPECT_EQ(plane.reason, "the face is plane");
  EXPECT_FALSE(plane.can_be);
  EXPECT_EQ(plane.indicator, 0.0);
  model.patches[0].off_plane = 0.005;
  const EffectDecision nearly = decide(row, facts);
  EXPECT_EQ(nearly.simulated, Simulated::no);
  EXPECT_TRUE(nearly.can_be);
  EXPECT_NE(nearly.reason.find("0.5 %"), std::string::npos) << nearly.reason;
}

TEST(Effects, PointsThatStayOpenAreCounted) {
  const SceneDescription scene =
      parse_scene(text, "scene.toml", "/nowhere", {"effects.normal_motion=off"});
  const ReducedModel model = model_in(scene);
  const EffectRecord told = effect_in(effects_of(scene, &model), "normal_motion");
  EXPECT_NE(told.reason.find("1 of 2 contact points are open at rest and never touch"),
            std::string::npos)
      << told.reason;
  EXPECT_FALSE(told.objection.empty());
}

// Nothing slips in the linear limits, and a stuck contact is as stiff as a full one.
TEST(Effects, LimitsAloneMissNeitherRoughnessNorALawOfTheSpeed) {
  constexpr const char* block = R"toml([model]
kind = "block"
mass = 1
moments_of_inertia = [0.002, 0.003, 0.0025]
height = 0.02
stiffness = [15800, 30000, 17500]
rotational_stiffness = [90, 80, 110]
[contact]
cells = [2, 2]
size = [0.1, 0.08]
normal_stiffness = 4e4
tangential_stiffness = 4e4
friction_coefficient = { law = "hyperbolic", static = 0.4, rate = 1 }
roughness = { law = "cubic", height = 5e-4 }
[excitation]
forces = [ { at = [0, -0.03, 0], force = [5, 0, 0] } ]
[response]
output = { at = [0, 0, 0], direction = [1, 0, 0] }
frequency = [18, 40]
harmonics = 1
)toml";
  for (const char* name : {"roughness", "rate_dependence"}) {
    const auto told = [&](const std::string& preload) {
      const SceneDescription scene =
          parse_scene(block, "scene.toml", "/nowhere",
                      {"response.preload=" + preload, std::string("effects.") + name + "=off"});
      const ReducedModel model = model_in(scene);
      return effect_in(effects_of(scene, &model), name);
    };
    const EffectRecord limits = told("[\"free\", \"stuck\"]");
    EXPECT_FALSE(limits.indicator) << name;
    EXPECT_EQ(limits.objection, "") << name;
    EXPECT_NE(told("[\"stuck\", 20]").objection, "") << name;
  }
}

TEST(Effects, OfTheLimitsAloneNothingIsSimulatedThatTheyDoNotHave) {
  const SceneDescription scene = read_scene(MICROSLIP_SCENES "/chain_3dof_normal.toml",
                                            {"response.preload=[\"free\", \"stuck\"]",
                                             "response.harmonics=9", "response.search_starts=5"});
  const ReducedModel model = model_in(scene);
  for (const ReducedModel* known : {static_cast<const ReducedModel*>(nullptr), &model}) {
    const std::vector<EffectRecord> effects = effects_of(scene, known);
    for (const EffectRow& row : effect_table) {
      if (!row.of_loads) continue;
      EXPECT_EQ(effect_in(effects, row.name).simulated, Simulated::no) << row.name;
    }
    EXPECT_NE(effect_in(effects, "coexistence").reason.find("only the limits"), std::string::npos);
  }
  EXPECT_TRUE(model.effects.mean_coupling);  // not left out: there is nothing to put back
}

TEST(Effects, InTimeStabilityIsThatOfAMotionThatRepeats) {
  const auto reason = [](const Overrides& overrides) {
    return effect_in(effects_of(scene_of(overrides), nullptr), "stability").reason;
  };
  EXPECT_NE(reason({"response.method=time"}).find("repeats"), std::string::npos);
  EXPECT_EQ(reason({}).find("repeats"), std::string::npos);
}

TEST(Effects, WhatIsNotKnownYetIsNotDenied) {
  const SceneDescription scene = scene_of({});
  for (const char* name : {"nonlinearity", "normal_motion", "second_direction", "coexistence"}) {
    EXPECT_EQ(effect_in(effects_of(scene, nullptr), name).simulated, Simulated::undecided) << name;
  }
}

TEST(Effects, APreloadOfStaticLoadsIsToldAsSimulated) {
  constexpr const char* blade = R"toml([model]
kind = "blade"
[material]
youngs_modulus = 2e11
poissons_ratio = 0.3
density = 7800
[supports]
clamped = ["root"]
[static]
forces = [ { at = "B", direction = [1, 0, 0], amplitude = 50 } ]
[contact]
surface = "contact"
slip_direction = [0, 1, 0]
friction_coefficient = 0.4
normal_stiffness = 1e12
tangential_stiffness = 1e12
preload = "static"
)toml";
  const auto told = [&](const Overrides& overrides) {
    const SceneDescription scene = parse_scene(blade, "scene.toml", "/nowhere", overrides);
    return effect_in(effects_of(scene, nullptr), "static_preload");
  };
  EXPECT_EQ(told({}).simulated, Simulated::yes) << told({}).reason;
  EXPECT_EQ(told({"effects.static_preload=on"}).simulated, Simulated::yes);
}

TEST(Effects, TheTableInTheDocumentationIsTheOneOfTheProgram) {
  std::ifstream in(MICROSLIP_EFFECTS);
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  for (const EffectRow& row : effect_table) {
    const std::string quantity = row.quantity.empty() ? "–" : std::string(row.quantity);
    const std::string threshold =
        std::isfinite(row.threshold) ? fmt::format("{:.3g}", row.threshold) : "–";
    const std::string line = fmt::format("| `{}` | {} | {} | {} | {} |\n", row.name, row.meaning,
                                         quantity, threshold, row.lost);
    EXPECT_NE(page.find(line), std::string::npos) << "share/doc/effects.md has not: " << line;
  }
}

// Friction along r takes four times as long; what it does here no bar can tell.
TEST(Effects, MotionAlongRThatDoesNothingIsLeftOutOfGivenModes) {
  const auto told = [](const std::string& across) {
    const SceneDescription scene = scene_of({"modal.points[0].phi_w_1=" + across});
    const ReducedModel model = model_in(scene);
    return effect_in(effects_of(scene, &model), "second_direction");
  };
  EXPECT_EQ(told("2e-4").simulated, Simulated::yes) << told("2e-4").reason;
  EXPECT_EQ(told("5e-5").simulated, Simulated::no) << told("5e-5").reason;
  EXPECT_NEAR(told("5e-5").indicator.value_or(0.0), 5e-5, 1e-9);
}

// Row 12c. Hard: a small peak that moves along r beside a large one that does not.
// Met in: axes p chosen by the largest peak.
// Right: friction along r counts, however small the peak.
//
// A mode along p, and a weakly excited one along r: its peak is small, and its motion is all along
// r.
TEST(Effects, APeakThatMovesAlongRCountsHoweverSmallBesideAnother) {
  constexpr const char* two = R"toml([model]
kind = "modal"
[modal]
frequency = [10, 20]
damping_ratio = 0.001
force_sine = [1, 1e-4]
output = [1, 1]
[[modal.points]]
weight = 1
tangential_stiffness = 2e3
tangential_stiffness_r = 2e3
normal_stiffness = 1e3
friction_coefficient = 0.4
preload = 20
phi_u_1 = 1
phi_u_2 = 0.01
phi_w_1 = 0.001
phi_w_2 = 1
[response]
frequency = [8, 12]
)toml";
  const auto ratio = [&](const Overrides& overrides) {
    return model_in(parse_scene(two, "scene.toml", "/nowhere", overrides)).effects.motion_ratio;
  };
  EXPECT_NEAR(ratio({}), 0.001, 1e-4);
  EXPECT_GT(ratio({"response.frequency=[8, 25]"}), 0.5);
  EXPECT_EQ(ratio({"response.frequency=[25, 8]"}), ratio({"response.frequency=[8, 25]"}));
  // Far from a resonance the place of the largest motion decides.
  EXPECT_LT(ratio({"response.frequency=[5, 6]"}), 0.01);
}

TEST(Effects, AKineticCoefficientAboveTheStaticIsWarnedOf) {
  const auto warnings = [](const std::string& law) {
    return scene_warnings(
        parse_scene(text, "scene.toml", "/nowhere", {"contact.friction_law=" + law}));
  };
  const auto grows = warnings("{ law = \"exponential\", static = 0.3, kinetic = 0.5, rate = 1 }");
  ASSERT_EQ(grows.size(), 1U);
  EXPECT_NE(grows[0].find("0.5 is above the static 0.3"), std::string::npos) << grows[0];
  EXPECT_TRUE(warnings("{ law = \"exponential\", static = 0.5, kinetic = 0.3, rate = 1 }").empty());
  EXPECT_TRUE(warnings("{ law = \"hyperbolic\", static = 0.5, rate = 1 }").empty());
}

TEST(Effects, ForcesThatCancelAreWarnedOf) {
  const auto warns = [](const std::string& direction, const std::string& phase) {
    const std::string forces =
        "excitation.forces=[{ at = \"B\", direction = [1, 0, 0], amplitude = \"1 N\" }, "
        "{ at = \"B\", direction = " +
        direction + ", amplitude = \"1 N\", phase = " + phase + " }]";
    const auto all = scene_warnings(read_scene(MICROSLIP_SCENES "/blade_to_ground.toml", {forces}));
    return std::ranges::any_of(all, [](const std::string& one) {
      return one.find("no force excites") != std::string::npos;
    });
  };
  EXPECT_TRUE(warns("[-1, 0, 0]", "0"));
  EXPECT_TRUE(warns("[1, 0, 0]", "180"));
  EXPECT_FALSE(warns("[-1, 0, 0]", "90"));
  EXPECT_FALSE(warns("[0, -1, 0]", "0"));
}

TEST(Effects, PointsWithoutAreaAreCounted) {
  std::string idle(text);
  idle.replace(idle.find("weight = 2"), 10, "weight = 0");
  const auto told = scene_warnings(parse_scene(idle, "scene.toml", "/nowhere", {}));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("1 of 2 have weight 0"), std::string::npos) << told[0];
}

TEST(Effects, HarmonicsBesideIntegrationInTimeAreWarnedOf) {
  const auto warnings = [](const Overrides& overrides) {
    return scene_warnings(parse_scene(text, "scene.toml", "/nowhere", overrides));
  };
  const auto told = warnings({"response.method=time", "response.harmonics=5"});
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("response.harmonics: 5"), std::string::npos) << told[0];
  EXPECT_NE(told[0].find("keeps 60"), std::string::npos) << told[0];
  EXPECT_TRUE(warnings({"response.method=time"}).empty());
  EXPECT_TRUE(warnings({"response.method=time", "response.harmonics=auto"}).empty());
  EXPECT_TRUE(warnings({"response.harmonics=5"}).empty());
}

TEST(Effects, AMapOutsideTheRangeIsWarnedOf) {
  const auto warnings_of = [](const std::string& maps) {
    return scene_warnings(parse_scene(text, "scene.toml", "/nowhere",
                                      {"response.frequency=[10, 14]", "response.maps=" + maps}));
  };
  EXPECT_TRUE(warnings_of("[10, 12, 14, \"peak\"]").empty());
  const std::vector<std::string> warnings = warnings_of("[12, 15]");
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("15 Hz lies outside the range 10 to 14 Hz"), std::string::npos)
      << warnings[0];
}

}  // namespace
}  // namespace microslip::pipelines::test_effects
