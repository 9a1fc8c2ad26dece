// [effects] against the rest of a scene: settings that contradict another key are refused, and both
// are named.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "pipelines/scene/scene_file.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/effect_table.hpp"

namespace microslip::pipelines::test_effects_section {
namespace {

using Overrides = std::vector<std::string>;

constexpr const char* modal = R"toml([model]
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
[response]
frequency = [8, 12]
harmonics = 3
)toml";

constexpr const char* chain = R"toml([model]
kind = "chain"
masses = [1]
springs = [1e4]
[modes]
damping_ratio = 0.02
[contact]
points = [ { slip = "m1", tangential_stiffness = 1e4, friction_coefficient = 0.5, cells = [2, 2], size = [0.1, 0.1] } ]
[excitation]
forces = [ { at = "m1", amplitude = 1 } ]
[response]
output = "m1"
frequency = [10, 30]
preload = ["free", 10, "stuck"]
)toml";

constexpr const char* chain_that_opens = R"toml([model]
kind = "chain"
coordinates = ["x1", "y1"]
frequency = [20]
mode_shapes = [[0.5, 0.7]]
[modes]
damping_ratio = 0.02
[contact]
points = [ { slip = "y1", approach = "x1", tangential_stiffness = 4e4, normal_stiffness = 4e4, friction_coefficient = 0.5 } ]
[excitation]
forces = [ { at = "y1", amplitude = 1 } ]
[response]
output = "y1"
frequency = [18, 28]
preload = [50]
)toml";

constexpr const char* blade = R"toml([model]
kind = "blade"
[material]
youngs_modulus = 2e11
poissons_ratio = 0.3
density = 7800
[supports]
clamped = ["root"]
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

constexpr const char* pressing =
    "static.forces=[{ at = \"B\", direction = [1, 0, 0], amplitude = 50 }]";

/// Empty: the scene is taken.
std::string complaint(const char* text, const Overrides& overrides) {
  try {
    static_cast<void>(parse_scene(text, "scene.toml", "/nowhere", overrides));
    return {};
  } catch (const SceneError& error) {
    return error.what();
  }
}

struct Contradicting {
  const char* text;
  Overrides overrides;
  const char* effect;  ///< its key,
  const char* other;   ///< and the one that it contradicts
};

class Contradictions : public testing::TestWithParam<Contradicting> {};

TEST_P(Contradictions, AreRefusedByBothNames) {
  const Contradicting& scene = GetParam();
  const std::string message = complaint(scene.text, scene.overrides);
  EXPECT_NE(message.find(std::string("effects.") + scene.effect + ": "), std::string::npos)
      << message;
  EXPECT_NE(message.find(scene.other), std::string::npos) << message;
}

const char* const no_normal = "normal_stiffness";
const std::string wear = "contact.wear_coefficient=1e-13";

