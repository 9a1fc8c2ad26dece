// Scenes of the kinds bar and chain: what their sections become, and what is refused.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "pipelines/description/curve_request.hpp"
#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/curve_requirements.hpp"
#include "pipelines/response/solver_scenes.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines::test_lean_scenes {
namespace {

using Overrides = std::vector<std::string>;

constexpr const char* bar_text = R"toml([model]
kind = "bar"
youngs_modulus = "200 GPa"
area = "1 cm^2"
density = 7800
length = "1 m"
end_stiffness = "80 kN/mm"
[modes]
count = 3
damping_ratio = "0.5 %"
[contact]
tangential_stiffness = "1e7 N/m^2"
friction_coefficient = 0.3
load = "2000*(0.2 + 0.8*(2*x/L - 1)^2)"
points = 4
[excitation]
force = "0.2 kN"
[response]
frequency = "1 kHz"
preload_scale = [1, 2]
)toml";

constexpr const char* chain_text = R"toml([model]
kind = "chain"
masses = ["1 kg", "1000 g"]
springs = ["41339 N/m", 41328]
[modes]
damping_ratio = [0.02, 0.03]
[contact]
points = [ { slip = "m1", tangential_stiffness = "40 kN/m", friction_coefficient = 0.5 } ]
[excitation]
forces = [ { at = "m2", amplitude = "10 N" }, { at = "m1", amplitude = 2, phase = 90 } ]
[response]
output = "m2"
frequency = [18, 28]
preload = ["free", 10, "30 N", "stuck"]
)toml";

constexpr const char* area_point =
    "contact.points=[{ slip = \"m1\", tangential_stiffness = 4e4, friction_coefficient = 0.5, "
    "cells = "
    "[4, 4], size = [0.1, 0.1], preload_moment = [1, 0] }]";

SceneDescription parse(const std::string& text, const Overrides& overrides = {}) {
  return parse_scene(text, "scene.toml", "/nowhere", overrides);
}

ModalModel model_of(const std::string& text, const Overrides& overrides = {}) {
  return std::get<ModalModel>(parse(text, overrides).model);
}

