#include "pipelines/accuracy/error_budget.hpp"

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "pipelines/accuracy/richer_models.hpp"
#include "pipelines/description/curve_request.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/response/harmonics_check.hpp"
#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/response/solver_scenes.hpp"
#include "pipelines/scene/scene_file.hpp"

namespace microslip::pipelines::test_error_budget {
namespace {

CurveBudget budget(const std::string& curve, const std::string& source, double amplitude,
                   double frequency) {
  CurveBudget result;
  result.rows.push_back({curve, peak_amplitude_goal, source, amplitude, ErrorKind::solved, 1.0});
  result.rows.push_back({curve, peak_frequency_goal, source, frequency, ErrorKind::solved, 1.0});
  return result;
}

CurveBudget lacking(const std::string& curve, const std::string& source) {
  CurveBudget result = budget(curve, "cells", 1e-3, 1e-4);
  result.unknown.push_back(source);
  return result;
}

TEST(ErrorBudget, ACurveThatCannotBeFollowedHasTheLargestErrorOfTheOthers) {
  std::vector<CurveBudget> budgets{budget("a", "mesh", 0.01, -0.008), lacking("b", "mesh"),
                                   budget("c", "mesh", -0.05, -0.005), CurveBudget{}};
  EXPECT_NE(budget_text(budgets[1]).find("not known: mesh"), std::string::npos);
  borrow_unknown(budgets);
  EXPECT_TRUE(budgets[1].unknown.empty());
  EXPECT_DOUBLE_EQ(bar_of(budgets[1].rows, "b", peak_amplitude_goal), 0.051);
  EXPECT_DOUBLE_EQ(bar_of(budgets[1].rows, "b", peak_frequency_goal), 0.0081);
  EXPECT_EQ(budgets[1].rows.back().kind, ErrorKind::borrowed);
  EXPECT_NE(budget_text(budgets[1]).find("mesh -5 % (as of another curve)"), std::string::npos);
  EXPECT_EQ(budgets[0].rows.size(), 2U);
  EXPECT_TRUE(budgets[3].rows.empty());
}

// A gap that never closes: a richer basis of the contact changes nothing, which tells nothing of
// curves that stick.
TEST(ErrorBudget, CurvesWithoutContactStandInForTheMeshAlone) {
  CurveBudget open = budget("open", "basis", 1e-11, 1e-11);
  open.touches = false;
  std::vector<CurveBudget> budgets{open, lacking("stuck", "basis")};
  borrow_unknown(budgets);
  EXPECT_EQ(budgets[1].unknown, std::vector<std::string>{"basis"});
  budgets = {budget("open", "mesh", 0.01, 0.001), lacking("stuck", "mesh")};
  budgets[0].touches = false;
  borrow_unknown(budgets);
  EXPECT_TRUE(budgets[1].unknown.empty());
}

TEST(ErrorBudget, WhatNoCurveKnowsStaysUnknown) {
  std::vector<CurveBudget> budgets{lacking("a", "mesh"), lacking("b", "mesh"),
                                   lacking("c", "harmonics"), budget("d", "harmonics", 0.1, 0.0)};
  borrow_unknown(budgets);
  EXPECT_EQ(budgets[0].unknown, std::vector<std::string>{"mesh"});
  // Other harmonics are another curve, not an error to be bounded by that of another.
  EXPECT_FALSE(budgets[2].has_bar());
}

TEST(ErrorBudget, OtherHarmonicsLeaveTheOtherErrorsAsTheyAre) {
  CurveBudget before = budget("a", "mesh", 0.01, -0.008);
  before.unknown = {"basis", "harmonics"};
  CurveBudget now = budget("a", "harmonics", 0.002, 0.0);
  now.dissipated_energy = 3.0;
  const CurveBudget both = with_harmonics_of(before, now);
  EXPECT_TRUE(both.has_bar());
  EXPECT_EQ(both.unknown, std::vector<std::string>{"basis"});
  EXPECT_DOUBLE_EQ(both.dissipated_energy, 3.0);
  const double mesh = bar_of(before.rows, "a", peak_amplitude_goal);
  EXPECT_DOUBLE_EQ(bar_of(both.rows, "a", peak_amplitude_goal),
                   mesh + bar_of(now.rows, "a", peak_amplitude_goal));
  EXPECT_FALSE(with_harmonics_of(both, lacking("a", "harmonics")).has_bar());
}

struct Traced {
  CurveResult curve;
  CurveBudget budget;
};

/// @param n_attachment  so many of its three modes count as attachment shapes.
Traced traced(const std::string& harmonics, double preload, Eigen::Index n_attachment = 0) {
  const SceneDescription scene =
      read_scene(MICROSLIP_SCENES "/chain_3dof_normal.toml", {"response.harmonics=" + harmonics});
  std::vector<std::string> warnings;
  ReducedModel model = model_of(scene, nullptr, warnings);
  model.n_attachment = n_attachment;
  Traced result;
  result.curve =
      trace_curve(model, scene, CurveRequest{"curve", preload}, [](const auto&) { return true; });
  check_harmonics(model, scene, preload, result.curve);
  result.budget = error_budget(model, scene, {}, result.curve);
  return result;
}

// Against a bar of 24 modes and 400 points.
TEST(ErrorBudget, OfABarHasItsModesAndItsContactPoints) {
  const auto peak_of = [](const std::vector<std::string>& overrides, CurveBudget* told) {
    std::vector<std::string> all{"modes.count=2",        "contact.points=10",
                                 "excitation.force=200", "response.frequency=[900, 1200]",
                                 "response.harmonics=3", "response.maps=[]"};
    all.insert(all.end(), overrides.begin(), overrides.end());
    const SceneDescription scene = read_scene(MICROSLIP_SCENES "/bar_constant_1000.toml", all);
    std::vector<std::string> warnings;
    const ReducedModel model = model_of(scene, nullptr, warnings);
    const CurveResult curve =
        trace_curve(model, scene, CurveRequest{"curve", 1.0}, [](const auto&) { return true; });
    if (told != nullptr) {
      *told = error_budget(model, scene, richer_models(model, scene, nullptr), curve);
    }
    return highest_peak(curve.curve)->amplitude;
  };
  for (const char* residual : {"modes.residual=none", "modes.residual=stiffness"}) {
    CurveBudget told;
    const double own = peak_of({residual}, &told);
    const auto beside = [&](const char* key) {
      return peak_of({residual, key}, nullptr) / own - 1.0;
    };
    const auto effect = [&](const char* source) {
      for (const ErrorRow& row : told.rows) {
        if (row.source == source && row.goal == std::string(peak_amplitude_goal)) return row.effect;
      }
      ADD_FAILURE() << source << ", " << residual;
      return 0.0;
    };
    const double cells = beside("contact.points=400");
    const double basis = beside("modes.count=24");
    std::printf("%s: cells told %.2e, true %.2e; basis told %.2e, true %.2e\n", residual,
                effect("cells"), cells, effect("basis"), basis);
    EXPECT_GT(std::abs(effect("cells")), 0.7 * std::abs(cells)) << residual;
    EXPECT_LT(std::abs(effect("cells")), 1.5 * std::abs(cells)) << residual;
    EXPECT_GT(std::abs(effect("basis")), 0.5 * std::abs(basis)) << residual;
    EXPECT_LT(std::abs(effect("basis")), 2e-3) << residual;
  }
}

double effect_of(const CurveBudget& budget, const char* goal) {
  for (const ErrorRow& row : budget.rows) {
    if (row.source == "harmonics" && row.goal == goal) return row.effect;
  }
  ADD_FAILURE() << goal;
  return 0.0;
}

TEST(ErrorBudget, TellsWhatMoreHarmonicsDoToTheDissipatedEnergy) {
  for (const double preload : {30.0, 100.0}) {
    const Traced few = traced("1", preload);
    const Traced truth = traced("9", preload);
    const double told = effect_of(few.budget, dissipated_energy_goal);
    const double before = highest_peak(few.curve.curve)->energy.friction;
    const double after = highest_peak(truth.curve.curve)->energy.friction;
    std::printf("%g N: dissipated energy %.6g J, told %+.4f, true %+.4f\n", preload, before, told,
                after / before - 1.0);
    EXPECT_GT(std::abs(told), 1e-3);
    // The richer peak is left where |da/ds| <= 1e-4 a: its place errs by 1e-4, and energy is not
    // stationary there.
    const double beyond = *few.budget.energy_ratio * few.curve.richer->left_out;
    EXPECT_NEAR(std::abs(told), std::abs(after / before - 1.0) + beyond, 1e-4);
    EXPECT_LT(beyond, 1e-3);
    EXPECT_NEAR(few.budget.dissipated_energy, before, 1e-12 * before);
  }
}

// Far above what slips: friction dissipates rounding, by which nothing is divided.
TEST(ErrorBudget, OfAContactThatSticksHasNoEffectOnDissipatedEnergy) {
  const Traced stuck = traced("1", 1e5);
  ASSERT_FALSE(stuck.budget.rows.empty());
  EXPECT_FALSE(stuck.budget.energy_ratio.has_value());
  for (const ErrorRow& row : stuck.budget.rows) EXPECT_NE(row.goal, dissipated_energy_goal);
  EXPECT_NE(budget_text(stuck.budget).find("friction dissipates nothing"), std::string::npos);
}

// Chosen harmonics end where the modes do; what is beyond is in no bar.
TEST(ErrorBudget, SaysWhereHarmonicsBeyondTheModesKeptAreNotAsked) {
  const std::vector<std::string> modes{"modes"};
  EXPECT_EQ(traced("auto", 30.0, 1).budget.unknown, modes);
  EXPECT_TRUE(traced("auto", 30.0).budget.unknown.empty()) << "no shapes: all are asked";
  EXPECT_TRUE(traced("auto", 1e5, 1).budget.unknown.empty()) << "nothing opens";
}

// Under a constant load even harmonics are no unknowns; a richer model whose load varies has them.
constexpr const char* level_point = R"toml([model]
kind = "modal"
[modal]
frequency = [20, 46, 66]
damping_ratio = 0.01
force_sine = [7, 0.5, 0.5]
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
harmonics = 5
)toml";

TEST(ErrorBudget, ARicherModelHasTheHarmonicsOfItsOwnMotions) {
  std::vector<std::string> warnings;
  const auto read = [&](const std::vector<std::string>& overrides) {
    return parse_scene(level_point, "scene.toml", "/nowhere", overrides);
  };
  const SceneDescription scene = read({});
  const SceneDescription tilted =
      read({"modal.points[0].phi_v_1=0.25", "modal.points[0].phi_v_2=0.3"});
  const auto with_evens = [](const SceneDescription& of, const ReducedModel& model) {
    return continuation_options(of, model).orders.empty();
  };
  const auto traced_one = [](const SceneDescription& of, const ReducedModel& model) {
    return trace_curve(model, of, curve_requests(of).at(0), [](const auto&) { return true; });
  };
  const ReducedModel model = model_of(scene, nullptr, warnings);
  RicherModels richer;
  richer.models.push_back({"basis", model_of(tilted, nullptr, warnings)});
  ASSERT_FALSE(with_evens(scene, model));
  ASSERT_TRUE(with_evens(tilted, richer.models[0].model));
  const CurveResult own = traced_one(scene, model);
  const CurveResult truth = traced_one(tilted, richer.models[0].model);
  const solver::ResponsePoint& peak = *highest_peak(truth.curve);
  ASSERT_GT(peak.q.sine(2).norm() + peak.q.mean().norm(), 1e-2 * peak.q.sine(1).norm());
  const CurveBudget told = error_budget(model, scene, richer, own);
  const double change = peak.amplitude / highest_peak(own.curve)->amplitude - 1.0;
  bool found = false;
  for (const ErrorRow& row : told.rows) {
    if (row.source != "basis" || row.goal != std::string(peak_amplitude_goal)) continue;
    found = true;
    std::printf("told %+.6f, true %+.6f\n", row.effect, change);
    EXPECT_NEAR(row.effect, change, 1e-4 * std::abs(change));
  }
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace microslip::pipelines::test_error_budget
