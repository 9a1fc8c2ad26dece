// Preload of a static contact solution on bars whose answer is known in closed form (ν = 0, so that
// sections stay plane): a bar of length L held at x0 whose end x1 meets a layer of stiffness k.
// Free, its end would move by v⁰ and the layer leaves it v = v⁰/(1 + kL/E), pressed by n = k v.
#include "pipelines/structure/static_preload.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "contact/patch/patch_load.hpp"
#include "fem/elements/polynomial_tractions.hpp"
#include "fem/petsc_error.hpp"
#include "pipelines/accuracy/richer_models.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/import/named_points.hpp"
#include "pipelines/model/curve_load.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "pipelines/system/scene_error.hpp"
#include "tests/support/box_mesh.hpp"

namespace microslip::pipelines::test_static_preload {
namespace {

constexpr double E = 2e11;
constexpr double rho = 8000.0;
constexpr double L = 0.02;
constexpr double side = 0.01;
constexpr double area = side * side;
constexpr double rounding = 1e-9;  // condition of K times rounding, with a margin

// The preload stands in line 21, loads in 13.
constexpr const char* text = R"([model]
kind = "mesh"
file = "bar.msh"
[material]
youngs_modulus = 2e11
poissons_ratio = 0
density = 8000
[supports]
clamped = ["x0"]
[modes]
count = 2
[static]
{}
[[contact]]
surface = "x1"
slip_direction = [0, 1, 0]
friction_coefficient = 0.4
normal_stiffness = {}
tangential_stiffness = 1e12
points = 64
preload = "static"
{}
[excitation]
forces = [ {{ at = "corner", direction = [0, 1, 0], amplitude = 1 }} ]
[response]
output = {{ at = "corner", direction = [0, 1, 0] }}
frequency = [1000, 2000]
)";

SceneDescription bar_scene(const std::string& loads, double stiffness,
                           const std::string& contact = "") {
  return parse_scene(fmt::format(fmt::runtime(text), loads, stiffness, contact), "bar.toml", "/",
                     {});
}

mesh::Mesh bar(mesh::ElementType type = mesh::ElementType::hex8) {
  return test::box_mesh(type, {.size = {L, side, side}, .cells = {4, 4, 4}, .map = {}});
}

struct Solved {
  mesh::Mesh mesh;
  ReducedModel model;
};

Solved solve(const SceneDescription& scene, mesh::Mesh mesh = bar()) {
  name_points(mesh, scene);
  check_names(mesh, scene);
  const SolvedStructure solved{mesh, solve_structure(mesh, scene)};
  std::vector<std::string> warnings;
  return {mesh, model_of(scene, &solved, warnings)};
}

/// Rest loads of a patch under a load of a curve [Pa].
Eigen::VectorXd rest_loads(const ReducedModel& model, double load, std::size_t patch = 0) {
  const auto points =
      contact::point_parameters(model.patches[patch], model.patches[patch].cells, model.effects,
                                contact::shared_load(model.patches, load)[patch]);
  Eigen::VectorXd preload(std::ssize(points));
  for (Eigen::Index i = 0; i < preload.size(); ++i) {
    preload[i] = points[static_cast<std::size_t>(i)].rest_load;
  }
  return preload;
}

/// Largest relative difference from one pressure.
double off(const Eigen::VectorXd& pressures, double expected) {
  return (pressures.array() / expected - 1.0).abs().maxCoeff();
}

TEST(StaticPreload, APulledBarPressesEvenly) {
  const double k = 0.5 * E / L;
  const double expected = 300.0 / area * (0.5 / 1.5);
  const Solved bar =
      solve(bar_scene(R"(forces = [ { at = "x1", direction = [1, 0, 0], amplitude = 300 } ])", k));
  EXPECT_NEAR(*bar.model.static_preload, expected * area, rounding * expected * area);
  EXPECT_LT(off(rest_loads(bar.model, *bar.model.static_preload), expected), rounding);
  // Suction of the same size is the same load.
  const Solved sucked =
      solve(bar_scene(R"(pressure = [ { surface = "x1", value = "-3 MPa" } ])", k));
  EXPECT_LT(off(rest_loads(sucked.model, *sucked.model.static_preload), expected), rounding);
}

// Rough surfaces press by k δ(v), the bar by E/L (v⁰ − v).
TEST(StaticPreload, ABarOnRoughSurfacesPressesByTheirLaw) {
  const double k = 0.5 * E / L;
  const double free = 300.0 / area * L / E;  // 3e-7 m, as high as the heights
  const std::string force = R"(forces = [ { at = "x1", direction = [1, 0, 0], amplitude = 300 } ])";
  for (const char* law : {"cubic", "gaussian"}) {
    const SceneDescription scene = bar_scene(
        force, k, fmt::format("roughness = {{ law = \"{}\", height = \"0.3 um\" }}", law));
    const contact::RoughSurface& surface = *scene.contacts[0].rules.roughness;
    double low = 0.0;
    double high = free;
    for (int step = 0; step < 80; ++step) {
      const double v = 0.5 * (low + high);
      (k * surface.at(v).compression > E / L * (free - v) ? high : low) = v;
    }
    const double expected = k * surface.at(low).compression;
    EXPECT_LT(expected, 0.8 * k * free / 1.5);  // of smooth surfaces
    const Solved bar = solve(scene);
    EXPECT_LT(off(rest_loads(bar.model, *bar.model.static_preload), expected), rounding) << law;
    EXPECT_LT(
        off(*bar.model.static_preload * bar.model.patches[0].vertices.preload_field, expected),
        rounding);
  }
}

TEST(StaticPreload, APreloadInNewtonsIsThatOfScaledLoads) {
  const Solved bar = solve(
      bar_scene(R"(forces = [ { at = "x1", direction = [1, 0, 0], amplitude = 300 } ])", 1e13));
  EXPECT_LT(off(rest_loads(bar.model, 50.0), 50.0 / area), rounding);
  EXPECT_EQ(std::get<double>(load_of({"", StaticPreload{}}, bar.model)), *bar.model.static_preload);
}

TEST(StaticPreload, AGapIsClosedFirst) {
  const double k = 0.5 * E / L;
  const double gap = 1e-7;
  const double free = 300.0 / area * L / E;  // 3e-7 m
  const std::string force = R"(forces = [ { at = "x1", direction = [1, 0, 0], amplitude = 300 } ])";
  const Solved bar = solve(bar_scene(force, k, "gap = \"0.1 um\""));
  const double expected = k * (free - gap) / 1.5;
  EXPECT_LT(off(rest_loads(bar.model, *bar.model.static_preload), expected), rounding);
  const Solved pushed = solve(bar_scene("", k, "gap = \"-0.1 um\""));  // interference alone
  EXPECT_LT(off(rest_loads(pushed.model, *pushed.model.static_preload), k * gap / 1.5), rounding);
}

// Centrifugal load of a bar that begins at r: u(L) = ρΩ²/E (r L²/2 + L³/3). Its stresses are 1e-6
// of E.
TEST(StaticPreload, ARotatingBarPressesByItsCentrifugalLoad) {
  const double k = 0.5 * E / L;
  const double r = 0.3;
  const double omega = 300.0;
  const Solved bar = solve(
      bar_scene("speed = 300\naxis = { origin = [-0.3, 0.005, 0], direction = [0, 0, 1] }", k));
  const double free = rho * omega * omega / E * (r * L * L / 2.0 + L * L * L / 3.0);
  EXPECT_LT(off(rest_loads(bar.model, *bar.model.static_preload), k * free / 1.5), 1e-4);
}

TEST(StaticPreload, ASpeedThatNothingStandsIsRefusedByItsName) {
  try {
    static_cast<void>(solve(bar_scene(
        "speed = 1e6\naxis = { origin = [-0.3, 0.005, 0], direction = [0, 0, 1] }", 1e13)));
    FAIL();
  } catch (const fem::EigenError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("bar.toml:13: static.speed: rotation: "))
        << error.what();
  }
}

