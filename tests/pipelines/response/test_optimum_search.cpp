// The search for a best value of a scene, and what it varies in the contact.
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/optimum_stage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "pipelines/model/contact_factors.hpp"
#include "pipelines/scene/scene_file.hpp"

namespace microslip::pipelines::test_optimum_search {
namespace {

using Overrides = std::vector<std::string>;

constexpr const char* bar_text = R"toml([model]
kind = "bar"
youngs_modulus = "200 GPa"
area = "1e-4 m^2"
density = 7800
length = "1 m"
end_stiffness = "80 kN/mm"
[modes]
count = 2
damping_ratio = "0.5 %"
residual = "stiffness"
[contact]
tangential_stiffness = "1e7 N/m^2"
friction_coefficient = 0.3
load = "2000 N/m"
points = 8
[excitation]
force = "0.2 kN"
[response]
frequency = ["900 Hz", "2200 Hz"]
harmonics = 1
optimum = "preload"
optimum_range = [0.01, 10]
)toml";

/// The first point rubs; the second is a stop behind a gap of 2e-4 m.
constexpr const char* stop_text = R"toml([model]
kind = "modal"
[modal]
frequency = [20.0]
damping_ratio = [0.01]
force_sine = [1.0]
output = [1.0]
points = [
  { weight = 1, tangential_stiffness = 5000, normal_stiffness = 5000, friction_coefficient = 0.4, preload = 2, phi_u_1 = 0.8, phi_v_1 = 0.3 },
  { weight = 1, tangential_stiffness = 0, normal_stiffness = 2000, friction_coefficient = 0, preload = -0.4, phi_u_1 = 0, phi_v_1 = 1 },
]
[response]
frequency = [15, 30]
)toml";

/// Two points that rub under loads far apart: the peak has two minima over the factor of the loads.
/// @param modes  frequency, damping_ratio, force_sine, output.
std::string two_valleys(const std::string& modes, const std::string& points,
                        const std::string& response) {
  return "[model]\nkind = \"modal\"\n[modal]\n" + modes + "points = [" + points +
         "]\n[response]\noptimum = \"preload\"\n" + response;
}

const char* const far_apart = R"toml(frequency = [50.0, 192.31, 649.2]
damping_ratio = 0.002
force_sine = [1.0, 0.24978, 0.11033]
output = [1.0, 0.15389, -0.11546]
)toml";
const char* const far_apart_points = R"toml(
{ weight = 1, tangential_stiffness = 142070, normal_stiffness = 0, friction_coefficient = 0.3, preload = 1, phi_u_1 = 0.65385, phi_u_2 = 0.10026, phi_u_3 = -0.30689 },
{ weight = 1, tangential_stiffness = 119980, normal_stiffness = 0, friction_coefficient = 0.3, preload = 45.023, phi_u_1 = 0.74858, phi_u_2 = -0.75156, phi_u_3 = 0.50394 },
)toml";

const char* const near_by = R"toml(frequency = [50.0, 273]
damping_ratio = [0.002, 0.0003]
force_sine = [1.0, 0.1]
output = [1.0, 1]
)toml";
const char* const near_by_points = R"toml(
{ weight = 1, tangential_stiffness = 55764, normal_stiffness = 81775, friction_coefficient = 0.3, preload = 1, phi_u_1 = 0.81882, phi_u_2 = 0.5, phi_v_1 = -0.10644, phi_v_2 = -0.1 },
{ weight = 1, tangential_stiffness = 71880, normal_stiffness = 0, friction_coefficient = 0.3, preload = 30.385, phi_u_1 = 0.6922, phi_u_2 = 0.5 },
)toml";

/// A peak that jumps beside the minimum of the others.
const char* const jump_text = R"toml([model]
kind = "modal"
[modal]
frequency = [50.0, 152.5]
damping_ratio = 0.002
force_sine = [1.0, -0.413]
output = [1.0, 0.3]
points = [
  { weight = 1, tangential_stiffness = 177700, normal_stiffness = 265580, friction_coefficient = 0.4, preload = 1, phi_u_1 = 0.61987, phi_u_2 = -0.10105, phi_v_1 = -0.48821, phi_v_2 = 0.015184 },
]
[response]
frequency = [40.0, 84.011]
harmonics = 1
optimum = "preload"
optimum_range = [0.02, 40]
)toml";

struct Found {
  solver::Optimum best;
  OptimumBracket bracket;
};

ReducedModel model_alone(const SceneDescription& scene) {
  std::vector<std::string> warnings;
  return model_of(scene, nullptr, warnings);
}

Found search(const SceneDescription& scene, bool with_bracket = true, int jobs = 2) {
  const ReducedModel model = model_alone(scene);
  OptimumSearch search(model, scene, nullptr, jobs);
  solver::Optimum best = search.best();
  if (std::string text = search.left_out(best); !text.empty()) best.warnings.push_back(text);
  OptimumBracket bracket;
  if (with_bracket) {
    bracket = search.bracket(jobs);
    search.complete(bracket);
  }
  return {std::move(best), std::move(bracket)};
}