std::string complaint(const std::string& text, const Overrides& overrides) {
  try {
    static_cast<void>(parse(text, overrides));
    return {};
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

void expect_complaint(const std::string& text, const Overrides& overrides,
                      const std::string& part) {
  const std::string message = complaint(text, overrides);
  EXPECT_NE(message.find(part), std::string::npos) << "\"" << message << "\" lacks " << part;
}

// ---- bar

TEST(BarScene, PointsLieInTheMiddleOfCellsAndCarryTheLoadThere) {
  const ModalModel bar = model_of(bar_text);
  ASSERT_EQ(bar.points.size(), 4U);
  EXPECT_EQ(bar.weights, Eigen::VectorXd::Constant(4, 0.25));
  EXPECT_EQ(bar.positions.col(0), Eigen::Vector4d(0.125, 0.375, 0.625, 0.875));
  EXPECT_DOUBLE_EQ(bar.points[0].rest_load, 2000.0 * (0.2 + 0.8 * 0.75 * 0.75));
  EXPECT_DOUBLE_EQ(bar.points[3].rest_load, bar.points[0].rest_load);
  EXPECT_EQ(bar.points[1].tangential_stiffness, 1e7);
  EXPECT_EQ(bar.points[1].normal_stiffness, 0.0);
}

TEST(BarScene, IsDrivenAndToldAtItsRightEnd) {
  const ModalModel bar = model_of(bar_text);
  EXPECT_EQ(bar.frequency_hz.size(), 3);
  EXPECT_EQ(bar.force_sine, Eigen::VectorXd(200.0 * bar.output));
  EXPECT_EQ(bar.damping_ratio, Eigen::VectorXd::Constant(3, 0.005));
}

TEST(BarScene, TheLoadIsAQuantityOrAFormula) {
  EXPECT_EQ(model_of(bar_text, {"contact.load=2 kN/m"}).points[2].rest_load, 2000.0);
  EXPECT_EQ(model_of(bar_text, {"contact.load=1500"}).points[2].rest_load, 1500.0);
  EXPECT_EQ(model_of(bar_text, {"contact.load=\"100*x\""}).points[2].rest_load, 62.5);
  expect_complaint(bar_text, {"contact.load=\"100*y\""}, "\"y\" is not known");
  expect_complaint(bar_text, {"contact.load=\"x - 0.5\""}, "-0.375 N/m at x = 0.125 m");
  expect_complaint(bar_text, {"contact.load=\"1/(x - x)\""}, "is inf at x = 0.125 m");
}

TEST(BarScene, ModesAreCountedOrNamed) {
  const ModalModel all = model_of(bar_text);
  const ModalModel second = model_of(bar_text, {"modes.which=[2]"});
  ASSERT_EQ(second.frequency_hz.size(), 1);
  EXPECT_EQ(second.frequency_hz[0], all.frequency_hz[1]);
  EXPECT_EQ(second.shapes.u.col(0), all.shapes.u.col(1));
  expect_complaint(bar_text, {"modes.which=[0]"}, "mode numbers from 1");
  expect_complaint(bar_text, {"modes.which=[2, 2]"}, "stands twice");
  expect_complaint(bar_text, {"modes.damping_ratio=[0.1, 0.2]"}, "2 values for 3 modes");
}

TEST(BarScene, TheResidualStandsInSeries) {
  const ModalModel bar = model_of(bar_text, {"modes.residual=stiffness", "modes.count=1"});
  for (Eigen::Index i = 0; i < 4; ++i) {
    EXPECT_NE(bar.points[static_cast<std::size_t>(i)].tangential_stiffness, 1e7);
  }
  EXPECT_EQ(
      setting_of(parse(bar_text, {"modes.residual=stiffness", "effects.residual=on"}), "residual"),
      "on");
  expect_complaint(bar_text, {"effects.residual=on"}, "no residual");
  expect_complaint(bar_text, {"modes.residual=stiffness", "contact.tangential_stiffness=1e13"},
                   "not positive");
}

TEST(BarScene, AFreeBarIsHeldByItsContact) {
  const SceneDescription held = parse(bar_text, {"model.end_stiffness=0"});
  const ModalModel bar = std::get<ModalModel>(held.model);
  EXPECT_EQ(bar.frequency_hz[0], 0.0);
  EXPECT_NO_THROW(require_held(reduced_model(held), held));
  const SceneDescription loose =
      parse(bar_text, {"model.end_stiffness=0", "contact.tangential_stiffness=0"});
  EXPECT_THROW(require_held(reduced_model(loose), loose), RefusedError);
  expect_complaint(bar_text,
                   {"model.end_stiffness=0", "modes.residual=stiffness", "modes.which=[2]"},
                   "rigid-body mode");
  expect_complaint(bar_text, {"model.end_stiffness=loose"}, "expected clamped or a number");
}

// ---- chain

TEST(ChainScene, IsReadInSi) {
  const ModalModel chain = model_of(chain_text);
  EXPECT_NEAR(chain.frequency_hz[0], 20.0, 0.05);
  EXPECT_NEAR(chain.frequency_hz[1], 52.4, 0.05);
  EXPECT_EQ(chain.damping_ratio, Eigen::Vector2d(0.02, 0.03));
  ASSERT_EQ(chain.points.size(), 1U);
  EXPECT_EQ(chain.points[0].tangential_stiffness, 4e4);
  EXPECT_EQ(chain.points[0].rest_load, 1.0);
  EXPECT_EQ(chain.load_measure, LoadMeasure::force);
  // cos 90° leaves a rounding of 2 N in the sine; the masses are 1 kg, so shapes are of size one.
  EXPECT_LT((chain.force_sine - 10.0 * chain.output).norm(), 1e-15);
  EXPECT_EQ(chain.force_cosine, Eigen::VectorXd(2.0 * chain.shapes.u.row(0).transpose()));
}

TEST(ChainScene, CurvesAreNamedByTheirPreload) {
  const auto requests = curve_requests(parse(chain_text));
  ASSERT_EQ(requests.size(), 4U);
  EXPECT_EQ(requests[1].name, "preload_10");
  EXPECT_EQ(std::get<double>(requests[2].load), 30.0);
  EXPECT_EQ(std::get<LimitName>(requests[3].load), LimitName::stuck);
}

TEST(ChainScene, MatricesAndModesSayTheSameAsTheChain) {
  const std::string head = "[model]\nkind = \"chain\"\n";
  const std::string rest = std::string(chain_text).substr(std::string(chain_text).find("[modes]"));
  const ModalModel chain = model_of(chain_text);
  const ModalModel matrices = model_of(
      head +
      "mass_matrix = [[1, 0], [0, 1]]\nstiffness_matrix = [[82667, -41328], [-41328, 41328]]\n" +
      rest);
  EXPECT_EQ(matrices.frequency_hz, chain.frequency_hz);
  EXPECT_EQ(matrices.shapes.u, chain.shapes.u);
  const ModalModel modes =
      model_of(head +
               "coordinates = [\"m1\", \"m2\"]\nfrequency = [20, \"0.05 kHz\"]\n"
               "mode_shapes = [[0.5, 0.9], [-0.9, 0.5]]\n" +
               rest);
  EXPECT_EQ(modes.frequency_hz, Eigen::Vector2d(20.0, 50.0));
  EXPECT_EQ(modes.output, Eigen::Vector2d(0.9, 0.5));
}

TEST(ChainScene, ContactsShareThePreloadAndMayJoinTwoMasses) {
  const SceneDescription scene = parse(
      chain_text,
      {"contact.points=[{ slip = \"m1\", tangential_stiffness = 1e4, friction_coefficient = 0.5 }, "
       "{ slip = { m2 = 1, m1 = -1 }, tangential_stiffness = 1e4, friction_coefficient = 0.1, "
       "share = 3 }]"});
  const ReducedModel model = reduced_model(scene);
  const auto points = contact_of(model, 100.0).points(0);
  EXPECT_EQ(points[0].rest_load, 25.0);
  EXPECT_EQ(points[1].rest_load, 75.0);
  EXPECT_EQ(model.patches[0].cells.shapes.u.row(1),
            model.output.transpose() - model.patches[0].cells.shapes.u.row(0));
}

TEST(ChainScene, ANegativePreloadIsAUniformGap) {
  const ReducedModel model = reduced_model(parse(
      chain_text,
      {"contact.points=[{ slip = \"m1\", approach = \"m2\", tangential_stiffness = 1e4, "
       "normal_stiffness = 2e4, friction_coefficient = 0.5 }, { slip = \"m1\", approach = \"m1\", "
       "tangential_stiffness = 1e4, normal_stiffness = 6e4, friction_coefficient = 0.5 }]"}));
  const auto points = contact_of(model, -8.0).points(0);
  EXPECT_DOUBLE_EQ(points[0].rest_load / 2e4, -1e-4);
  EXPECT_DOUBLE_EQ(points[1].rest_load / 6e4, -1e-4);
}

TEST(ChainScene, AMomentLoadsTheCellsUnevenly) {
  const SceneDescription scene = parse(chain_text, {area_point, "response.preload=[50]"});
  const ReducedModel model = reduced_model(scene);
  require_loads(model, scene);
  const auto points = contact_of(model, 50.0).points(0);
  ASSERT_EQ(points.size(), 16U);
  double force = 0.0, moment_p = 0.0, moment_r = 0.0;
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_EQ(points[i].tangential_stiffness, 2500.0);
    EXPECT_GE(points[i].rest_load, 0.0);
    const auto row = static_cast<Eigen::Index>(i);
    force += points[i].rest_load;
    moment_p -= model.patches[0].cells.points(row, 2) * points[i].rest_load;
    moment_r += model.patches[0].cells.points(row, 0) * points[i].rest_load;
  }
  EXPECT_NEAR(force, 50.0, 1e-13);  // sums of sixteen numbers of size ten
  EXPECT_NEAR(moment_p, 1.0, 1e-14);
  EXPECT_NEAR(moment_r, 0.0, 1e-14);
}

// Rows of four cells at r = ∓37.5 mm, ∓12.5 mm; 30 N and 1 N m act at r = −33.3 mm. Two rows carry:
// N₁ + N₂ = 30 N, 37.5 N₁ + 12.5 N₂ = 1000 N mm, so 25 N and 5 N, and the approach falls by 20 N a
// row.
TEST(ChainScene, AMomentLiftsCellsOff) {
  const SceneDescription scene = parse(chain_text, {area_point, "response.preload=[30]"});
  const ReducedModel model = reduced_model(scene);
  require_loads(model, scene);
  const auto points = contact_of(model, 30.0).points(0);
  const std::array<double, 4> rows{25.0, 5.0, -15.0, -35.0};
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(points[i].rest_load, rows[i / 4] / 4.0, 1e-12);  // rounding of numbers of size ten
  }
}

