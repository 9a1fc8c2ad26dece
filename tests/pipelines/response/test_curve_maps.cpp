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

/// Two motions that no balance of one harmonic has.
CurveResult integrated() {
  CurveResult result;
  result.name = "preload_1";
  result.load = 1.0;
  result.integrated = true;
  for (const double frequency : {0.25, 0.75}) {
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
  const SceneDescription scene =
      read_scene(MICROSLIP_SCENES "/oscillator_1dof.toml",
                 {"response.frequency=[0.25, 0.75]", "response.points=2",
                  "response.maps=[0.25, 0.5, 0.75, \"folds\"]", "response.map_phases=4"});
  ReducedModel model = reduced_model(scene);
  model.effects = contact_effects(model, scene);
  const CurveMaps drawn = curve_maps(model, scene, integrated());
  ASSERT_EQ(drawn.maps.size(), 2U);
  EXPECT_EQ(drawn.maps[0].name, "preload_1_0.25Hz_1");
  EXPECT_EQ(drawn.maps[1].name, "preload_1_0.75Hz_1");
  EXPECT_DOUBLE_EQ(drawn.maps[0].amplitude, 2.5e-5);
  const double shape = model.patches[0].cells.shapes.u(0, 0);
  EXPECT_NEAR(drawn.maps[1].points.relative_displacement(0, 0), 7.5e-5 * shape, 1e-12 * shape)
      << "with its harmonics";
  ASSERT_EQ(drawn.missing.size(), 2U);
  EXPECT_NE(drawn.missing[0].find("no map at 0.5 Hz, where no motion was integrated"),
            std::string::npos)
      << drawn.missing[0];
  EXPECT_NE(drawn.missing[1].find("no map at folds"), std::string::npos) << drawn.missing[1];
}

}  // namespace
}  // namespace microslip::pipelines::test_curve_maps
