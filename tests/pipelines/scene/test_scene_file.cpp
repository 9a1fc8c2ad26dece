#include "pipelines/scene/scene_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "pipelines/scene/scene_template.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/toml_text.hpp"
#include "tests/support/mutated_text.hpp"
#include "tests/support/temporary_folder.hpp"

namespace microslip::pipelines::test_scene_file {
namespace {

using Overrides = std::vector<std::string>;

constexpr const char* blade_text = R"([model]
kind = "blade"
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
density = 7800
[supports]
clamped = ["root"]
[modes]
count = 3
damping_ratio = "0.2 %"
[contact]
surface = "contact"
friction_coefficient = 0.4
normal_stiffness = "1e12 N/m^3"
tangential_stiffness = "rigid"
wear_coefficient = "1e-13 m^2/N"
[excitation]
forces = [ { at = "B", direction = [2, 0, 0], amplitude = "0.5 N" } ]
[response]
output = { at = "A", direction = [1, 0, 0] }
frequency = ["350 Hz", "0.25 kHz"]
preload = [ "free", -5e5, "1 kN", "stuck" ]
maps = [ "peak", "folds", "315 Hz" ]
)";

constexpr const char* modal_text = R"([model]
kind = "modal"
[modal]
frequency = [15.9, 41.4]
damping_ratio = 0.01
force_sine = [0.0, 0.3]
force_cosine = [1.0, 0.4]
output = [0.9, 0.35]
points = [
  { weight = 1, tangential_stiffness = 1e4, normal_stiffness = 2e4, friction_coefficient = 0.3, preload = -2, phi_u_1 = 0.8, phi_u_2 = -0.5 },
  { weight = 2, tangential_stiffness = 1e4, normal_stiffness = 2e4, friction_coefficient = 0.3, preload = 2, phi_u_1 = 0.8, phi_u_2 = -0.5, phi_v_2 = 0.25 },
]
[response]
frequency = 20
)";

SceneDescription parse(const std::string& text, const Overrides& overrides = {}) {
  return parse_scene(text, "scene.toml", "/nowhere", overrides);
}

/// Message of the SceneError; empty when the scene is taken.
std::string complaint(const std::string& text, const Overrides& overrides = {}) {
  try {
    static_cast<void>(parse(text, overrides));
    return {};
  } catch (const SceneError& error) {
    return error.what();
  }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

void expect_complaint(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_NE(message.find(part), std::string::npos) << "\"" << message << "\" lacks " << part;
  }
}

std::size_t line_of(const std::string& text, const std::string& part) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(text.find(part));
  return static_cast<std::size_t>(std::count(text.begin(), end, '\n')) + 1;
}

// ---- what is read

TEST(SceneFile, ABladeSceneIsReadInSi) {
  const SceneDescription scene = parse(blade_text);
  EXPECT_DOUBLE_EQ(scene.material.youngs_modulus, 2.1e11);
  EXPECT_EQ(scene.clamped, std::vector<std::string>{"root"});
  EXPECT_DOUBLE_EQ(std::get<std::vector<double>>(scene.modes.damping).at(0), 0.002);
  EXPECT_EQ(scene.contacts.front().normal_stiffness, 1e12);
  EXPECT_FALSE(scene.contacts.front().tangential_stiffness.has_value());
  EXPECT_DOUBLE_EQ(scene.contacts.front().wear_coefficient, 1e-13);
  ASSERT_EQ(scene.forces.size(), 1U);
  EXPECT_EQ(scene.forces[0].direction, Eigen::Vector3d::UnitX());
  EXPECT_EQ(scene.response->frequency_begin_hz, 350.0);
  EXPECT_EQ(scene.response->frequency_end_hz, 250.0);
  const std::vector<PreloadEntry> preload{LimitName::free, -5e5, 1000.0, LimitName::stuck};
  EXPECT_EQ(scene.response->preload, preload);
  const std::vector<MapEntry> maps{MapName::peak, MapName::folds, 315.0};
  EXPECT_EQ(scene.response->maps, maps);
}

// For what is refused when the scene has been read: by its model.
TEST(SceneFile, KnowsWhereItsKeysStand) {
  const SceneDescription scene =
      parse_scene(blade_text, "scene.toml", "/nowhere", {"effects.stability=off"});
  EXPECT_EQ(place_in(scene, "response.frequency"), "scene.toml:22: response.frequency");
  EXPECT_EQ(place_in(scene, "effects.stability"), "--set effects.stability=off: effects.stability");
  EXPECT_EQ(place_in(scene, "modes.solver"), "modes.solver");
}

TEST(SceneFile, EveryKeyOfTheBladeHasADefault) {
  const BladeModel blade = std::get<BladeModel>(parse(blade_text).model);
  const mesh::BladeGeometry& g = blade.geometry;
  for (const double length : {blade.sizes.element_size, g.root_width, g.root_height, g.root_length,
                              g.platform_width, g.platform_height, g.platform_length, g.span,
                              g.root_chord, g.tip_chord, g.root_thickness, g.tip_thickness}) {
    EXPECT_GT(length, 0.0);
    EXPECT_LT(length, 1.0);
  }
}

TEST(SceneFile, AModalSceneIsReadWithItsPoints) {
  const SceneDescription scene = parse(modal_text);
  const auto& modal = std::get<ModalModel>(scene.model);
  EXPECT_EQ(modal.frequency_hz, Eigen::Vector2d(15.9, 41.4));
  EXPECT_EQ(modal.damping_ratio, Eigen::Vector2d(0.01, 0.01));
  EXPECT_EQ(modal.force_static, Eigen::Vector2d::Zero());
  ASSERT_EQ(modal.points.size(), 2U);
  EXPECT_EQ(modal.points[0].rest_load, -2.0);
  EXPECT_EQ(modal.points[1].normal_stiffness, 2e4);
  EXPECT_EQ(modal.weights, Eigen::Vector2d(1.0, 2.0));
  EXPECT_EQ(modal.shapes.u(1, 1), -0.5);
  EXPECT_EQ(modal.shapes.v(0, 1), 0.0);
  EXPECT_EQ(modal.shapes.v(1, 1), 0.25);
  EXPECT_EQ(modal.positions.rows(), 0);
  EXPECT_EQ(scene.response->frequency_begin_hz, 20.0);
  EXPECT_EQ(scene.response->frequency_end_hz, 20.0);
  EXPECT_EQ(scene.response->preload_scale, std::vector<double>{1.0});
}

TEST(SceneFile, AngularFrequenciesAreTurnedIntoHertz) {
  const std::string text =
      replaced(modal_text, "frequency = [15.9, 41.4]", "angular_frequency = [100, \"600 rpm\"]");
  const auto modal = std::get<ModalModel>(parse(text).model);
  EXPECT_DOUBLE_EQ(modal.frequency_hz[0], 50.0 / std::numbers::pi);
  EXPECT_DOUBLE_EQ(modal.frequency_hz[1], 10.0);
}