TEST(ChainScene, AnAreaOfSeveralContactsTiltsUnderItsShare) {
  const ReducedModel model = reduced_model(parse(
      chain_text,
      {"contact.points=[{ slip = \"m2\", tangential_stiffness = 1, friction_coefficient = 0.5 }, "
       "{ slip = \"m1\", approach = \"m1\", tangential_stiffness = 4e4, normal_stiffness = 8e4, "
       "friction_coefficient = 0.5, share = 3, cells = [2, 2], size = [0.2, 0.2], preload_moment = "
       "[0, 1] }]"}));
  const auto points = contact_of(model, 40.0).points(0);
  EXPECT_DOUBLE_EQ(points[0].rest_load, 10.0);
  const std::array<double, 4> cells{2.5, 12.5, 2.5, 12.5};  // 30/4 ∓ 1/(4 · 0.05)
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(points[i + 1].rest_load, cells[i], 1e-13);
}

TEST(ChainScene, AMomentWithoutEquilibriumIsRefused) {
  for (const char* loads : {"[50, 26.6]", "[0]", "[-30]"}) {
    const SceneDescription scene =
        parse(chain_text, {area_point, "response.preload=" + std::string(loads)});
    const ReducedModel model = reduced_model(scene);
    EXPECT_THROW(require_loads(model, scene), RefusedError) << loads;
  }
}

