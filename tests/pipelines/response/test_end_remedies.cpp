// Whatever ends a curve, or a search for a best value, has a remedy that the program knows.
#include "pipelines/description/curve_request.hpp"
#include "pipelines/response/end_remedies.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/response/curve_maps.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "pipelines/text/scene_keys.hpp"

namespace microslip::pipelines::test_end_remedies {
namespace {

using Method = ResponseDescription::Method;

/// Words of a text that look like keys of a scene, or like options.
std::vector<std::string> things_to_set(std::string_view text) {
  static const std::regex thing(R"(--[a-z-]+|\b[a-z]+\.[a-z_]+\b)");
  const std::string words(text);
  return {std::sregex_token_iterator(words.begin(), words.end(), thing), {}};
}

bool is_known(const std::string& thing) {
  if (thing == "--resume" || thing == "--budget") return true;
  const std::size_t dot = thing.find('.');
  if (dot == std::string::npos) return false;
  const auto keys = section_spec(thing.substr(0, dot)).keys;
  return std::ranges::find(keys, std::string_view(thing).substr(dot + 1), &KeySpec::name) !=
         keys.end();
}

void expect_remedy(std::string_view text, const std::string& of) {
  const std::vector<std::string> things = things_to_set(text);
  EXPECT_FALSE(things.empty()) << of << ": " << text;
  for (const std::string& thing : things) EXPECT_TRUE(is_known(thing)) << of << ": " << thing;
}

// Row 85. Hard: a name of a diagnosis helps nobody who does not know the solver.
// Met in: incomplete curves of the campaigns.
// Right: every end names a key to set.
TEST(EndRemedies, EveryEndOfACurveNamesWhatToSet) {
  for (const Method method : {Method::harmonic_balance, Method::time}) {
    EXPECT_TRUE(remedy_of(solver::Diagnosis::none, method).empty());
    for (const auto& end : solver::names::diagnoses) {
      if (end.value != solver::Diagnosis::none)
        expect_remedy(remedy_of(end.value, method), end.text);
    }
  }
}

TEST(EndRemedies, EveryEndOfASearchNamesWhatToSet) {
  EXPECT_TRUE(remedy_of(solver::NotFound::none).empty());
  const auto count = static_cast<int>(solver::NotFound::count);
  for (int i = 1; i < count; ++i) {
    expect_remedy(remedy_of(static_cast<solver::NotFound>(i)), std::to_string(i));
  }
}

constexpr const char* undamped = R"toml([model]
kind = "chain"
masses = [1]
springs = [4e4]
[modes]
damping_ratio = 0
[contact]
points = [ { slip = "m1", tangential_stiffness = 1e4, friction_coefficient = 0.5 } ]
[excitation]
forces = [ { at = "m1", amplitude = 10 } ]
[response]
output = "m1"
frequency = [20, 60]
preload = [ "free", 1 ]
)toml";

struct Problem {
  SceneDescription scene;
  ReducedModel model;
};

Problem problem_of(const std::vector<std::string>& overrides) {
  Problem problem{parse_scene(undamped, "scene.toml", "/nowhere", overrides), {}};
  problem.model = reduced_model(problem.scene);
  problem.model.effects = contact_effects(problem.model, problem.scene);
  return problem;
}

CurveResult curve_of(std::size_t which, const Problem& problem) {
  const CurveRequest request = curve_requests(problem.scene).at(which);
  return trace_curve(problem.model, problem.scene, request, [](const auto&) { return true; });
}

TEST(EndRemedies, AMessageOfACurveEndsWithThatOfItsEnd) {
  for (const std::size_t which : {0U, 1U}) {
    const solver::ResponseCurve curve = curve_of(which, problem_of({})).curve;
    EXPECT_EQ(curve.diagnosis, solver::Diagnosis::unbounded);
    EXPECT_TRUE(curve.message.ends_with(remedy_of(curve.diagnosis, Method::harmonic_balance)))
        << curve.message;
  }
  const solver::ResponseCurve cut = curve_of(1, problem_of({"response.time_budget=1e-9 s"})).curve;
  EXPECT_EQ(cut.diagnosis, solver::Diagnosis::budget);
  EXPECT_TRUE(cut.message.ends_with(remedy_of_time())) << cut.message;
}

TEST(EndRemedies, ACompleteCurveHasNone) {
  const solver::ResponseCurve curve = curve_of(0, problem_of({"modes.damping_ratio=0.01"})).curve;
  EXPECT_TRUE(curve.complete);
  EXPECT_EQ(curve.message, "");
}

TEST(EndRemedies, AMapThatThereIsNotIsTold) {
  const Problem problem =
      problem_of({"modes.damping_ratio=0.01", "response.maps=[30, 70]", "response.harmonics=1"});
  const CurveMaps drawn = curve_maps(problem.model, problem.scene, curve_of(1, problem));
  EXPECT_EQ(drawn.maps.size(), 1U);  // at 30 Hz
  ASSERT_EQ(drawn.missing.size(), 1U);
  EXPECT_NE(drawn.missing[0].find("no map at 70 Hz"), std::string::npos) << drawn.missing[0];
  expect_remedy(drawn.missing[0], "map");
}

}  // namespace
}  // namespace microslip::pipelines::test_end_remedies