/// A force on every node of x1: the traction a + b y along x, y from the middle of the face.
void pull(SceneDescription& scene, const mesh::Mesh& mesh, double a, double b) {
  const Eigen::VectorXd y = mesh.nodes().col(1).array() - 0.5 * side;
  const Eigen::MatrixXd unit =
      fem::polynomial_tractions(mesh.nodes(), mesh.surface("x1"), mesh::FaceFrame{}, 1);
  Eigen::VectorXd force = Eigen::VectorXd::Zero(mesh.n_nodes());
  for (Eigen::Index column = 0; column < unit.cols(); column += 3) {  // along x
    const Eigen::VectorXd share = unit.col(column).reshaped(3, mesh.n_nodes()).row(0).transpose();
    force += (a * share.sum() + b * share.dot(y)) * share;
  }
  for (const Eigen::Index node : mesh.surface("x1").nodes) {
    const std::string name = fmt::format("node {}", node);
    scene.points.push_back({name, Eigen::Vector3d(mesh.nodes().row(node)), "test"});
    scene.static_loads.forces.push_back(
        {.at = name, .direction = Eigen::Vector3d::UnitX(), .amplitude = force[node], .place = ""});
  }
}

// The layer is soft, so that the end moves as it would without: by v⁰ = (a + b y) L/E. It presses
// by k v⁰ where that is above 0, on five eighths of the face, and is open by −v⁰ on the rest.
TEST(StaticPreload, ATiltedEndPressesLinearlyAndIsOpenOnTheRest) {
  constexpr double soft = 1e-7;
  SceneDescription scene =
      bar_scene("", soft * E / L, "gap = -1");  // in place of loads, which follow
  scene.contacts[0].gap = 0.0;
  const mesh::Mesh mesh = bar(mesh::ElementType::hex20);
  pull(scene, mesh, 1e6, 8e6 / side);
  const Solved tilted = solve(scene, mesh);
  const double total = *tilted.model.static_preload;
  const Eigen::VectorXd found = rest_loads(tilted.model, total);
  const Eigen::VectorXd y = tilted.model.patches[0].cells.points.col(1).array() - 0.5 * side;
  const Eigen::VectorXd expected = soft * (1e6 + 8e6 / side * y.array());
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-6 * expected.maxCoeff());
  EXPECT_EQ((found.array() < 0.0).count(), 24);  // of 64
  EXPECT_NEAR(total, soft * 0.5 * 5e6 * 0.625 * area, 1e-6 * total);
  EXPECT_NEAR(rest_loads(tilted.model, 0.5 * total).minCoeff(), 0.5 * found.minCoeff(), 1e-9);
  // Rows of cells along y press by 0, 0, 0, 0.5, 1.5, … 4.5 of what a gives.
  const double mean = 12.5 / 8.0;
  EXPECT_NEAR(*tilted.model.static_variation, std::sqrt(41.25 / 8.0 - mean * mean) / mean, 1e-6);
  // Left out, its force is spread over the face.
  scene.uniform_static_preload = true;
  const Solved even = solve(scene, mesh);
  EXPECT_NEAR(*even.model.static_preload, total, rounding * total);
  EXPECT_LT(off(rest_loads(even.model, total), total / area), rounding);
  EXPECT_EQ(even.model.static_variation, tilted.model.static_variation);
}

