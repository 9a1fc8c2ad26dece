// What [effects] switches off though other keys give it: the scene is the one without those keys.
#include "pipelines/description/effects_left_out.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "pipelines/files/model_file.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/scene/scene_file.hpp"

namespace microslip::pipelines::test_effects_left_out {
namespace {

using Overrides = std::vector<std::string>;

constexpr const char* modal = R"toml([model]
kind = "modal"
[modal]
frequency = [10, 20, 4000]
attachment = 1
damping_ratio = 0.01
force_sine = [1, 0, 3]
output = [1, 0, 2]
[[modal.points]]
weight = 1
tangential_stiffness = 2e3
tangential_stiffness_r = 1e3
normal_stiffness = 3e3
friction_coefficient = 0.4
preload = 20
phi_u_1 = 1
phi_u_2 = 0.3
phi_u_3 = 5
phi_v_1 = 0.5
p = 0
r = 0
residual_p = 1e-4
residual_q = 2e-4
residual_r = 3e-4
[[modal.points]]
weight = 3
tangential_stiffness = 1e3
tangential_stiffness_r = 1e3
normal_stiffness = 1e3
friction_coefficient = 0.4
preload = -5
phi_u_1 = 2
phi_u_2 = 0.1
phi_u_3 = 4
phi_v_1 = 0.2
p = 1
r = 1
residual_p = 4e-4
residual_q = 5e-4
residual_r = 6e-4
[response]
frequency = [8, 12]
harmonics = 3
maps = ["peak"]
)toml";

constexpr const char* bar = R"toml([model]
kind = "bar"
length = 2
end_stiffness = 1e6
area = 1e-4
youngs_modulus = 2e11
density = 7800
[modes]
count = 3
damping_ratio = 0.01
residual = "stiffness"
[contact]
points = 5
load = 100
friction_coefficient = 0.3
tangential_stiffness = 1e8
[excitation]
force = 10
)toml";

constexpr const char* blade = R"toml([model]
kind = "blade"
[material]
youngs_modulus = 2e11
poissons_ratio = 0.3
density = 7800
[supports]
clamped = ["root"]
[static]
axis = { origin = [0, 0, 0], direction = [1, 0, 0] }
speed = "3000 rpm"
[contact]
surface = "contact"
slip_direction = [0, 1, 0]
friction_coefficient = 0.4
normal_stiffness = 1e12
tangential_stiffness = 1e12
[excitation]
forces = [ { at = "B", direction = [1, 0, 0], amplitude = 1 } ]
[response]
output = { at = "A", direction = [1, 0, 0] }
frequency = [300, 350]
preload = [100]
)toml";

const std::string law =
    "contact.friction_law={ law = \"exponential\", static = 0.5, kinetic = 0.2, rate = 3 }";
const std::string rough = "contact.roughness={ law = \"cubic\", height = 1e-3 }";

SceneDescription scene_of(const char* text, const Overrides& overrides) {
  return parse_scene(text, "scene.toml", "/nowhere", overrides);
}

std::string off(std::string_view effect) { return "effects." + std::string(effect) + "=off"; }

TEST(EffectsLeftOut, RoughSurfacesAreSmooth) {
  const SceneDescription scene = scene_of(modal, {rough, off("roughness")});
  EXPECT_FALSE(is_rough(scene));
  EXPECT_TRUE(is_rough(as_written(scene)));
  // What roughness would not allow, it does not where it is left out.
  EXPECT_NO_THROW(
      static_cast<void>(scene_of(modal, {rough, off("roughness"), "effects.normal_motion=off"})));
}

TEST(EffectsLeftOut, ALawOfTheSpeedIsItsCoefficientAtRest) {
  const SceneDescription scene = scene_of(modal, {law, off("rate_dependence")});
  EXPECT_FALSE(is_rate_dependent(scene));
  const ReducedModel model = reduced_model(scene);
  EXPECT_TRUE((model.patches[0].cells.friction.array() == 0.5).all());
  const SceneDescription meshed = scene_of(
      blade, {"contact.friction_coefficient={ law = \"hyperbolic\", static = 0.3, rate = 1 }",
              off("rate_dependence")});
  EXPECT_FALSE(is_rate_dependent(meshed));
  EXPECT_EQ(meshed.contacts[0].friction.at(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1))[0],
            0.3);
}

// The last mode is an attachment shape, and flexibility stands in series with the stiffness.
TEST(EffectsLeftOut, GivenPointsHaveTheirLocalStiffnessAndFreeModesAlone) {
  const SceneDescription scene = scene_of(modal, {off("residual")});
  Overrides without{
      "modal.attachment=0",          "modal.frequency=[10, 20]",    "modal.force_sine=[1, 0]",
      "modal.output=[1, 0]",         "modal.points[0].phi_u_3=",    "modal.points[1].phi_u_3=",
      "modal.points[0].residual_p=", "modal.points[1].residual_p=", "modal.points[0].residual_q=",
      "modal.points[1].residual_q=", "modal.points[0].residual_r=", "modal.points[1].residual_r="};
  const ReducedModel expected = reduced_model(scene_of(modal, without));
  const ReducedModel model = reduced_model(scene);
  EXPECT_EQ(model.frequency, expected.frequency);
  EXPECT_EQ(model.n_attachment, 0);
  EXPECT_EQ(model.output, expected.output);
  const contact::PatchSamples& cells = model.patches[0].cells;
  const contact::PatchSamples& free = expected.patches[0].cells;
  EXPECT_EQ(cells.shapes.u, free.shapes.u);
  EXPECT_EQ(cells.compliance.rows(), 0);
  const double rounding = 1e-14;  // 1/k - c and back
  EXPECT_TRUE(cells.stiffness.isApprox(free.stiffness, rounding)) << cells.stiffness;
  EXPECT_TRUE(cells.preload_field.isApprox(free.preload_field, rounding)) << "a gap has its length";
}

