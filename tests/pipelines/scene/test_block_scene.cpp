// Scenes of the kind block: modes, cells and loads they become, limits in which simpler scenes say
// the same, and what is refused.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/QR>

#include "contact/patch/contact_area.hpp"
#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/model/tilted_area.hpp"
#include "pipelines/response/curve_requirements.hpp"
#include "pipelines/response/solver_scenes.hpp"
#include "pipelines/scene/block_scene.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "pipelines/scene/scene_template.hpp"
#include "pipelines/system/scene_error.hpp"
#include "solver/continuation.hpp"

namespace microslip::pipelines::test_block_scene {
namespace {

using Overrides = std::vector<std::string>;

constexpr const char* block_text = R"toml([model]
kind = "block"
mass = "2 kg"
moments_of_inertia = [0.002, 0.003, 0.004]
height = "20 mm"
stiffness = ["20 kN/m", 30000, 25000]
rotational_stiffness = [60, 80, "100 N*m"]
[modes]
damping_ratio = "2 %"
[contact]
cells = [3, 2]
size = ["90 mm", "40 mm"]
centre = ["5 mm", "-3 mm"]
normal_stiffness = "40 kN/m"
tangential_stiffness = "30 kN/m"
friction_coefficient = 0.5
[excitation]
forces = [ { at = [0, "-30 mm", 0], force = ["5 N", 0, 0] }, { moment = [0, 0, 0.1], phase = 90 } ]
[response]
output = { at = [0.01, 0, 0], direction = [0, 2, 0] }
frequency = 20
preload = [40]
)toml";

SceneDescription parse(const std::string& text, const Overrides& overrides = {}) {
  return parse_scene(text, "scene.toml", "/nowhere", overrides);
}

ReducedModel model_in(const SceneDescription& scene) {
  ReducedModel model = reduced_model(scene);
  model.effects = contact_effects(model, scene);
  return model;
}

ReducedModel model_of(const Overrides& overrides = {}) {
  return model_in(parse(block_text, overrides));
}

std::string text_of(const Eigen::Vector3d& v) {
  return fmt::format("[{:.17g},{:.17g},{:.17g}]", v[0], v[1], v[2]);
}

void expect_complaint(const Overrides& overrides, const std::string& part) {
  try {
    static_cast<void>(parse(block_text, overrides));
    ADD_FAILURE() << "taken: lacks " << part;
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

solver::ResponsePoint point_of(const ReducedModel& model, const SceneDescription& scene,
                               double load) {
  const auto options = continuation_options(scene, model);
  const auto curve =
      solver::solve_at_frequency(solver_scene(model, load), options.frequency_begin, options);
  EXPECT_TRUE(curve.complete) << curve.message;
  return curve.points.empty() ? solver::ResponsePoint{} : curve.points.front();
}

TEST(BlockScene, ModesAreThoseOfTheSixCoordinates) {
  const ReducedModel model = model_of();
  std::array<double, 6> squares{20000.0 / 2, 30000.0 / 2, 25000.0 / 2,
                                60 / 0.002,  80 / 0.003,  100 / 0.004};
  std::sort(squares.begin(), squares.end());
  for (Eigen::Index i = 0; i < 6; ++i) {  // rounding of the eigensolver
    EXPECT_NEAR(model.frequency[i], std::sqrt(squares[static_cast<std::size_t>(i)]), 1e-10);
  }
}

TEST(BlockScene, AMatrixSaysTheSameAsItsDiagonal) {
  const Overrides matrix{
      "model.stiffness_matrix=[[20000,0,0,0,0,0],[0,30000,0,0,0,0],[0,0,25000,0,0,0],"
      "[0,0,0,60,0,0],[0,0,0,0,80,0],[0,0,0,0,0,100]]"};
  std::string text = block_text;
  for (const char* key : {"stiffness = [", "rotational_stiffness = ["}) {
    const std::size_t at = text.find(std::string("\n") + key) + 1;
    text.erase(at, text.find('\n', at) - at + 1);
  }
  const ReducedModel model = model_in(parse(text, matrix));
  EXPECT_EQ(model.frequency, model_of().frequency);
}

// The block turned by a small angle and moved: every cell goes where its place on the rigid body
// goes.
TEST(BlockScene, CellsMoveWithTheBody) {
  const ReducedModel model = model_of();
  const Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(6, -1.0, 2.0);
  for (Eigen::Index i = 0; i < model.patches[0].cells.weights.size(); ++i) {
    const Eigen::Vector3d from_mass_centre(model.patches[0].cells.points(i, 0) + 0.005, 0.02,
                                           model.patches[0].cells.points(i, 2) - 0.003);
    Eigen::Vector3d expected;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string direction = axis == 0 ? "[1,0,0]" : axis == 1 ? "[0,1,0]" : "[0,0,1]";
      expected[axis] = model_of({"response.output.at=" + text_of(from_mass_centre),
                                 "response.output.direction=" + direction})
                           .output.dot(q);
    }
    const Eigen::Vector3d moved(model.patches[0].cells.shapes.u.row(i).dot(q),
                                model.patches[0].cells.shapes.v.row(i).dot(q),
                                model.patches[0].cells.shapes.w.row(i).dot(q));
    EXPECT_LT((moved - expected).norm(), 1e-12 * q.norm() * 50.0);  // shapes are below 50 /√kg
  }
}

TEST(BlockScene, PointMotionIsTheCrossProduct) {
  const Eigen::Vector3d c(0.3, -0.2, 0.7);
  const Eigen::Vector3d turn(0.1, 0.5, -0.4);
  Eigen::Matrix<double, 6, 1> x;
  x << 1.0, 2.0, 3.0, turn;
  const Eigen::Vector3d expected(1.0 + turn[1] * c[2] - turn[2] * c[1],
                                 2.0 + turn[2] * c[0] - turn[0] * c[2],
                                 3.0 + turn[0] * c[1] - turn[1] * c[0]);
  EXPECT_LT((point_motion(c) * x - expected).norm(), 1e-15);
}

// Action and reaction, virtual work: modal contact forces are those of the resultant at the centre
// of the area, moved to the centre of mass; at rest nothing dynamic is left.
TEST(BlockScene, ModalForcesAreForceAndMomentOfTheCells) {
  const ReducedModel model = model_of();
  const Eigen::Index n = model.patches[0].cells.weights.size();
  const Eigen::Matrix3Xd tractions = Eigen::Matrix3Xd::NullaryExpr(3, n, [](auto i, auto j) {
    return std::sin(1.0 + static_cast<double>(3 * j + i));  // (n, f_r, f_p)
  });
  const Eigen::VectorXd modal =
      model.patches[0].cells.shapes.u.transpose() *
          model.patches[0].cells.weights.cwiseProduct(tractions.row(2).transpose()) +
      model.patches[0].cells.shapes.v.transpose() *
          model.patches[0].cells.weights.cwiseProduct(tractions.row(0).transpose()) +
      model.patches[0].cells.shapes.w.transpose() *
          model.patches[0].cells.weights.cwiseProduct(tractions.row(1).transpose());
  const contact::PatchSamples& cells = model.patches[0].cells;
  Eigen::Vector<double, 6> whole = Eigen::Vector<double, 6>::Zero();  // (q, r, p)
  for (Eigen::Index i = 0; i < n; ++i) {
    whole += contact::cell_matrix(cells.points(i, 2), cells.points(i, 0)).transpose() *
             (cells.weights[i] * tractions.col(i));
  }
  const Eigen::Vector3d force(whole[2], whole[0], whole[1]);
  const Eigen::Vector3d moment(whole[5], whole[3], whole[4]);
  const ReducedModel driven =
      model_of({"excitation.forces=[{ at = [0.005, 0.02, -0.003], force = " + text_of(force) +
                ", moment = " + text_of(moment) + " }]"});
  EXPECT_LT((driven.force_sine - modal).norm(), 1e-13 * modal.norm());
  EXPECT_EQ(driven.force_cosine, Eigen::VectorXd::Zero(6));
}

TEST(BlockScene, ForcesAndTheirPhasesMoveTheModes) {
  const ReducedModel model = model_of();
  EXPECT_NEAR(model.force_sine.squaredNorm(), 5.0 * 5.0 / 2.0 + std::pow(5.0 * 0.03, 2) / 0.004,
              1e-12);  // Σ (φ·F)² = Fᵀ M⁻¹ F; rounding
  EXPECT_NEAR(model.force_cosine.squaredNorm(), 0.1 * 0.1 / 0.004, 1e-12);
}

TEST(BlockScene, CellsShareStiffnessAndLoadByArea) {
  const ReducedModel model = model_of();
  const auto points = contact_of(model, 40.0).points(0);
  ASSERT_EQ(points.size(), 6U);
  EXPECT_NEAR(model.patches[0].cells.weights.sum(), 0.09 * 0.04, 1e-17);
  for (const auto& point : points) {
    EXPECT_DOUBLE_EQ(point.tangential_stiffness, 30000.0 / 0.0036);
    EXPECT_DOUBLE_EQ(point.normal_stiffness, 40000.0 / 0.0036);
    EXPECT_DOUBLE_EQ(point.rest_load, 40.0 / 0.0036);
  }
}

// The bodies tilt by one rotation, and the cells carry by the rough law: their loads are those of
// the approach that a plane gives, and force and moments add up.
TEST(BlockScene, RoughCellsCarryForceAndMoments) {
  const double height = 1e-3;
  const ReducedModel model = model_of({"contact.roughness={ law = \"cubic\", height = \"1 mm\" }",
                                       "contact.preload_moment=[0.1, \"0.3 N*m\"]"});
  const auto points = contact_of(model, 40.0).points(0);
  const auto surface = contact::RoughSurface::cubic(height);
  double force = 0.0, about_p = 0.0, about_r = 0.0;
  Eigen::MatrixX3d plane(6, 3);
  Eigen::VectorXd approach(6);
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double n = points[static_cast<std::size_t>(i)].rest_load;
    const double load = model.patches[0].cells.weights[i] * n;
    force += load;
    about_r += model.patches[0].cells.points(i, 0) * load;
    about_p -= model.patches[0].cells.points(i, 2) * load;
    plane.row(i) << 1.0, model.patches[0].cells.points(i, 0), model.patches[0].cells.points(i, 2);
    approach[i] = surface.approach(n / model.patches[0].cells.stiffness(i, 1));
  }
  EXPECT_NEAR(force, 40.0, 1e-10);  // an imbalance of 1e-12
  EXPECT_NEAR(about_p, 0.1, 1e-12);
  EXPECT_NEAR(about_r, 0.3, 1e-12);
  const Eigen::Vector3d tilt = plane.colPivHouseholderQr().solve(approach);
  EXPECT_LT((plane * tilt - approach).norm(), 1e-12);  // [m]; approaches are 1e-3
}

TEST(BlockScene, PreloadsWithoutEquilibriumAreRefused) {
  const SceneDescription scene = parse(block_text, {"contact.preload_moment=[0, 1.3]"});
  // Cell centres reach 30 mm along p: 1.3 N m need more than 43.3 N.
  try {
    require_loads(model_in(scene), scene);
    FAIL() << "taken";
  } catch (const RefusedError& error) {
    EXPECT_NE(std::string(error.what()).find("more than 43.3333 N"), std::string::npos)
        << error.what();
  }
  EXPECT_NO_THROW(require_loads(model_of({"contact.preload_moment=[0, 1.3]"}),
                                parse(block_text, {"response.preload=[43.4, \"free\"]"})));
}

// A gap cannot carry moments: told before anything is solved, by the place in the list.
TEST(BlockScene, AGapUnderMomentsIsNamed) {
  const auto refusal = [](const Overrides& overrides) -> std::string {
    try {
      require_response(parse(block_text, overrides));
    } catch (const RefusedError& error) {
      return error.what();
    }
    return "taken";
  };
  const std::string moments = "contact.preload_moment=[0.1, 0.2]";
  const std::string said = refusal({moments, "response.preload=[\"free\", 40, -5]"});
  EXPECT_NE(said.find("response.preload[2] = -5 N"), std::string::npos) << said;
  EXPECT_NE(said.find("contact.preload_moment = [0.1, 0.2] N m"), std::string::npos) << said;
  EXPECT_NE(refusal({moments, "response.preload=[0]"}).find("response.preload[0] = 0 N"),
            std::string::npos);
  EXPECT_EQ(refusal({moments, "response.preload=[40, \"free\"]"}), "taken");
  EXPECT_EQ(refusal({"response.preload=[40, -5]"}), "taken");
}

// Theory 20.6: motion in one direction, springs and contact in one plane, surfaces that are hardly
// rough, a mass and its spring: 20.3 with one mass.
TEST(BlockScene, InOneDirectionItIsAChain) {
  constexpr const char* chain_text = R"toml([model]
kind = "chain"
masses = [1]
springs = [15791]
[modes]
damping_ratio = 0.02
[contact]
points = [ { slip = "m1", tangential_stiffness = 40000, friction_coefficient = 0.5 } ]
[excitation]
forces = [ { at = "m1", amplitude = 10 } ]
[response]
output = "m1"
frequency = 24
preload = [8]
)toml";
  const Overrides common{"model.mass=1",
                         "model.height=0",
                         "model.stiffness=[15791, 9e4, 15791]",
                         "contact.centre=[0, 0]",
                         "contact.tangential_stiffness=40000",
                         "contact.roughness={ law = \"cubic\", height = 1e-12 }",
                         "response.frequency=24"};
  for (const char* harmonics : {"1", "7"}) {
    const std::string order = fmt::format("response.harmonics={}", harmonics);
    const SceneDescription simple = parse(chain_text, {order});
    const auto expected = point_of(model_in(simple), simple, 8.0);
    EXPECT_GT(expected.report.slip_share, 0.1);
    for (const char* axis : {"[1, 0, 0]", "[0, 0, 1]"}) {
      Overrides overrides = common;
      overrides.push_back(order);
      overrides.push_back(fmt::format("response.output={{ direction = {} }}", axis));
      overrides.push_back(fmt::format("excitation.forces=[{{ force = {} }}]",
                                      axis[1] == '1' ? "[10, 0, 0]" : "[0, 0, 10]"));
      const SceneDescription scene = parse(block_text, overrides);
      const auto point = point_of(model_in(scene), scene, 8.0);
      EXPECT_NEAR(point.amplitude / expected.amplitude, 1.0, 1e-9) << axis;
      EXPECT_NEAR(std::remainder(point.phase - expected.phase, 2.0 * std::acos(-1.0)), 0.0, 1e-9);
    }
  }
}

