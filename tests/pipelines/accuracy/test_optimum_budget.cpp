// What a best preload may be wrong by, beside what it is wrong by.
#include "pipelines/accuracy/optimum_budget.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "pipelines/model/model_family.hpp"
#include "pipelines/response/optimum_stage.hpp"
#include "pipelines/scene/scene_file.hpp"

namespace microslip::pipelines {
namespace {

struct Found {
  solver::Optimum optimum;
  CurveBudget budget;
};

Found search(const std::string& harmonics) {
  const SceneDescription scene =
      read_scene(MICROSLIP_SCENES "/chain_3dof_normal.toml",
                 {"response.harmonics=" + harmonics, "response.optimum=preload",
                  "response.optimum_range=[20, 400]"});
  std::vector<std::string> warnings;
  const ReducedModel model = model_of(scene, nullptr, warnings);
  Found found;
  found.optimum = OptimumSearch(model, scene, nullptr, 1).best();
  found.budget = optimum_budget(model, scene, {}, found.optimum, 1);
  return found;
}

double told(const CurveBudget& budget, const char* goal) {
  return bar_of(budget.rows, optimum_name, goal);
}

TEST(OptimumBudget, TellsHowFarMoreHarmonicsMoveTheBestPreload) {
  const Found truth = search("9");
  ASSERT_TRUE(truth.optimum.found);
  for (const char* harmonics : {"1", "3"}) {
    const Found few = search(harmonics);
    ASSERT_TRUE(few.optimum.found);
    ASSERT_TRUE(few.budget.has_bar());
    const double moved = std::abs(truth.optimum.best.parameter / few.optimum.best.parameter - 1.0);
    EXPECT_GT(told(few.budget, best_value_goal), moved) << harmonics;
    EXPECT_LT(told(few.budget, best_value_goal), 2.5 * moved) << harmonics;
  }
  EXPECT_LT(told(truth.budget, best_value_goal), 1e-3);
}

TEST(OptimumBudget, HasNoRowsWhereNothingIsFound) {
  const SceneDescription scene =
      read_scene(MICROSLIP_SCENES "/chain_3dof_normal.toml",
                 {"response.optimum=preload", "response.optimum_range=[20, 400]"});
  std::vector<std::string> warnings;
  const ReducedModel model = model_of(scene, nullptr, warnings);
  EXPECT_TRUE(optimum_budget(model, scene, {}, {}, 1).rows.empty());
}

}  // namespace
}  // namespace microslip::pipelines