INSTANTIATE_TEST_SUITE_P(
    OfAScene, Contradictions,
    testing::Values(
        Contradicting{
            modal, {"effects.nonlinearity=on", "modal.points="}, "nonlinearity", "[contact]"},
        Contradicting{chain, {"effects.nonlinearity=off"}, "nonlinearity", "response.preload"},
        Contradicting{modal, {"effects.nonlinearity=off"}, "nonlinearity", "preload_scale"},
        Contradicting{chain,
                      {"effects.nonlinearity=off", "response.preload=[\"free\", \"stuck\"]",
                       "response.optimum=preload", "response.optimum_range=[1, 100]"},
                      "nonlinearity",
                      "response.optimum"},
        Contradicting{chain, {"effects.normal_motion=on"}, "normal_motion", no_normal},
        Contradicting{
            blade,
            {"effects.normal_motion=off", "contact.roughness={ law = \"cubic\", height = 1e-6 }"},
            "normal_motion",
            "contact.roughness"},
        Contradicting{blade,
                      {"effects.normal_motion=off", "response.preload=[\"free\", -100]"},
                      "normal_motion",
                      "response.preload"},
        Contradicting{blade,
                      {"effects.normal_motion=off", "response.preload=[{ gap = \"10 um\" }]"},
                      "normal_motion",
                      "response.preload"},
        Contradicting{modal,
                      {"effects.normal_motion=off", "modal.points[0].preload=-20"},
                      "normal_motion",
                      "preload of every contact point"},
        Contradicting{modal,
                      {"effects.separation=on", "effects.normal_motion=off"},
                      "separation",
                      "effects.normal_motion"},
        Contradicting{chain, {"effects.separation=on"}, "separation", no_normal},
        Contradicting{modal,
                      {"effects.separation=off", "modal.points[0].preload=-20"},
                      "separation",
                      "response.preload"},
        Contradicting{chain_that_opens,
                      {"effects.separation=off", "response.preload=[50, -1e5]"},
                      "separation",
                      "response.preload"},
        Contradicting{modal,
                      {"effects.mean_coupling=on", "effects.normal_motion=off"},
                      "mean_coupling",
                      "effects.normal_motion"},
        Contradicting{chain, {"effects.mean_coupling=on"}, "mean_coupling", no_normal},
        Contradicting{modal, {"effects.second_direction=on"}, "second_direction", "phi_w_1"},
        Contradicting{chain, {"effects.second_direction=on"}, "second_direction", "along r"},
        Contradicting{blade,
                      {"effects.second_direction=on", "contact.friction_coefficient=0"},
                      "second_direction",
                      "friction_coefficient"},
        Contradicting{modal,
                      {"effects.higher_harmonics=on", "response.harmonics=1"},
                      "higher_harmonics",
                      "response.harmonics"},
        Contradicting{
            modal, {"effects.higher_harmonics=off"}, "higher_harmonics", "response.harmonics"},
        Contradicting{
            modal,
            {"effects.higher_harmonics=off", "response.harmonics=1", "response.method=time"},
            "higher_harmonics",
            "response.method"},
        Contradicting{modal, {"effects.roughness=on"}, "roughness", "contact.roughness"},
        Contradicting{modal,
                      {"effects.rate_dependence=on"},
                      "rate_dependence",
                      "contact.friction_coefficient"}));

INSTANTIATE_TEST_SUITE_P(
    OfItsOtherSections, Contradictions,
    testing::Values(
        Contradicting{modal, {"effects.moments=on"}, "moments", "contact.points"},
        Contradicting{modal, {"effects.residual=on"}, "residual", "modes.residual"},
        Contradicting{blade,
                      {"effects.residual=off", "contact.normal_stiffness=rigid"},
                      "residual",
                      "normal_stiffness"},
        Contradicting{modal, {"effects.local_frames=on"}, "local_frames", "contact.surface"},
        Contradicting{
            blade, {"effects.local_frames=on", "contact.fit=3"}, "local_frames", "contact.fit"},
        Contradicting{blade,
                      {"effects.local_frames=on", "contact.preload_moment=[1, 0]"},
                      "local_frames",
                      "contact.preload_moment"},
        Contradicting{
            blade,
            {"effects.local_frames=on", "contact.preload_moment=[1, 0]", "effects.moments=off"},
            "local_frames",
            "contact.preload_moment"},
        Contradicting{
            blade, {"effects.static_preload=on"}, "static_preload", "contact.preload = \"static\""},
        Contradicting{blade, {"effects.centrifugal=on"}, "centrifugal", "static.speed"},
        Contradicting{blade,
                      {"effects.centrifugal=off", "contact.preload=static",
                       "static.speed=\"3000 rpm\"", "static.axis={ direction = [1, 0, 0] }"},
                      "centrifugal",
                      "contact.preload"},
        Contradicting{blade,
                      {"effects.centrifugal=off", "static.speed=\"3000 rpm\"",
                       "static.axis={ direction = [1, 0, 0] }", "response.optimum=static.speed",
                       "response.optimum_range=[10, 100]", "response.optimum_at=100"},
                      "centrifugal",
                      "response.optimum"},
        Contradicting{modal, {"effects.wear=on"}, "wear", "contact.wear_coefficient"},
        Contradicting{modal, {"effects.wear=on", wear}, "wear", "response.maps"},
        Contradicting{modal,
                      {"effects.wear=on", wear, "response.maps=[\"peak\"]", "effects.maps=off"},
                      "wear",
                      "effects.maps"},
        Contradicting{modal, {"effects.maps=on"}, "maps", "response.maps"},
        Contradicting{modal,
                      {"effects.coexistence=on", "response.search_starts=0"},
                      "coexistence",
                      "response.search_starts"},
        Contradicting{modal,
                      {"effects.coexistence=off", "response.search_starts=4"},
                      "coexistence",
                      "response.search_starts"},
        Contradicting{modal,
                      {"effects.coexistence=on", "response.method=time"},
                      "coexistence",
                      "response.method"}));

