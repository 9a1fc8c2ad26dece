// A curve whose forces no number of instants gives as closely as asked for reaches its end, and
// tells what they err by; one that their errors turn more often than it turns is traced again with
// located events.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "contact/contact_force.hpp"
#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/response/solver_scenes.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "solver/sampled_walk.hpp"
#include "tests/support/floating_point_traps.hpp"

namespace microslip::pipelines::test_sampled_curve {
namespace {

// Lanes compute what they then do not take.
[[maybe_unused]] const tests::UntrappedFile this_file(__FILE__);

/// Two modes; 48 points that move along both directions of a face, all differently.
std::string scene_in_a_plane() {
  std::string points;
  for (int i = 0; i < 48; ++i) {
    points += fmt::format(
        "{{ weight = 1.0, tangential_stiffness = 500.0, normal_stiffness = 0.0, "
        "friction_coefficient = 0.3, preload = 2, phi_u_1 = {}, phi_u_2 = {}, phi_w_1 = {}, "
        "phi_w_2 = {} }},\n",
        0.4 + 0.02 * i, std::cos(0.1 * i), std::sin(0.2 * i), 0.5 * std::sin(0.1 * i),
        0.3 * std::cos(0.3 * i));
  }
  return fmt::format(R"toml([model]
kind = "modal"
[modal]
frequency = [50, 80]
damping_ratio = 0.01
force_sine = [20, 5]
force_cosine = [0, 3]
output = [1, 1]
points = [
{}]
[response]
frequency = [45, 60]
harmonics = 3
)toml",
                     points);
}

const std::string by_speed =
    "[contact]\nfriction_law = { law = \"hyperbolic\", static = 0.3, rate = 10.0 }\n";

/// Two modes; n points that strike, of the area of twelve.
/// @param normal  how far they move along the normal, [1/√kg].
/// @param law     of their friction; empty: it is constant.
/// @param range   of frequencies [Hz].
std::string striking_scene(int n, double normal, const std::string& law, const std::string& range) {
  std::string points;
  for (int i = 0; i < n; ++i) {
    const double at = 12.0 * i / n;
    points += fmt::format(
        "{{ weight = {}, tangential_stiffness = 4e5, normal_stiffness = 1e6, "
        "friction_coefficient = 0.3, preload = 2, phi_u_1 = {}, phi_v_1 = {}, phi_u_2 = {}, "
        "phi_v_2 = {} }},\n",
        12.0 / n, 0.3 * (0.5 + 0.05 * at), normal * (0.3 + 0.06 * at), 0.3 * std::cos(0.2 * at),
        normal * std::sin(0.25 * at));
  }
  return fmt::format(R"toml([model]
kind = "modal"
[modal]
frequency = [100, 260]
damping_ratio = 0.001
force_sine = [20, 5]
force_cosine = [0, 0]
output = [1, 0.5]
points = [
{}]
{}[response]
frequency = [{}]
harmonics = 3
)toml",
                     points, law, range);
}

CurveResult curve_of(const ReducedModel& model, const SceneDescription& scene) {
  return trace_curve(model, scene, curve_requests(scene).front(), [](const auto&) { return true; });
}

std::vector<double> folds_of(const solver::ResponseCurve& curve) {
  std::vector<double> folds;
  for (const solver::ResponsePoint& point : curve.points) {
    if (point.mark == solver::PointMark::fold) folds.push_back(point.frequency);
  }
  return folds;
}

bool is_located(const solver::ResponseCurve& curve) {
  return std::ranges::find(curve.log, solver::Remedy::located_events,
                           &solver::SolverEvent::remedy) != curve.log.end();
}

TEST(SampledCurve, FoldsThatErrorsOfForcesMakeAreNone) {
  const SceneDescription scene =
      parse_scene(striking_scene(12, 0.3, by_speed, "61, 64"), "scene.toml", "/nowhere", {});
  ReducedModel model = reduced_model(scene);
  model.effects = contact_effects(model, scene);
  ASSERT_TRUE(contact::is_sampled(model.patches, model.effects));
  // As sampled forces have it: six folds, two of which located events know.
  const solver::ResponseCurve sampled =
      solver::trace_response(balanced_scene(model, 1.0, continuation_options(scene, model)),
                             continuation_options(scene, model));
  EXPECT_GT(folds_of(sampled).size(), 2);

  const CurveResult result = curve_of(model, scene);
  EXPECT_TRUE(result.curve.complete) << result.curve.message;
  EXPECT_TRUE(is_located(result.curve));
  model.effects.located = true;
  EXPECT_EQ(folds_of(result.curve), folds_of(curve_of(model, scene).curve));
  EXPECT_EQ(folds_of(result.curve).size(), 2);
}

TEST(SampledCurve, FoldsThatErrorsMakeOfFrictionByTheRateAreNoneWherePointsAreMore) {
  const SceneDescription scene =
      parse_scene(striking_scene(40, 0.3, by_speed, "61, 64"), "scene.toml", "/nowhere", {});
  ReducedModel model = reduced_model(scene);
  model.effects = contact_effects(model, scene);
  const CurveResult result = curve_of(model, scene);
  EXPECT_TRUE(is_located(result.curve));
  EXPECT_EQ(folds_of(result.curve).size(), 2);
}

// As those of a blade are true, and cost six times as much with located events.
TEST(SampledCurve, CloseFoldsOfManyPointsWithConstantFrictionStay) {
  const SceneDescription scene =
      parse_scene(striking_scene(48, 1.0, "", "149, 160"), "scene.toml", "/nowhere", {});
  ReducedModel model = reduced_model(scene);
  model.effects = contact_effects(model, scene);
  ASSERT_TRUE(contact::is_sampled(model.patches, model.effects));
  const CurveResult result = curve_of(model, scene);
  EXPECT_TRUE(result.curve.complete) << result.curve.message;
  EXPECT_FALSE(is_located(result.curve));
  EXPECT_TRUE(solver::is_led_by_errors(result.curve.points));  // by which few would be
}

TEST(SampledCurve, ReachesItsEndWithMostInstants) {
  const SceneDescription scene =
      parse_scene(scene_in_a_plane(), "scene.toml", "/nowhere", {"response.harmonics=3"});
  ReducedModel model = reduced_model(scene);
  model.effects = contact_effects(model, scene);
  ASSERT_TRUE(contact::is_sampled(model.patches, model.effects));
  model.effects.force_tolerance = 1e-9;
  EXPECT_EQ(contact::instants_of(model.patches, model.effects), contact::most_instants);
  const CurveResult result = curve_of(model, scene);
  EXPECT_TRUE(result.curve.complete) << result.curve.message;
  EXPECT_NE(result.curve.message.find("contact forces sampled 2048 times a period err by some"),
            std::string::npos)
      << result.curve.message;
}

}  // namespace
}  // namespace microslip::pipelines::test_sampled_curve