// Normal force and both moments of the contact about its centre vary within the cycle.
TEST(BlockScene, ForceAndMomentsVaryInTheCycle) {
  const SceneDescription scene =
      parse(block_text, {"contact.roughness={ law = \"cubic\", height = \"0.5 mm\" }",
                         "excitation.forces=[{ at = [0.02, -0.03, 0.01], force = [6, 8, 4] }]",
                         "response.harmonics=3"});
  const ReducedModel model = model_in(scene);
  const auto point = point_of(model, scene, 40.0);
  const contact::ContactMap map =
      contact_of(model, 40.0).map(0, contact::Places::cells, point.q, point.frequency, 24);
  const contact::PatchSamples& cells = model.patches[0].cells;
  Eigen::Vector3d lowest = Eigen::Vector3d::Constant(1e9);
  Eigen::Vector3d highest = -lowest;
  for (Eigen::Index k = 0; k < 24; ++k) {
    Eigen::Vector3d now = Eigen::Vector3d::Zero();  // N, M_p, M_r
    for (Eigen::Index i = 0; i < cells.size(); ++i) {
      const double load = cells.weights[i] * map.normal_traction(i, k);
      now += load * Eigen::Vector3d(1.0, -cells.points(i, 2), cells.points(i, 0));
    }
    lowest = lowest.cwiseMin(now);
    highest = highest.cwiseMax(now);
  }
  EXPECT_GT((highest - lowest)[0], 2.0);   // N of 40
  EXPECT_GT((highest - lowest)[1], 0.01);  // N m: 2 N at 5 mm
  EXPECT_GT((highest - lowest)[2], 0.01);
  EXPECT_LT(point.energy_imbalance, 1e-10);
}

