// Motions of the patches that a sampled force may leave out (theory 14.2).
#include "pipelines/model/contact_coordinates.hpp"

#include <gtest/gtest.h>

#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/scene/scene_file.hpp"

namespace microslip::pipelines::test_contact_coordinates {
namespace {

// Each mode moves a point of its own. Stiffness times compliance, k φ²/ω² at rest: far above 1 for
// the first, 2.5e-5 for the second, 2.5e-9 for the third.
constexpr const char* text = R"toml([model]
kind = "modal"
[modal]
frequency = [10, 1000, 1000]
damping_ratio = 0.5
force_sine = [1, 0, 0]
output = [1, 0, 0]
points = [
  { weight = 1, tangential_stiffness = 1e5, normal_stiffness = 0, friction_coefficient = 0.4, preload = 1, phi_u_1 = 1, phi_u_2 = 0, phi_u_3 = 0 },
  { weight = 1, tangential_stiffness = 1e3, normal_stiffness = 0, friction_coefficient = 0.4, preload = 1, phi_u_1 = 0, phi_u_2 = 1, phi_u_3 = 0 },
  { weight = 1, tangential_stiffness = 0.1, normal_stiffness = 0, friction_coefficient = 0.4, preload = 1, phi_u_1 = 0, phi_u_2 = 0, phi_u_3 = 1 },
]
[response]
frequency = [8, 12]
)toml";

TEST(ContactCoordinates, KeepMotionsDownToAMillionthOfTheStiffness) {
  // What is left out is missing in the balance of its mode, and the residual told does not know.
  const SceneDescription scene = parse_scene(text, "scene.toml", "/nowhere", {});
  ReducedModel model = reduced_model(scene);
  model.effects = contact_effects(model, scene);
  const contact::MotionCoordinates kept = contact_coordinates(model, scene);
  ASSERT_FALSE(kept.all_modes());
  EXPECT_EQ(kept.of_modes.rows(), 2);
  EXPECT_GT(kept.of_modes.col(1).norm(), 0.0);
  EXPECT_LT(kept.of_modes.col(2).norm(), 1e-6 * kept.of_modes.col(1).norm());
}

}  // namespace
}  // namespace microslip::pipelines::test_contact_coordinates
