// A forecast beyond memory ends before anything is solved, and names the way that fits.
#include "pipelines/structure/solver_memory.hpp"

#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "fem/petsc_error.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "pipelines/structure/structure_stage.hpp"
#include "pipelines/system/exit_code.hpp"
#include "tests/support/address_space.hpp"
#include "tests/support/box_mesh.hpp"

namespace microslip::pipelines::test_solver_memory {
namespace {

using fem::SolverKind;

/// Compact: 89 000 unknowns, whose factor is far larger than what an iterative solution takes.
const mesh::Mesh& cube() {
  static const mesh::Mesh mesh = test::box_mesh(
      mesh::ElementType::tet10, {.size = {1, 1, 1}, .cells = {15, 15, 15}, .map = {}});
  return mesh;
}

std::string complaint(SolverKind solver) {
  try {
    require_memory(cube(), solver);
  } catch (const fem::MemoryError& error) {
    EXPECT_EQ(exit_code_of(error), ExitCode::exhausted);
    return error.what();
  }
  return "";
}

TEST(SolverMemory, OfTheIterativeWayIsLessForACompactBody) {
  const SolverMemory memory = solver_memory(cube(), SolverKind::direct);
  EXPECT_LT(memory.iterative_mb, 0.7 * memory.direct_mb);
  EXPECT_EQ(memory.needed_mb(), memory.direct_mb);
  EXPECT_EQ(solver_memory(cube(), SolverKind::iterative).needed_mb(), memory.iterative_mb);
}

TEST(SolverMemory, BeyondWhatThereIsIsRefusedAndTheOtherWayOffered) {
  const SolverMemory memory = solver_memory(cube(), SolverKind::direct);
  const test::Room room(0.5 * (memory.iterative_mb + 0.7 * memory.direct_mb));
  const std::string text = complaint(SolverKind::direct);
  for (const char* part :
       {"out of memory: modes.solver = \"direct\" needs about", "ulimit -v",
        "use the iterative solver: modes.solver = \"iterative\" needs about", "coarser mesh"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
  }
  EXPECT_EQ(complaint(SolverKind::iterative), "");
}

TEST(SolverMemory, BeyondBothOffersNeither) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "AddressSanitizer needs more address space itself";
#endif
  const test::Room room(20.0);
  EXPECT_EQ(complaint(SolverKind::direct).find("\"iterative\""), std::string::npos);
  EXPECT_NE(complaint(SolverKind::iterative).find("modes.solver = \"iterative\" needs about"),
            std::string::npos);
}

TEST(SolverMemory, WhatEndedInTheSolverNamesTheOtherWayOnce) {
  for (const auto& [text, told] :
       {std::pair("out of memory",
                  "out of memory; use the iterative solver: modes.solver = \"iterative\""),
        std::pair("out of memory: 9 MB are needed. Use the iterative solver or a coarser mesh.",
                  "out of memory: 9 MB are needed. Use the iterative solver or a coarser mesh; the "
                  "iterative solver is modes.solver = \"iterative\""),
        std::pair("modes.solver = \"iterative\" needs about 1 GB",
                  "modes.solver = \"iterative\" needs about 1 GB")}) {
    EXPECT_EQ(with_iterative_way(text), told);
  }
}

TEST(SolverMemory, ThatIsThereIsNotComplainedAbout) {
  EXPECT_EQ(complaint(SolverKind::direct), "");
  EXPECT_EQ(memory_warning(solver_memory(cube(), SolverKind::direct)), "");
}

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
[excitation]
forces = [ { at = "corner", direction = [1, 3, 2], amplitude = "20 N" } ]
)";

mesh::Mesh cantilever() {
  return test::box_mesh(mesh::ElementType::hex20,
                        {.size = {0.1, 0.02, 0.015}, .cells = {12, 3, 2}, .map = {}});
}

/// Modes and static shapes of a scene, residual stiffness or attachment shapes.
StructureModes solved(const std::vector<std::string>& overrides) {
  return solve_structure(cantilever(), parse_scene(scene_text, "cantilever.toml", ".", overrides));
}

class Bases : public testing::TestWithParam<const char*> {};

TEST_P(Bases, AreThoseOfTheDirectWay) {
  const std::string residual = std::string("modes.residual=") + GetParam();
  const StructureModes direct = solved({residual});
  const StructureModes iterative = solved({residual, "modes.solver=iterative"});
  const Eigen::VectorXd& exact = direct.basis.frequency;
  ASSERT_EQ(iterative.basis.frequency.size(), exact.size());
  EXPECT_LT((iterative.basis.frequency - exact).cwiseQuotient(exact).cwiseAbs().maxCoeff(), 1e-6);
  ASSERT_EQ(iterative.residuals.size(), direct.residuals.size());
  for (std::size_t i = 0; i < direct.residuals.size(); ++i) {
    const Eigen::MatrixX3d& wanted = direct.residuals[i].row_sums;
    EXPECT_LT((iterative.residuals[i].row_sums - wanted).norm(), 1e-6 * wanted.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Bases, testing::Values("stiffness", "attachment"));

TEST(Scene, ARotatingBodyIsSolvedDirectly) {
  try {
    static_cast<void>(solved({"modes.solver=iterative", "static.speed=\"3000 rpm\"",
                              "static.axis={ origin = [0, 0, 0], direction = [0, 1, 0] }"}));
    FAIL() << "a rotating body was solved iteratively";
  } catch (const std::exception& error) {
    EXPECT_EQ(exit_code_of(error), ExitCode::bad_input);
    EXPECT_NE(std::string(error.what()).find("modes.solver"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace microslip::pipelines::test_solver_memory