/// Pressed where (a + b y) > 0.
Solved pressed_at_an_edge(SceneDescription& scene, double a, double b) {
  scene.contacts[0].gap = 0.0;
  const mesh::Mesh mesh = bar(mesh::ElementType::hex20);
  pull(scene, mesh, a, b);
  return solve(scene, mesh);
}

// Rows of cells have their middles at 7/16, 5/16, … of the side: one of eight is pressed, or none
// though their edge is.
TEST(StaticPreload, OfFewPointsIsAsked) {
  SceneDescription scene = bar_scene("", 1e-7 * E / L, "gap = -1");
  const Solved edge = pressed_at_an_edge(scene, -3e6, 8e6 / side);
  const std::vector<std::string> asked = static_preload_questions(edge.model, scene);
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_NE(asked[0].find("press 8 of 64 contact points"), std::string::npos) << asked[0];
  SceneDescription between = bar_scene("", 1e-7 * E / L, "gap = -1");
  try {
    static_cast<void>(pressed_at_an_edge(between, -3.7e6, 8e6 / side));
    FAIL();
  } catch (const RefusedError& error) {
    EXPECT_NE(std::string(error.what()).find("between its points only, by 3e-08 m"),
              std::string::npos)
        << error.what();
  }
}

TEST(StaticPreload, ThatNothingBearsIsAsked) {
  for (const double force : {4e5, 8e5}) {  // [N], of which half presses
    const SceneDescription scene = bar_scene(
        fmt::format(R"(forces = [ {{ at = "x1", direction = [1, 0, 0], amplitude = {} }} ])",
                    force),
        1e13);
    const std::vector<std::string> asked = static_preload_questions(solve(scene).model, scene);
    EXPECT_EQ(asked.size(), force > 6e5 ? 1U : 0U);
    if (force > 6e5)
      EXPECT_NE(asked[0].find("4e+09 Pa in the mean"), std::string::npos) << asked[0];
  }
}

// What more shapes do is asked of the same blade, pressed alike.
TEST(StaticPreload, IsThatOfTheModelWithMoreShapesAsWell) {
  const SceneDescription scene =
      bar_scene(R"(forces = [ { at = "x1", direction = [1, 1, 0], amplitude = 300 } ])", 1e13);
  const SolvedStructure solved{bar(), solve_structure(bar(), scene)};
  std::vector<std::string> warnings;
  const ReducedModel model = model_of(scene, &solved, warnings);
  const RicherModels richer = richer_models(model, scene, &solved, {"basis"});
  ASSERT_EQ(richer.models.size(), 1U);
  const contact::PatchSamples& cells = model.patches[0].cells;
  EXPECT_EQ(richer.models[0].model.patches[0].cells.preload_field, cells.preload_field);
  EXPECT_GT(cells.preload_field.maxCoeff(), 1.1 * cells.preload_field.mean()) << "not uniform";
}