TEST(SceneFile, DampingIsANumberAListOrATable) {
  const auto damping = [](const std::string& value) {
    return parse(blade_text, {"modes.damping_ratio=" + value}).modes.damping;
  };
  EXPECT_EQ(std::get<std::vector<double>>(damping("[0.1, 0, 0.5]")),
            (std::vector<double>{0.1, 0.0, 0.5}));
  EXPECT_EQ(std::get<RayleighDamping>(damping("{ alpha = 2, beta = 1e-6 }")).beta, 1e-6);
  EXPECT_EQ(std::get<std::vector<double>>(damping("0")), std::vector<double>{0.0});
}

TEST(SceneFile, LineEndsTabsAndByteOrderMarkDoNotMatter) {
  std::string windows = "\xEF\xBB\xBF";
  for (const char c : std::string(blade_text)) {
    if (c == '\n') windows += '\r';
    windows += c;
    if (c == '=') windows += '\t';
  }
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "scene.toml", std::ios::binary) << windows;
  const SceneDescription scene = read_scene(folder.path() / "scene.toml");
  EXPECT_EQ(scene.complete_toml, parse(blade_text).complete_toml);
}

TEST(SceneFile, PointsComeFromACsvFileBesideTheScene) {
  const test::TemporaryFolder folder;
  const std::filesystem::path below = folder.path() / "with space ä";
  std::filesystem::create_directory(below);
  std::ofstream(below / "points.csv")
      << "preload,phi_u_2,phi_u_1,\"weight\",friction_coefficient,r,"
         "normal_stiffness,tangential_stiffness\r\n"
         "5,0.2,0.1,3,0.4,0.7,100,200\r\n";
  std::string text(modal_text);
  const auto begin = text.find("points = [");
  text.replace(begin, text.find("]\n[response]") + 2 - begin, "points = \"points.csv\"\n");
  std::ofstream(below / "scene.toml") << text;
  const SceneDescription scene = read_scene(below / "scene.toml");
  const auto& modal = std::get<ModalModel>(scene.model);
  ASSERT_EQ(modal.points.size(), 1U);
  EXPECT_EQ(modal.points[0].tangential_stiffness, 200.0);
  EXPECT_EQ(modal.shapes.u.row(0), Eigen::RowVector2d(0.1, 0.2));
  EXPECT_EQ(modal.positions.row(0), Eigen::RowVector2d(0.0, 0.7));

  // The completed scene stands in another folder and still finds its points.
  const test::TemporaryFolder elsewhere;
  std::ofstream(elsewhere.path() / "scene.toml") << scene.complete_toml;
  EXPECT_EQ(std::get<ModalModel>(read_scene(elsewhere.path() / "scene.toml").model).points.size(),
            1U);
}

// ---- the completed scene

TEST(SceneFile, TheCompletedSceneReadsBackToItself) {
  for (const char* text : {blade_text, modal_text}) {
    const std::string complete = parse(text, {"title=a \"quoted\" ü"}).complete_toml;
    EXPECT_EQ(parse(complete).complete_toml, complete);
  }
}

TEST(SceneFile, TheCompletedSceneHasDefaultsAndOverrides) {
  const std::string complete =
      parse(blade_text, {"excitation.forces[0].amplitude=2", "contact.fit=7"}).complete_toml;
  for (const char* part : {"span = \"114.1 mm\"", "amplitude = 2", "phase = 0", "fit = 7",
                           "slip_direction = [0, 0, 1]", "normal_motion = \"auto\"",
                           "method = \"harmonic_balance\"", "length_unit"}) {
    const bool expected = std::string(part) != "length_unit";  // a key of another kind
    EXPECT_EQ(complete.find(part) != std::string::npos, expected) << part << "\n" << complete;
  }
  EXPECT_LT(complete.find("[model]"), complete.find("[material]"));
}

TEST(SceneFile, NumbersOfTheCompletedSceneKeepEveryDigitAndNoMore) {
  for (const char* number : {"0.10000000000000002", "0.3", "1e-90", "2.0", "3"}) {
    const std::string assignment = std::string("contact.friction_coefficient=") + number;
    const SceneDescription scene = parse(blade_text, {assignment});
    EXPECT_EQ(std::get<double>(parse(scene.complete_toml).contacts.front().friction.value),
              std::get<double>(scene.contacts.front().friction.value));
    EXPECT_NE(scene.complete_toml.find(std::string("friction_coefficient = ") + number + "\n"),
              std::string::npos)
        << scene.complete_toml;
  }
}

