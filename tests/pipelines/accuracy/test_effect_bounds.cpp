#include "pipelines/accuracy/effect_bounds.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace microslip::pipelines::test_effect_bounds {
namespace {

constexpr double tolerance = 0.02;

EffectRecord left_out(const char* name, const char* objection = "") {
  EffectRecord effect{.name = name, .setting = "auto", .simulated = Simulated::no, .reason = ""};
  effect.objection = objection;
  return effect;
}

TEST(EffectBounds, TheLargestChangeOfAnyPeakIsTold) {
  std::vector<EffectRecord> effects{left_out("second_direction"), left_out("higher_harmonics"),
                                    left_out("roughness")};
  tell_bounds({{"a", peak_amplitude_goal, "second_direction", -7e-4, ErrorKind::solved, 0.1},
               {"b", peak_amplitude_goal, "second_direction", 2e-4, ErrorKind::solved, 0.1},
               {"b", peak_frequency_goal, "mesh", 0.5, ErrorKind::solved, 0.1}},
              tolerance, effects);
  EXPECT_EQ(effects[0].bound, 7e-4);
  EXPECT_FALSE(effects[1].bound.has_value());  // not told
  EXPECT_FALSE(effects[2].bound.has_value());
}

// What a user sees who lays the curves over one another.
TEST(EffectBounds, WhatThePeaksMakeOfTheCurveIsToldBesideThem) {
  std::vector<EffectRecord> effects{left_out("second_direction")};
  tell_bounds({{"a", peak_amplitude_goal, "second_direction", -4e-3, ErrorKind::solved, 0.1},
               {"a", along_curve_goal, "second_direction", 0.055, ErrorKind::estimated, 0.1}},
              tolerance, effects);
  EXPECT_EQ(effects[0].bound, 4e-3);
  EXPECT_EQ(effects[0].bound_along, 0.055);
  EXPECT_EQ(effects[0].objection, "");  // a tolerance is one of peaks
}

// No sample was taken of the other curve: it may change more.
TEST(EffectBounds, WhatOneCurveAloneTellsBesideItsPeaksIsNotToldOfAll) {
  std::vector<EffectRecord> effects{left_out("second_direction")};
  tell_bounds({{"a", peak_amplitude_goal, "second_direction", -4e-3, ErrorKind::solved, 0.1},
               {"a", along_curve_goal, "second_direction", 0.055, ErrorKind::estimated, 0.1},
               {"b", peak_amplitude_goal, "second_direction", 1e-3, ErrorKind::solved, 0.1}},
              tolerance, effects);
  EXPECT_EQ(effects[0].bound, 4e-3);
  EXPECT_FALSE(effects[0].bound_along);
}

// Energy is not stationary at a peak, and no tolerance is one of it.
TEST(EffectBounds, TheDissipatedEnergyPutsNothingBack) {
  std::vector<EffectRecord> effects{left_out("second_direction")};
  const std::vector<ErrorRow> rows{
      {"a", peak_amplitude_goal, "second_direction", 1e-3, ErrorKind::solved, 0.1},
      {"a", dissipated_energy_goal, "second_direction", -0.022, ErrorKind::solved, 0.1}};
  EXPECT_TRUE(missed_effects(rows, tolerance, effects).empty());
  tell_bounds(rows, tolerance, effects);
  EXPECT_EQ(effects[0].bound, 1e-3);
  EXPECT_EQ(effects[0].objection, "");
}

// A tolerance is one of peaks: a flank that moves by more is objected to, and by twice as much the
// effect is put back.
TEST(EffectBounds, WhatMovesAFlankALittleIsObjectedToAndNotPutBack) {
  const auto at = [](double change) {
    return std::vector<ErrorRow>{
        {"a", largest_indicator_goal, "second_direction", 0.5, ErrorKind::estimated, 0.1},
        {"a", peak_amplitude_goal, "second_direction", 1e-3, ErrorKind::solved, 0.1},
        {"a", amplitude_there_goal, "second_direction", change, ErrorKind::solved, 0.1}};
  };
  std::vector<EffectRecord> effects{left_out("second_direction")};
  EXPECT_TRUE(missed_effects(at(1.5 * tolerance), tolerance, effects).empty());
  EXPECT_FALSE(missed_effects(at(2.5 * tolerance), tolerance, effects).empty());
  tell_bounds(at(1.5 * tolerance), tolerance, effects);
  EXPECT_NE(effects[0].objection.find("3 %"), std::string::npos) << effects[0].objection;
}

TEST(EffectBounds, WhatMattersIsObjectedToAndWhatDoesNotAnswersTheIndicator) {
  const auto objection = [](double change) {
    std::vector<EffectRecord> effects{left_out("normal_motion", "the indicator says so")};
    tell_bounds({{"a", peak_amplitude_goal, "normal_motion", change, ErrorKind::solved, 0.1}},
                tolerance, effects);
    return effects[0].objection;
  };
  EXPECT_NE(objection(-0.3).find("30 %"), std::string::npos) << objection(-0.3);
  EXPECT_NE(objection(std::numeric_limits<double>::infinity()).find("not found"),
            std::string::npos);
  EXPECT_NE(objection(1.05).find("by up to 105 %"), std::string::npos) << objection(1.05);
  EXPECT_EQ(objection(0.01), "");
}

TEST(EffectBounds, ACurveWithoutAPeakIsToldInWords) {
  std::vector<EffectRecord> effects{left_out("centrifugal", "the indicator says so")};
  tell_bounds({{"a", resonance_goal, "centrifugal", 0.21, ErrorKind::solved, 0.1},
               {"a", end_amplitude_goal, "centrifugal", -0.8, ErrorKind::solved, 0.1},
               {"b", peak_amplitude_goal, "centrifugal", 0.001, ErrorKind::solved, 0.1}},
              tolerance, effects);
  EXPECT_FALSE(effects[0].bound.has_value());  // that of "b" alone would be a false one
  EXPECT_NE(effects[0].reason.find("curve a has no peak within its range to compare: the resonance "
                                   "nearest to the range changes by +21 % with it"),
            std::string::npos)
      << effects[0].reason;
  EXPECT_NE(effects[0].reason.find("can be compared change by 0.1 % at most"), std::string::npos);
  // The end of the range says little beside a resonance that moves.
  EXPECT_NE(effects[0].objection.find("changes by +21 %"), std::string::npos);
  EXPECT_EQ(effects[0].objection.find("by -80 %"), std::string::npos) << effects[0].objection;
}

TEST(EffectBounds, AnEndThatChangesIsObjectedToWhereTheResonanceStays) {
  std::vector<EffectRecord> effects{left_out("second_direction")};
  tell_bounds({{"a", resonance_goal, "second_direction", 0.001, ErrorKind::solved, 0.1},
               {"a", end_amplitude_goal, "second_direction", -0.3, ErrorKind::solved, 0.1}},
              tolerance, effects);
  EXPECT_NE(effects[0].objection.find("by -30 %"), std::string::npos) << effects[0].objection;
}

// As of contact that is proved linear.
TEST(EffectBounds, ABoundThatIsThereNeedsNoReasonForNone) {
  std::vector<EffectRecord> effects{left_out("nonlinearity")};
  effects[0].bound = 0.0;
  tell_bounds({}, tolerance, effects, {{"nonlinearity", "no curve has a peak to compare"}});
  EXPECT_EQ(effects[0].bound, 0.0);
  EXPECT_EQ(effects[0].reason, "");
}

TEST(EffectBounds, WhatHasNoneSaysWhy) {
  std::vector<EffectRecord> effects{left_out("moments"), left_out("roughness")};
  const std::vector<NoBound> none{{"moments", "the time was over"}, {"roughness", "unused"}};
  tell_bounds({{"a", peak_amplitude_goal, "roughness", 1e-3, ErrorKind::solved, 0.1}}, tolerance,
              effects, none);
  EXPECT_EQ(effects[0].reason, "; no bound was made of what it would change: the time was over");
  EXPECT_EQ(effects[1].reason, "");
}

TEST(EffectBounds, EffectsThatHideEachOtherAreObjectedToTogether) {
  std::vector<EffectRecord> effects{left_out("moments"), left_out("residual"),
                                    left_out("roughness")};
  tell_bounds({{"a", peak_amplitude_goal, "moments", 0.01, ErrorKind::solved, 0.1},
               {"a", peak_amplitude_goal, "residual", 0.01, ErrorKind::solved, 0.1},
               {"a", peak_amplitude_goal, "moments + residual", 0.3, ErrorKind::solved, 0.1}},
              tolerance, effects);
  EXPECT_EQ(effects[0].bound, 0.01);
  EXPECT_EQ(effects[0].bound_together, 0.3);
  EXPECT_EQ(effects[1].bound_together, 0.3);
  EXPECT_FALSE(effects[2].bound_together.has_value());
  EXPECT_NE(effects[0].objection.find("moments + residual put back together"), std::string::npos);
  EXPECT_EQ(effects[1].objection, "");  // told once
}

TEST(EffectBounds, WhatOneOfSeveralDoesIsNotHeldAgainstAnother) {
  std::vector<EffectRecord> effects{left_out("moments"), left_out("residual")};
  tell_bounds({{"a", peak_amplitude_goal, "moments", 1e-4, ErrorKind::solved, 0.1},
               {"a", peak_amplitude_goal, "residual", 0.29, ErrorKind::solved, 0.1},
               {"a", peak_amplitude_goal, "moments + residual", 0.3, ErrorKind::solved, 0.1}},
              tolerance, effects);
  EXPECT_NE(effects[0].reason.find("moments + residual put back together"), std::string::npos);
  EXPECT_EQ(effects[0].objection, "");
  EXPECT_NE(effects[1].objection.find("29 %"), std::string::npos) << effects[1].objection;
}

TEST(EffectBounds, AModelWithAllOfThemThatCannotBeSaysWhy) {
  std::vector<EffectRecord> effects{left_out("moments"), left_out("residual"),
                                    left_out("roughness")};
  const std::vector<NoBound> none{{"moments + residual", "they are 3 for 2"}};
  tell_bounds({{"a", peak_amplitude_goal, "moments", 0.01, ErrorKind::solved, 0.1},
               {"a", peak_amplitude_goal, "residual", 0.01, ErrorKind::solved, 0.1}},
              tolerance, effects, none);
  EXPECT_EQ(effects[0].reason,
            "; with moments + residual put back together no bound was made: they are 3 for 2");
  EXPECT_FALSE(effects[0].bound_together.has_value());
  EXPECT_EQ(effects[1].reason, "");  // told once
  EXPECT_EQ(effects[2].reason, "");
}

TEST(EffectBounds, WhatIsSimulatedHasNone) {
  std::vector<EffectRecord> effects{left_out("second_direction")};
  effects[0].simulated = Simulated::yes;
  tell_bounds({{"a", peak_amplitude_goal, "second_direction", 0.5, ErrorKind::solved, 0.1}},
              tolerance, effects);
  EXPECT_FALSE(effects[0].bound.has_value());
  EXPECT_EQ(effects[0].objection, "");
}

std::vector<std::string> missed_names(const std::vector<ErrorRow>& rows,
                                      const std::vector<EffectRecord>& effects) {
  std::vector<std::string> names;
  for (const MissedEffect& one : missed_effects(rows, tolerance, effects))
    names.push_back(one.name);
  return names;
}

const std::vector<ErrorRow> both_matter{
    {"a", peak_amplitude_goal, "normal_motion", 0.25, ErrorKind::solved, 0.1},
    {"a", peak_frequency_goal, "second_direction", -0.03, ErrorKind::solved, 0.1}};

TEST(MissedEffects, ThoseThatAutoLeavesOutAndThatMatterArePutBack) {
  EXPECT_EQ(missed_names(both_matter, {left_out("normal_motion"), left_out("second_direction")}),
            (std::vector<std::string>{"normal_motion", "second_direction"}));
  const std::vector<ErrorRow> little{
      {"a", peak_amplitude_goal, "normal_motion", 0.019, ErrorKind::solved, 0.1}};
  EXPECT_TRUE(missed_names(little, {left_out("normal_motion")}).empty());
}

// Beside the peaks: a solution point, the end of a range, a peak outside it.
TEST(MissedEffects, ThoseThatMatterElsewhereArePutBackAsWell) {
  for (const char* goal :
       {amplitude_there_goal, resonance_goal, end_amplitude_goal, peak_outside_goal}) {
    for (const char* name : {"normal_motion", "second_direction", "roughness", "rate_dependence"}) {
      const auto missed = [&](double change) {
        return missed_names({{"a", peak_amplitude_goal, name, 1e-3, ErrorKind::solved, 0.1},
                             {"a", goal, name, change, ErrorKind::solved, 0.1}},
                            {left_out(name)});
      };
      EXPECT_EQ(missed(-0.05), std::vector<std::string>{name}) << goal;
      EXPECT_TRUE(missed(0.019).empty()) << goal;
    }
  }
}

TEST(MissedEffects, ASwitchOfTheUserIsObeyed) {
  std::vector<EffectRecord> effects{left_out("normal_motion"), left_out("second_direction")};
  effects[0].setting = "off";
  effects[1].simulated = Simulated::yes;
  EXPECT_TRUE(missed_names(both_matter, effects).empty());
}

TEST(MissedEffects, WhatARunCannotPutBackIsNotMissed) {
  EXPECT_TRUE(missed_names({{"a", peak_amplitude_goal, "harmonics", 0.5, ErrorKind::solved, 0.1},
                            {"a", peak_amplitude_goal, "moments", 0.5, ErrorKind::solved, 0.1}},
                           {left_out("higher_harmonics"), left_out("moments")})
                  .empty());
}

// The row is of the peak without: 25 % more with it is a fifth too little without.
TEST(MissedEffects, AreToldByWhatThePeakWouldLose) {
  const auto missed = missed_effects(both_matter, tolerance, {left_out("normal_motion")});
  ASSERT_EQ(missed.size(), 1U);
  EXPECT_DOUBLE_EQ(missed[0].change, 0.2);
  std::vector<EffectRecord> effects{left_out("normal_motion")};
  effects[0].setting = "on";  // as the scene that is solved with it says
  effects[0].simulated = Simulated::yes;
  tell_switched_on(missed, effects);
  EXPECT_EQ(effects[0].setting, "auto");
  EXPECT_DOUBLE_EQ(effects[0].switched_on.value(), 0.2);
  EXPECT_NE(effects[0].reason.find("switched on after the run: left out it would have changed the "
                                   "peak by 20 %"),
            std::string::npos)
      << effects[0].reason;
}

TEST(MissedEffects, APeakThatIsLostWithTheEffectIsBeyondEveryTolerance) {
  constexpr double lost = std::numeric_limits<double>::infinity();
  const auto missed =
      missed_effects({{"a", peak_amplitude_goal, "normal_motion", lost, ErrorKind::estimated, 0.1}},
                     tolerance, {left_out("normal_motion")});
  ASSERT_EQ(missed.size(), 1U);
  EXPECT_TRUE(std::isinf(missed[0].change));
}

TEST(BesideBar, EveryEffectThatIsLeftOutIsTold) {
  constexpr double lost = std::numeric_limits<double>::infinity();
  const std::vector<ErrorRow> rows{
      {"a", peak_amplitude_goal, "second_direction", -0.075, ErrorKind::solved, 0.1},
      {"a", peak_frequency_goal, "second_direction", 0.01, ErrorKind::solved, 0.1},
      {"a", peak_amplitude_goal, "normal_motion", 2e-6, ErrorKind::solved, 0.1},
      {"a", peak_amplitude_goal, "moments", lost, ErrorKind::estimated, 0.1},
      {"a", peak_outside_goal, "centrifugal", 0.21, ErrorKind::solved, 0.1},
      {"a", peak_amplitude_goal, "normal_motion + moments", 0.5, ErrorKind::solved, 0.1}};
  const BesideBar of_a = beside_bar(
      rows, {"second_direction", "normal_motion", "moments", "centrifugal", "roughness"});
  EXPECT_EQ(of_a.at("second_direction"), 0.075);
  EXPECT_EQ(of_a.at("centrifugal"), 0.21);
  EXPECT_EQ(
      beside_bar_text(of_a),
      "left out: centrifugal (would change peaks by up to 21 %), moments (with it the highest "
      "peak is not found), roughness (what it would change is not known), second_direction "
      "(would change peaks by up to 7.5 %)");
  EXPECT_EQ(after_bar(beside_bar(rows, {"normal_motion"})), "");
}

TEST(BesideBar, OfSeveralCurvesTheLargestChangeCounts) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  BesideBar of_all;
  for (const BesideBar& one : {BesideBar{{"a", 0.1}, {"b", unknown}, {"c", 0.2}},
                               BesideBar{{"a", 0.3}, {"b", 0.4}, {"c", unknown}}}) {
    keep_larger(one, of_all);
  }
  EXPECT_EQ(of_all.at("a"), 0.3);
  EXPECT_TRUE(std::isnan(of_all.at("b")));
  EXPECT_TRUE(std::isnan(of_all.at("c")));
}

}  // namespace
}  // namespace microslip::pipelines::test_effect_bounds
