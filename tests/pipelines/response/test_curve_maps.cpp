#include "pipelines/response/curve_maps.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "contact/phase.hpp"
#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/scene/scene_file.hpp"

namespace microslip::pipelines::test_curve_maps {
namespace {

constexpr const char* slider = R"toml([model]
kind = "modal"
[modal]
frequency = [20]
damping_ratio = 0.01
force_sine = [1]
output = [1]
[[modal.points]]
weight = 1
tangential_stiffness = 1e4
normal_stiffness = 5e4
friction_coefficient = 0.3
preload = 1
phi_u_1 = 1
[response]
frequency = [15, 25]
method = "time"
points = 2
maps = [15, 20.5, 25]
map_phases = 4
)toml";

/// Two motions that no balance of one harmonic has.
CurveResult integrated() {
  CurveResult result;
  result.name = "scale_1";
  result.load = 1.0;
  result.integrated = true;
  for (const double frequency : {15.0, 25.0}) {
    solver::ResponsePoint& point = result.curve.points.emplace_back();
    point.frequency = contact::two_pi * frequency;
    point.q = contact::Harmonics(3, 1);
    point.q.rows()(1, 0) = 1e-3;
    point.q.rows()(6, 0) = 1e-4 * frequency;
    point.amplitude = 1e-4 * frequency;
  }
  return result;
}

// Its own motions are drawn; at another frequency there is none, and the message says what to do.
TEST(CurveMaps, OfMotionsIntegratedInTimeAreTheirs) {
  const SceneDescription scene = parse_scene(slider, "scene.toml", "/nowhere", {});
  ReducedModel model = reduced_model(scene);
  model.effects = contact_effects(model, scene);
  const CurveMaps drawn = curve_maps(model, scene, integrated());
  ASSERT_EQ(drawn.maps.size(), 2U);
  EXPECT_EQ(drawn.maps[0].name, "scale_1_15Hz_1");
  EXPECT_EQ(drawn.maps[1].name, "scale_1_25Hz_1");
  EXPECT_DOUBLE_EQ(drawn.maps[0].amplitude, 1.5e-3);
  EXPECT_NEAR(drawn.maps[1].points.relative_displacement(0, 0), 2.5e-3, 1e-15)
      << "with its harmonics";
  ASSERT_EQ(drawn.missing.size(), 1U);
  EXPECT_NE(drawn.missing[0].find("no map at 20.5 Hz, where no motion was integrated"),
            std::string::npos)
      << drawn.missing[0];
}

}  // namespace
}  // namespace microslip::pipelines::test_curve_maps