TEST(ChainScene, LimitsKnowNoMoment) {
  const SceneDescription scene = parse(chain_text, {area_point});
  const ReducedModel model = reduced_model(scene);
  const SceneDescription plain = parse(chain_text);
  const ReducedModel point = reduced_model(plain);
  EXPECT_LT((limit_scene(model).contact->stuck_stiffness() -
             limit_scene(point).contact->stuck_stiffness())
                .norm(),
            1e-9);  // rounding of 4e4 N/m per kg
}

TEST(ChainScene, MistakesAreNamed) {
  expect_complaint(chain_text, {"response.output=m3"}, "\"m3\"; there are: m1, m2");
  expect_complaint(chain_text, {"excitation.forces[0].at=m"}, "no coordinate \"m\"");
  expect_complaint(chain_text, {"contact.points[0].slip=m9"}, "no coordinate \"m9\"");
  expect_complaint(chain_text, {"contact.points[0].stick=m1"}, "unknown key");
  expect_complaint(chain_text, {"contact.points[0].normal_stiffness=1"}, "go together");
  expect_complaint(chain_text, {"contact.points[0].approach=m2"}, "go together");
  expect_complaint(chain_text, {"contact.points[0].cells=[2, 2]"}, "size: is missing");
  expect_complaint(chain_text, {"contact.points[0].preload_moment=[1, 0]"},
                   "several cells along r");
  expect_complaint(chain_text, {"contact.points[0].share=0"}, "every share");
  expect_complaint(chain_text, {"model.springs=[1]"}, "1 springs for 2 masses");
  expect_complaint(chain_text, {"model.springs=[1, -1]"}, "-1 is negative");
  expect_complaint(chain_text, {"model.masses=[1, 0]"}, "above 0");
  expect_complaint(chain_text, {"model.frequency=[1, 2]"}, "go together");
  expect_complaint(chain_text, {"model.frequency=[1]", "model.mode_shapes=[[1]]"},
                   "expected one of");
  expect_complaint(chain_text, {"model.coordinates=[\"a\", \"a\"]"}, "stands twice");
  expect_complaint(chain_text, {"modes.count=3"}, "3 modes of a system that has 2");
  expect_complaint(chain_text, {"material.density=1"}, "unknown in a scene of kind \"chain\"");
  EXPECT_NE(parse_scene(chain_text, "scene.toml", ".", {"contact.points=[]"})
                .without_contact.find("the scene has no [contact]"),
            std::string::npos);
}

TEST(LeanScenes, TheCompletedSceneReadsBackToItself) {
  for (const char* text : {bar_text, chain_text}) {
    const std::string complete = parse(text).complete_toml;
    EXPECT_EQ(parse(complete).complete_toml, complete);
  }
  EXPECT_NE(parse(chain_text).complete_toml.find("cells = [1, 1]"), std::string::npos);
}

}  // namespace
}  // namespace microslip::pipelines::test_lean_scenes
