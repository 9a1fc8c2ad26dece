// A curve whose forces no number of instants gives as closely as asked for reaches its end, and
// tells what they err by.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "contact/contact_force.hpp"
#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/scene/scene_file.hpp"
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
        "friction_coefficient = 0.3, preload = {}, phi_u_1 = {}, phi_u_2 = {}, phi_w_1 = {}, "
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

TEST(SampledCurve, ReachesItsEndWithMostInstants) {
  const SceneDescription scene =
      parse_scene(scene_in_a_plane(), "scene.toml", "/nowhere", {"response.harmonics=3"});
  ReducedModel model = reduced_model(scene);
  model.effects = contact_effects(model, scene);
  ASSERT_TRUE(contact::is_sampled(model.patches, model.effects));
  model.effects.force_tolerance = 1e-9;
  EXPECT_EQ(contact::instants_of(model.patches, model.effects), contact::most_instants);
  const CurveResult result =
      trace_curve(model, scene, curve_requests(scene).front(), [](const auto&) { return true; });
  EXPECT_TRUE(result.curve.complete) << result.curve.message;
  EXPECT_NE(result.curve.message.find("contact forces sampled 2048 times a period err by some"),
            std::string::npos)
      << result.curve.message;
}

}  // namespace
}  // namespace microslip::pipelines::test_sampled_curve
