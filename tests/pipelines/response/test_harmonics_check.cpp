// Peaks of given harmonics are solved with more, whatever the number of modes: contact sees those
// through few coordinates.
#include "pipelines/response/harmonics_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "pipelines/description/curve_request.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/response/solver_scenes.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "solver/continuation.hpp"

namespace microslip::pipelines::test_harmonics_check {
namespace {

std::string list(int n, const auto& entry) {
  std::string text = "[";
  for (int i = 0; i < n; ++i) text += (i == 0 ? "" : ", ") + std::to_string(entry(i));
  return text + "]";
}

/// A point that slips; modes from 20 Hz on.
std::string scene_with(int n_modes, const std::string& harmonics, double end_hz = 24.0) {
  const auto falling = [](int i) { return 1.0 / (1 + i); };
  std::string text = "[model]\nkind = \"modal\"\n[modal]\ndamping_ratio = 0.01\n";
  text += "frequency = " + list(n_modes, [](int i) { return 20.0 + 26.0 * i; }) + "\n";
  text += "force_sine = " + list(n_modes, [&](int i) { return 7.0 * falling(i); }) + "\n";
  text += "output = " + list(n_modes, falling) + "\n[[modal.points]]\nweight = 1\n";
  text += "tangential_stiffness = 4e4\nnormal_stiffness = 4e4\nfriction_coefficient = 0.5\n";
  text += "preload = 30\n";
  for (int i = 0; i < n_modes; ++i) {
    text += "phi_u_" + std::to_string(i + 1) + " = " + std::to_string(0.5 * falling(i)) + "\n";
  }
  text += "phi_v_1 = 0.2\n[response]\nfrequency = [21, " + std::to_string(end_hz);
  text += "]\nharmonics = ";
  return text + harmonics + "\n";
}

CurveResult traced(const std::string& text) {
  const SceneDescription scene = parse_scene(text, "scene.toml", "/nowhere", {});
  std::vector<std::string> warnings;
  return trace_curve(model_of(scene, nullptr, warnings), scene, curve_requests(scene).at(0),
                     [](const auto&) { return true; });
}

TEST(HarmonicsCheck, TellsWhatMoreDoWhateverTheNumberOfModes) {
  for (const int n_modes : {4, 70}) {
    const CurveResult three = traced(scene_with(n_modes, "3"));
    const CurveResult eleven = traced(scene_with(n_modes, "11"));
    ASSERT_TRUE(three.richer && three.richer->change) << n_modes << " modes";
    EXPECT_GT(std::abs(*three.richer->change), 1e-4) << n_modes << " modes";
    const double own = highest_peak(eleven.curve)->amplitude;
    EXPECT_NEAR(three.richer->amplitude, own, 1e-6 * own) << n_modes << " modes";
  }
}

// Row 99. Hard: the range ends between the peaks with few and with more harmonics.
// Met in: ranges set by a curve of one harmonic.
// Right: climbed from inward: a peak is told by a peak, not by the end beside it.
//
// With one harmonic the peak lies at 22.19 Hz, with nine at 22.095: of a range that ends between
// them the end is the highest place with one, and no longer with more.
TEST(HarmonicsCheck, FindsAPeakInsideWhereTheEndOfTheRangeWasTheHighest) {
  const CurveResult one = traced(scene_with(4, "1", 22.15));
  const double truth = highest_peak(traced(scene_with(4, "9")).curve)->frequency;
  ASSERT_NEAR(one.curve.points.back().frequency, 2.0 * std::numbers::pi * 22.15, 1e-6);
  ASSERT_TRUE(one.richer && one.richer->change);
  EXPECT_NEAR(one.richer->frequency, truth, 1e-5 * truth);
}

// The end was settled with more harmonics as well: what is told of the peak is not taken from
// there.
TEST(HarmonicsCheck, TellsAPeakByAPeakAndNotByTheEndOfTheRange) {
  const CurveResult chosen = traced(scene_with(4, "\"auto\"", 22.15));
  const double truth = highest_peak(traced(scene_with(4, "9")).curve)->frequency;
  const solver::SettledPeak& settled = chosen.curve.settled_peak;
  ASSERT_GT(settled.amplitude, 0.0);
  EXPECT_FALSE(settled.is_end);
  EXPECT_NEAR(settled.frequency, truth, 1e-4 * truth);
}

// Row 96. Hard: one peak of one harmonic is two with more, and the higher one is elsewhere.
// Met in: kω that meets a mode along the curve.
// Right: the check tells the higher one.
//
// Mode 2, hardly damped, at three times the peak, which becomes two with harmonic 3: the lower one
// is nearer to it.
TEST(HarmonicsCheck, TellsTheHigherOfTwoPeaksBesideAnInternalResonance) {
  const auto scene = [](const char* harmonics) {
    return std::string(R"([model]
kind = "modal"
[modal]
frequency = [20, 64.0855690801184]
damping_ratio = [0.003, 1.1855e-6]
force_sine = [7, 0]
output = [0.75, 0.5]
points = [ { weight = 1, tangential_stiffness = 4e4, normal_stiffness = 4e4, friction_coefficient = 0.5, preload = 28.59, phi_u_1 = 0.5, phi_u_2 = 0.05, phi_v_1 = 0.1 } ]
[response]
frequency = [19, 28]
harmonics = )") +
           harmonics + "\n";
  };
  const CurveResult one = traced(scene("1"));
  const CurveResult nine = traced(scene("9"));
  const double truth = highest_peak(nine.curve)->amplitude;
  ASSERT_GT(truth, 1.5 * highest_peak(one.curve)->amplitude);
  ASSERT_TRUE(one.richer && one.richer->change);
  EXPECT_NEAR(one.richer->amplitude, truth, 1e-6 * truth);
}

/// A mode that neither the excitation nor the first harmonics move, far above.
std::string with_distant_mode(double hz, const std::string& harmonics) {
  return R"([model]
kind = "modal"
[modal]
damping_ratio = [0.003, 0.001]
force_sine = [7, 0]
output = [0.75, 3]
points = [ { weight = 1, tangential_stiffness = 4e4, normal_stiffness = 4e4, friction_coefficient = 0.5, preload = 28.59, phi_u_1 = 0.5, phi_u_2 = 2, phi_v_1 = 0.1 } ]
frequency = [20, )" +
         std::to_string(hz) + "]\n[response]\nfrequency = [19, 28]\nharmonics = " + harmonics +
         "\n";
}

// At fifteen times the peak the mode moves it by 2.3 %, and the eleven harmonics of a check that
// ends there by 0.1 %.
TEST(HarmonicsCheck, ReachesAModeFarAboveTheHarmonicsGiven) {
  const CurveResult three = traced(with_distant_mode(319.0, "3"));
  const double own = highest_peak(three.curve)->amplitude;
  const double truth = highest_peak(traced(with_distant_mode(319.0, "17")).curve)->amplitude;
  const double eleven = highest_peak(traced(with_distant_mode(319.0, "11")).curve)->amplitude;
  ASSERT_GT(std::abs(own / truth - 1.0), 0.02);
  ASSERT_LT(std::abs(own / eleven - 1.0), 0.002);
  ASSERT_TRUE(three.richer && three.richer->change);
  EXPECT_EQ(three.richer->highest, 11);
  EXPECT_EQ(three.richer->beyond, std::vector<int>{15});
  EXPECT_NEAR(three.richer->amplitude, truth, 0.001 * truth);
}

// Half way between two multiples of the peak: that costs nothing, and nothing is missed.
TEST(HarmonicsCheck, GoesNoFurtherWhereNoModeIsNear) {
  const CurveResult three = traced(with_distant_mode(331.0, "3"));
  ASSERT_TRUE(three.richer && three.richer->change);
  EXPECT_TRUE(three.richer->beyond.empty());
  const double truth = highest_peak(traced(with_distant_mode(331.0, "17")).curve)->amplitude;
  EXPECT_NEAR(three.richer->amplitude, truth, 0.001 * truth);
}

/// Mode 2 at twice a frequency in the range, where the motion of mode 1 is small: with harmonic 2
/// the output, which hardly sees mode 1, has its highest peak there.
std::string with_internal_resonance(const std::string& harmonics) {
  return R"([model]
kind = "modal"
[modal]
frequency = [55.438712, 146.48495, 398.19144]
damping_ratio = 0.001084
force_sine = [-0.765, 0.39, 0.8976]
output = [0.0154, 0.7914, -0.4731]
points = [
  { weight = 1, tangential_stiffness = 301796, normal_stiffness = 247800, friction_coefficient = 0.196, preload = 1.016, phi_u_1 = 0.2093, phi_u_2 = 0.1463, phi_u_3 = 0.3113, phi_v_1 = -0.4178, phi_v_2 = -0.05597, phi_v_3 = -0.6755 },
  { weight = 1, tangential_stiffness = 161960, normal_stiffness = 6556.6, friction_coefficient = 0.1112, preload = 3.6245, phi_u_1 = 0.7174, phi_u_2 = 0.3808, phi_u_3 = -0.6852, phi_v_1 = 0.6521, phi_v_2 = 0.00772, phi_v_3 = 0.3206 },
]
[response]
frequency = [44.4, 88.7]
)" + harmonics;
}

TEST(ChosenHarmonics, HaveTheHighestPeakWhereverItResonates) {
  const CurveResult five = traced(with_internal_resonance("harmonics = 5\n"));
  const CurveResult chosen =
      traced(with_internal_resonance("harmonics = \"auto\"\nharmonic_tolerance = 0.05\n"));
  const solver::ResponsePoint& peak = *highest_peak(five.curve);
  ASSERT_NEAR(peak.frequency / (2.0 * std::numbers::pi), 73.5, 0.1);
  EXPECT_NEAR(highest_peak(chosen.curve)->frequency, peak.frequency, 1e-3 * peak.frequency);
  EXPECT_NEAR(highest_peak(chosen.curve)->amplitude, peak.amplitude, 0.05 * peak.amplitude);
}

/// Mode 2 at three times a frequency away from the peak: the output hardly sees mode 1.
std::string with_third_harmonic(const std::string& harmonics) {
  return R"([model]
kind = "modal"
[modal]
frequency = [20.0, 63.998]
damping_ratio = [0.0171, 0.0002]
force_sine = [1.0, 0.0]
output = [0.8, 10.294]
points = [ { weight = 1, tangential_stiffness = 6371.8, normal_stiffness = 6371.8, friction_coefficient = 0.5, preload = 0.52766, phi_u_1 = 0.5, phi_u_2 = 0.21024 } ]
[response]
frequency = [15.0, 35.0]
harmonics = )" +
         harmonics + "\n";
}

