// What is solved of a structure: known by all that enters, and by nothing else.
#include "pipelines/structure/structure_task.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "contact/phase.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "pipelines/structure/structure_stage.hpp"
#include "pipelines/system/result_cache.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/temporary_folder.hpp"

namespace microslip::pipelines::test_structure_task {
namespace {

constexpr const char* scene_text = R"([model]
kind = "blade"
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
density = 7800
[supports]
clamped = ["x0"]
[modes]
count = 4
damping_ratio = 0.01
[contact]
surface = "x1"
slip_direction = [0, 1, 0]
friction_coefficient = 0.4
normal_stiffness = "1e12 N/m^3"
tangential_stiffness = "1e12 N/m^3"
[static]
axis = { origin = [0, 0, 0], direction = [0, 1, 0] }
[excitation]
forces = [ { at = "corner", direction = [1, 3, 2], amplitude = "20 N" } ]
[response]
output = { at = "corner", direction = [0, 1, 0] }
frequency = ["1000 Hz", "2200 Hz"]
preload = [ 20 ]
)";

mesh::Mesh cantilever() {
  return test::box_mesh(mesh::ElementType::hex20,
                        {.size = {0.1, 0.02, 0.015}, .cells = {3, 1, 1}, .map = {}});
}

SceneDescription scene_with(const std::vector<std::string>& overrides) {
  return parse_scene(scene_text, "cantilever.toml", ".", overrides);
}

/// Whether the modes of a changed scene are those that were kept of the scene as it is.
class Kept {
 public:
  Kept() { static_cast<void>(solved({})); }

  StructureModes solved(const std::vector<std::string>& overrides) {
    told_.clear();
    const ResultCache cache(folder_.path(), [&](const std::string& line) { told_ += line; });
    return solve_structure(mesh_, scene_with(overrides));
  }
  bool serves(const std::vector<std::string>& overrides) {
    static_cast<void>(solved(overrides));
    return told_.find("modes: taken from an earlier run") != std::string::npos;
  }

