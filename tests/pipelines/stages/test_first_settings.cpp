// What a run with a budget of time begins with.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "pipelines/scene/scene_file.hpp"
#include "pipelines/stages/first_settings.hpp"

namespace microslip::pipelines::test_first_settings {
namespace {

constexpr const char* chain = R"toml([model]
kind = "chain"
masses = [1, 1]
springs = [4e4, 1e4]
[modes]
damping_ratio = 0.03
[contact]
points = [ { slip = "m2", tangential_stiffness = 1e5, friction_coefficient = 0.5 } ]
[excitation]
forces = [ { at = "m1", amplitude = 10 } ]
[response]
output = "m2"
frequency = [10, 60]
preload = [ 8 ]
)toml";

HarmonicSettings first(const std::vector<std::string>& overrides) {
  return first_settings(parse_scene(chain, "scene.toml", "/nowhere", overrides)).settings.harmonics;
}

TEST(FirstSettings, WithoutABudgetHarmonicsAreChosenAtOnce) {
  EXPECT_TRUE(first({"accuracy.tolerance=2 %"}).chosen());
  EXPECT_TRUE(first({"accuracy.budget=60 s"}).chosen());  // no accuracy is asked for
}

TEST(FirstSettings, WithABudgetTheyAreGivenFirst) {
  const HarmonicSettings given = first({"accuracy.tolerance=2 %", "accuracy.budget=60 s"});
  EXPECT_FALSE(given.chosen());
  EXPECT_EQ(given.highest, 9);
  EXPECT_TRUE(given.checked);
}

TEST(FirstSettings, WithHardlyAnyTimeThereIsOne) {
  const HarmonicSettings one = first({"accuracy.tolerance=2 %", "accuracy.budget=1 ms"});
  EXPECT_FALSE(one.chosen());
  EXPECT_EQ(one.highest, 1);
}

TEST(FirstSettings, HarmonicsOfTheSceneStay) {
  EXPECT_EQ(
      first({"accuracy.tolerance=2 %", "accuracy.budget=60 s", "response.harmonics=5"}).highest, 5);
}

}  // namespace
}  // namespace microslip::pipelines::test_first_settings