TEST(BlockScene, MistakesAreNamed) {
  expect_complaint({"model.mas=1"}, "did you mean \"mass\"");
  expect_complaint({"model.moments_of_inertia=[1, 2]"}, "2 numbers; expected [p, q, r]");
  expect_complaint({"model.moments_of_inertia=[1, 2, 0]"}, "above 0");
  expect_complaint({"model.stiffness=[1, 2, -3]"}, "model.stiffness");
  expect_complaint({"model.stiffness_matrix=[[1]]"}, "one of the two");
  expect_complaint({"contact.cells=[0, 2]"}, "from 1 to");
  expect_complaint({"contact.cells=[2]"}, "[along p, along r]");
  expect_complaint({"contact.size=[0, 1]"}, "above 0");
  expect_complaint({"contact.cells=[4, 1]", "contact.preload_moment=[1, 0]"}, "along r");
  expect_complaint({"contact.friction_coefficient=-1"}, "friction_coefficient");
  expect_complaint(
      {"contact.roughness={ law = \"cubic\", height = 1e-5 }", "contact.normal_stiffness=0"},
      "normal_stiffness above 0");
  expect_complaint({"excitation.forces=[{ at = \"B\" }]"}, "expected a list of numbers");
  expect_complaint({"excitation.forces=[{ amplitude = 1 }]"}, "unknown key");
  expect_complaint({"response.output=\"m1\""}, "expected { at");
  expect_complaint({"response.output={ at = [0, 0, 0] }"}, "direction");
  expect_complaint({"modes.count=7"}, "7 modes of a system that has 6");
  expect_complaint({"modes.damping_ratio=[0.1, 0.2]"}, "2 values for 6 modes");
}

TEST(BlockScene, TemplateAndCompletedSceneReadBack) {
  const SceneDescription from_template = parse(scene_template("block"));
  const SceneDescription again = parse(from_template.complete_toml);
  EXPECT_EQ(again.complete_toml, from_template.complete_toml);
  EXPECT_TRUE(from_template.rules.roughness.has_value());
  EXPECT_EQ(std::get<ModalModel>(from_template.model).points.size(), 16U);
}

}  // namespace
}  // namespace microslip::pipelines::test_block_scene
