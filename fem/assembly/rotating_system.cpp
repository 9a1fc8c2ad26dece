#include "fem/assembly/rotating_system.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fem/assembly/own_elements.hpp"
#include "fem/elements/deformed_element.hpp"
#include "fem/elements/number_text.hpp"
#include "fem/petsc/columns.hpp"
#include "fem/petsc/factorisation.hpp"
#include "fem/petsc/petsc_check.hpp"
#include "fem/petsc_error.hpp"

namespace microslip::fem {
namespace {

/// Forces on the nodes of this rank, 3 per node [N].
struct Balance {
  Eigen::VectorXd load;      // Ω² M P (x + u − o)
  Eigen::VectorXd internal;  // f(u)
};

class RotatingAssembly {
 public:
  RotatingAssembly(FeSystem& system, const mesh::Mesh& mesh, const Material& material,
                   Tet10Rule rule, const Rotation& rotation)
      : system_(system),
        mesh_(mesh),
        material_(material),
        rule_(rule),
        rotation_(rotation),
        square_(rotation.speed * rotation.speed),
        radial_(Eigen::Matrix3d::Identity() - rotation.direction * rotation.direction.transpose()) {
  }

  /// Both sides of (1) at a displacement; (2) becomes the stiffness of the system.
  Balance assemble(const Eigen::MatrixX3d& displacement) {
    const Mat K = system_.stiffness.get();
    const DofMap& dofs = system_.dofs;
    Balance balance{Eigen::VectorXd::Zero(dofs.n_local_dofs()),
                    Eigen::VectorXd::Zero(dofs.n_local_dofs())};
    check(MatZeroEntries(K));
    for_own_elements(
        mesh_, dofs, [&](const mesh::ElementBlock& block, Eigen::Index e, const ElementDofs& own) {
          evaluate(block, e, displacement);
          add_forces(own, balance);
          check(MatSetValuesBlocked(K, own.n, own.index.data(), own.n, own.index.data(),
                                    element_.tangent.data(), ADD_VALUES));
        });
    check(MatAssemblyBegin(K, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(K, MAT_FINAL_ASSEMBLY));
    return balance;
  }

 private:
  void evaluate(const mesh::ElementBlock& block, Eigen::Index e,
                const Eigen::MatrixX3d& displacement) {
    const auto nodes = block.connectivity.row(e).transpose();
    const Eigen::MatrixX3d x = mesh_.nodes()(nodes, Eigen::all);
    const Eigen::MatrixX3d u = displacement(nodes, Eigen::all);
    deform_element(block.type, x, u, material_, rule_, element_);
    element_matrices(block.type, x, material_, rule_, matrices_);
    load_ = square_ * radial_ * ((x + u).rowwise() - rotation_.origin.transpose()).transpose() *
            matrices_.mass;
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
      for (Eigen::Index j = 0; j < x.rows(); ++j) {
        element_.tangent.block<3, 3>(3 * i, 3 * j) -= square_ * matrices_.mass(i, j) * radial_;
      }
    }
  }

  void add_forces(const ElementDofs& own, Balance& balance) const {
    for (int i = 0; i < own.n; ++i) {
      const Eigen::Index node = own.index[static_cast<std::size_t>(i)];
      if (node < system_.dofs.first() || node >= system_.dofs.last()) continue;
      const Eigen::Index row = 3 * (node - system_.dofs.first());
      balance.load.segment<3>(row) += load_.col(i);
      balance.internal.segment<3>(row) += element_.force.col(i);
    }
  }

  FeSystem& system_;
  const mesh::Mesh& mesh_;
  const Material& material_;
  Tet10Rule rule_;
  Rotation rotation_;
  double square_;           // Ω²
  Eigen::Matrix3d radial_;  // P
  DeformedElement element_;
  ElementMatrices matrices_;
  Eigen::Matrix3Xd load_;
};

std::string at_speed(const Rotation& rotation) {
  return " at a speed of " + number_text(rotation.speed) + " rad/s (" +
         number_text(30.0 * rotation.speed / std::numbers::pi) + " rpm)";
}

void require_stable(const FeSystem& system, const Rotation& rotation) {
  const Eigen::Index n_negative =
      Factorisation(system.stiffness.get(), FactorKind::inertia_only).inertia().negative;
  if (n_negative == 0) return;
  throw EigenError("rotation: the body is not stable" + at_speed(rotation) +
                   ": its stiffness has " + std::to_string(n_negative) +
                   " negative eigenvalues there; lower the speed, or look whether axis, units and "
                   "supports are right");
}

double norm(const Eigen::VectorXd& local) { return column_norms(local)[0]; }

}  // namespace

Eigen::VectorXd rotate_system(FeSystem& system, const mesh::Mesh& mesh, const Material& material,
                              Tet10Rule rule, const Rotation& rotation,
                              const Eigen::VectorXd& start) {
  constexpr int max_steps = 30;
  constexpr double tolerance = 1e-9;
  RotatingAssembly assembly(system, mesh, material, rule, rotation);
  Eigen::VectorXd u = start;
  double first = 0.0;  // out of balance: what a body at rest again is measured by
  for (int step = 0; step < max_steps; ++step) {
    const Balance balance = assembly.assemble(u.reshaped<Eigen::RowMajor>(mesh.n_nodes(), 3));
    const Eigen::VectorXd rest = balance.load - balance.internal;
    const double size = norm(rest);
    if (!std::isfinite(size)) break;
    if (step == 0) first = size;
    const bool balanced = size <= tolerance * std::max(norm(balance.load), step == 0 ? 0.0 : first);
    Eigen::VectorXd correction = Eigen::VectorXd::Zero(u.size());
    if (!balanced) {
      const Factorisation tangent(system.stiffness.get(), FactorKind::indefinite);
      correction = system.dofs.to_mesh(tangent.solve(rest));
    }
    // In thin bodies rounding leaves more out of balance than the load, which no displacement
    // feels.
    if (balanced || correction.norm() <= tolerance * u.norm()) {
      require_stable(system, rotation);
      return u;
    }
    u += correction;
  }
  throw EigenError("rotation: no static equilibrium is found" + at_speed(rotation) +
                   "; lower the speed, or look whether axis, units and supports are right");
}

}  // namespace microslip::fem