TEST(EffectsLeftOut, ABarHasItsLocalStiffness) {
  const std::string none = arrays_of(reduced_model(scene_of(bar, {"modes.residual=none"})));
  EXPECT_TRUE(arrays_of(reduced_model(scene_of(bar, {off("residual")}))) == none);
  EXPECT_TRUE(arrays_of(reduced_model(scene_of(bar, {}))) != none);
}

TEST(EffectsLeftOut, ModesOfAMeshAreAlone) {
  const SceneDescription scene = scene_of(blade, {off("residual"), "modes.attachment_degree=1"});
  const SceneDescription none = scene_of(blade, {"modes.residual=none"});
  EXPECT_EQ(scene.settings.basis, none.settings.basis);
}

TEST(EffectsLeftOut, AnAreaIsOnePointInItsMiddle) {
  const ReducedModel model = reduced_model(scene_of(modal, {off("moments")}));
  const ReducedModel whole = reduced_model(scene_of(modal, {}));
  const contact::PatchSamples& point = model.patches[0].cells;
  const contact::PatchSamples& area = whole.patches[0].cells;
  ASSERT_EQ(point.size(), 1);
  EXPECT_EQ(point.weights[0], 4.0);
  EXPECT_EQ(point.points(0, 0), 0.75);
  EXPECT_EQ(point.shapes.u(0, 0), 0.25 * 1.0 + 0.75 * 2.0);
  EXPECT_NEAR(point.preload_field[0] * point.weights[0], area.preload_field.dot(area.weights),
              1e-12);
  EXPECT_NEAR(point.stiffness(0, 1) * point.weights[0], area.stiffness.col(1).dot(area.weights),
              1e-9);
}

TEST(EffectsLeftOut, OtherKeysAreAsIfTheyWereNotGiven) {
  EXPECT_EQ(scene_of(blade, {off("centrifugal")}).rotation->speed, 0.0);
  EXPECT_TRUE(scene_of(modal, {off("maps")}).response->maps.empty());
  EXPECT_FALSE(has_wear(scene_of(modal, {"contact.wear_coefficient=1e-13", off("wear")})));
  EXPECT_FALSE(scene_of(modal, {off("stability")}).judges_stability);
}

TEST(EffectsLeftOut, WhatNothingGivesIsNotLeftOut) {
  for (const char* effect : {"roughness", "rate_dependence", "static_preload", "wear"}) {
    const SceneDescription scene = scene_of(modal, {off(effect)});
    EXPECT_EQ(left_out(scene, effect), nullptr) << effect;
    EXPECT_FALSE(is_given(scene, effect)) << effect;
    EXPECT_EQ(scene.written, nullptr) << effect;
  }
}

// Everything off: each comes back alone, and none of the others with it.
TEST(EffectsLeftOut, OneIsPutBackWithoutTheOthers) {
  const std::vector<std::string> given{
      "roughness", "rate_dependence", "moments", "residual", "stability", "wear", "maps"};
  Overrides all{law, rough, "contact.wear_coefficient=1e-13"};
  for (const std::string& effect : given) all.push_back(off(effect));
  const SceneDescription scene = scene_of(modal, all);
  for (const std::string& effect : given) {
    Overrides others = all;
    std::erase(others, off(effect));
    const SceneDescription expected = scene_of(modal, others);
    const SceneDescription with = with_effect(scene, effect);
    EXPECT_NE(left_out(scene, effect), nullptr) << effect;
    EXPECT_EQ(left_out(with, effect), nullptr) << effect;
    EXPECT_TRUE(arrays_of(reduced_model(with)) == arrays_of(reduced_model(expected))) << effect;
    for (const std::string& other : given) {
      EXPECT_EQ(is_given(with, other), other == effect) << effect << ", " << other;
    }
    const SceneDescription without = without_effect(with, effect);
    EXPECT_FALSE(is_given(without, effect)) << effect;
    EXPECT_TRUE(arrays_of(reduced_model(without)) == arrays_of(reduced_model(scene))) << effect;
  }
  EXPECT_THROW(static_cast<void>(with_effect(scene, "centrifugal")), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(without_effect(scene, "maps")), std::invalid_argument);
}

// Results that are kept go by this text.
TEST(EffectsLeftOut, AreWrittenInTheSceneThatIsKept) {
  const SceneDescription scene = scene_of(modal, {rough, off("roughness")});
  EXPECT_NE(scene.complete_toml, scene_of(modal, {rough}).complete_toml);
  const SceneDescription again = parse_scene(scene.complete_toml, "scene.toml", "/nowhere", {});
  EXPECT_FALSE(is_rough(again));
  EXPECT_TRUE(is_rough(as_written(again)));
}

}  // namespace
}  // namespace microslip::pipelines::test_effects_left_out
