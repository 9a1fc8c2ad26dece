#include "pipelines/accuracy/left_out.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "pipelines/accuracy/along_curve.hpp"
#include "pipelines/accuracy/beside_peaks.hpp"
#include "pipelines/description/curve_request.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/response/curve_requirements.hpp"
#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/scene/scene_file.hpp"

namespace microslip::pipelines::test_left_out {
namespace {

using Overrides = std::vector<std::string>;

// One mode along p, which slips, and a load that varies; along r it moves as well.
constexpr const char* point = R"toml([model]
kind = "modal"
[modal]
frequency = [20, 52]
damping_ratio = 0.03
force_sine = [7, 0.5]
output = [0.75, 0.5]
[[modal.points]]
weight = 1
tangential_stiffness = 4e4
normal_stiffness = 4e4
friction_coefficient = 0.5
preload = 30
phi_u_1 = 0.5
phi_u_2 = -0.8
phi_v_1 = 0.1
phi_w_1 = 0.3
phi_w_2 = 0.3
[response]
frequency = [19, 28]
harmonics = 1
)toml";

struct Study {
  SceneDescription scene;
  ReducedModel model;
  std::vector<CurveResult> curves;
};

Study solved(const SceneDescription& scene) {
  std::vector<std::string> warnings;
  Study study{scene, model_of(scene, nullptr, warnings), {}};
  for (const CurveRequest& request : curve_requests(scene)) {
    study.curves.push_back(
        trace_curve(study.model, scene, request, [](const auto&) { return true; }));
  }
  return study;
}

Study of_point(const Overrides& overrides) {
  return solved(parse_scene(point, "scene.toml", "/nowhere", overrides));
}

/// Of the chain whose load varies, between its limits.
Study of_chain(Overrides overrides) {
  overrides.insert(overrides.end(), {"response.harmonics=1", "response.maps=[]"});
  return solved(read_scene(MICROSLIP_SCENES "/chain_3dof_normal.toml", overrides));
}

std::vector<ErrorRow> rows_of(const Study& study) {
  std::vector<ErrorRow> rows;
  const RicherModels others = models_left_out(study.model, study.scene, nullptr);
  for (const CurveResult& curve : study.curves) {
    const auto own = rows_left_out(study.model, study.scene, others.models, curve);
    rows.insert(rows.end(), own.begin(), own.end());
  }
  return rows;
}

const ErrorRow* found(const std::vector<ErrorRow>& rows, const std::string& source,
                      const std::string& goal, const std::string& curve = "") {
  const auto row = std::ranges::find_if(rows, [&](const ErrorRow& one) {
    return one.source == source && one.goal == goal && (curve.empty() || one.curve == curve);
  });
  return row == rows.end() ? nullptr : &*row;
}

double amplitude(const Study& study, std::size_t i = 0) {
  return highest_peak(study.curves.at(i).curve)->amplitude;
}

// Both begin elsewhere: one with the motion that it is compared with, the other at rest.
TEST(LeftOut, AMotionInTimeIsIntegratedAgainWithTheEffect) {
  for (const char* range : {"response.frequency=22", "response.frequency=[21, 25]"}) {
    const Overrides in_time{"response.method=time", "response.points=5", range};
    Overrides off = in_time;
    off.emplace_back("effects.normal_motion=off");
    const Study without = of_point(off);
    const Study with = of_point(in_time);
    const auto rows = rows_of(without);
    const ErrorRow* row = found(rows, "normal_motion", peak_amplitude_goal);
    ASSERT_NE(row, nullptr) << range;
    const double expected = amplitude(with) / amplitude(without) - 1.0;
    EXPECT_GT(std::abs(expected), 5e-3);
    EXPECT_NEAR(row->effect, expected, 1e-5) << range;
  }
}

TEST(LeftOut, FrictionAlongRHasABoundInTime) {
  const Study without =
      of_point({"response.method=time", "response.frequency=22", "effects.second_direction=off"});
  const Study with = of_point({"response.method=time", "response.frequency=22"});
  const auto rows = rows_of(without);
  const ErrorRow* row = found(rows, "second_direction", peak_amplitude_goal);
  ASSERT_NE(row, nullptr);
  EXPECT_NEAR(row->effect, amplitude(with) / amplitude(without) - 1.0, 1e-5);
}

// Below the limit of the indicator as well: what is "off" has a bound wherever `auto` has one.
TEST(LeftOut, LittleMotionAlongRIsPutBackAndNoneIsNot) {
  const auto names = [](double across, const char* setting) {
    const std::string w = std::to_string(across);
    const Study study = of_point({"modal.points[0].phi_w_1=" + w, "modal.points[0].phi_w_2=" + w,
                                  std::string("effects.second_direction=") + setting});
    return effects_left_out(study.model, study.scene);
  };
  EXPECT_EQ(names(1e-5, "off"), Overrides{"second_direction"});
  EXPECT_EQ(names(0.0, "off"), Overrides{});
  EXPECT_EQ(names(0.0, "auto"), Overrides{});
}

TEST(LeftOut, LimitsAloneAreComparedByTheirPeaks) {
  const Overrides limits{"response.preload=[\"free\", \"stuck\"]"};
  Overrides off = limits;
  off.emplace_back("effects.normal_motion=off");
  const Study without = of_chain(off);
  const Study with = of_chain(limits);
  const auto rows = rows_of(without);
  const auto change = [&](std::size_t i) {
    return amplitude(with, i) / amplitude(without, i) - 1.0;
  };
  const ErrorRow* free = found(rows, "normal_motion", peak_amplitude_goal, "free");
  ASSERT_NE(free, nullptr);
  EXPECT_EQ(free->effect, 0.0);  // nothing touches
  const ErrorRow* stuck = found(rows, "normal_motion", peak_amplitude_goal, "stuck");
  ASSERT_NE(stuck, nullptr);
  EXPECT_NEAR(stuck->effect, change(1), 1e-9);
  EXPECT_GT(std::abs(change(1)), 1e-3);
}

TEST(LeftOut, LimitsBesideCurvesUnderALoadHaveNoRows) {
  const Study study = of_chain({"response.preload=[50, \"stuck\"]", "effects.normal_motion=off"});
  const auto rows = rows_of(study);
  EXPECT_FALSE(rows.empty());
  EXPECT_EQ(found(rows, "normal_motion", peak_amplitude_goal, "stuck"), nullptr);
}

// Above the resonance of the one model, about that of the other: the end of the range says nothing.
TEST(LeftOut, WithoutAPeakInTheRangeTheResonanceIsTold) {
  const Overrides above{"response.frequency=[23.5, 27]"};
  Overrides off = above;
  off.emplace_back("effects.second_direction=off");
  const Study without = of_point(off);
  const Study with = of_point(above);
  EXPECT_EQ(highest_peak(without.curves[0].curve)->mark, solver::PointMark::none);
  ASSERT_EQ(highest_peak(with.curves[0].curve)->mark, solver::PointMark::peak);
  const auto rows = rows_of(without);
  EXPECT_EQ(found(rows, "second_direction", peak_amplitude_goal), nullptr);
  const ErrorRow* resonance = found(rows, "second_direction", resonance_goal);
  ASSERT_NE(resonance, nullptr);
  const double stuck_with = stuck_frequencies(with.model).minCoeff();
  EXPECT_NEAR(resonance->effect, stuck_with / stuck_frequencies(without.model).minCoeff() - 1.0,
              1e-9);
  EXPECT_GT(resonance->effect, 0.02);
}

// With friction along r the lower mode stands above the other, which it does not hold.
TEST(LeftOut, ResonancesThatChangePlacesAreComparedByTheirShapes) {
  const Overrides crossing{"modal.frequency=[20, 26]",    "modal.points[0].phi_u_1=0",
                           "modal.points[0].phi_u_2=0.1", "modal.points[0].phi_v_1=0",
                           "modal.points[0].phi_w_1=1",   "modal.points[0].phi_w_2=0",
                           "response.frequency=[30, 34]"};
  Overrides off = crossing;
  off.emplace_back("effects.second_direction=off");
  const Study with = of_point(crossing);
  ASSERT_GT(stuck_frequencies(with.model).maxCoeff(),
            1.4 * stuck_frequencies(with.model).minCoeff());
  const auto rows = rows_of(of_point(off));
  const ErrorRow* resonance = found(rows, "second_direction", resonance_goal);
  ASSERT_NE(resonance, nullptr);
  EXPECT_NEAR(resonance->effect, 0.0, 1e-9);
}

// Lightly damped and bent by the closing gap: at the frequency of the one peak the other model has
// no solution as high.
TEST(LeftOut, APeakThatIsNotReachedFromThatWithoutIsFoundAlongACurveOfItsOwn) {
  const Overrides gap{"modal.points[0].phi_v_1=0.5",
                      "modal.points[0].phi_w_1=0",
                      "modal.points[0].phi_w_2=0",
                      "modal.points[0].preload=-10",
                      "modal.points[0].friction_coefficient=0.2",
                      "modal.damping_ratio=0.002",
                      "response.frequency=[15, 60]",
                      "contact.roughness={ law = \"cubic\", height = \"20 mm\" }"};
  Overrides off = gap;
  off.emplace_back("effects.roughness=off");
  const Study without = of_point(off);
  const Study with = of_point(gap);
  const auto rows = rows_of(without);
  const ErrorRow* height = found(rows, "roughness", peak_amplitude_goal);
  ASSERT_NE(height, nullptr);
  const double expected = amplitude(with) / amplitude(without) - 1.0;
  EXPECT_GT(expected, 0.9);
  EXPECT_NEAR(height->effect, expected, 1e-6);
  const ErrorRow* place = found(rows, "roughness", peak_frequency_goal);
  ASSERT_NE(place, nullptr);
  EXPECT_NEAR(place->effect,
              highest_peak(with.curves[0].curve)->frequency /
                      highest_peak(without.curves[0].curve)->frequency -
                  1.0,
              1e-6);
  Study hurried = without;
  hurried.scene.response->time_budget = 1e-6;
  hurried.curves[0].curve.seconds = 0.0;
  const auto rows_in_time = rows_of(hurried);
  const ErrorRow* lost = found(rows_in_time, "roughness", peak_amplitude_goal);
  ASSERT_NE(lost, nullptr);
  EXPECT_FALSE(std::isfinite(lost->effect)) << "a curve that takes longer than it may";
}

/// Three modes with close resonances, and friction along p alone.
Study of_three(Overrides values) {
  for (const char* fixed :
       {"modal.damping_ratio=0.005", "modal.output=[0.75, 0.5, 0.4]", "response.frequency=[15, 45]",
        "modal.points[0].phi_u_1=0.5", "effects.second_direction=off"}) {
    values.emplace_back(fixed);
  }
  return of_point(values);
}

// With friction along r the peak at 24.35 Hz is a shoulder, where the response changes by 3 %; that
// at 27.08 Hz is lower by 7 % of the highest.
TEST(LeftOut, ALowerPeakThatBecomesAShoulderIsNotLost) {
  const Study without =
      of_three({"modal.frequency=[20, 25.852, 29.073]", "modal.force_sine=[7, -4.7, 1.536]",
                "modal.points[0].preload=4.12", "modal.points[0].phi_u_2=-0.388",
                "modal.points[0].phi_u_3=-0.164", "modal.points[0].phi_v_1=0.085",
                "modal.points[0].phi_v_2=0.293", "modal.points[0].phi_w_1=-0.023",
                "modal.points[0].phi_w_2=0.395", "modal.points[0].phi_w_3=0.394"});
  const auto rows = rows_of(without);
  const ErrorRow* height = found(rows, "second_direction", peak_amplitude_goal);
  ASSERT_NE(height, nullptr);
  EXPECT_NEAR(height->effect, -0.070, 0.002);  // of curves with and without: 0.2507 to 0.1809
  EXPECT_NEAR(height->where_hz, 27.08, 0.01);
}

// The peak at 24.96 Hz goes to 25.31 Hz, several of its widths.
TEST(LeftOut, ALowerPeakThatMovesFarIsNotLost) {
  const Study without =
      of_three({"modal.frequency=[20, 23.914, 26.168]", "modal.force_sine=[7, 1.509, -4.276]",
                "modal.points[0].preload=12.7", "modal.points[0].phi_u_2=-0.215",
                "modal.points[0].phi_u_3=-0.707", "modal.points[0].phi_v_1=0.004",
                "modal.points[0].phi_v_2=-0.278", "modal.points[0].phi_w_1=-0.04",
                "modal.points[0].phi_w_2=-0.344", "modal.points[0].phi_w_3=-0.327"});
  const auto rows = rows_of(without);
  const ErrorRow* height = found(rows, "second_direction", peak_amplitude_goal);
  const ErrorRow* place = found(rows, "second_direction", peak_frequency_goal);
  ASSERT_NE(height, nullptr);
  ASSERT_NE(place, nullptr);
  EXPECT_NEAR(height->effect, 0.1985 - 0.2154, 1e-3);  // as the curves with and without have it
  EXPECT_NEAR(place->effect, 0.2154 * (25.314 / 24.962 - 1.0), 1e-4);
}

// The peak at 23.43 Hz goes to 23.89 Hz and more than doubles: its flank has the old height, within
// 6 %, at the old frequency, and is no shoulder.
TEST(LeftOut, ALowerPeakThatMovesAndGrowsIsNoShoulder) {
  const Study without =
      of_three({"modal.frequency=[20, 24.228, 22.761]", "modal.force_sine=[7, -5.523, 1.917]",
                "modal.points[0].preload=1.57", "modal.points[0].phi_u_2=0.589",
                "modal.points[0].phi_u_3=-0.523", "modal.points[0].phi_v_1=-0.163",
                "modal.points[0].phi_v_2=0.264", "modal.points[0].phi_w_1=0.336",
                "modal.points[0].phi_w_2=0.613", "modal.points[0].phi_w_3=-0.555"});
  const auto rows = rows_of(without);
  const ErrorRow* height = found(rows, "second_direction", peak_amplitude_goal);
  ASSERT_NE(height, nullptr);
  // As the curves with and without have it, over the highest.
  EXPECT_NEAR(height->effect, (7.2841 - 3.1291) / 11.979, 1e-3);
  EXPECT_NEAR(height->where_hz, 23.427, 0.01);
}

// Nothing drives the second mode but contact along q, or along r: the curve without has one peak.
TEST(LeftOut, APeakThatExistsOnlyWithAnEffectIsFound) {
  struct Case {
    const char *effect, *setting, *shape;
  };
  for (const Case& one :
       {Case{"normal_motion", "effects.normal_motion=off", "modal.points[0].phi_v"},
        Case{"second_direction", "effects.second_direction=off", "modal.points[0].phi_w"}}) {
    const std::string shape = one.shape;
    Overrides with{"modal.frequency=[20, 37]",   "modal.damping_ratio=[0.01, 1e-4]",
                   "modal.force_sine=[1, 0]",    "modal.output=[0.8, 3]",
                   "modal.points[0].phi_u_2=0",  "modal.points[0].phi_v_1=0",
                   "modal.points[0].phi_w_1=0",  "modal.points[0].phi_w_2=0",
                   "response.frequency=[15, 45]"};
    with.insert(with.end(), {shape + "_1=0.008", shape + "_2=0.6"});
    Overrides off = with;
    off.emplace_back(one.setting);
    const Study without = of_point(off);
    const solver::ResponsePoint& own = *highest_peak(without.curves[0].curve);
    const solver::ResponsePoint there = *highest_peak(of_point(with).curves[0].curve);
    ASSERT_GT(there.amplitude, 1.5 * own.amplitude) << one.effect;
    ASSERT_GT(there.frequency, 1.5 * own.frequency) << one.effect;
    const auto rows = rows_of(without);
    const ErrorRow* height = found(rows, one.effect, peak_amplitude_goal);
    ASSERT_NE(height, nullptr) << one.effect;
    EXPECT_NEAR(height->effect, there.amplitude / own.amplitude - 1.0, 1e-3) << one.effect;
    EXPECT_NEAR(height->where_hz, there.frequency / (2.0 * std::numbers::pi), 0.01) << one.effect;
  }
}

TEST(LeftOut, APeakThatLeavesTheRangeIsToldByItsFrequency) {
  const Study without = of_point({"response.frequency=[20, 23]", "effects.second_direction=off"});
  ASSERT_EQ(highest_peak(without.curves[0].curve)->mark, solver::PointMark::peak);
  const auto rows = rows_of(without);
  EXPECT_EQ(found(rows, "second_direction", peak_amplitude_goal), nullptr);
  const ErrorRow* outside = found(rows, "second_direction", peak_outside_goal);
  ASSERT_NE(outside, nullptr);
  const Study with = of_point({});
  const double expected = highest_peak(with.curves[0].curve)->frequency /
                              highest_peak(without.curves[0].curve)->frequency -
                          1.0;
  EXPECT_NEAR(outside->effect, expected, 1e-4);
}

// Each alone is compared with the other still off.
TEST(LeftOut, SeveralArePutBackTogetherAsWell) {
  const Study without = of_point({"effects.normal_motion=off", "effects.second_direction=off"});
  const Study with = of_point({});
  const auto rows = rows_of(without);
  const ErrorRow* both = found(rows, "normal_motion + second_direction", peak_amplitude_goal);
  ASSERT_NE(both, nullptr);
  EXPECT_NEAR(both->effect, amplitude(with) / amplitude(without) - 1.0, 1e-6);
  for (const char* alone : {"normal_motion", "second_direction"}) {
    const ErrorRow* row = found(rows, alone, peak_amplitude_goal);
    ASSERT_NE(row, nullptr) << alone;
    EXPECT_GT(std::abs(row->effect - both->effect), 1e-3) << alone;
  }
}

// A static force presses the point, so that it slips less: the mean decides the load.
TEST(LeftOut, TheMeanOfNormalMotionThatIsOffIsPutBack) {
  const Overrides pressed{"modal.force_static=[300, 0]", "effects.second_direction=off"};
  Overrides off = pressed;
  off.emplace_back("effects.mean_coupling=off");
  for (const char* harmonics : {"response.harmonics=1", "response.harmonics=3"}) {
    const auto study = [&](Overrides overrides) {
      overrides.emplace_back(harmonics);
      return of_point(overrides);
    };
    const Study without = study(off);
    const Study with = study(pressed);
    const auto rows = rows_of(without);
    const ErrorRow* height = found(rows, "mean_coupling", peak_amplitude_goal);
    const ErrorRow* place = found(rows, "mean_coupling", peak_frequency_goal);
    ASSERT_TRUE(height != nullptr && place != nullptr) << harmonics;
    const double expected = amplitude(with) / amplitude(without) - 1.0;
    EXPECT_GT(std::abs(expected), 0.02);
    constexpr double known = 1e-6;
    EXPECT_NEAR(height->effect, expected, known) << harmonics;
    // A peak is flat, a = 1 - (d/zeta)^2/2 at d of the frequency beside it: within that height d is
    // not known.
    const double flat = 0.03 * std::sqrt(2.0 * known);
    EXPECT_NEAR(place->effect,
                highest_peak(with.curves[0].curve)->frequency /
                        highest_peak(without.curves[0].curve)->frequency -
                    1.0,
                flat);
    const std::vector<RicherModel> others =
        models_left_out(without.model, without.scene, nullptr).models;
    EXPECT_EQ(found(rows_of(with), "mean_coupling", peak_amplitude_goal), nullptr);
    EXPECT_EQ(others.front().source, "mean_coupling");
  }
}

// Three modes and a point that slips; along r it moves with the second mode above all. The
// indicator is largest where friction along r changes the curve by 1 % of the peak, which was told
// alone once; beside the second resonance, which it damps, by a fifth.
constexpr const char* two_resonances = R"toml([model]
kind = "modal"
[modal]
frequency = [20, 24.852, 41.011]
damping_ratio = 0.01
force_sine = [7, 0.545, -1.944]
output = [0.75, 0.056, -0.556]
[[modal.points]]
weight = 1
tangential_stiffness = 2e4
normal_stiffness = 4e4
friction_coefficient = 0.5
preload = 60
phi_u_1 = 0.5
phi_u_2 = 0.083
phi_u_3 = -0.019
phi_v_1 = 0
phi_w_1 = 0.064
phi_w_2 = 0.148
phi_w_3 = -0.13
[response]
frequency = [19, 28]
harmonics = 1
)toml";