const solver::Optimum& entry(const Found& found, const std::string& parameter, double factor) {
  for (const OptimumOfFactor& one : found.bracket.entries) {
    if (one.parameter == parameter && one.factor == factor) return one.optimum;
  }
  throw std::out_of_range(parameter);
}

void expect_same(const solver::Optimum& a, const solver::Optimum& b) {
  EXPECT_TRUE(a.found) << a.message;
  EXPECT_TRUE(b.found) << b.message;
  // Equations that differ by rounding, searched to 1e-4 of the parameter.
  EXPECT_NEAR(a.best.parameter, b.best.parameter, 2e-4 * b.best.parameter);
  EXPECT_NEAR(a.best.amplitude, b.best.amplitude, 1e-6 * b.best.amplitude);
}

TEST(OptimumSearch, VariesTheLocalStiffnessAndNotTheResidualFlexibility) {
  const Found found = search(parse_scene(bar_text, "bar", ".", {}));
  for (const double factor : {0.5, 2.0}) {
    const std::string key = "contact.tangential_stiffness=" + std::to_string(1e7 * factor);
    const Found scaled = search(parse_scene(bar_text, "bar", ".", {key}), false);
    expect_same(entry(found, "contact_stiffness", factor), scaled.best);
  }
}

TEST(OptimumSearch, IsTheSameToTheLastBitSideBySide) {
  const SceneDescription scene = parse_scene(bar_text, "bar", ".", {});
  const Found one = search(scene, true, 1);
  const Found three = search(scene, true, 3);
  EXPECT_EQ(one.best.message, three.best.message);
  EXPECT_EQ(one.bracket.left_out, three.bracket.left_out);
  ASSERT_EQ(one.bracket.entries.size(), 4U);
  ASSERT_EQ(three.bracket.entries.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const OptimumOfFactor& a = one.bracket.entries[i];
    const OptimumOfFactor& b = three.bracket.entries[i];
    EXPECT_EQ(a.parameter, b.parameter);
    EXPECT_EQ(a.factor, b.factor);
    EXPECT_EQ(a.optimum.best.parameter, b.optimum.best.parameter);
    EXPECT_EQ(a.optimum.best.amplitude, b.optimum.best.amplitude);
  }
}

TEST(OptimumSearch, WidensTheRangeByTheFactorOfFriction) {
  // Under a constant load only μ n counts: the best preload is that of the scene divided by the
  // factor.
  const Found found =
      search(parse_scene(bar_text, "bar", ".", {"response.optimum_range=[0.4, 1]"}));
  for (const double factor : {0.5, 2.0}) {
    const solver::Optimum& other = entry(found, "friction_coefficient", factor);
    ASSERT_TRUE(other.found) << other.message;
    // Both searches end within 1e-4 of their minimum.
    EXPECT_NEAR(factor * other.best.parameter, found.best.best.parameter,
                2e-4 * found.best.best.parameter);
    EXPECT_LE(other.trace.front().parameter, 0.4 / std::max(1.0, factor) * (1.0 + 1e-9));
    EXPECT_GE(other.trace.back().parameter, 1.0 / std::min(1.0, factor) * (1.0 - 1e-9));
  }
  for (const OptimumOfFactor& one : found.bracket.entries) {  // and it is told
    const bool friction = one.parameter == "friction_coefficient";
    EXPECT_EQ(one.widened, friction) << one.parameter;
    EXPECT_EQ(one.range[0], 0.4 / (friction ? std::max(1.0, one.factor) : 1.0));
    EXPECT_EQ(one.range[1], 1.0 / (friction ? std::min(1.0, one.factor) : 1.0));
  }
}

TEST(OptimumSearch, KeepsGapsUnderAnotherStiffness) {
  const Overrides preload{"response.optimum=preload", "response.optimum_range=[0.2, 8]"};
  const Found found = search(parse_scene(stop_text, "stop", ".", preload));
  std::string doubled = stop_text;
  const auto replace = [&](const std::string& from, const std::string& to) {
    for (auto at = doubled.find(from); at != doubled.npos;
         at = doubled.find(from, at + to.size())) {
      doubled.replace(at, from.size(), to);
    }
  };
  replace("= 5000", "= 10000");
  replace("= 2000", "= 4000");
  replace("= -0.4", "= -0.8");
  const Found scaled = search(parse_scene(doubled, "stop", ".", preload), false);
  expect_same(entry(found, "contact_stiffness", 2.0), scaled.best);
}

TEST(OptimumSearch, GapsKeepTheirWidthBesideResidualFlexibility) {
  ReducedModel model;
  contact::PatchSamples& cells = model.patches.emplace_back().cells;
  cells.stiffness = Eigen::MatrixX3d::Constant(2, 3, 1e4);
  cells.compliance = Eigen::MatrixX3d::Constant(2, 3, 5e-5);
  cells.preload_field = Eigen::Vector2d(-3.0, 20.0);
  const ReducedModel stiffer = with_point_stiffness(model, 2.0, 1.0);
  const contact::PatchSamples& found = stiffer.patches[0].cells;
  EXPECT_NEAR(found.preload_field[0] / found.stiffness(0, 1), -3e-4, 1e-15);
  EXPECT_EQ(found.preload_field[1], 20.0);  // presses: a force
}

