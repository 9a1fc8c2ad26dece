#include "pipelines/accuracy/effect_bounds.hpp"

#include <gtest/gtest.h>

namespace microslip::pipelines {
namespace {

TEST(EffectBounds, TheLargestChangeOfAnyPeakIsTold) {
  std::vector<EffectRecord> effects{{"second_direction", "auto", false, "little motion"},
                                    {"higher_harmonics", "auto", false, "one"},
                                    {"roughness", "auto", false, "smooth"}};
  tell_bounds({{"a", peak_amplitude_goal, "second_direction", -7e-4, true, 0.1},
               {"b", peak_amplitude_goal, "second_direction", 2e-4, true, 0.1},
               {"b", peak_frequency_goal, "mesh", 0.5, true, 0.1}},
              effects);
  EXPECT_EQ(effects[0].reason,
            "little motion; having it would change the highest peaks by 0.07 % at most");
  EXPECT_EQ(effects[1].reason, "one");  // not told
  EXPECT_EQ(effects[2].reason, "smooth");
}

}  // namespace
}  // namespace microslip::pipelines