/// Amplitude of a curve that does not fold, between its points.
double amplitude_at(const solver::ResponseCurve& curve, double frequency) {
  const auto next =
      std::ranges::lower_bound(curve.points, frequency, {}, &solver::ResponsePoint::frequency);
  if (next == curve.points.begin()) return next->amplitude;
  const solver::ResponsePoint& a = *std::prev(next);
  const double share = (frequency - a.frequency) / (next->frequency - a.frequency);
  return a.amplitude + share * (next->amplitude - a.amplitude);
}

TEST(LeftOut, WhatChangesTheCurveBesideThePeaksIsSeenWhereTheIndicatorIsNotLargest) {
  const auto study = [](const char* setting) {
    return solved(parse_scene(two_resonances, "scene.toml", "/nowhere",
                              {std::string("effects.second_direction=") + setting}));
  };
  const Study without = study("off");
  const Study with = study("on");
  const CurveResult& curve = without.curves.at(0);
  const RicherModels others = models_left_out(without.model, without.scene, nullptr);
  const auto known = rows_left_out(without.model, without.scene, others.models, curve);
  const auto along = indicators_along(without.model, without.scene, others.models, curve);
  const auto rows = rows_there(without.model, without.scene, others.models, curve, along, known);
  ASSERT_EQ(rows.size(), 3U);
  const double told = std::abs(rows[1].effect);
  // What the curve with friction along r is off by, what its peak tells left out.
  double change = 0.0;
  const double top = amplitude(without);
  for (const solver::ResponsePoint& one : curve.curve.points) {
    const double there = amplitude_at(with.curves.at(0).curve, one.frequency);
    change = std::max(change, std::abs(there - one.amplitude) / top);
  }
  double of_peaks = 0.0;
  for (const ErrorRow& row : known) of_peaks = std::max(of_peaks, std::abs(row.effect));
  EXPECT_LT(of_peaks, 0.02);
  EXPECT_GT(change, 0.1);
  EXPECT_GT(told, 0.5 * change);
  // At the largest indicator alone next to nothing is seen.
  EXPECT_EQ(rows.front().where_hz, largest_along(along.front(), curve).where_hz);
  EXPECT_LT(std::abs(rows.front().effect), 0.1 * change);
  // With what the change of the peak makes of the curve all of it is told.
  EXPECT_EQ(rows.back().goal, along_curve_goal);
  EXPECT_GT(rows.back().effect, 0.9 * change);
  EXPECT_LT(rows.back().effect, 2.0 * change);
}

}  // namespace
}  // namespace microslip::pipelines::test_left_out