TEST(OptimumSearch, DoesNotVaryWhatTheContactDoesNotHave) {
  SceneDescription scene = parse_scene(bar_text, "bar", ".", {});
  ReducedModel model = model_alone(scene);
  EXPECT_EQ(no_stiffness_factor(model, scene), "");
  EXPECT_EQ(no_friction_factor(model), "");
  scene.contacts.emplace_back();  // both local stiffnesses "rigid"
  EXPECT_EQ(stiffness_place(scene), StiffnessPlace::none);
  EXPECT_NE(no_stiffness_factor(model, scene).find("rigid"), std::string::npos);
  scene.contacts[0].normal_stiffness = 1e11;
  EXPECT_EQ(stiffness_place(scene), StiffnessPlace::keys);
  const SceneDescription halved = with_stiffness_keys(scene, 0.5);
  EXPECT_EQ(halved.contacts[0].normal_stiffness, 5e10);
  EXPECT_FALSE(halved.contacts[0].tangential_stiffness.has_value());
  model.patches.clear();
  EXPECT_NE(no_friction_factor(model).find("no contact"), std::string::npos);
}

TEST(OptimumSearch, SaysWhichNumberIsNotVariedBecauseItIsSearched) {
  const Found found =
      search(parse_scene(bar_text, "bar", ".",
                         {"response.optimum=contact.friction_coefficient",
                          "response.optimum_range=[0.1, 0.6]", "response.preload_scale=[1]"}));
  ASSERT_EQ(found.bracket.left_out.size(), 1U);
  EXPECT_NE(
      found.bracket.left_out[0].find("contact.friction_coefficient is the number that is searched"),
      std::string::npos)
      << found.bracket.left_out[0];
  EXPECT_EQ(found.bracket.entries.size(), 2U);  // those of the stiffness
}

TEST(OptimumSearch, SaysThatItDoesNotIntegrateInTime) {
  const Overrides settings{"response.method=time", "response.optimum_range=[0.5, 4]",
                           "response.optimum=preload"};
  const SceneDescription scene = parse_scene(stop_text, "stop", ".", settings);
  const ReducedModel model = model_alone(scene);
  OptimumSearch in_time(model, scene, nullptr, 1);
  EXPECT_NE(in_time.warning().find("harmonic balance"), std::string::npos);
  ASSERT_FALSE(in_time.best().notes.empty());
  EXPECT_EQ(in_time.best().notes.front(), in_time.warning());
  const SceneDescription plain = parse_scene(bar_text, "bar", ".", {});
  const ReducedModel other = model_alone(plain);
  EXPECT_EQ(OptimumSearch(other, plain, nullptr, 1).warning(), "");
}

solver::Optimum best_of(const std::string& text, const Overrides& overrides = {}) {
  return search(parse_scene(text, "scene.toml", "/nowhere", overrides), false).best;
}

// The values of a scan over five decades lie far from the bottom of the deeper valley.
TEST(OptimumSearch, FindsTheDeeperOfTwoValleysOverManyDecades) {
  const solver::Optimum best =
      best_of(two_valleys(far_apart, far_apart_points,
                          "frequency = [35, 908.89]\nharmonics = 1\noptimum_range = [0.00044421, "
                          "60]\n"));
  ASSERT_TRUE(best.found) << best.message;
  EXPECT_NEAR(best.best.parameter, 0.148, 0.01);
  EXPECT_LT(best.best.amplitude, 4.69e-5);  // the other valley: 5.04e-5 at 7.8
}

// With three harmonics the other one is lower.
TEST(OptimumSearch, AsksEveryValleyForTheHarmonicsThatItNeeds) {
  const solver::Optimum best =
      best_of(two_valleys(near_by, near_by_points,
                          "frequency = [40, 72.294]\nharmonics = 5\noptimum_range = [0.01, 60]\n"),
              {"accuracy.tolerance=off"});
  ASSERT_TRUE(best.found) << best.message;
  EXPECT_NEAR(best.best.parameter, 6.2, 0.1);
  EXPECT_LT(best.best.amplitude, 8.12e-5);  // the other valley: 8.2e-5 at 0.195
  EXPECT_NE(best.message.find("another minimum of nearly the same height near 0.19"),
            std::string::npos)
      << best.message;
}

// What is followed past the jump is lower than all, and not the highest peak of its curve.
TEST(OptimumSearch, DoesNotTakeAPeakForTheHighestWhereThatWasLost) {
  const solver::Optimum best = best_of(jump_text);
  ASSERT_TRUE(best.found) << best.message;
  EXPECT_NEAR(best.best.parameter, 10.87, 0.02);
  EXPECT_NEAR(best.best.amplitude, 5.741e-5, 1e-8);
}

}  // namespace
}  // namespace microslip::pipelines::test_optimum_search
