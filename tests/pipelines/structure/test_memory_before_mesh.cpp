// What is told before the mesh is made lies below what the mesh tells, and not far below.
#include "pipelines/structure/memory_before_mesh.hpp"

#include <iostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "pipelines/scene/scene_file.hpp"
#include "pipelines/structure/structure_stage.hpp"
#include "pipelines/system/temporary_folder.hpp"

namespace microslip::pipelines::test_memory_before_mesh {
namespace {

struct Geometry {
  const char* name;
  const char* scene;
  std::vector<std::string> overrides;
};

SceneDescription scene_of(const Geometry& geometry) {
  return read_scene(std::string(MICROSLIP_SCENES) + "/" + geometry.scene, geometry.overrides);
}

/// An aerofoil alone, as thin as two elements, as far as a blade can be one.
std::vector<std::string> thin() {
  return {"model.root_thickness=2 mm",   "model.tip_thickness=1.5 mm", "model.root_width=2 mm",
          "model.root_height=5 mm",      "model.platform_height=2 mm", "model.platform_width=14 mm",
          "model.platform_length=60 mm", "model.span=60 mm",           "model.element_size=1.5 mm"};
}

/// Little but its root.
std::vector<std::string> compact() {
  return {"model.root_width=56 mm", "model.root_height=60 mm", "model.root_length=56 mm",
          "model.span=20 mm", "model.element_size=6 mm"};
}

class Geometries : public testing::TestWithParam<Geometry> {};

TEST_P(Geometries, TakeMoreThanIsToldBeforeTheyAreMeshed) {
  const SceneDescription scene = scene_of(GetParam());
  const auto least = memory_before_mesh(scene);
  ASSERT_TRUE(least.has_value());
  const TemporaryFolder folder;
  const mesh::Mesh mesh = obtain_mesh(scene, folder.path() / "mesh.msh");
  const SolverMemory told = solver_memory(mesh, fem::SolverKind::direct);
  const double unknowns = 3.0 * static_cast<double>(mesh.n_nodes());
  std::cout << unknowns << " unknowns, at least " << least->degrees_of_freedom << "; "
            << told.direct_mb << " MB, at least " << least->memory.direct_mb << "; iterative "
            << told.iterative_mb << " MB, at least " << least->memory.iterative_mb << '\n';
  constexpr double not_far = 0.4;
  const auto expect_below = [&](double lower, double value) {
    EXPECT_LT(lower, value);
    EXPECT_GT(lower, not_far * value);
  };
  expect_below(least->degrees_of_freedom, unknowns);
  expect_below(least->memory.direct_mb, told.direct_mb);
  expect_below(least->memory.iterative_mb, told.iterative_mb);
}

INSTANTIATE_TEST_SUITE_P(
    MemoryBeforeMesh, Geometries,
    testing::Values(Geometry{"blade", "blade_to_ground.toml", {"model.element_size=4 mm"}},
                    Geometry{"step", "step_blade.toml", {"model.element_size=4 mm"}},
                    Geometry{"thin", "blade_to_ground.toml", thin()},
                    Geometry{"compact", "blade_to_ground.toml", compact()}),
    [](const auto& one) { return one.param.name; });

TEST(MemoryBeforeMesh, AGivenMeshNeedsNone) {
  EXPECT_FALSE(memory_before_mesh(read_scene(std::string(MICROSLIP_SCENES) + "/plate_mesh.toml")));
}

}  // namespace
}  // namespace microslip::pipelines::test_memory_before_mesh
