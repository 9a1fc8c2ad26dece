// What is told of the mesh of a file, beside what finer elements of the same body give.
#include "pipelines/accuracy/given_mesh.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "mesh/refined_mesh.hpp"
#include "pipelines/accuracy/error_budget.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/import/named_points.hpp"
#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "pipelines/structure/extrapolated_modes.hpp"
#include "pipelines/structure/structure_stage.hpp"
#include "pipelines/system/temporary_folder.hpp"
#include "tests/support/box_mesh.hpp"

namespace microslip::pipelines::test_given_mesh {
namespace {

constexpr const char* blade = MICROSLIP_SCENES "/blade_to_ground.toml";

constexpr const char* plate = MICROSLIP_SCENES "/plate_mesh.toml";

/// The default blade from a file instead of its geometry.
SceneDescription from_file(const std::filesystem::path& mesh,
                           const std::vector<std::string>& overrides = {}) {
  std::ifstream stream(blade);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::string geometry = "kind = \"blade\"\nelement_size = \"3 mm\"";
  text.replace(text.find(geometry), geometry.size(),
               "kind = \"mesh\"\nfile = \"" + mesh.string() + "\"");
  return parse_scene(text, "from_file.toml", mesh.parent_path(), overrides);
}

double peak_of(const CurveResult& curve) { return highest_peak(curve.curve)->frequency; }

class GivenMesh : public testing::Test {
 protected:
  /// Peak of a limit on elements of 5 mm [rad/s].
  static double exact(LimitName limit) {
    const SceneDescription scene = read_scene(blade, {"model.element_size=\"5 mm\""});
    const TemporaryFolder folder;
    const SolvedStructure structure = solved_structure(scene, folder.path() / "fine.msh");
    std::vector<std::string> warnings;
    const ReducedModel model = model_of(scene, &structure, warnings);
    return peak_of(trace_curve(model, scene, {"limit", limit}, [](const auto&) { return true; }));
  }
  const TemporaryFolder folder_;
};

TEST_F(GivenMesh, HasARowOfItsElements) {
  const std::filesystem::path file = folder_.path() / "blade.msh";
  static_cast<void>(solved_structure(read_scene(blade, {"model.element_size=\"12 mm\""}), file));
  const SceneDescription scene = from_file(file);
  const SolvedStructure structure = solved_structure(scene, folder_.path() / "mesh.msh");
  std::vector<std::string> warnings;
  const ReducedModel model = model_of(scene, &structure, warnings);
  const RicherModels richer = richer_models(model, scene, &structure, {"mesh"});
  ASSERT_EQ(richer.models.size(), 1U);
  EXPECT_TRUE(richer.unknown.empty());
  for (const auto& [name, limit] :
       {std::pair{"free", LimitName::free}, {"stuck", LimitName::stuck}}) {
    const CurveResult curve =
        trace_curve(model, scene, {name, limit}, [](const auto&) { return true; });
    const CurveBudget budget = error_budget(model, scene, richer, curve);
    const double told = bar_of(budget.rows, name, peak_frequency_goal);
    const double wrong = peak_of(curve) / exact(limit) - 1.0;
    std::printf("%s: told %.2f %%, true %.2f %%\n", name, 100.0 * told, 100.0 * wrong);
    EXPECT_GT(wrong, 0.01) << name << ": elements of 12 mm are large";
    EXPECT_GT(told, wrong) << name;
    EXPECT_LT(told, 2.5 * wrong) << name;  // as far as test_stress_jumps lets it be
  }
}

/// The same with four nodes a tetrahedron.
mesh::Mesh linear_of(const mesh::Mesh& mesh) {
  const mesh::ElementBlock& block = mesh.elements().front();
  std::map<std::string, std::vector<mesh::FaceBlock>> surfaces;
  for (const std::string& name : mesh.surface_names()) {
    for (const mesh::FaceBlock& face : mesh.surface(name).faces) {
      surfaces[name].push_back({mesh::FaceType::tri3, face.connectivity.leftCols(3)});
    }
  }
  const mesh::ElementBlock linear{mesh::ElementType::tet4, block.connectivity.leftCols(4),
                                  block.tags};
  return {mesh.nodes(), {linear}, surfaces, {}};
}

// accuracy.md has what this prints: elements that lock are far off, the same with midside nodes
// nearly as near as elements of half the size.
TEST_F(GivenMesh, MidsideNodesEndTheLockingOfLinearElements) {
  const SceneDescription scene =
      read_scene(blade, {"model.element_size=\"10 mm\"", "modes.residual=none", "modes.count=1"});
  const auto first = [&](const mesh::Mesh& mesh) {
    const double hz = solve_structure(mesh, scene).basis.frequency[0] / (2.0 * std::numbers::pi);
    std::printf("%td elements, %td nodes: %.1f Hz\n", mesh.n_elements(), mesh.n_nodes(), hz);
    return hz;
  };
  const mesh::Mesh linear = linear_of(obtain_mesh(scene, folder_.path() / "blade.msh"));
  const mesh::Mesh quadratic = mesh::quadratic(linear);
  const double locked = first(linear);
  const double cured = first(quadratic);
  const double finer = first(mesh::refined(quadratic));
  EXPECT_GT(locked, 2.0 * finer);
  EXPECT_GT(cured, finer);
  EXPECT_LT(cured, 1.02 * finer);
}

double first_frequency(const std::vector<std::string>& settings) {
  const TemporaryFolder folder;
  return solved_structure(read_scene(plate, settings), folder.path() / "mesh.msh")
      .modes.basis.frequency[0];
}

// Elements of the file are twice as large as those they are cut into.
TEST_F(GivenMesh, IsSetAgainstTheFileWhereItsElementsAreCut) {
  const double exact = first_frequency({"model.refinement=2"});
  const SceneDescription scene = read_scene(plate, {"model.refinement=1"});
  const SolvedStructure structure = solved_structure(scene, folder_.path() / "mesh.msh");
  EXPECT_EQ(structure.coarser, nullptr);
  std::vector<std::string> warnings;
  const ReducedModel model = model_of(scene, &structure, warnings);
  const RicherModels richer = richer_models(model, scene, &structure, {"mesh"});
  ASSERT_EQ(richer.models.size(), 1U);
  const CurveResult curve =
      trace_curve(model, scene, {"free", LimitName::free}, [](const auto&) { return true; });
  const CurveBudget budget = error_budget(model, scene, richer, curve);
  const double told = bar_of(budget.rows, "free", peak_frequency_goal);
  const double wrong = model.frequency[0] / exact - 1.0;
  std::printf("cut once: told %.2g %%, true %.2g %%\n", 100.0 * told, 100.0 * wrong);
  EXPECT_GT(wrong, 0.0);
  EXPECT_GT(told, wrong);
  EXPECT_LT(told, 16.0 * wrong) << "as smooth fields converge";
}

TEST_F(GivenMesh, IsExtrapolatedWhereItsElementsAreCutTwice) {
  const double once = first_frequency({"model.refinement=1"});
  const double twice = first_frequency({"model.refinement=2"});
  const SceneDescription scene =
      read_scene(plate, {"model.refinement=2", "accuracy.tolerance=0.01"});
  const SolvedStructure structure = solved_structure(scene, folder_.path() / "mesh.msh");
  ASSERT_NE(structure.coarser, nullptr);
  EXPECT_NE(structure.coarser->text.find("as the file has them"), std::string::npos)
      << structure.coarser->text;
  const double limit = structure.modes.basis.frequency[0];
  EXPECT_LT(limit, twice);
  EXPECT_LT(twice - limit, once - twice) << "a third cut changes less than the second";
}

constexpr const char* one_brick = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
2 1 "x0"
3 2 "body"
$EndPhysicalNames
$Nodes
8
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0 0 1
6 1 0 1
7 1 1 1
8 0 1 1
$EndNodes
$Elements
2
1 3 2 1 1 1 5 8 4
2 5 2 2 1 1 2 3 4 5 6 7 8
$EndElements
)";

constexpr const char* of_a_box = R"([model]
kind = "mesh"
file = "box.msh"
[material]
youngs_modulus = 2e11
poissons_ratio = 0.3
density = 8000
[supports]
clamped = ["x0"]
[modes]
count = 2
[[contact]]
surface = "x1"
slip_direction = [0, 1, 0]
friction_coefficient = 0.4
normal_stiffness = 1e10
tangential_stiffness = 1e10
[excitation]
forces = [ { at = "corner", direction = [0, 1, 0], amplitude = 1 } ]
[response]
output = { at = "corner", direction = [0, 1, 0] }
frequency = [1000, 2000]
preload = [10]
)";