// Row 103. Hard: a harmonic that was not given makes a higher peak away from the highest one.
// Met in: 2.27e-3 m at 21.3 Hz where 1.24e-3 ± 0.7 % was told.
// Right: traced with it; no bar where the choice was stopped before.
TEST(HarmonicsCheck, LooksForHigherPeaksWhereAHarmonicResonates) {
  const CurveResult one = traced(with_third_harmonic("1"));
  const solver::ResponsePoint truth = *highest_peak(traced(with_third_harmonic("9")).curve);
  ASSERT_GT(truth.amplitude, 1.5 * highest_peak(one.curve)->amplitude);
  ASSERT_TRUE(one.richer && one.richer->change);
  EXPECT_NEAR(one.richer->amplitude, truth.amplitude, 0.01 * truth.amplitude);
  EXPECT_NEAR(one.richer->frequency, truth.frequency, 1e-3 * truth.frequency);
}

// Two peaks of nearly one height, of which the second harmonic takes more from the first: the other
// is higher by 2 % then, and at another frequency.
TEST(HarmonicsCheck, AnotherPeakCountsHoweverLittleItIsHigher) {
  const auto with = [](const char* harmonics) {
    return R"([model]
kind = "modal"
[modal]
frequency = [100, 140, 286.0721767]
damping_ratio = [0.004, 0.004, 0.0003]
force_sine = [1, 1.5, 0]
output = [1, 1, 0.6]
points = [
  { weight = 1, tangential_stiffness = 100000, normal_stiffness = 100000, friction_coefficient = 0.4, preload = 8, phi_u_1 = 0.5, phi_u_2 = 0.6, phi_u_3 = 0.5, phi_v_1 = 0.3, phi_v_2 = -0.5, phi_v_3 = 0.7 },
]
[response]
frequency = [92, 170]
harmonics = )" +
           std::string(harmonics) + "\n";
  };
  const CurveResult one = traced(with("1"));
  const solver::ResponsePoint truth = *highest_peak(traced(with("6")).curve);
  ASSERT_GT(truth.frequency, 1.2 * highest_peak(one.curve)->frequency);
  ASSERT_TRUE(one.richer && one.richer->change);
  EXPECT_NEAR(one.richer->amplitude, truth.amplitude, 0.01 * truth.amplitude);
  EXPECT_NEAR(one.richer->frequency, truth.frequency, 0.01 * truth.frequency);
}