 private:
  test::TemporaryFolder folder_;
  mesh::Mesh mesh_ = cantilever();
  std::string told_;
};

TEST(StructureTask, ModesServeEveryChangeThatDoesNotEnterThem) {
  Kept kept;
  for (const char* change :
       {"response.preload=[10, 30]", "contact.friction_coefficient=0.1",
        "modes.damping_ratio=0.002", "response.output={ at = \"y0\", direction = [1, 0, 0] }",
        "response.harmonics=3", "contact.points=50", "supports.clamped=[\"x0\", \"x0\"]",
        "static.axis={ origin = [1, 0, 0], direction = [0, 0, 1] }",
        "excitation.forces=[ { at = \"corner\", direction = [1, 3, 2], amplitude = \"7.3 N\" } "
        "]"}) {
    EXPECT_TRUE(kept.serves({change})) << change;
  }
}

TEST(StructureTask, WhatEntersIsSolvedFor) {
  Kept kept;
  for (const char* change :
       {"material.density=7801", "material.poissons_ratio=0.31",
        "supports.clamped=[\"x0\", \"y0\"]", "modes.count=5", "modes.residual=\"stiffness\"",
        "modes.attachment_degree=1", "modes.solver=iterative", "contact.surface=\"z1\"",
        "contact.normal_stiffness=\"2e12 N/m^3\"", "contact.slip_direction=[0, 1, 1]",
        "static.speed=\"3000 rpm\"",
        "excitation.forces=[ { at = \"corner\", direction = [1, 3, 2.1], "
        "amplitude = \"20 N\" } ]"}) {
    EXPECT_FALSE(kept.serves({change})) << change;
  }
  EXPECT_TRUE(kept.serves({}));
}

TEST(StructureTask, ModesOfAnEarlierRunAreTheSameBits) {
  Kept kept;
  const StructureModes taken = kept.solved({});
  const StructureModes solved = solve_structure(cantilever(), scene_with({}));
  EXPECT_EQ(taken.basis.frequency, solved.basis.frequency);
  EXPECT_EQ(taken.basis.shapes, solved.basis.shapes);
  ASSERT_TRUE(taken.richer);
  EXPECT_EQ(taken.richer->basis.shapes, solved.richer->basis.shapes);
  EXPECT_EQ(taken.attachment_text, solved.attachment_text);
  EXPECT_EQ(taken.n_dofs, solved.n_dofs);
  EXPECT_EQ(taken.timings.assembly, 0.0) << "of another run: nothing to tell of this one";
}

// Harmonics beyond the modes kept are asked nothing; where they are chosen closely that matters.
TEST(StructureTask, ModesReachWhatCloselyChosenHarmonicsAreAsked) {
  const mesh::Mesh mesh = cantilever();
  const auto n_modes = [&](const std::vector<std::string>& overrides) {
    const StructureModes modes = solve_structure(mesh, scene_with(overrides));
    return modes.basis.n_free();
  };
  const std::string low = "response.frequency=[\"300 Hz\", \"400 Hz\"]";
  const std::string close = "response.harmonic_tolerance=\"0.9 %\"";
  const StructureModes modes = solve_structure(mesh, scene_with({low, close}));
  EXPECT_GT(modes.basis.n_free(), 4);
  EXPECT_GE(modes.basis.frequency[modes.basis.n_free() - 1], 40 * contact::two_pi * 300.0);
  ASSERT_EQ(modes.notes.size(), 1U);
  EXPECT_NE(modes.notes[0].find("in place of 4"), std::string::npos) << modes.notes[0];
  EXPECT_GT(n_modes({low, "accuracy.tolerance=\"1.9 %\""}), 4);
  EXPECT_GT(n_modes({low, "accuracy.tolerance=\"1.9 %\"", "response.harmonics=3"}), 4);
  EXPECT_EQ(n_modes({close}), 16) << "no more than four times as many";
  EXPECT_EQ(n_modes({low}), 4);
  EXPECT_EQ(n_modes({low, "accuracy.tolerance=\"2 %\""}), 4);
  EXPECT_EQ(n_modes({low, close, "response.harmonics=3"}), 4) << "none are chosen";
  EXPECT_EQ(n_modes({low, close, "modes.residual=\"none\""}), 4) << "no shapes resonate";
  EXPECT_EQ(n_modes({low, close, "modes.damping_ratio=[0.1, 0.1, 0.1, 0.1]"}), 4);
}

// Modes of a cube come in groups of one frequency, of which a Krylov method sees some. The count,
// which comes last, tells; modes and what stands for the others are then solved for again.
TEST(StructureTask, ModesThatWereMissedAreFoundInTheEnd) {
  const mesh::Mesh cube = test::box_mesh(mesh::ElementType::hex20,
                                         {.size = {0.1, 0.1, 0.1}, .cells = {1, 1, 1}, .map = {}});
  const SceneDescription scene = scene_with({"modes.count=10"});
  fem::Structure structure(cube, scene.material, scene.clamped);
  static_cast<void>(structure.solve_modes({.n_modes = 10, .count = fem::CountTime::at_the_end}));
  ASSERT_EQ(structure.count_modes(), std::nullopt);
  const fem::ModalBasis right = structure.solve_modes({.n_modes = 10});
  for (const char* residual : {"modes.residual=\"stiffness\"", "modes.residual=\"attachment\""}) {
    const StructureModes modes = solve_structure(cube, scene_with({"modes.count=10", residual}));
    EXPECT_EQ(modes.basis.inertia_count, right.inertia_count);
    EXPECT_EQ(modes.basis.frequency.head(10), right.frequency);
    EXPECT_EQ(modes.residuals.size() + (modes.basis.n_attachment > 0 ? 1U : 0U), 1U);
  }
}

TEST(StructureTask, IsReadBackFromItsBytes) {
  const mesh::Mesh mesh = cantilever();
  const TaskFace face{mesh.surface("x1"), {}, {1e12, 1e12, 1e12}};
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(3 * mesh.n_nodes(), 1);
  forces(3 * mesh.node_set("corner").front() + 1, 0) = 1.0;
  const StructureTask task{mesh,   {"x0"}, {210e9, 0.3, 7800.0}, {}, {}, {.n_modes = 4},
                           {face}, forces};
  const StructureTask read = structure_task(bytes_of(task));
  EXPECT_EQ(bytes_of(read), bytes_of(task));
  EXPECT_EQ(solve(read).basis.shapes, solve(task).basis.shapes);
}

TEST(StructureTask, LoadsAreTheSameShapeWhateverTheirAmplitude) {
  const Eigen::MatrixXd loads = Eigen::MatrixXd::Random(30, 3);
  Eigen::MatrixXd others = loads;
  others.col(0) *= 0.1;
  others.col(1) *= -1e5 / 3.0;
  others.col(2).setZero();
  const Eigen::MatrixXd shapes = loads_as_shapes(loads);
  const Eigen::MatrixXd same = loads_as_shapes(others);
  ASSERT_EQ(shapes.cols(), 3);
  ASSERT_EQ(same.cols(), 2) << "what is zero has no shape";
  EXPECT_EQ(same.col(0), shapes.col(0));
  EXPECT_EQ(same.col(1), -shapes.col(1));
  EXPECT_EQ(shapes.cwiseAbs().maxCoeff(), 1.0);
  EXPECT_TRUE(shapes.col(2).isApprox(loads.col(2) / loads.col(2).cwiseAbs().maxCoeff(), 1e-11));
}

}  // namespace
}  // namespace microslip::pipelines::test_structure_task