TEST(SceneFile, LettersBeyondAsciiStandInQuotesAndComments) {
  // toml++ 3.3 asks for white space among them and runs past the end of its table.
  const auto complaint = [](const std::string& text) -> std::string {
    try {
      static_cast<void>(parse_toml(text, "scene.toml"));
    } catch (const SceneError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(complaint("\xEF\xBB\xBF# \u03ba\n[model]\nname = \"\u03ba\"  # \u03ba\n"), "");
  EXPECT_EQ(complaint("[model]\nname = \"\"\"\n\u03ba\n\"\"\"\nother = '\u03ba'\n"), "");
  for (const std::string text : {"[model]\nend_\u03ba = 3\n", "[model]\na = \u03ba\n"}) {
    EXPECT_TRUE(complaint(text).starts_with("scene.toml:2:5: ")) << complaint(text);
    EXPECT_NE(complaint(text).find("not plain ASCII"), std::string::npos) << complaint(text);
  }
  EXPECT_NE(complaint("[model]\nlength = 2 \u00b5m\n").find("in quotes: \"2 \u00b5m\""),
            std::string::npos);
}

TEST(SceneFile, TextsOfTheCompletedSceneSurviveQuotesAndControls) {
  for (const char* title : {"plain", "it's", "a \"b\" c", "back\\slash", "two\nlines", "tab\there",
                            "é ✓", "x '''", "\x7f"}) {
    const SceneDescription scene = parse(modal_text, {std::string("title=") + title});
    EXPECT_EQ(scene.title, title);
    EXPECT_EQ(parse(scene.complete_toml).title, scene.title) << scene.complete_toml;
  }
}

TEST(SceneTemplate, IsAcceptedAsItIsAndHoldsTheDefaults) {
  for (const char* kind : {"blade", "step", "mesh", "modes", "modal", "bar", "chain"}) {
    EXPECT_EQ(complaint(scene_template(kind)), "") << kind;
  }
  expect_complaint(
      [] {
        try {
          static_cast<void>(scene_template("plate"));
        } catch (const SceneError& error) {
          return std::string(error.what());
        }
        return std::string();
      }(),
      {"plate", "blade, step, mesh, modes, modal, bar, chain"});
}

TEST(SceneFile, FacesOfAStepFileHaveNames) {
  const SceneDescription scene =
      parse(scene_template("step"), {"faces.tip=[{ number = 3 }, { point = ['1 mm', 0, 0], size = "
                                     "'2 mm', edge_size = '1 mm' }]"});
  const auto& step = std::get<StepModel>(scene.model);
  ASSERT_EQ(step.faces.size(), 3U);
  const FaceDescription& tip = step.faces.back();
  EXPECT_EQ(tip.name, "tip");
  ASSERT_EQ(tip.choices.size(), 2U);
  EXPECT_EQ(tip.choices[0].number, 3);
  EXPECT_DOUBLE_EQ(tip.choices[1].point->x(), 1e-3);
  EXPECT_EQ(tip.choices[1].edge_size, 1e-3);
  const SceneDescription again = parse(scene.complete_toml);
  EXPECT_EQ(std::get<StepModel>(again.model).faces.back().choices[1].size, 2e-3);
  EXPECT_EQ(*element_size_of(with_elements_scaled(again, 2.0)), 2.0 * step.element_size);
}

TEST(SceneFile, AFaceIsNamedInOneWay) {
  const std::string text = scene_template("step");
  expect_complaint(complaint(text, {"faces.tip={ size = 0.001 }"}), {"faces.tip", "here are 0"});
  expect_complaint(complaint(text, {"faces.tip={ number = 1, normal = [1, 0, 0] }"}),
                   {"faces.tip", "here are 2"});
  expect_complaint(complaint(text, {"faces.tip={ number = 1, near = [1, 0, 0] }"}),
                   {"near", "goes with normal"});
  expect_complaint(complaint(text, {"faces.tip=7"}), {"faces.tip", "expected a table", "found 7"});
  expect_complaint(complaint(text, {"faces.tip=[]"}), {"faces.tip", "the list is empty"});
}

// ---- overrides

TEST(Overrides, AnyKeyMayBeSetAlsoInsideLists) {
  const SceneDescription scene =
      parse(blade_text, {"excitation.forces[0].amplitude=2 N", "response.preload[1]=7",
                         "model.span=120 mm", "effects.stability=on", "response.frequency=300"});
  EXPECT_EQ(scene.forces[0].amplitude, 2.0);
  EXPECT_EQ(scene.response->preload[1], PreloadEntry(7.0));
  EXPECT_DOUBLE_EQ(std::get<BladeModel>(scene.model).geometry.span, 0.12);
  EXPECT_EQ(scene.response->frequency_end_hz, 300.0);
}

TEST(Overrides, AMissingSectionIsMade) {
  EXPECT_EQ(setting_of(parse(modal_text, {"effects.separation=on"}), "separation"), "on");
}

TEST(Overrides, TheLastOneHolds) {
  EXPECT_EQ(parse(blade_text, {"modes.count=4", "modes.count=5"}).settings.basis.n_modes, 5);
}

TEST(Overrides, MessagesNameTheOverride) {
  expect_complaint(complaint(modal_text, {"modal.frequncy=3"}),
                   {"--set modal.frequncy=3", "did you mean \"frequency\"?"});
  expect_complaint(complaint(blade_text, {"contact.friction_coefficient=-1"}),
                   {"--set contact.friction_coefficient=-1", "out of range"});
  expect_complaint(complaint(blade_text, {"material.density=5 m"}), {"--set", "density", "kg/m^3"});
  expect_complaint(complaint(blade_text, {"foo.bar=1"}), {"--set foo.bar=1", "foo"});
  expect_complaint(complaint(modal_text, {"response.frequency=[1, nan]"}), {"--set", "finite"});
  expect_complaint(complaint(modal_text, {"modal.points[0].preload=nan"}), {"--set", "preload"});
}

TEST(SceneFile, RoughPointsNeedNormalStiffness) {
  const std::string text =
      replaced(modal_text, "weight = 2, tangential_stiffness = 1e4, normal_stiffness = 2e4",
               "weight = 2, tangential_stiffness = 1e4, normal_stiffness = 0");
  EXPECT_EQ(complaint(text), "");
  expect_complaint(complaint(text, {"contact.roughness={ law = \"cubic\", height = \"1 um\" }"}),
                   {"contact.roughness", "point 2 of 2", "normal_stiffness"});
}

TEST(Overrides, OneWithoutAValueTakesTheKeyAway) {
  EXPECT_EQ(parse(blade_text, {"contact.wear_coefficient="}).contacts.front().wear_coefficient,
            0.0);
  EXPECT_EQ(parse(blade_text, {"response.preload[0]="}).response->preload.size() + 1,
            parse(blade_text).response->preload.size());
  expect_complaint(complaint(blade_text, {"material.density="}), {"material.density", "missing"});
  expect_complaint(complaint(blade_text, {"response.optimun="}),
                   {"--set response.optimun=", "no \"optimun\""});
  expect_complaint(complaint(blade_text, {"sections.key="}), {"no \"sections\""});
}

TEST(Overrides, BrokenOnesAreRefused) {
  for (const char* broken :
       {"", "=", "=5", "modes.count", "modes..count=5", ".count=5", "modes.=5",
        "response.preload[=1", "response.preload[x]=1", "response.preload[9]=1",
        "response.preload[-1]=1", "response.preload[0]x=1", "title[0]=x", "modes.count.more=5",
        "model[0].kind=blade"}) {
    EXPECT_NE(complaint(blade_text, {broken}), "") << broken;
    EXPECT_NE(complaint(blade_text, {broken}).find("--set"), std::string::npos) << broken;
  }
}

TEST(Overrides, ALineBreakDoesNotSmuggleInAnotherKey) {
  const SceneDescription scene = parse(modal_text, {"title=1\nmodes=2"});
  EXPECT_EQ(scene.title, "1\nmodes=2");
}

// ---- what is refused

TEST(BadScene, UnknownKeysAreNamedWithLineAndNearestName) {
  const std::string text = replaced(blade_text, "youngs_modulus", "young_modulus");
  expect_complaint(complaint(text),
                   {"scene.toml:" + std::to_string(line_of(text, "young_modulus")) + ": ",
                    "material.young_modulus", "did you mean \"youngs_modulus\"?"});
  expect_complaint(complaint(replaced(blade_text, "[supports]", "[suports]")),
                   {"suports", "did you mean \"supports\"?"});
  expect_complaint(complaint(replaced(blade_text, "amplitude", "amplitud")),
                   {"excitation.forces.amplitud", "did you mean \"amplitude\"?"});
}

TEST(BadScene, WhatAForceOrAContactLacksIsSaidInWordsOfAnEngineer) {
  const std::string text = replaced(blade_text, ", amplitude = \"0.5 N\"", "");
  expect_complaint(complaint(text), {"excitation.forces.amplitude: is missing: F, the whole force",
                                     "e.g. \"0.5 N\" [N]"});
  expect_complaint(complaint(blade_text, {"contact.surface=[\"top\", \"shroud\"]"}),
                   {"contact.surface", "[[contact]]"});
}

TEST(BadScene, AFileThatIsNotThereIsToldWithItsKeyAndASimilarName) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "mu_hot.csv") << "p,r,value\n0,0,0.3\n";
  const auto told = [&](const std::string& name) {
    return complaint(blade_text, {fmt::format("contact.friction_coefficient={{ file = \"{}\" }}",
                                              (folder.path() / name).string())});
  };
  expect_complaint(told("mu_hto.csv"),
                   {"contact.friction_coefficient: ", "mu_hto.csv: no such file",
                    "did you mean \"mu_hot.csv\"?"});
  expect_complaint(told("quite_another.csv"), {"beside it: mu_hot.csv"});
  expect_complaint(told("mu.txt"), {"ends in .txt"});
  expect_complaint(told("there/mu.csv"), {"there is no folder"});
}

