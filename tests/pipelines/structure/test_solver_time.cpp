// Modes that a budget of time has no room for are not begun.
#include "pipelines/structure/solver_time.hpp"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "pipelines/system/deadline.hpp"
#include "pipelines/system/exit_code.hpp"
#include "pipelines/system/machine_speed.hpp"
#include "tests/support/box_mesh.hpp"

namespace microslip::pipelines::test_solver_time {
namespace {

const BasisSettings ten;

struct Budget {
  explicit Budget(double seconds) { begin_deadline(seconds); }
  ~Budget() { begin_deadline(std::numeric_limits<double>::infinity()); }
  Budget(const Budget&) = delete;
  Budget& operator=(const Budget&) = delete;
  Budget(Budget&&) = delete;
  Budget& operator=(Budget&&) = delete;
};

TEST(SolverTime, GrowsWithTheMeshAndTheNumberOfModes) {
  EXPECT_GT(modes_seconds(200'000.0, ten), 2.0 * modes_seconds(100'000.0, ten));
  EXPECT_GT(modes_seconds(1e5, {.n_modes = 40}), 3.0 * modes_seconds(1e5, ten));
}

/// Seconds on the machine of share/doc/costs.md.
double there(double seconds) { return seconds / machine_slowness(); }

TEST(SolverTime, IsWithinAFactorOfTwoOfWhatWasTaken) {
  const BasisSettings iterative{.solver = fem::SolverKind::iterative};
  struct Taken {
    double degrees_of_freedom, direct, iterative;  // without mesh and start, share/doc/costs.md
  };
  for (const Taken& taken : {Taken{31'395.0, 1.07, 15.3}, Taken{116'622.0, 7.2, 68.0},
                             Taken{326'766.0, 31.0, 171.0}, Taken{998'523.0, 330.0, 490.0}}) {
    const auto ratio = [&](const BasisSettings& basis, double seconds) {
      return there(modes_seconds(taken.degrees_of_freedom, basis)) / seconds;
    };
    EXPECT_NEAR(std::log2(ratio(ten, taken.direct)), 0.0, 0.6);
    EXPECT_NEAR(std::log2(ratio(iterative, taken.iterative)), 0.0, 0.6);
  }
}

TEST(SolverTime, IsWithinAFactorOfTwoOfWhatManyModesTook) {
  EXPECT_NEAR(std::log2(there(modes_seconds(5'811.0, {.n_modes = 300})) / 5.1), 0.0, 0.6);
  EXPECT_NEAR(std::log2(there(modes_seconds(5'811.0, {.n_modes = 900})) / 39.9), 0.0, 0.6);
}

TEST(SolverTime, WhatFitsIsBegunAndWhatDoesNotIsRefusedWithWhatWouldHelp) {
  const mesh::Mesh mesh = test::box_mesh(mesh::ElementType::hex8, {});
  EXPECT_NO_THROW(require_time(mesh, ten));
  const double seconds = modes_seconds(3.0 * static_cast<double>(mesh.n_nodes()), ten);
  {
    const Budget enough(10.0 * seconds + 60.0);
    EXPECT_NO_THROW(require_time(mesh, ten));
  }
  const Budget little(0.1 * seconds);
  try {
    require_time(mesh, ten);
    FAIL() << "begun";
  } catch (const std::exception& error) {
    EXPECT_EQ(exit_code_of(error), ExitCode::exhausted);
    EXPECT_NE(std::string(error.what()).find("larger elements"), std::string::npos);
  }
}

}  // namespace
}  // namespace microslip::pipelines::test_solver_time
