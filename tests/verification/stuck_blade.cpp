// The stuck blade against direct finite elements: is a handful of modes of the free blade the right
// model of a blade whose contact face is held?
//
// Direct: K + local springs (k = 1e11 N/m³ along y and x) at the points of the contact face, its
// modes and its response. Reduced: N modes of the blade without contact, K_c = ∫ Φᵀ k Φ dA added to
// Ω²,
//   residual none:       k = k_local,
//   residual stiffness:  1/k = 1/k_local + c_N, c_N the flexibility of the modes left out (theory
//                        section 14),
//   attachment d:        k = k_local, and static shapes of the tractions of degree d and of the
//   forces behind
//                        the modes (theory section 14.1).
// Compared: the first three stuck frequencies; the displacement along x of the tip at A under
// forces along x at B and B', at 0.95 ω₁ without damping (direct: one solution of (K − ω²M)u = F)
// and at resonance with 0.2 % damping, |Σ_n φ_A φ_nᵀF / (ω_n² − ω_1² + 2iζω_nω_1)|.
//
// Rayleigh: constraints on the shapes raise every frequency, so "none" errs upward, and less with
// every mode. "stiffness" is no bound; it is asked to be nearer than "none" in the first two
// frequencies, and with the default ten modes to be right to a tenth of the width of the resonance,
// 2ζ. "attachment" contains "none", so it errs upward too, and less with every degree; with the
// default ten modes and uniform tractions it is asked for a hundredth of that width.
#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>
#include <string>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "fem/modal_analysis.hpp"
#include "fem/slepc_session.hpp"
#include "mesh/mesh_reader.hpp"
#include "mesh/mesher_process.hpp"
#include "tests/support/campaign.hpp"
#include "tests/support/surface_springs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace microslip::stuck_blade {
namespace {

constexpr double k_local = 1e11;  // [N/m³]
constexpr double damping_ratio = 0.002;
const fem::Material steel{2.1e11, 0.3, 7800.0};

mesh::Mesh default_blade() {
  const test::TemporaryFolder folder;
  // What is compared are models of one mesh, whatever its size.
  const double element_size = tests::whole_campaigns() ? 0.005 : 0.008;
  mesh::mesh_blade({}, {element_size}, folder.path() / "blade.msh");
  return mesh::read_gmsh(folder.path() / "blade.msh");
}

// Rows p (slip, along y), q (normal, along x), r.
Eigen::Matrix3d contact_frame() {
  Eigen::Matrix3d frame;
  frame << 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0;
  return frame;
}

struct Modes {
  Eigen::VectorXd frequency;  // [rad/s]
  Eigen::VectorXd at_A;       // φ along x
  Eigen::VectorXd load;       // φᵀF
};

double amplitude(const Modes& modes, double omega, double ratio) {
  std::complex<double> sum = 0.0;
  for (Eigen::Index n = 0; n < modes.frequency.size(); ++n) {
    const double natural = modes.frequency[n];
    sum += modes.at_A[n] * modes.load[n] /
           std::complex<double>(natural * natural - omega * omega, 2.0 * ratio * natural * omega);
  }
  return std::abs(sum);
}

struct Blade {
  mesh::Mesh mesh;
  const mesh::Surface& face = mesh.surface("contact");
  mesh::SurfaceSampling sampling = mesh::sample_surface(mesh.nodes(), face, 600);

  [[nodiscard]] Eigen::Index x_of(const std::string& point) const {
    return 3 * mesh.node_set(point).front();
  }

  [[nodiscard]] Modes modes_of(const Eigen::VectorXd& frequency,
                               const Eigen::MatrixXd& shapes) const {
    const Eigen::VectorXd load = 0.5 * (shapes.row(x_of("B")) + shapes.row(x_of("B'"))).transpose();
    return {frequency, shapes.row(x_of("A")).transpose(), load};
  }