/// The curve with chosen harmonics, stopped when this has been asked for so many times.
solver::ResponseCurve stopped_after(long most, long& asked) {
  const SceneDescription scene =
      parse_scene(with_third_harmonic("\"auto\""), "scene.toml", "/nowhere", {});
  std::vector<std::string> warnings;
  const ReducedModel model = model_of(scene, nullptr, warnings);
  solver::ContinuationOptions options = continuation_options(scene, model);
  options.stop = [&asked, most] { return ++asked > most; };
  asked = 0;
  return solver::trace_response(solver_scene(model, 1.0), options,
                                [](const auto&) { return true; });
}

TEST(ChosenHarmonics, AreNotKnownToBeEnoughBeforeTheChoiceHasEnded) {
  long all = 0;
  const solver::ResponseCurve whole = stopped_after(std::numeric_limits<long>::max(), all);
  const double truth = highest_peak(whole)->amplitude;
  ASSERT_TRUE(whole.complete);
  EXPECT_FALSE(is_unsettled(whole));
  int n_wrong = 0;
  constexpr int parts = 40;
  for (int part = 1; part < parts; ++part) {
    long asked = 0;
    const solver::ResponseCurve curve = stopped_after(part * all / parts, asked);
    if (!curve.complete) continue;
    const solver::ResponsePoint& peak = *highest_peak(curve);
    if (std::abs(peak.amplitude / truth - 1.0) < 0.1) continue;
    ++n_wrong;
    EXPECT_FALSE(is_left_out_known(curve, peak.harmonics_left_out)) << part;
  }
  EXPECT_GT(n_wrong, 0);
}

