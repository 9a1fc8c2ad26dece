// Static contact of a tetrahedral bar against CalculiX, an independent code, on the same nodes and
// elements.
//
// A bar clamped at one end lies with a whole side on a layer of springs that cannot pull. Bent onto
// it at its far end it lifts off behind, as a beam on an elastic foundation does; turned about an
// axis beside it, it is pressed all along.
// CalculiX integrates the pressure at points of its own (TYPE=SURFACE TO SURFACE), microslip at the
// middle of the cells of the face. With 25 cells per triangle displacements agree to 2e-3 of the
// largest and forces to 1.4e-4, with the 350 here to 1.4e-4 and 7e-5. Without friction, small
// displacements; straight tet10, whose stiffness both integrate exactly.
//
// CalculiX is run before PETSc is opened: nothing is started as a child once MPI is up.
#include <cstdio>

#include <gtest/gtest.h>

#include "fem/slepc_session.hpp"
#include "fem/surface_load.hpp"
#include "mesh/surface.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/calculix.hpp"

namespace microslip::pipelines::static_contact {
namespace {

constexpr double tolerance = 3e-4;
constexpr double stiffness = 1e12;

constexpr const char* text = R"([model]
kind = "mesh"
file = "bar.msh"
[material]
youngs_modulus = 2e11
poissons_ratio = 0.3
density = 8000
[supports]
clamped = ["z0"]
[modes]
count = 1
residual = "none"
[static]
forces = [ { at = "z1", direction = [1, 0, 0], amplitude = "1 kN" } ]
speed = 0
axis = { origin = [-0.5, 0, 0], direction = [0, 1, 0] }
[contact]
surface = "x1"
slip_direction = [0, 1, 0]
friction_coefficient = 0.4
normal_stiffness = 1e12
tangential_stiffness = 1e12
points = 20000
preload = "static"
)";

struct Case {
  const char* name;
  SceneDescription scene;
  bool opens;
  test::CalculixContact calculix{};
};

void compare(const Case& one, const mesh::Mesh& mesh) {
  const SolvedStructure solved{mesh, solve_structure(mesh, one.scene)};
  std::vector<std::string> warnings;
  const ReducedModel model = model_of(one.scene, &solved, warnings);
  const double force = *model.static_preload;
  const Eigen::VectorXd approach = force / stiffness * model.patches[0].vertices.preload_field;
  const mesh::SurfaceSampling sampling =
      mesh::sample_surface(mesh.nodes(), mesh.surface("x1"), contact_points(one.scene.settings, 0));
  const Eigen::VectorXd v = sampling.to_vertices * one.calculix.displacement.col(0);
  const double off = (approach - v).cwiseAbs().maxCoeff() / v.maxCoeff();
  std::printf(
      "%-7s CalculiX %11.5f N, here %11.5f N (%+.1e); displacements %.2e to %.2e m, off by %.1e\n",
      one.name, one.calculix.force, force, force / one.calculix.force - 1.0, v.minCoeff(),
      v.maxCoeff(), off);
  EXPECT_NEAR(force, one.calculix.force, tolerance * one.calculix.force) << one.name;
  EXPECT_LT(off, tolerance) << one.name;
  EXPECT_EQ(v.minCoeff() < -1e-3 * v.maxCoeff(), one.opens) << one.name;
}

TEST(StaticContact, IsThatOfCalculiX) {
  if (!test::has_calculix()) GTEST_SKIP() << "ccx is not on PATH (apt: calculix-ccx)";
  const mesh::Mesh mesh = test::box_mesh(
      mesh::ElementType::tet10, {.size = {0.01, 0.02, 0.06}, .cells = {2, 3, 10}, .map = {}});
  std::vector<Case> cases;
  cases.push_back({"bent", parse_scene(text, "bar.toml", "/", {}), true});
  cases.push_back({"turned",
                   parse_scene(text, "bar.toml", "/", {"static.forces=[]", "static.speed=50"}),
                   false});
  for (Case& one : cases) {
    Eigen::VectorXd load = Eigen::VectorXd::Zero(3 * mesh.n_nodes());
    if (!one.scene.static_loads.forces.empty()) {
      load = 1000.0 / (0.01 * 0.02) *
             fem::uniform_tractions(mesh.nodes(), mesh.surface("z1"), mesh::FaceFrame{}).col(0);
    }
    one.calculix = test::calculix_contact(mesh, one.scene.material, one.scene.clamped,
                                          {"x1", stiffness, load, *one.scene.rotation});
  }
  const fem::SlepcSession session;
  for (const Case& one : cases) compare(one, mesh);
}

}  // namespace
}  // namespace microslip::pipelines::static_contact
