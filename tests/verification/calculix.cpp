// Natural frequencies against CalculiX, an independent code, on the same nodes and elements.
//
// With the same quadrature (four points for K and M of tet10) the matrices agree but for rounding
// and the precision of the deck, 12 digits of a coordinate; what is left is the seventh digit
// CalculiX prints: 1e-6. The mass of hex20 is integrated with 27 points there and exactly here,
// which shows in the sixth digit on distorted elements: 1e-5. Wedges have 9 points there and 18
// here, which on this mesh, one element thick, is 2e-3 of the tenth frequency: 3e-3. The blade is
// the default geometry as it is exported, of curved tet10. Its modes are usually computed with the
// accurate rule, which is a little stiffer on curved elements: that difference is printed and
// bounded too; it falls with the elements.
//
// The rotating plates have the static equilibrium and its tangent in them: large displacements,
// stresses, spin softening. The load of CalculiX follows the displacement, as ours does.
//
// CalculiX is run before PETSc is opened: nothing is started as a child once MPI is up.
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "fem/modal_analysis.hpp"
#include "fem/slepc_session.hpp"
#include "mesh/mesh_reader.hpp"
#include "mesh/mesher_process.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/calculix.hpp"
#include "tests/support/campaign.hpp"
#include "tests/support/temporary_folder.hpp"

namespace microslip::calculix {
namespace {

constexpr int n_modes = 10;
const fem::Material titanium{1.14e11, 0.32, 4430.0};

struct Case {
  const char* name;
  mesh::Mesh mesh;
  double tolerance;
  Eigen::VectorXd calculix;
  const char* foot = "z0";
  fem::Rotation rotation{};
};

// A tapered plate, twisted by 40° from foot to tip and bowed: every edge is curved.
Eigen::Vector3d twist(const Eigen::Vector3d& x) {
  const double s = x[2] / 0.1;
  const double angle = 0.7 * s;
  const double width = 1.0 - 0.4 * s;
  const double a = (x[0] - 0.02) * width;
  const double b = (x[1] - 0.003) * width + 12.0 * a * a;
  return {a * std::cos(angle) - b * std::sin(angle), a * std::sin(angle) + b * std::cos(angle),
          x[2]};
}

mesh::Mesh plate(mesh::ElementType type, bool curved) {
  const test::BoxGrid grid{.size = {0.04, 0.006, 0.1}, .cells = {4, 1, 8}, .map = twist};
  return curved ? test::box_mesh(type, grid) : test::straight_box_mesh(type, grid);
}

mesh::Mesh blade(double element_size) {
  const test::TemporaryFolder folder;
  mesh::mesh_blade({}, {element_size}, folder.path() / "blade.msh");
  return mesh::read_gmsh(folder.path() / "blade.msh");
}

std::vector<Case> cases() {
  using mesh::ElementType;
  std::vector<Case> all;
  all.push_back({"tet10 straight", plate(ElementType::tet10, false), 1e-6, {}});
  all.push_back({"tet10 curved", plate(ElementType::tet10, true), 1e-6, {}});
  all.push_back({"hex20 straight", plate(ElementType::hex20, false), 1e-5, {}});
  all.push_back({"hex20 curved", plate(ElementType::hex20, true), 1e-5, {}});
  all.push_back({"wedge15 straight", plate(ElementType::wedge15, false), 3e-3, {}});
  all.push_back({"wedge15 curved", plate(ElementType::wedge15, true), 3e-3, {}});
  // As a blade on a disc, its axis askew to it: the first frequency rises by a third.
  const fem::Rotation turning{
      .speed = 1500.0, .origin = {0.0, 0.0, -0.2}, .direction = {0.8, 0.6, 0.0}};
  all.push_back({"tet10 rotating", plate(ElementType::tet10, true), 1e-5, {}, "z0", turning});
  all.push_back({"hex20 rotating", plate(ElementType::hex20, true), 1e-5, {}, "z0", turning});
  if (tests::whole_campaigns()) all.push_back({"blade, 6 mm", blade(0.006), 1e-5, {}, "root"});
  all.push_back({"blade, 4 mm", blade(0.004), 1e-5, {}, "root"});
  return all;
}

double largest_error(const Case& one, fem::Tet10Rule rule) {
  fem::Structure structure(one.mesh, titanium, {one.foot}, rule);
  if (one.rotation.speed > 0.0) structure.rotate(one.mesh, titanium, one.rotation);
  const Eigen::VectorXd frequency = structure.solve_modes({.n_modes = n_modes}).frequency;
  return (frequency - one.calculix).cwiseQuotient(one.calculix).cwiseAbs().maxCoeff();
}

TEST(CalculiX, FindsTheSameTenFrequencies) {
  if (!test::has_calculix()) GTEST_SKIP() << "ccx is not on PATH (apt: calculix-ccx)";
  std::vector<Case> all = cases();
  for (Case& one : all) {
    one.calculix =
        test::calculix_frequencies(one.mesh, titanium, {one.foot}, n_modes, one.rotation);
  }
  const fem::SlepcSession session;
  std::printf("%-20s %16s %22s %22s\n", "mesh", "CalculiX [rad/s]", "same rule, largest",
              "accurate, largest");
  double last = 0.0;
  for (const Case& one : all) {
    const double same = largest_error(one, fem::Tet10Rule::four_point);
    const double accurate = largest_error(one, fem::Tet10Rule::accurate);
    std::printf("%-20s %16.6f %22.1e %22.1e\n", one.name, one.calculix[0], same, accurate);
    EXPECT_LT(same, one.tolerance) << one.name;
    last = accurate;
  }
  EXPECT_LT(last, 5e-4);  // the finest blade: 3.9e-4, against 1.0e-3 at 6 mm
}

}  // namespace
}  // namespace microslip::calculix