TEST_F(GivenMesh, HasTheElementsThatTheSceneMakesOfThoseInTheFile) {
  std::ofstream(folder_.path() / "box.msh") << one_brick;
  const auto made = [&](const std::vector<std::string>& settings) {
    return obtain_mesh(parse_scene(of_a_box, "box.toml", folder_.path(), settings),
                       folder_.path() / "mesh.msh");
  };
  EXPECT_EQ(made({}).n_nodes(), 8);
  EXPECT_EQ(made({"model.refinement=1"}).n_nodes(), 27);
  const mesh::Mesh quadratic = made({"model.midside_nodes=\"on\""});
  EXPECT_EQ(quadratic.elements().front().type, mesh::ElementType::hex20);
  EXPECT_EQ(quadratic.node_set("x0").size(), 8U);
  EXPECT_EQ(made({"model.midside_nodes=\"on\"", "model.refinement=1"}).n_elements(), 8);
}

// Elements of first order lock in bending, which makes no jump of stress.
TEST_F(GivenMesh, IsNotKnownWhereJumpsTellAPart) {
  const SceneDescription scene = parse_scene(of_a_box, "box.toml", "/", {});
  for (const auto type : {mesh::ElementType::hex8, mesh::ElementType::hex20}) {
    mesh::Mesh box =
        test::box_mesh(type, {.size = {0.1, 0.01, 0.01}, .cells = {8, 2, 2}, .map = {}});
    name_points(box, scene);
    StructureModes modes = solve_structure(box, scene);
    const SolvedStructure structure{std::move(box), std::move(modes)};
    std::vector<std::string> warnings;
    const ReducedModel model = model_of(scene, &structure, warnings);
    const RicherModels richer = richer_models(model, scene, &structure, {"mesh"});
    const bool locks = type == mesh::ElementType::hex8;
    EXPECT_EQ(richer.models.empty(), locks);
    EXPECT_EQ(richer.unknown,
              locks ? std::vector<std::string>{"mesh"} : std::vector<std::string>{});
  }
}

}  // namespace
}  // namespace microslip::pipelines::test_given_mesh
