// Effects that a scene leaves out: what is simulated then, and what is told of it.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "contact/harmonics.hpp"
#include "pipelines/model/contact_effects.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/model/effects.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/scene/scene_file.hpp"

namespace microslip::pipelines {
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
  return contact_of(model, 1.0).modal_force()->evaluate(q, 70.0);
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
    EXPECT_FALSE(effect.simulated) << effect.name;
    EXPECT_NE(effect.reason.find("effects.normal_motion"), std::string::npos) << effect.reason;
  }
  EXPECT_EQ(n_told, 3);
}

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
}  // namespace microslip::pipelines
