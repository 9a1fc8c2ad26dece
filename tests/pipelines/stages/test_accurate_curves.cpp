// What a round of refinement is priced by.
#include "pipelines/stages/accurate_curves.hpp"

#include <gtest/gtest.h>

#include "pipelines/system/machine_speed.hpp"

namespace microslip::pipelines::test_accurate_curves {
namespace {

// Curves take longer on a slow or busy machine, and their seconds are measured: mesh and modes that
// took no longer would make a mesh ten times as fine look cheap there.
TEST(AccurateCurves, MeshAndModesAreAsDearAsTheMachineIsSlow) {
  StructureModes modes;
  modes.n_dofs = 69003;
  const double from_an_earlier_run = seconds_of_structure(modes) / machine_slowness();
  EXPECT_GT(from_an_earlier_run, 5.0);
  EXPECT_LT(from_an_earlier_run, 20.0);
  modes.timings = {.assembly = 0.3, .factorisation = 2.2, .ordering = 0.5, .eigensolve = 2.8};
  const double quiet = seconds_of_structure(modes);
  modes.timings = {.assembly = 1.5, .factorisation = 11.0, .ordering = 2.5, .eigensolve = 14.0};
  EXPECT_DOUBLE_EQ(seconds_of_structure(modes), 5.0 * quiet);
}

}  // namespace
}  // namespace microslip::pipelines::test_accurate_curves
