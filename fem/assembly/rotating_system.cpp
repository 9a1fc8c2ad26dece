#include "fem/assembly/rotating_system.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "fem/assembly/own_elements.hpp"
#include "fem/elements/deformed_element.hpp"
#include "fem/elements/number_text.hpp"
#include "fem/petsc/columns.hpp"
#include "fem/petsc/factorisation.hpp"
#include "fem/petsc/petsc_check.hpp"
#include "fem/petsc_error.hpp"
#include "fem/ranks.hpp"

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
        radial_(Eigen::Matrix3d::Identity() - rotation.direction * rotation.direction.transpose()) {
  }

  void turn_at(double square_of_speed) { square_ = square_of_speed; }

  /// Both sides of (1) at a displacement; (2) becomes the stiffness of the system.
  Balance assemble(const Eigen::MatrixX3d& displacement) {
    const Mat K = system_.stiffness.get();
    const DofMap& dofs = system_.dofs;
    Balance balance{Eigen::VectorXd::Zero(dofs.n_local_dofs()),
                    Eigen::VectorXd::Zero(dofs.n_local_dofs())};
    check(MatZeroEntries(K));
    beyond_ = false;
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

  /// Whether the last assembly had strains that no law of small ones describes, or elements turned
  /// inside out.
  [[nodiscard]] bool is_beyond_its_law() const { return anywhere(beyond_); }

 private:
  void evaluate(const mesh::ElementBlock& block, Eigen::Index e,
                const Eigen::MatrixX3d& displacement) {
    const auto nodes = block.connectivity.row(e).transpose();
    const Eigen::MatrixX3d x = mesh_.nodes()(nodes, Eigen::all);
    const Eigen::MatrixX3d u = displacement(nodes, Eigen::all);
    deform_element(block.type, x, u, material_, rule_, element_);
    constexpr double largest = 0.2;
    beyond_ = beyond_ || element_.inside_out || !(element_.strain <= largest);
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
  double square_ = 0.0;  // Ω²
  bool beyond_ = false;
  Eigen::Matrix3d radial_;  // P
  DeformedElement element_;
  ElementMatrices matrices_;
  Eigen::Matrix3Xd load_;
};

std::string rpm(double speed) { return number_text(30.0 * speed / std::numbers::pi) + " rpm"; }

std::string at_speed(const Rotation& rotation) {
  return " at a speed of " + number_text(rotation.speed) + " rad/s (" + rpm(rotation.speed) + ")";
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

struct Attempt {
  bool found = false;  ///< else Newton's method does not end, or where a linear law says nothing
  Eigen::VectorXd u;
  double reach = 0.0;  ///< of the largest step, over the length of the body
};

constexpr double farthest = 100.0;  // reach that may come back

/// Newton's method at one speed.
Attempt balanced(RotatingAssembly& assembly, const FeSystem& system, const mesh::Mesh& mesh,
                 const Eigen::VectorXd& start) {
  constexpr int max_steps = 15;
  constexpr double tolerance = 1e-9;
  Attempt attempt{false, start};
  Eigen::VectorXd& u = attempt.u;
  const double length =
      (mesh.nodes().colwise().maxCoeff() - mesh.nodes().colwise().minCoeff()).norm();
  double first = 0.0;  // out of balance: what a body at rest again is measured by
  for (int step = 0; step < max_steps; ++step) {
    const Balance balance = assembly.assemble(u.reshaped<Eigen::RowMajor>(mesh.n_nodes(), 3));
    const Eigen::VectorXd rest = balance.load - balance.internal;
    const double size = norm(rest);
    if (!std::isfinite(size)) break;
    if (step == 0) first = size;
    const bool is_balanced =
        size <= tolerance * std::max(norm(balance.load), step == 0 ? 0.0 : first);
    Eigen::VectorXd correction = Eigen::VectorXd::Zero(u.size());
    if (!is_balanced) {
      // Without pivoting: a step that is poor where the tangent is indefinite ends the attempt.
      const Factorisation tangent(system.stiffness.get(), FactorKind::positive_definite);
      correction = system.dofs.to_mesh(tangent.solve(rest));
    }
    // In thin bodies rounding leaves more out of balance than the load, which no displacement
    // feels.
    if (is_balanced || correction.norm() <= tolerance * u.norm()) {
      attempt.found = !assembly.is_beyond_its_law();
      break;
    }
    attempt.reach = std::max(attempt.reach, correction.cwiseAbs().maxCoeff() / length);
    if (!(attempt.reach <= farthest)) break;
    u += correction;
  }
  return attempt;
}

/// @param found  the highest speed with an equilibrium on the way [rad/s]; 0: none.
[[noreturn]] void refuse(const Rotation& rotation, double found) {
  throw EigenError("rotation: no static equilibrium is found" + at_speed(rotation) +
                   ", or none with strains below 0.2" +
                   (found > 0.0 ? "; one is up to " + rpm(found) : "") +
                   "; lower the speed, or look whether axis, units and supports are right");
}

}  // namespace

Eigen::VectorXd rotate_system(FeSystem& system, const mesh::Mesh& mesh, const Material& material,
                              Tet10Rule rule, const Rotation& rotation, const Equilibrium& start) {
  constexpr double shortest = 1.0 / 1024.0;
  constexpr double shortest_of_reached = 1.0 / 64.0;  // where it buckles it stops soon
  RotatingAssembly assembly(system, mesh, material, rule, rotation);
  const double before = start.speed * start.speed;
  const double after = rotation.speed * rotation.speed;
  Eigen::VectorXd u = start.displacement;
  double reached = 0.0;  // of the way from one square to the other
  for (double step = 1.0; reached < 1.0;) {
    const double next = std::min(1.0, reached + step);
    assembly.turn_at(before + next * (after - before));
    Attempt attempt = balanced(assembly, system, mesh, u);
    if (attempt.found) {
      u = std::move(attempt.u);
      reached = next;
      step *= 2.0;
      continue;
    }
    step *= std::min(0.5, attempt.reach > farthest ? farthest / attempt.reach : 1.0);
    if (step < std::max(shortest, shortest_of_reached * reached)) {
      refuse(rotation, std::sqrt(before + reached * (after - before)));
    }
  }
  require_stable(system, rotation);
  return u;
}

}  // namespace microslip::fem
