#include "pipelines/accuracy/effect_bounds.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace microslip::pipelines {
namespace {

constexpr double tolerance = 0.02;

EffectRecord left_out(const char* name, const char* objection = "") {
  EffectRecord effect{.name = name, .setting = "auto", .simulated = Simulated::no};
  effect.objection = objection;
  return effect;
}

TEST(EffectBounds, TheLargestChangeOfAnyPeakIsTold) {
  std::vector<EffectRecord> effects{left_out("second_direction"), left_out("higher_harmonics"),
                                    left_out("roughness")};
  tell_bounds({{"a", peak_amplitude_goal, "second_direction", -7e-4, true, 0.1},
               {"b", peak_amplitude_goal, "second_direction", 2e-4, true, 0.1},
               {"b", peak_frequency_goal, "mesh", 0.5, true, 0.1}},
              tolerance, effects);
  EXPECT_EQ(effects[0].bound, 7e-4);
  EXPECT_FALSE(effects[1].bound.has_value());  // not told
  EXPECT_FALSE(effects[2].bound.has_value());
}

TEST(EffectBounds, WhatMattersIsObjectedToAndWhatDoesNotAnswersTheIndicator) {
  const auto objection = [](double change) {
    std::vector<EffectRecord> effects{left_out("normal_motion", "the indicator says so")};
    tell_bounds({{"a", peak_amplitude_goal, "normal_motion", change, true, 0.1}}, tolerance,
                effects);
    return effects[0].objection;
  };
  EXPECT_NE(objection(-0.3).find("30 %"), std::string::npos) << objection(-0.3);
  EXPECT_NE(objection(std::numeric_limits<double>::infinity()).find("not found"),
            std::string::npos);
  EXPECT_EQ(objection(0.01), "");
}

TEST(EffectBounds, WhatIsSimulatedHasNone) {
  std::vector<EffectRecord> effects{left_out("second_direction")};
  effects[0].simulated = Simulated::yes;
  tell_bounds({{"a", peak_amplitude_goal, "second_direction", 0.5, true, 0.1}}, tolerance, effects);
  EXPECT_FALSE(effects[0].bound.has_value());
  EXPECT_EQ(effects[0].objection, "");
}

}  // namespace
}  // namespace microslip::pipelines
