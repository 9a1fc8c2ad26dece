#include "pipelines/accuracy/coarser_mesh.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "pipelines/accuracy/ladders.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "pipelines/system/temporary_folder.hpp"

namespace microslip::pipelines::test_coarser_mesh {
namespace {

/// A blade whose modes are more than those asked for, as many as its harmonics reach.
SceneDescription blade() {
  return read_scene(MICROSLIP_SCENES "/blade_to_ground.toml",
                    {"model.element_size=\"15 mm\"", "modes.count=12", "response.harmonics=auto",
                     "response.harmonic_tolerance=0.005"});
}

// On coarser elements other modes reach as far, and others would be compared.
TEST(CoarserMesh, HasAsManyModesAsTheModel) {
  const SceneDescription scene = blade();
  const TemporaryFolder folder;
  const SolvedStructure structure = solved_structure(scene, folder.path() / "mesh.msh");
  ASSERT_GT(structure.modes.basis.n_free(), 12);
  std::vector<std::string> warnings;
  const ReducedModel model = model_of(scene, &structure, warnings);
  std::string note;
  const auto coarser = coarser_mesh(model, scene, structure, note);
  ASSERT_TRUE(coarser) << note;
  EXPECT_EQ(coarser->model.frequency.size(), model.frequency.size());
  EXPECT_EQ(coarser->model.n_attachment, model.n_attachment);
}

TEST(Ladders, OfModesHaveTheNumberThatTheyTell) {
  for (const Ladder& ladder : ladders(blade())) {
    if (ladder.knob != "modes") continue;
    for (const Rung& rung : ladder.rungs) {
      EXPECT_EQ(rung.value, std::to_string(rung.scene.settings.basis.n_modes));
      EXPECT_EQ(rung.scene.settings.basis.reach, 0.0) << rung.value;
      EXPECT_FALSE(rung.same_basis) << rung.value << ": the scene has more";
    }
    return;
  }
  FAIL() << "a scene of a mesh has modes";
}

}  // namespace
}  // namespace microslip::pipelines::test_coarser_mesh
