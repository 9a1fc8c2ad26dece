#include "pipelines/accuracy/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "pipelines/scene/scene_file.hpp"

namespace microslip::pipelines::test_convergence {
namespace {

SceneDescription scene(const std::string& name, const std::vector<std::string>& overrides) {
  return read_scene(MICROSLIP_SCENES "/" + name + ".toml", overrides);
}

/// A bar with a peak in its range.
SceneDescription bar() {
  return scene("bar_constant_1000", {"response.frequency=[900, 1300]", "response.maps=[]",
                                     "contact.points=40", "modes.count=4"});
}

struct Climbed {
  std::vector<RungResult> results;
  std::vector<std::vector<RungResult>> kept;  ///< on the way
  std::vector<std::string> said;
};

Climbed climbed(const Ladder& ladder) {
  Repetitions never(0.0);
  Climbed result;
  result.results = climb(ladder, {}, never,
                         {[&](const std::string& sentence) { result.said.push_back(sentence); },
                          [&](const auto& known) { result.kept.push_back(known); }});
  return result;
}

Climbed climbed(const SceneDescription& scene, const std::string& knob) {
  const std::vector<Ladder> all = ladders(scene);
  return climbed(*std::ranges::find(all, knob, &Ladder::knob));
}

// What an interrupt would leave: after each curve a table, whose last row is its finest.
TEST(Convergence, HandsOnWhatIsKnownAfterEveryCurve) {
  const Climbed bar_points = climbed(bar(), "points");
  ASSERT_EQ(bar_points.results.size(), 5U);
  ASSERT_EQ(bar_points.kept.size(), 5U);
  for (std::size_t i = 0; i < bar_points.kept.size(); ++i) {
    const std::vector<RungResult>& known = bar_points.kept[i];
    ASSERT_EQ(known.size(), i + 1);
    EXPECT_FALSE(known.back().true_error);
    if (i == 0) continue;
    EXPECT_DOUBLE_EQ(*known.front().true_error,
                     known.front().amplitude / known.back().amplitude - 1.0);
  }
}

// Of points their number, not evenly (bar_counts.hpp).
TEST(Convergence, OfABarIsToldWithOrders) {
  const Climbed bar_points = climbed(bar(), "points");
  const RungResult& own = bar_points.results[2];
  EXPECT_EQ(own.value, "40");
  EXPECT_TRUE(own.is_peak);
  ASSERT_TRUE(own.order && own.estimated_error);
  EXPECT_GT(*own.order, 0.5);
  EXPECT_LT(std::abs(*own.true_error), std::abs(*bar_points.results[0].true_error));
  const Climbed bar_modes = climbed(bar(), "modes");
  EXPECT_LT(std::abs(*bar_modes.results[3].true_error), std::abs(*bar_modes.results[0].true_error));
}

// Where all harmonics that matter are there, the motion repeats itself as it is.
TEST(Convergence, SetsBalanceAgainstTime) {
  const Climbed chain =
      climbed(scene("chain_2dof", {"response.preload=[50]", "response.harmonics=25"}), "method");
  ASSERT_EQ(chain.results.size(), 2U);
  EXPECT_TRUE(chain.results[1].is_peak);
  EXPECT_EQ(chain.results[0].frequency, chain.results[1].frequency);
  EXPECT_LT(std::abs(*chain.results[0].true_error), 2e-4);
  const Climbed one =
      climbed(scene("chain_2dof", {"response.preload=[50]", "response.harmonics=1"}), "method");
  EXPECT_GT(std::abs(*one.results[0].true_error), 1e-3);
}

// Fixed steps miss the instants at which the point changes its state by as much as a step.
TEST(Convergence, OfStepsInTimeIsOfSecondOrder) {
  Ladder ladder = ladders(scene("oscillator_1dof", {"response.maps=[]"})).front();
  ASSERT_EQ(ladder.knob, "steps");
  ladder.rungs.erase(ladder.rungs.begin() + 3, ladder.rungs.end() - 1);
  const Climbed steps = climbed(ladder);
  ASSERT_EQ(steps.results.size(), 4U);
  EXPECT_FALSE(steps.results[0].estimated_error);
  for (const std::size_t i : {1U, 2U}) {  // 500 and 1000
    ASSERT_TRUE(steps.results[i].order);
    EXPECT_NEAR(*steps.results[i].order, 2.0, 0.3);
  }
}

TEST(Convergence, TakesTheHighestPointOfASweepInTimeForAPeak) {
  const auto at = [](const char* range) {
    const SceneDescription sweep =
        scene("oscillator_1dof", {"response.maps=[]", "response.points=5", range});
    Ladder ladder = ladders(sweep).front();
    ladder.rungs.resize(1);
    return climbed(ladder).results.front();
  };
  const RungResult inside = at("response.frequency=[0.6, 1.4]");
  EXPECT_TRUE(inside.is_peak);
  EXPECT_NEAR(inside.frequency, 2.0 * M_PI, 1e-9);  // 1 Hz
  EXPECT_FALSE(at("response.frequency=[0.6, 0.9]").is_peak);
}

TEST(Convergence, LeavesOutStepsThatAreTooFew) {
  const SceneDescription bar =
      scene("bar_constant_1000",
            {"contact.points=8", "modes.count=40", "response.maps=[]", "response.method=time"});
  Ladder ladder = ladders(bar)[2];
  ASSERT_EQ(ladder.knob, "steps");
  ladder.rungs.resize(1);
  const Climbed steps = climbed(ladder);
  EXPECT_TRUE(steps.results.empty());
  EXPECT_NE(steps.said.front().find("left out: response.steps_per_period: 250 steps per period"),
            std::string::npos)
      << steps.said.front();
}

}  // namespace
}  // namespace microslip::pipelines::test_convergence