// Where one harmonic is enough nothing is pruned; what was solved for to confirm that tells how far
// the frequency and the energy of the peak are off.
TEST(ChosenHarmonics, TellTheFrequencyAndTheEnergyOfThePeak) {
  const std::string text = scene_with(4, "15");
  const auto harmonics = text.find("harmonics = 15");
  const CurveResult chosen =
      traced(text.substr(0, harmonics) + "harmonics = \"auto\"\nharmonic_tolerance = 0.1\n");
  const CurveResult many = traced(text);
  const solver::ResponsePoint& own = *highest_peak(chosen.curve);
  const solver::ResponsePoint& truth = *highest_peak(many.curve);
  const solver::SettledPeak& told = chosen.curve.settled_peak;
  ASSERT_GT(told.amplitude, 0.0);
  const auto left = [](double told_value, double own_value, double true_value) {
    return std::abs(told_value - true_value) / std::abs(own_value - true_value);
  };
  EXPECT_LT(left(told.amplitude, own.amplitude, truth.amplitude), 0.3);
  EXPECT_LT(left(told.frequency, own.frequency, truth.frequency), 0.3);
  EXPECT_LT(left(told.dissipated_energy, own.energy.friction, truth.energy.friction), 0.3);
}

}  // namespace
}  // namespace microslip::pipelines::test_harmonics_check