TEST(BadScene, MissingKeysAreNamedWithTheirSection) {
  const std::string text = replaced(blade_text, "density = 7800\n", "");
  expect_complaint(complaint(text), {"scene.toml:" + std::to_string(line_of(text, "[material]")),
                                     "material.density", "is missing", "kg/m^3"});
  expect_complaint(complaint("[model]\nkind = \"blade\"\n"), {"youngs_modulus", "missing"});
  expect_complaint(complaint(""), {"model.kind", "missing"});
}

// Row 54. Hard: text that is no TOML in every way there is.
// Met in: scenes edited by hand.
// Right: refused in a few lines with file and line.
TEST(BadScene, TomlErrorsTellTheLine) {
  for (const char* broken : {"density = 1e\n", "density = 7800\ndensity = 7800\n", "density = \n",
                             "density = \"7800\n", "density = 7,8\n", "density = 1\x01\n"}) {
    const std::string text = replaced(blade_text, "density = 7800\n", broken);
    const std::string message = complaint(text);
    const std::size_t line = line_of(text, "density");
    const bool told = message.find("scene.toml:" + std::to_string(line) + ":") == 0 ||
                      message.find("scene.toml:" + std::to_string(line + 1) + ":") == 0;
    EXPECT_TRUE(told) << message;
  }
  EXPECT_NE(complaint("\xFF\xFE\x00"), "");
}