constexpr const char* second_contact = R"(
[[contact]]
surface = "y0"
slip_direction = [1, 0, 0]
friction_coefficient = 0.4
normal_stiffness = 1e13
tangential_stiffness = 1e12
points = 64
preload = "static"
)";

// Bent towards y1: the contact there carries all of the load, that at y0 has gaps, under any
// preload.
TEST(StaticPreload, OneOfTwoContactsMayBeOpen) {
  SceneDescription scene =
      bar_scene(R"(forces = [ { at = "x1", direction = [0, 1, 0], amplitude = 300 } ])", 1e13,
                second_contact);
  scene.contacts[0].surface = "y1";
  scene.contacts[0].slip_direction = Eigen::Vector3d::UnitX();
  const Solved bent = solve(scene);
  const double total = *bent.model.static_preload;
  const Eigen::VectorXd pressed = rest_loads(bent.model, total, 0);
  EXPECT_NEAR(pressed.cwiseMax(0.0).dot(bent.model.patches[0].cells.weights), total, 1e-12 * total);
  const Eigen::VectorXd open = rest_loads(bent.model, total, 1);
  EXPECT_LE(open.maxCoeff(), 0.0);
  EXPECT_LT(open.minCoeff(), 0.0);
  EXPECT_LT((rest_loads(bent.model, 2.0 * total, 1) - 2.0 * open).norm(), 1e-12 * open.norm());
  EXPECT_LT((bent.model.patches[1].vertices.preload_field.array()).maxCoeff(),
            1e-9 * -open.minCoeff());
}

TEST(StaticPreload, IsToldWithItsOpenPart) {
  const std::string force = R"(forces = [ { at = "x1", direction = [0, 1, 0], amplitude = 300 } ])";
  SceneDescription scene = bar_scene(force, 1e13, second_contact);
  scene.contacts[0].surface = "y1";
  scene.contacts[0].slip_direction = Eigen::Vector3d::UnitX();
  const std::string told = describe_static_preload(bar(), scene);
  EXPECT_TRUE(told.starts_with("static preload x1: ")) << told;  // named as its surface was
  EXPECT_NE(
      told.find("static preload y0: 0 N, pressure 0 to 0 Pa, 100.0 % of the area open by up to"),
      std::string::npos)
      << told;
}

std::string refusal(const SceneDescription& scene) {
  try {
    static_cast<void>(solve(scene));
  } catch (const RefusedError& error) {
    return error.what();
  }
  return "";
}

TEST(StaticPreload, LoadsThatDoNotPressAreRefused) {
  const std::string away = refusal(
      bar_scene(R"(forces = [ { at = "x1", direction = [-1, 0, 0], amplitude = 300 } ])", 1e13));
  EXPECT_NE(away.find("bar.toml:21: contact[0].preload: the static loads press no contact: where "
                      "it is nearest it "
                      "stays 3e-07 m away"),
            std::string::npos)
      << away;
}

TEST(StaticPreload, ABodyThatSupportsDoNotHoldIsRefused) {
  SceneDescription scene =
      bar_scene(R"(forces = [ { at = "x1", direction = [1, 0, 0], amplitude = 300 } ])", 1e13);
  scene.clamped = {"corner"};  // one node: three rotations are left
  const std::string told = refusal(scene);
  EXPECT_NE(told.find("contact[0].preload: no static solution"), std::string::npos) << told;
  EXPECT_NE(told.find("supports.clamped"), std::string::npos) << told;
}

TEST(StaticPreload, UnknownPlacesOfLoadsAreRefusedWithTheNamesThereAre) {
  for (const char* loads : {R"(forces = [ { at = "x9", direction = [1, 0, 0], amplitude = 300 } ])",
                            R"(pressure = [ { surface = "x9", value = 1 } ])"}) {
    try {
      check_names(bar(), bar_scene(loads, 1e13));
      ADD_FAILURE() << loads;
    } catch (const SceneError& error) {
      const std::string told = error.what();
      EXPECT_NE(told.find("bar.toml:13: static."), std::string::npos) << told;
      EXPECT_NE(told.find("\"x9\""), std::string::npos) << told;
      EXPECT_NE(told.find("\"y0\""), std::string::npos) << told;
    }
  }
}

}  // namespace
}  // namespace microslip::pipelines::test_static_preload