TEST(EffectsSection, WhatOnlyNonlinearContactDoesIsRefusedWithoutIt) {
  const Overrides linear{
      "effects.nonlinearity=off", "response.preload=[\"free\", \"stuck\"]", "response.harmonics=3",
      "contact.friction_coefficient={ law = \"hyperbolic\", static = 0.4, rate = 1 }"};
  EXPECT_EQ(complaint(blade, linear), "");
  for (const char* effect :
       {"separation", "mean_coupling", "higher_harmonics", "rate_dependence", "coexistence"}) {
    Overrides all = linear;
    all.push_back(std::string("effects.") + effect + "=on");
    const std::string message = complaint(blade, all);
    EXPECT_NE(message.find(std::string("effects.") + effect + ": "), std::string::npos) << message;
    EXPECT_NE(message.find("effects.nonlinearity"), std::string::npos) << message;
  }
}

TEST(EffectsSection, WhatOnlyContactUnderALoadDoesIsRefusedOfTheLimitsAlone) {
  const Overrides limits{
      "response.preload=[\"free\", \"stuck\"]", "response.harmonics=3",
      "contact.friction_coefficient={ law = \"hyperbolic\", static = 0.4, rate = 1 }",
      "contact.roughness={ law = \"cubic\", height = 1e-6 }"};
  EXPECT_EQ(complaint(blade, limits), "");
  for (const char* effect : {"nonlinearity", "separation", "mean_coupling", "higher_harmonics",
                             "roughness", "rate_dependence", "coexistence"}) {
    Overrides all = limits;
    all.push_back(std::string("effects.") + effect + "=on");
    const std::string message = complaint(blade, all);
    EXPECT_NE(message.find(std::string("effects.") + effect + ": "), std::string::npos) << message;
    EXPECT_NE(message.find("response.preload (--set response.preload="), std::string::npos)
        << message;
    all.front() = "response.preload=[\"free\", 100]";
    EXPECT_EQ(complaint(blade, all), "") << effect;
  }
}

// Which key to leave out, and where it stands: the scene or the command line has it.
TEST(EffectsSection, TheOtherKeyIsToldWithItsPlace) {
  EXPECT_EQ(complaint(modal, {"effects.higher_harmonics=off"}),
            "--set effects.higher_harmonics=off: effects.higher_harmonics: \"off\" contradicts "
            "response.harmonics; leave out response.harmonics (scene.toml:20) or "
            "effects.higher_harmonics");
  const std::string by_hand =
      complaint(modal, {"effects.higher_harmonics=off", "response.harmonics=5"});
  EXPECT_NE(by_hand.find("response.harmonics (--set response.harmonics=5) or"), std::string::npos)
      << by_hand;
  const std::string rough = complaint(
      blade, {"effects.normal_motion=off", "contact.roughness={ law = \"cubic\", height = 1e-6 }"});
  EXPECT_NE(rough.find("leave out contact.roughness (--set contact.roughness="), std::string::npos)
      << rough;
  const std::string lacking = complaint(modal, {"effects.wear=on"});
  EXPECT_NE(lacking.find("needs contact.wear_coefficient; else leave out effects.wear"),
            std::string::npos)
      << lacking;
}