// Row 74. Hard: a key of 40 000 dotted parts: the parser calls itself as often.
// Met in: such a key, which crashed the parser.
// Right: refused with its line, before it is parsed.
//
/// Each part of a dotted key is a call of the parser within the one before.
TEST(BadScene, KeysOfManyPartsAreRefusedBeforeTheyAreParsed) {
  std::string deep = "a";
  for (int i = 0; i < 40'000; ++i) deep += ".a";
  for (const std::string& text : {deep + " = 1\n", "[" + deep + "]\n", "[[" + deep + "]]\n",
                                  "\"a\"." + deep + " = 1\n", "x = { " + deep + " = 1 }\n"}) {
    EXPECT_EQ(complaint("# 1\n" + text).find("scene.toml:2: a key of more than 100 parts"), 0U);
  }
  EXPECT_NE(complaint(blade_text, {"material.density={ " + deep + " = 1 }"}), "");
  // Points of texts, comments and numbers are none of keys.
  const std::string points(40'000, '.');
  const std::string harmless = "# " + points + "\ntitle = \"" + points + "\\\"" + points + "\"\n";
  EXPECT_EQ(complaint(harmless + blade_text), "");
}

TEST(BadScene, NumbersAreCheckedForRangeAndSense) {
  const auto refused = [](const std::string& assignment, const std::vector<std::string>& parts) {
    const std::string message = complaint(blade_text, {assignment});
    EXPECT_NE(message, "") << assignment;
    expect_complaint(message, parts);
  };
  refused("material.density=0", {"material.density", "1e-15 to 1e+20 kg/m^3"});
  refused("material.density=1e-99", {"1e-15 to"});
  refused("material.youngs_modulus=0", {"material.youngs_modulus", "1e-15 to 1e+20 Pa"});
  refused("material.youngs_modulus=1e99", {"to 1e+20"});
  refused("material.youngs_modulus=nan", {"finite"});
  refused("material.youngs_modulus=inf", {"finite"});
  refused("material.youngs_modulus=1e400 Pa", {"youngs_modulus"});
  refused("material.youngs_modulus=210 GHz", {"youngs_modulus", "GHz", "Pa"});
  refused("material.youngs_modulus=true", {"expected a number"});
  refused("material.youngs_modulus=[1]", {"expected a number"});
  refused("material.poissons_ratio=0.5", {"poissons_ratio", "0.4999"});
  refused("modes.count=0", {"1 to 1000"});
  refused("modes.count=2.5", {"whole number"});
  refused("modes.count=99999999999", {"1 to 1000"});
  refused("modes.damping_ratio=-0.1", {"negative"});
  refused("modes.damping_ratio=[0.1, 0.1]", {"2 values for 3 modes"});
  refused("modes.damping_ratio={ alfa = 1 }", {"alfa", "alpha, beta"});
  refused("contact.slip_direction=[0, 0, 0]", {"zero"});
  refused("contact.slip_direction=[0, 1]", {"three numbers"});
  refused("contact.slip_direction=[0, nan, 1]", {"finite"});
  refused("contact.friction_coefficient=-0.1", {"at least 0"});
  refused(
      "contact.friction_coefficient={ law = \"exponential\", static = 0, kinetic = 0.4, rate = 1 }",
      {"static", "0.4", "above 0"});
  refused("contact.normal_stiffness=rgid", {"rigid"});
  refused("contact.fit=-1", {"degree"});
  refused("contact.surface=5", {"text in quotes"});
  refused("contact.surface=", {"is missing"});
  refused("supports.clamped=root", {"list"});
  refused("supports.clamped=[1]", {"quotes"});
  refused("excitation.forces=5", {"list"});
  refused("excitation.forces=[5]", {"tables"});
  refused("model.span=-1 mm", {"above 0"});
  refused("title=5", {"title", "text"});
}

TEST(BadScene, FrequenciesMustBeAboveZero) {
  expect_complaint(complaint(modal_text, {"response.frequency=0 Hz"}), {"0 Hz", "above 0"});
  expect_complaint(complaint(modal_text, {"response.frequency=[-5, 5]"}), {"above 0"});
  expect_complaint(complaint(modal_text, {"response.frequency=[1, 2, 3]"}), {"[from, to]"});
  expect_complaint(complaint(modal_text, {"response.frequency=[]"}), {"[from, to]"});
  expect_complaint(complaint(modal_text, {"response.frequency=[\"60 s\", 5]"}), {"\"s\"", "Hz"});
  EXPECT_EQ(complaint(modal_text, {"response.frequency=[\"300 rpm\", \"200 rad/s\"]"}), "");
  EXPECT_EQ(complaint(modal_text, {"response.frequency=[20, 20]"}), "");
  EXPECT_EQ(complaint(modal_text, {"response.frequency=[\"20 Hz\"]"}), "");
}

TEST(BadScene, WordsAmongNumbersAreToldTheWordsThereAre) {
  expect_complaint(complaint(blade_text, {"response.preload=[\"stcuk\"]"}),
                   {"free, stuck", "did you mean \"stuck\"?"});
  expect_complaint(complaint(blade_text, {"response.maps=[\"peaks\"]"}),
                   {"did you mean \"peak\"?"});
  expect_complaint(complaint(blade_text, {"response.preload=[]"}), {"empty"});
  expect_complaint(complaint(blade_text, {"response.preload=[\"5 mm\"]"}), {"mm", "N"});
  expect_complaint(complaint(blade_text, {"response.maps=[0]"}), {"above 0"});
}

TEST(Scene, AttachmentShapesAreTheDefaultWhereTheContactHasAStiffnessOfItsOwn) {
  const Overrides local{"contact.tangential_stiffness=1e12"};
  const SceneDescription usual = parse(blade_text, local);
  EXPECT_EQ(usual.settings.basis.residual, ResidualKind::attachment);
  EXPECT_FALSE(usual.settings.basis.attachment_degree.has_value());
  EXPECT_EQ(usual.modes.residual_note, "");
  const SceneDescription rigid = parse(blade_text, {});
  EXPECT_EQ(rigid.settings.basis.residual, ResidualKind::stiffness);
  EXPECT_NE(rigid.modes.residual_note.find("contact.tangential_stiffness"), std::string::npos);
  const SceneDescription again = parse_scene(rigid.complete_toml, "again.toml", ".", {});
  EXPECT_EQ(again.settings.basis.residual, ResidualKind::stiffness);
  EXPECT_EQ(again.modes.residual_note, "") << "the completed scene says it";
  EXPECT_EQ(
      parse(blade_text, {local[0], "modes.attachment_degree=2"}).settings.basis.attachment_degree,
      2);
  expect_complaint(complaint(blade_text, {"modes.residual=attachment"}),
                   {"modes.residual", "contact.tangential_stiffness"});
  expect_complaint(
      complaint(blade_text, {local[0], "modes.residual=none", "modes.attachment_degree=1"}),
      {"modes.attachment_degree", "\"none\""});
  for (const char* degree : {"-1", "13", "1.5", "\"many\""}) {
    expect_complaint(
        complaint(blade_text, {local[0], std::string("modes.attachment_degree=") + degree}),
        {"modes.attachment_degree", "0 to 12", "auto"});
  }
  expect_complaint(complaint(blade_text, {local[0], "modes.residual=rigid"}),
                   {"attachment", "stiffness", "none"});
}

TEST(Scene, AGapMayBeALength) {
  const auto preload =
      parse(blade_text, {"response.preload=[{ gap = \"8.4 um\" }, -5]"}).response->preload;
  ASSERT_EQ(preload.size(), 2U);
  EXPECT_NEAR(std::get<UniformGap>(preload[0]).width, 8.4e-6, 1e-20);
  EXPECT_EQ(parse(blade_text, {"response.preload={ gap = 1e-5 }"}).response->preload.front(),
            PreloadEntry(UniformGap{1e-5}));
  expect_complaint(complaint(blade_text, {"response.preload=[{ gap = \"5 N\" }]"}), {"gap", "m"});
  expect_complaint(complaint(blade_text, {"response.preload=[{ gap = 0 }]"}), {"gap", "above 0"});
  expect_complaint(complaint(blade_text, {"response.preload=[{ width = 1e-5 }]"}),
                   {"width", "gap"});
}

TEST(BadScene, WhatThisVersionDoesNotHaveIsRefusedByName) {
  const auto refused = [](const char* text, const std::string& assignment) {
    const std::string message = complaint(text, {assignment});
    EXPECT_NE(message.find("available"), std::string::npos) << assignment << ": " << message;
  };
  refused(blade_text, "model.kind=shell");
  refused(blade_text, "contact.surface=[\"a\", \"b\"]");
  EXPECT_EQ(
      setting_of(parse(blade_text, {"effects.residual=off", "modes.residual=none"}), "residual"),
      "off");
  for (const char* friction : {"0.3 m", "0.3 +* p"}) {
    expect_complaint(
        complaint(blade_text, {std::string("contact.friction_coefficient='") + friction + "'"}),
        {"contact.friction_coefficient"});
  }
  for (const char* harmonics :
       {"0", "1.0", "100", "\"all\"", "[]", "[3, 5]", "[1, 100]", "[1, 2.5]", "[1, -1]"}) {
    expect_complaint(complaint(modal_text, {std::string("response.harmonics=") + harmonics}),
                     {"response.harmonics"});
  }
  const std::string mesh = replaced(blade_text, "\"blade\"", "\"mesh\"\nfile = \"x.cas\"");
  expect_complaint(complaint(mesh), {"x.cas", ".msh, .inp"});
}

TEST(SceneFile, FrictionByPlaceIsThatOfTheModalPointsThatRub) {
  const std::string there = "contact.friction_law={ expression = \"0.3 + 10*p\" }";
  const std::string text =
      replaced(replaced(modal_text, "{ weight = 1,", "{ p = 0.01, weight = 1,"), "{ weight = 2,",
               "{ p = 0.02, weight = 2,");
  const auto friction = [](const SceneDescription& scene) {
    const std::vector<contact::PointParameters>& points = std::get<ModalModel>(scene.model).points;
    return std::array{points[0].friction_coefficient, points[1].friction_coefficient};
  };
  const SceneDescription scene = parse(text, {there});
  EXPECT_EQ(friction(scene), (std::array{0.3 + 10 * 0.01, 0.3 + 10 * 0.02}));
  EXPECT_FALSE(scene.rules.friction);
  const std::string smooth =
      replaced(text, "friction_coefficient = 0.3", "friction_coefficient = 0");
  EXPECT_EQ(friction(parse(smooth, {there}))[0], 0.0);
  expect_complaint(complaint(modal_text, {there}), {"contact.friction_law", "columns p and r"});
  expect_complaint(complaint(text, {"contact.friction_law={ expression = \"p - 1\" }"}),
                   {"contact.friction_law", "at least 0"});
}

TEST(SceneFile, LawsOfContactAreRead) {
  const SceneDescription blade = parse(
      blade_text, {"contact.friction_coefficient={ law = \"exponential\", static = 0.5, kinetic = "
                   "\"30 %\", rate = \"2 s/mm\" }",
                   "contact.roughness=[{ law = \"cubic\", height = \"3 um\" }, { law = \"cubic\", "
                   "height = \"4 um\" }]",
                   "contact.preload_field={ expression = \"1 + 10*p\" }"});
  ASSERT_TRUE(blade.contacts.front().rules.friction && blade.contacts.front().rules.roughness);
  EXPECT_EQ(blade.contacts.front().rules.friction->at(0.0).value, 0.5);
  EXPECT_NEAR(blade.contacts.front().rules.friction->at(5e-4).value, 0.3 + 0.2 * std::exp(-1.0),
              1e-15);
  EXPECT_DOUBLE_EQ(blade.contacts.front().rules.roughness->height(), 5e-6);
  ASSERT_TRUE(blade.contacts.front().preload_field.has_value());
  EXPECT_EQ(complaint(blade.complete_toml), "");
  const SceneDescription only_one = parse(blade_text, {"contact[0].tangential_stiffness=1e12"});
  EXPECT_EQ(only_one.contacts[0].tangential_stiffness, 1e12);
  const SceneDescription field = parse(blade_text, {"contact.friction_coefficient=0.3+0.1*p",
                                                    "contact.preload_moment=[\"2 N*m\", 0]"});
  const Eigen::VectorXd p = Eigen::Vector2d(0.0, 1.0);
  EXPECT_EQ(field.contacts.front().friction.at(p, p), Eigen::VectorXd(0.3 + 0.1 * p.array()));
  EXPECT_EQ(field.contacts.front().preload_moment[0], 2.0);
  const SceneDescription table =
      parse(blade_text, {"contact.friction_coefficient={ expression = \"0.3 + 0.1*p\" }"});
  EXPECT_EQ(table.contacts.front().friction.at(p, p), field.contacts.front().friction.at(p, p));
  expect_complaint(complaint(blade_text, {"contact.friction_coefficient={ law = \"hyperbolic\", "
                                          "static = 0.4, kinetic = 0.2, rate = 3 }"}),
                   {"kinetic", "known: law, static, rate"});
  const SceneDescription modal =
      parse(modal_text, {"contact.friction_law={ law = \"hyperbolic\", static = 0.4, rate = 3 }",
                         "response.harmonics=5", "response.method=time", "response.points=7"});
  EXPECT_NEAR(modal.rules.friction->at(1.0).value, 0.1, 1e-15);
  EXPECT_EQ(modal.settings.harmonics.highest, 5);
  EXPECT_EQ(modal.response->method, ResponseDescription::Method::time);
  EXPECT_EQ(modal.response->n_time_points, 7);
}

TEST(SceneFile, HarmonicsAreANumberAListOrChosen) {
  const HarmonicSettings list =
      parse(modal_text, {"response.harmonics=[5, 0, 1, 3]"}).settings.harmonics;
  EXPECT_EQ(list.orders, (std::vector<int>{5, 1, 3}));
  EXPECT_EQ(list.highest, 5);
  EXPECT_EQ(list.tolerance, 0.0);
  const HarmonicSettings chosen = parse(modal_text, {"response.harmonics=auto"}).settings.harmonics;
  EXPECT_EQ(chosen.tolerance, 1e-2);
  EXPECT_EQ(chosen.highest, most_automatic_harmonics);
  const auto finer =
      parse(modal_text, {"response.harmonics=auto", "response.harmonic_tolerance=0.01 %"});
  EXPECT_DOUBLE_EQ(finer.settings.harmonics.tolerance, 1e-4);
  EXPECT_EQ(complaint(finer.complete_toml), "");
  EXPECT_EQ(parse(modal_text, {"response.harmonics=3"}).settings.harmonics.tolerance, 0.0);
}

TEST(SceneFile, ChoicesOfHarmonicBalanceAreRefusedForTimeIntegration) {
  expect_complaint(complaint(modal_text, {"response.method=time", "response.search_starts=3"}),
                   {"response.search_starts", "harmonic_balance"});
  EXPECT_EQ(complaint(modal_text, {"response.method=time", "response.harmonics=9"}), "");
}

TEST(SceneFile, HarmonicsAreChosenWhereTheSceneDoesNotSay) {
  const HarmonicSettings silent = parse(modal_text).settings.harmonics;
  EXPECT_EQ(silent.tolerance, 1e-2);
  EXPECT_EQ(silent.highest, most_automatic_harmonics);
  // What knows one harmonic alone, or has all of them, asks for none to be chosen.
  for (const char* setting : {"response.method=time", "effects.higher_harmonics=off"}) {
    const SceneDescription scene = parse(modal_text, {setting});
    EXPECT_EQ(scene.settings.harmonics.highest, 1) << setting;
    EXPECT_EQ(scene.settings.harmonics.tolerance, 0.0) << setting;
    EXPECT_NE(scene.complete_toml.find("harmonics = 1"), std::string::npos) << setting;
  }
}

TEST(SceneFile, TimeIntegrationHasNoHarmonicsToChoose) {
  const SceneDescription said =
      parse(modal_text, {"response.method=time", "response.harmonics=auto"});
  EXPECT_EQ(said.settings.harmonics.highest, 1);
  EXPECT_FALSE(said.settings.harmonics.chosen());
  EXPECT_EQ(complaint(said.complete_toml), "");
}

TEST(BadScene, LawsOfContactTellWhatTheyMiss) {
  const auto bad = [](const std::string& value, const std::vector<std::string>& words) {
    expect_complaint(complaint(blade_text, {value}), words);
  };
  bad("contact.friction_coefficient={ law = \"hyperbolic\", rate = 1 }", {"static is missing"});
  bad("contact.friction_coefficient={ law = \"linear\" }", {"exponential, hyperbolic"});
  bad("contact.friction_coefficient={ law = \"hyperbolic\", static = 1, rate = 1, kinetic = 1 }",
      {"kinetic"});
  bad("contact.friction_coefficient={ law = \"hyperbolic\", static = -1, rate = 1 }",
      {"static", "at least 0"});
  bad("contact.friction_coefficient={ expression = 3 }", {"expression"});
  bad("contact.roughness={ law = \"cubic\" }", {"height is missing"});
  bad("contact.roughness={ law = \"cubic\", height = 1e-6, hight = 2 }", {"hight", "known"});
  bad("contact.roughness=[{ law = \"cubic\", height = 1e-6 }, { law = \"gaussian\", height = 1e-6 "
      "}]",
      {"cubic surface against a gaussian"});
  bad("contact.preload_moment=[1]", {"[M_p, M_r]"});
  expect_complaint(complaint(blade_text, {"contact.preload_moment=[1, 0]",
                                          "contact.preload_field={ expression = \"p\" }"}),
                   {"preload_moment", "one of the two"});
}

/// What is no TOML has no keys to ask for; the message names the one it breaks off in all the same.
TEST(SceneFile, WhatIsNoTomlIsToldByLineColumnAndKey) {
  const auto said = [](const std::string& from, const std::string& to) {
    return complaint(replaced(modal_text, from, to));
  };
  EXPECT_EQ(said("[15.9, 41.4]", "[15.9,\n 1e400]"),
            "scene.toml:5:7: modal.frequency: 1e400 is out of range: expected a number of at most "
            "1.797e308 in "
            "size");
  EXPECT_NE(said("weight = 2", "weight = 2.").find("scene.toml:11:16: modal.points.weight: "),
            std::string::npos)
      << said("weight = 2", "weight = 2.");
  EXPECT_NE(said("phi_v_2", "phi_v_22").find("scene.toml:9: modal.points: unknown column"),
            std::string::npos)
      << said("phi_v_2", "phi_v_22");
  EXPECT_NE(said("frequency = 20", "frequency = 99999999999999999999")
                .find("response.frequency: 9999999999999999999"),
            std::string::npos);
  EXPECT_NE(said("frequency = 20", "frequency = \"20").find("response.frequency: "),
            std::string::npos);
  EXPECT_NE(said("damping_ratio = 0.01", "frequency = 0.01").find("modal.frequency: "),
            std::string::npos);
  EXPECT_EQ(complaint(modal_text, {"modal.frequency=[1e400, 3]"}),
            "--set modal.frequency=[1e400, 3]: 1e400 is out of range: expected a number of at most "
            "1.797e308 in "
            "size");
  EXPECT_NE(complaint(modal_text, {"response.search_starts=many"})
                .find("expected a whole number, 0 to 1000"),
            std::string::npos)
      << complaint(modal_text, {"response.search_starts=many"});
}

TEST(SceneFile, TablesAndFormulasOfThePatchAreReadWithTheScene) {
  const Overrides missing{"contact.friction_coefficient={file=\"none.csv\"}"};
  EXPECT_NE(complaint(blade_text, missing).find("/nowhere/none.csv: no such file"),
            std::string::npos)
      << complaint(blade_text, missing);
  EXPECT_NE(complaint(blade_text, {"contact.preload_field=1+sqt(p)"})
                .find("character 3: \"sqt\" is not known"),
            std::string::npos);
}

TEST(SceneFile, NegativeScalesWouldTurnGapsIntoPressure) {
  expect_complaint(complaint(modal_text, {"response.preload_scale=[1, -1]"}),
                   {"preload_scale", "at least 0"});
  EXPECT_EQ(parse(modal_text, {"response.preload_scale=[0, 2]"}).response->preload_scale,
            (std::vector<double>{0.0, 2.0}));
}

TEST(SceneFile, AnyNumberCanBeSearched) {
  const std::vector<std::string> search{"response.optimum=contact.normal_stiffness",
                                        "response.optimum_range=[\"1 GPa/m\", 1e12]",
                                        "response.preload=[100, \"free\"]"};
  const SceneDescription scene = parse(blade_text, search);
  ASSERT_TRUE(scene.response->optimum.has_value());
  EXPECT_EQ(scene.response->optimum->range, (std::array<double, 2>{1e9, 1e12}));
  EXPECT_EQ(scene.response->optimum->load, 100.0);
  const SceneDescription changed = with_value(scene, "contact.normal_stiffness", 2.5e10);
  EXPECT_EQ(changed.contacts.front().normal_stiffness, 2.5e10);
  EXPECT_FALSE(changed.response->optimum.has_value());
  EXPECT_EQ(changed.contacts.front().tangential_stiffness,
            scene.contacts.front().tangential_stiffness);
  const SceneDescription force = parse(
      blade_text, {"response.optimum=excitation.forces[0].amplitude",
                   "response.optimum_range=[\"1 mN\", \"2 N\"]", "response.optimum_at=\"1 kN\""});
  EXPECT_EQ(force.response->optimum->range, (std::array<double, 2>{1e-3, 2.0}));
  EXPECT_EQ(force.response->optimum->load, 1000.0);
  EXPECT_EQ(with_value(force, force.response->optimum->key, 0.25).forces[0].amplitude, 0.25);
}

TEST(BadScene, SearchesOfNoNumber) {
  const auto bad = [](const std::string& key, const std::string& range,
                      const std::vector<std::string>& words) {
    expect_complaint(
        complaint(blade_text, {"response.optimum=" + key, "response.optimum_range=" + range,
                               "response.optimum_at=100"}),
        words);
  };
  bad("contact.frction_coefficient", "[0.1, 1]", {"contact.frction", "friction_coefficient"});
  bad("contact.mu", "[0.1, 1]", {"did you mean \"contact.friction_coefficient\"?"});
  bad("response.frequency", "[1, 2]", {"outside [response]"});
  bad("modes.count", "[5, 10]", {"whole number"});
  bad("contact.friction_coefficient", "[-1, 1]", {"optimum_range", "-1 is no value"});
  bad("contact.friction_coefficient", "[\"1 mm\", 1]", {"optimum_range", "mm"});
  bad("contact.normal_stiffness", "[2e10, 1e10]", {"low < high"});
  bad("excitation.forces[7].amplitude", "[1, 2]", {"forces has no entry 7"});
  bad("preload", "[1, 2]", {"optimum_at", "no meaning"});
  expect_complaint(complaint(blade_text, {"response.optimum=material.density"}), {"optimum_range"});
  expect_complaint(
      complaint(blade_text, {"response.optimum=material.density", "response.optimum_range=[1, 2]",
                             "response.preload=[1, 2]"}),
      {"optimum_at", "2 positive preloads"});
}

TEST(BadScene, KeysThatSayNothingAreRefused) {
  expect_complaint(complaint(blade_text, {"response.optimum_range=[1, 2]"}), {"optimum"});
  expect_complaint(
      complaint(blade_text, {"response.optimum=preload", "response.optimum_range=[2, 1]"}),
      {"0 < low < high"});
  std::string free(blade_text);
  const auto begin = free.find("[contact]");
  free.erase(begin, free.find("[excitation]") - begin);
  EXPECT_EQ(complaint(free), "");  // `modes` works without a contact; what `run` says of it:
  expect_complaint(parse(free).without_contact, {"response.preload", "no [contact]"});
  expect_complaint(complaint(modal_text, {"response.preload=5"}), {"preload"});
  expect_complaint(complaint(modal_text, {"contact.surface=a"}),
                   {"contact.surface", "unknown key", "friction_law"});
}

TEST(BadScene, ALengthUnitMustBeALength) {
  const std::string mesh = replaced(blade_text, "\"blade\"", "\"mesh\"\nfile = \"x.msh\"");
  const auto unit = [&](const std::string& value) {
    return std::get<MeshFileModel>(parse(mesh, {"model.length_unit=" + value}).model).length_unit;
  };
  EXPECT_DOUBLE_EQ(unit("mm").value(), 1e-3);
  EXPECT_DOUBLE_EQ(unit("0.0254").value(), 0.0254);
  for (const char* value : {"", "s", "0", "-1", "1 mm", "nan"}) {
    EXPECT_NE(complaint(mesh, {std::string("model.length_unit=") + value}), "") << value;
  }
}

TEST(SceneFile, TheLengthUnitIsThatOfTheFileUnlessItIsGmshs) {
  const auto model = [](const std::string& file) {
    const std::string mesh = replaced(blade_text, "\"blade\"", "\"mesh\"\nfile = \"" + file + "\"");
    return std::get<MeshFileModel>(parse(mesh).model);
  };
  EXPECT_DOUBLE_EQ(model("x.msh").length_unit.value(), 1.0);
  EXPECT_FALSE(model("x.INP").length_unit.has_value());
  EXPECT_NE(model("x.unv").place.find("model.file"), std::string::npos);
}

// ---- modal scenes

TEST(BadModalScene, ListsMustFitTheNumberOfModes) {
  expect_complaint(complaint(modal_text, {"modal.output=[1, 2, 3]"}), {"3 values for 2 modes"});
  expect_complaint(complaint(modal_text, {"modal.output=[1]"}), {"1 value for 2 modes"});
  expect_complaint(complaint(modal_text, {"modal.frequency=[]"}), {"empty"});
  expect_complaint(complaint(modal_text, {"modal.frequency=[-1, 2]"}), {"negative"});
  expect_complaint(complaint(modal_text, {"modal.damping_ratio=[0.1, -0.1]"}), {"negative"});
  expect_complaint(complaint(modal_text, {"modal.angular_frequency=[1, 2]"}), {"not both"});
  expect_complaint(complaint(replaced(modal_text, "frequency = [15.9, 41.4]\n", "")),
                   {"angular_frequency"});
  expect_complaint(complaint(modal_text, {"modal.force_sine=[1, nan]"}), {"finite"});
  EXPECT_EQ(complaint(modal_text, {"modal.damping_ratio=50 %"}), "");
}

TEST(SceneFile, NumbersOfInlinePointsMayHaveUnits) {
  const std::string with_units = replaced(
      replaced(modal_text, "tangential_stiffness = 1e4", "tangential_stiffness = \"10 kN/m^3\""),
      "friction_coefficient = 0.3", "friction_coefficient = \"30 %\"");
  const contact::PointParameters point = std::get<ModalModel>(parse(with_units).model).points[0];
  EXPECT_EQ(point.tangential_stiffness, 1e4);
  EXPECT_EQ(point.friction_coefficient, 0.3);
  expect_complaint(complaint(replaced(modal_text, "phi_u_1 = 0.8", "phi_u_1 = \"0.8 m\"")),
                   {"modal.points: phi_u_1", "\"m\" is not understood"});
}

TEST(SceneFile, ATolerancesGoalsAreNamesOfBars) {
  const auto goals = [](const std::string& list) {
    return parse(modal_text, {"accuracy.goals=" + list}).accuracy.goals;
  };
  using Goals = std::vector<std::string>;
  EXPECT_EQ(parse(modal_text).accuracy.goals, (Goals{"peak_amplitude", "peak_frequency"}));
  EXPECT_EQ(goals("[\"dissipated_energy\"]"), Goals{"dissipated_energy"});
  EXPECT_EQ(goals("[\"optimum\"]"), (Goals{"optimum", "peak_amplitude"}));
  for (const char* wrong : {"[]", "[\"peak\"]", "[1]", "\"optimum\""}) {
    expect_complaint(complaint(modal_text, {std::string("accuracy.goals=") + wrong}),
                     {"accuracy.goals", "peak_amplitude"});
  }
}

TEST(BadModalScene, InlinePointsTellTheirLine) {
  const std::string text(modal_text);
  const std::string second = "scene.toml:" + std::to_string(line_of(text, "weight = 2"));
  expect_complaint(complaint(replaced(text, "{ weight = 2", "{ weight = -2")),
                   {second, "weight", "-2 is negative"});
  expect_complaint(complaint(replaced(text, "{ weight = 2, ", "{ ")), {second, "no weight"});
  expect_complaint(complaint(replaced(text, "phi_v_2 = 0.25", "phi_v_3 = 0.25")),
                   {"unknown column", "phi_v_3", "2 modes"});
  expect_complaint(complaint(replaced(text, "phi_v_2 = 0.25", "tangential_stiffness_r = 1")),
                   {"this point has no tangential_stiffness_r"});
  EXPECT_EQ(complaint(replaced(text, "phi_v_2 = 0.25", "phi_w_2 = 0")), "");
  expect_complaint(complaint(modal_text, {"modal.points=[5]"}), {"expected tables"});
  expect_complaint(complaint(modal_text, {"modal.points=5"}), {"CSV file"});
}

TEST(BadModalScene, BadPointTablesAreToldWithLineAndColumn) {
  const test::TemporaryFolder folder;
  const std::string header =
      "weight,tangential_stiffness,normal_stiffness,friction_coefficient,preload,phi_u_1,phi_u_2\n";
  const auto told = [&](const std::string& table) {
    std::ofstream(folder.path() / "p.csv", std::ios::binary) << table;
    return complaint(modal_text, {"modal.points=" + (folder.path() / "p.csv").string()});
  };
  EXPECT_EQ(told(header + "1,1,1,0.3,1,1,1\n"), "");
  EXPECT_EQ(told("# points\n\n" + header + "\n1,0,0,0,-1,1,1"), "");
  expect_complaint(told(header + "1,1,1,0.3,1,1,1\n1,-1,1,0.3,1,1,1\n"),
                   {"p.csv:3: tangential_stiffness: ", "-1 is negative"});
  expect_complaint(told("# one\n" + header + "1,1,1,0.3,nan,1,1\n"),
                   {"p.csv:3: preload: ", "finite"});
  expect_complaint(told(header + "1,1,1,0.3,inf,1,1\n"), {"p.csv:2: preload: ", "finite"});
  expect_complaint(told(header + "1,1,1,0.3,1 N,1,1\n"), {"p.csv:2: preload: ", "not a number"});
  expect_complaint(told(header + "1,1,1,0.3,,1,1\n"), {"p.csv:2: preload: "});
  expect_complaint(told(header + "1,1,1\n"), {"p.csv:2: ", "3 values under 7"});
  expect_complaint(told(header), {"no contact points"});
  expect_complaint(told(""), {"empty"});
  expect_complaint(told("1,1,1,0.3,1,1,1\n1,1,1,0.3,1,1,1\n"), {"p.csv:1: ", "\"1\" stands twice"});
  expect_complaint(told("# c\nweight,weigth\n1,1\n"),
                   {"p.csv:2: ", "weigth", "did you mean \"weight\"?"});
  expect_complaint(told("weight,preload\n1,1\n"),
                   {"p.csv:1: ", "\"tangential_stiffness\" is missing"});
  expect_complaint(told(header.substr(0, header.size() - 9) + "\n1,1,1,0.3,1,1\n"), {"phi_u_2"});
  expect_complaint(complaint(modal_text, {"modal.points=no such.csv"}),
                   {"/nowhere/no such.csv: no such file"});
}

// ---- files

std::string reading_complaint(const std::filesystem::path& file) {
  try {
    static_cast<void>(read_scene(file));
    return {};
  } catch (const SceneError& error) {
    return error.what();
  }
}

TEST(BadSceneFile, MissingAndUnreadableFilesAreNamed) {
  const test::TemporaryFolder folder;
  expect_complaint(reading_complaint(folder.path() / "none.toml"), {"none.toml: no such file"});
  expect_complaint(reading_complaint(folder.path()), {"not a file"});
  EXPECT_NE(reading_complaint(""), "");
  expect_complaint(reading_complaint(std::string(5000, 'x')), {"too long"});
  std::filesystem::create_symlink(folder.path() / "loop", folder.path() / "loop");
  EXPECT_NE(reading_complaint(folder.path() / "loop"), "");
}

TEST(BadSceneFile, AHugeFileIsNotRead) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "huge.toml";
  std::ofstream(file) << "title = \"x\"\n";
  std::filesystem::resize_file(file, 1'000'000'000);  // sparse: takes no disk
  expect_complaint(reading_complaint(file), {"1000000000 bytes", "at most 64000000"});
}

/// A scene with a few bytes changed, swapped or cut ends in a description or a SceneError.
TEST(BadSceneFile, AnyMutationEndsInASceneOrAnError) {
  constexpr char all_bytes[] =
      "\"'[]{}=.,#\n\t -+eE019nainf\0\xFF\xC3";  // a zero byte is among them
  test::MutatedText mutated(7, {all_bytes, sizeof(all_bytes) - 1});
  int n_taken = 0;
  constexpr int n_trials = 3000;
  for (int i = 0; i < n_trials; ++i) {
    const std::string text = mutated.of(i % 2 == 0 ? blade_text : modal_text, 4, 8, 40);
    n_taken += complaint(text).empty() ? 1 : 0;  // another exception ends the test
  }
  EXPECT_GT(n_taken, 0);
  EXPECT_LT(n_taken, n_trials);
}

TEST(BadSceneFile, DeepNestingEndsInAnError) {
  EXPECT_NE(complaint("x = " + std::string(100'000, '[')), "");
}

}  // namespace
}  // namespace microslip::pipelines::test_scene_file