  // Mode shapes along p and q at the sampling points, n_points × N.
  [[nodiscard]] Eigen::MatrixXd shapes_along(const fem::ModalBasis& basis, int axis) const {
    Eigen::MatrixXd nodal(std::ssize(face.nodes), basis.frequency.size());
    const Eigen::Matrix3d frame = contact_frame();
    for (Eigen::Index i = 0; i < nodal.rows(); ++i) {
      nodal.row(i) =
          frame.row(axis) * basis.shapes.middleRows<3>(3 * face.nodes[static_cast<std::size_t>(i)]);
    }
    return sampling.to_centres * nodal;
  }
};

enum class Residual { none, stiffness };

fem::ModalBasis with_attachment(const Blade& blade, fem::Structure& structure,
                                const fem::ModalBasis& basis, int degree) {
  Eigen::MatrixXd F = Eigen::MatrixXd::Zero(3 * blade.mesh.n_nodes(), 1);
  F(blade.x_of("B"), 0) = F(blade.x_of("B'"), 0) = 0.5;
  return structure.attach(basis, {{blade.face, contact_frame()}}, F, {.degree = degree}).basis;
}

Modes reduced_modes(const Blade& blade, fem::Structure& structure, const fem::ModalBasis& basis,
                    Residual residual) {
  Eigen::MatrixX3d c = Eigen::MatrixX3d::Zero(std::ssize(blade.face.nodes), 3);
  if (residual == Residual::stiffness)
    c = structure.residual_flexibility(basis, blade.face, contact_frame()).row_sums;
  Eigen::MatrixXd K = basis.frequency.cwiseAbs2().asDiagonal();
  for (const int axis : {0, 1}) {
    const Eigen::ArrayXd flexibility =
        1.0 / k_local + (blade.sampling.to_centres * c.col(axis)).array();
    EXPECT_GT(flexibility.minCoeff(), 0.0);
    const Eigen::VectorXd k = (blade.sampling.weights.array() / flexibility).matrix();
    const Eigen::MatrixXd Phi = blade.shapes_along(basis, axis);
    K += Phi.transpose() * k.asDiagonal() * Phi;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(K);
  const Modes free = blade.modes_of(basis.frequency, basis.shapes);
  return {eigen.eigenvalues().cwiseSqrt(), eigen.eigenvectors().transpose() * free.at_A,
          eigen.eigenvectors().transpose() * free.load};
}

fem::ModalBasis first_modes(const fem::ModalBasis& basis, Eigen::Index n) {
  return {.frequency = basis.frequency.head(n),
          .shapes = basis.shapes.leftCols(n),
          .residual = basis.residual.head(n)};
}

struct Direct {
  Modes modes;
  double off_resonance;  // |u_A| at 0.95 ω₁ [m/N]
  double resonance;
};

Direct direct_solution(const Blade& blade) {
  Eigen::MatrixX3d stiffness = Eigen::MatrixX3d::Zero(blade.sampling.weights.size(), 3);
  stiffness.leftCols<2>().setConstant(k_local);
  const test::SprungStructure stuck(
      blade.mesh, steel, {"root"},
      {blade.face, blade.sampling.to_centres, blade.sampling.weights, contact_frame(), stiffness});
  const test::SprungModes found = stuck.modes(40);
  const Modes modes = blade.modes_of(found.frequency, found.shapes);
  Eigen::MatrixXd F = Eigen::MatrixXd::Zero(3 * blade.mesh.n_nodes(), 1);
  F(blade.x_of("B"), 0) = F(blade.x_of("B'"), 0) = 0.5;
  const Eigen::MatrixXd u = stuck.response(0.95 * modes.frequency[0], F);
  return {modes, std::abs(u(blade.x_of("A"), 0)),
          amplitude(modes, modes.frequency[0], damping_ratio)};
}

struct Errors {
  Eigen::Array3d frequency;
  double off_resonance;
  double resonance;
};

Errors errors_of(const Modes& reduced, const Direct& direct) {
  const Eigen::VectorXd& exact = direct.modes.frequency;
  return {reduced.frequency.head<3>().cwiseQuotient(exact.head<3>()).array() - 1.0,
          amplitude(reduced, 0.95 * exact[0], 0.0) / direct.off_resonance - 1.0,
          amplitude(reduced, reduced.frequency[0], damping_ratio) / direct.resonance - 1.0};
}

void print(const char* residual, Eigen::Index n, const Errors& e) {
  std::printf("%-10s %4td   %+9.1e %+9.1e %+9.1e   %+9.1e %+9.1e\n", residual, n, e.frequency[0],
              e.frequency[1], e.frequency[2], e.off_resonance, e.resonance);
}

TEST(StuckBlade, FewModesWithResidualStiffnessAreThoseOfDirectFiniteElements) {
  const Blade blade{default_blade()};  // before PETSc is opened: the mesher is a child process
  const fem::SlepcSession session;
  const Direct direct = direct_solution(blade);
  fem::Structure structure(blade.mesh, steel, {"root"});
  const fem::ModalBasis free = structure.solve_modes({.n_modes = 40});
  const auto hz = [](double omega) { return omega / (2.0 * std::numbers::pi); };
  const Eigen::VectorXd& stuck = direct.modes.frequency;
  std::printf(
      "%td degrees of freedom; free %.3f %.3f %.3f Hz; stuck, direct: %.3f %.3f %.3f Hz, %.4g "
      "m/N\n",
      structure.n_dofs(), hz(free.frequency[0]), hz(free.frequency[1]), hz(free.frequency[2]),
      hz(stuck[0]), hz(stuck[1]), hz(stuck[2]), direct.resonance);
  std::printf(
      "relative errors of the reduced model\n"
      "residual   modes   frequencies 1, 2, 3             at 0.95 w1  at resonance\n");
  Eigen::Array3d before = Eigen::Array3d::Constant(1.0);
  for (const Eigen::Index n : {5, 10, 20, 40}) {
    const fem::ModalBasis basis = first_modes(free, n);
    const Errors none = errors_of(reduced_modes(blade, structure, basis, Residual::none), direct);
    const Errors stiffness =
        errors_of(reduced_modes(blade, structure, basis, Residual::stiffness), direct);
    print("none", n, none);
    print("stiffness", n, stiffness);
    Errors lower = none;
    for (const int degree : {0, 1, 2}) {
      const fem::ModalBasis attached = with_attachment(blade, structure, basis, degree);
      const Errors errors =
          errors_of(reduced_modes(blade, structure, attached, Residual::none), direct);
      print(("attach. " + std::to_string(degree)).c_str(), n, errors);
      EXPECT_TRUE((errors.frequency > -1e-8).all() &&
                  (errors.frequency < lower.frequency + 1e-8).all())
          << n;
      if (n >= 10) {
        EXPECT_LT(errors.frequency[0], 0.01 * 2.0 * damping_ratio) << n;
      }
      lower = errors;
    }
    EXPECT_TRUE((none.frequency > 0.0).all() && (none.frequency < before).all()) << n;
    EXPECT_TRUE((stiffness.frequency.abs() < none.frequency).head<2>().all()) << n;
    if (n >= 10) {
      EXPECT_LT(std::abs(stiffness.frequency[0]), 0.1 * 2.0 * damping_ratio) << n;
    }
    before = none.frequency;
  }
}

}  // namespace
}  // namespace microslip::stuck_blade