// The range of the search, which has no gap, contradicts nothing, though it stands first.
TEST(EffectsSection, TheKeyThatContradictsIsNamed) {
  for (const std::string effect : {"normal_motion", "separation"}) {
    const std::string message =
        complaint(blade, {"response.optimum=preload", "response.optimum_range=[10, 100]",
                          "response.preload=[-100]", "effects." + effect + "=off"});
    EXPECT_NE(
        message.find("leave out response.preload (--set response.preload=[-100]) or effects." +
                     effect),
        std::string::npos)
        << message;
    EXPECT_EQ(message.find("optimum_range"), std::string::npos) << message;
  }
}

// The second contact is fitted by a polynomial; the first has the same key and is not.
TEST(EffectsSection, TheContactThatContradictsIsNamed) {
  const std::string second = std::string(blade).replace(std::string(blade).find("[contact]"), 9,
                                                        "[[contact]]\nfit = "
                                                        "\"none\"");
  const std::string message = complaint(
      (second + "[[contact]]\nsurface = \"other\"\nslip_direction = [0, 1, 0]\n"
                "friction_coefficient = 0.4\nnormal_stiffness = 1e12\n"
                "tangential_stiffness = 1e12\nfit = 3\n[effects]\nlocal_frames = \"on\"\n")
          .c_str(),
      {});
  EXPECT_NE(message.find("leave out contact.fit (scene.toml:28) or effects.local_frames"),
            std::string::npos)
      << message;
}

// Preloads of a static scene that does not say are the program's, and nothing to leave out.
TEST(EffectsSection, AKeyThatNobodyHasWrittenIsNotToBeLeftOut) {
  const std::string message = complaint(
      blade, {"effects.nonlinearity=off", "response.preload=", "contact.preload=static", pressing});
  EXPECT_NE(message.find("contradicts response.preload"), std::string::npos) << message;
  EXPECT_NE(message.find("; else leave out effects.nonlinearity"), std::string::npos) << message;
}

TEST(EffectsSection, HarmonicsLeftToTheProgramAreOneWhereHigherOnesAreOff) {
  const SceneDescription scene = parse_scene(
      modal, "scene.toml", "/nowhere", {"effects.higher_harmonics=off", "response.harmonics=auto"});
  EXPECT_EQ(scene.settings.harmonics.highest, 1);
  EXPECT_FALSE(scene.settings.harmonics.chosen());
}

TEST(EffectsSection, ASpeedWithoutAnAxisIsRefusedByBothNames) {
  const std::string message = complaint(blade, {"static.speed=\"3000 rpm\""});
  EXPECT_NE(message.find("static.speed"), std::string::npos) << message;
  EXPECT_NE(message.find("static.axis"), std::string::npos) << message;
}

TEST(EffectsSection, SettingsThatAgreeAreTaken) {
  EXPECT_EQ(complaint(modal, {"effects.separation=on", "effects.normal_motion=on"}), "");
  EXPECT_EQ(complaint(modal, {"effects.separation=off", "effects.normal_motion=off",
                              "effects.mean_coupling=off"}),
            "");
  EXPECT_EQ(
      complaint(chain, {"effects.nonlinearity=off", "response.preload=[\"free\", \"stuck\"]"}), "");
  EXPECT_EQ(complaint(modal, {"effects.coexistence=on", "response.search_starts=4"}), "");
  EXPECT_EQ(complaint(modal, {"effects.higher_harmonics=on", "response.harmonics=1",
                              "response.method=time"}),
            "");
  EXPECT_EQ(complaint(modal, {"effects.wear=on", wear, "response.maps=[\"peak\"]"}), "");
  EXPECT_EQ(complaint(blade, {"effects.static_preload=off", "contact.preload=static", pressing}),
            "");
}

TEST(EffectsSection, EveryRowOfTheTableIsAKey) {
  for (const EffectRow& row : effect_table) {
    const std::string key = "effects." + std::string(row.name);
    EXPECT_EQ(complaint(modal, {key + "=auto"}), "") << key;
    EXPECT_NE(complaint(modal, {key + "=perhaps"}).find("auto, on, off"), std::string::npos) << key;
  }
}

}  // namespace
}  // namespace microslip::pipelines::test_effects_section
