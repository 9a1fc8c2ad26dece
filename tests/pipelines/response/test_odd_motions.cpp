// Under constant loads contact changes sign with the motion: even harmonics are zero, and no
// unknowns.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/description/curve_request.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/response/solver_scenes.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "solver/balance/harmonic_balance.hpp"
#include "solver/stability/stability.hpp"

namespace microslip::pipelines::test_odd_motions {
namespace {

using Overrides = std::vector<std::string>;

// It slips; the second mode stands at twice and three times the frequency of the first resonance.
constexpr const char* point = R"toml([model]
kind = "modal"
[modal]
frequency = [20, 46, 66]
damping_ratio = 0.01
force_sine = [7, 0.5, 0.5]
force_static = [0, 0, 0]
output = [0.75, 0.5, 0.3]
[[modal.points]]
weight = 1
tangential_stiffness = 4e4
normal_stiffness = 4e4
friction_coefficient = 0.5
preload = 30
phi_u_1 = 0.5
phi_u_2 = -0.8
phi_u_3 = 0.4
phi_v_1 = 0
[response]
frequency = [19, 28]
harmonics = 6
)toml";

struct Study {
  std::vector<int> orders;
  bool without_mean = false;
  solver::ResponseCurve curve;
};

Study solved(const Overrides& overrides) {
  const SceneDescription scene = parse_scene(point, "scene.toml", "/nowhere", overrides);
  std::vector<std::string> warnings;
  const ReducedModel model = model_of(scene, nullptr, warnings);
  const CurveResult result =
      trace_curve(model, scene, curve_requests(scene).at(0), [](const auto&) { return true; });
  const solver::ContinuationOptions options = continuation_options(scene, model);
  return {options.orders, options.without_mean, result.curve};
}

const std::vector<int> odd{1, 3, 5, 6};  // and the highest, whose columns are asked for

TEST(OddMotions, EvenHarmonicsOfContactUnderAConstantLoadAreNoUnknowns) {
  for (const char* plane : {"modal.points[0].phi_w_1=0", "modal.points[0].phi_w_1=0.4"}) {
    const Study lean = solved({plane});
    const Study all = solved({plane, "response.harmonics=[1, 2, 3, 4, 5, 6]"});
    EXPECT_EQ(lean.orders, odd);
    EXPECT_TRUE(lean.without_mean);
    EXPECT_FALSE(all.without_mean);
    EXPECT_EQ(all.orders.size(), 6U);
    ASSERT_TRUE(lean.curve.complete && all.curve.complete);
    const solver::ResponsePoint& own = *highest_peak(lean.curve);
    const solver::ResponsePoint& other = *highest_peak(all.curve);
    EXPECT_NEAR(own.amplitude, other.amplitude, 1e-9 * other.amplitude);
    EXPECT_NEAR(own.frequency, other.frequency, 1e-9 * other.frequency);
    EXPECT_EQ(own.stability, other.stability);
    EXPECT_GT(other.q.sine(3).norm(), 1e-3 * other.q.sine(1).norm()) << "else none would do";
    EXPECT_LT(other.q.sine(2).norm() + other.q.mean().norm(), 1e-9 * other.q.sine(1).norm());
  }
}

TEST(OddMotions, WhatMayBreakTheSymmetryKeepsThem) {
  for (const char* one :
       {"modal.points[0].phi_v_1=0.1", "modal.force_static=[1, 0, 0]",
        "contact.friction_law={ law = \"exponential\", static = 0.5, kinetic = 0.4, rate = 2 }"}) {
    const Study kept = solved({one, "response.harmonics=3"});
    EXPECT_TRUE(kept.orders.empty() && !kept.without_mean) << one;
  }
  EXPECT_EQ(solved({"modal.points[0].phi_v_1=0.1", "effects.normal_motion=off"}).orders, odd);
  EXPECT_EQ(solved({"response.harmonics=7"}).orders, (std::vector<int>{1, 3, 5, 7}));
}

/// Largest growth of Hill's exponents at a motion [rad/s]; empty: it is proved stable without them.
std::optional<double> growth(const solver::Scene& scene, const solver::HarmonicSet& set,
                             const solver::ResponsePoint& at) {
  solver::HarmonicBalance balance(scene, set);
  const auto evaluation = balance.evaluate(balance.unknowns(at.q), at.frequency);
  const solver::StabilityReport report =
      solver::assess_stability(balance, evaluation.jacobian, at.q, at.frequency);
  if (report.basis == solver::StabilityBasis::damped_linear) return std::nullopt;
  return solver::hill_growth(balance, at.q, at.frequency, *report.reduced).value().largest;
}

// The even half of the perturbations has the exponents of all; both are cut off at some harmonic.
TEST(OddMotions, ExponentsAreThoseOfAllHarmonics) {
  const SceneDescription scene =
      parse_scene(point, "scene.toml", "/nowhere", {"response.harmonics=9"});
  std::vector<std::string> warnings;
  const ReducedModel model = model_of(scene, nullptr, warnings);
  const solver::Scene solved_one = solver_scene(model, 1.0);
  const Study lean = solved({"response.harmonics=9"});
  const solver::HarmonicSet odd_alone({1, 3, 5, 7, 9}, solver::HarmonicSet::Mean::left_out);
  double largest = 0.0;
  int n_compared = 0;
  for (const solver::ResponsePoint& at : lean.curve.points) {
    const auto all = growth(solved_one, 9, at);
    const auto of_odd = growth(solved_one, odd_alone, at);
    EXPECT_EQ(all.has_value(), of_odd.has_value()) << at.frequency;
    if (!all || !of_odd) continue;
    ASSERT_LT(*all, 0.0);
    largest = std::max(largest, std::abs(*of_odd / *all - 1.0));
    ++n_compared;
  }
  EXPECT_GT(n_compared, 10);
  std::cout << "exponents differ by " << largest << '\n';
  EXPECT_LT(largest, 1e-6);
}

TEST(OddMotions, OrdersThatAreAskedForAreKept) {
  EXPECT_EQ(solved({"response.harmonics=[1, 2]"}).orders, (std::vector<int>{1, 2}));
}

}  // namespace
}  // namespace microslip::pipelines::test_odd_motions
