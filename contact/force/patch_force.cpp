#include "contact/force/patch_force.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "contact/closed_form/cycle_force.hpp"
#include "contact/closed_form/cycle_phases.hpp"
#include "contact/closed_form/cycle_states.hpp"
#include "contact/closed_form/friction_cycle.hpp"
#include "contact/closed_form/slip_functions.hpp"
#include "contact/force/block_kernels.hpp"

namespace microslip::contact {
namespace {

void require_one(int n_harmonics) {
  if (n_harmonics == 1) return;
  throw std::invalid_argument("PatchForce: " + std::to_string(n_harmonics) +
                              " harmonics; the closed form has one");
}

RestingPoints at_rest(const ContactPatch& patch) {
  const Eigen::Index n = patch.n_points();
  RestingPoints points{patch.weights(), Eigen::VectorXd(n), Eigen::MatrixX3d(n, 3), {}};
  for (Eigen::Index i = 0; i < n; ++i) {
    const PointParameters& point = patch.points()[static_cast<std::size_t>(i)];
    const double k_u = point.has_friction() ? point.tangential_stiffness : 0.0;
    const Eigen::Vector3d stiffness(k_u, point.normal_stiffness, 0.0);
    points.reference_load[i] = std::max(point.rest_load, 0.0);
    points.stuck_stiffness.row(i) = stiffness.transpose();
    points.ranges.emplace_back(
        LinearRange{stiffness, point.rest_load, FrictionLaw::constant(point.friction_coefficient)});
  }
  return points;
}

ModalShapes along_p(ModalShapes shapes) {
  shapes.w.resize(0, 0);
  return shapes;
}

/// @param phi  receives the mode shapes of these points, [mode][block], padded with zeros.
void pack(const Eigen::MatrixXd& shape, std::span<const Eigen::Index> points, double* phi) {
  for (Eigen::Index mode = 0; mode < shape.cols(); ++mode, phi += block_points) {
    const double* column = shape.col(mode).data();
    for (std::size_t i = 0; i < points.size(); ++i) phi[i] = column[points[i]];
    std::fill(phi + points.size(), phi + block_points, 0.0);
  }
}

template <std::size_t E>
using Rows = std::array<std::array<double, block_points>, E>;

// Forces and derivatives of the points of one block, times their weights.
struct BlockForces {
  Rows<3> friction;       // mean, sin, cos
  Rows<3> normal;         // dynamic part
  Rows<7> friction_by_u;  // (mean, mean), then rows mean, sin, cos by columns sin, cos
  Rows<9> friction_by_v;  // rows mean, sin, cos by columns mean, sin, cos
  Rows<6> normal_by_v;    // upper triangle: (m,m) (m,s) (m,c) (s,s) (s,c) (c,c)
  bool any_contact = false;
  bool any_coupling = false;  // friction depends on v

  void set(std::size_t i, double weight, double reference_load, const CycleForce& force) {
    const ForceCoefficients& f = force.friction;
    const ForceCoefficients& n = force.normal;
    fill(friction, i, weight, {f.mean, f.sin, f.cos});
    fill(normal, i, weight, {n.mean - reference_load, n.sin, n.cos});
    const auto& u = force.friction_by_u;
    fill(friction_by_u, i, weight,
         {force.mean_by_u_mean, u[0][0], u[0][1], u[1][0], u[1][1], u[2][0], u[2][1]});
    const auto& v = force.friction_by_v;
    fill(friction_by_v, i, weight,
         {v[0][0], v[0][1], v[0][2], v[1][0], v[1][1], v[1][2], v[2][0], v[2][1], v[2][2]});
    const auto& k = force.normal_by_v;
    fill(normal_by_v, i, weight, {k[0][0], k[0][1], k[0][2], k[1][1], k[1][2], k[2][2]});
    any_contact = any_contact || force.regime != CycleRegime::separated;
    any_coupling = any_coupling || force.regime == CycleRegime::stick_slip ||
                   force.regime == CycleRegime::separation ||
                   (force.regime == CycleRegime::full_stick && force.mean_by_u_mean == 0.0);
  }

 private:
  template <std::size_t E>
  static void fill(Rows<E>& rows, std::size_t i, double weight,
                   const std::array<double, E>& values) {
    for (std::size_t e = 0; e < E; ++e) {
      rows[e][i] = weight * values[e];
    }
  }
};

// Modal sums over all points, as the kernels give them.
struct ModalSums {
  explicit ModalSums(std::size_t n_modes)
      : force(3 * n_modes),
        by_uu(7 * n_modes * n_modes),
        by_uv(9 * n_modes * n_modes),
        by_vv(6 * n_modes * n_modes) {}

  std::vector<double> force;
  std::vector<double> by_uu;
  std::vector<double> by_uv;
  std::vector<double> by_vv;
};

void add_block(ModalSums& sums, std::size_t n_modes, std::size_t n_points, const double* phi_u,
               const double* phi_v, const BlockForces& forces, bool derivatives) {
  const BlockKernels& kernels = block_kernels();
  // The normal force counts even where nothing touches: a rest load that is gone.
  kernels.add_force(n_modes, n_points, phi_v, forces.normal[0].data(), sums.force.data());
  if (!forces.any_contact) {
    return;
  }
  kernels.add_force(n_modes, n_points, phi_u, forces.friction[0].data(), sums.force.data());
  if (!derivatives) return;
  kernels.add_symmetric_products_7(n_modes, n_points, phi_u, forces.friction_by_u[0].data(),
                                   sums.by_uu.data());
  kernels.add_symmetric_products_6(n_modes, n_points, phi_v, forces.normal_by_v[0].data(),
                                   sums.by_vv.data());
  if (forces.any_coupling) {
    kernels.add_products_9(n_modes, n_points, phi_u, phi_v, forces.friction_by_v[0].data(),
                           sums.by_uv.data());
  }
}

// The 3 × 3 harmonic blocks (row harmonic, column harmonic) of one pair of modes.
Eigen::Matrix3d pair_block(const ModalSums& sums, std::size_t n, std::size_t i, std::size_t j) {
  const std::size_t half = i >= j ? i * n + j : j * n + i;  // symmetric in the modes
  const double* u = &sums.by_uu[7 * half];
  const double* v = &sums.by_uv[9 * (i * n + j)];
  const double* k = &sums.by_vv[6 * half];
  Eigen::Matrix3d J;
  // ∂n_s/∂v_mean = 2 ∂n_mean/∂v_s: one integral, weights 1/π and 1/2π.
  J << u[0] + v[0] + k[0], u[1] + v[1] + k[1], u[2] + v[2] + k[2],  //
      v[3] + 2.0 * k[1], u[3] + v[4] + k[3], u[4] + v[5] + k[4],    //
      v[6] + 2.0 * k[2], u[5] + v[7] + k[4], u[6] + v[8] + k[5];
  return J;
}

ForceAndJacobian unpacked(const ModalSums& sums, std::size_t n) {
  const auto N = static_cast<Eigen::Index>(n);
  ForceAndJacobian result{Harmonics(1, N), Eigen::MatrixXd(3 * N, 3 * N),
                          Eigen::VectorXd::Zero(3 * N)};
  result.force.vector() = Eigen::Map<const Eigen::VectorXd>(sums.force.data(), 3 * N);
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < n; ++i) {
      const Eigen::Matrix3d J = pair_block(sums, n, i, j);
      const auto row = static_cast<Eigen::Index>(i);
      const auto column = static_cast<Eigen::Index>(j);
      for (Eigen::Index h = 0; h < 3; ++h) {
        for (Eigen::Index k = 0; k < 3; ++k) {
          result.jacobian(h * N + row, k * N + column) = J(h, k);
        }
      }
    }
  }
  return result;
}

PointMotion motion_of(Eigen::Index point, const PatchMotion& motion) {
  const PointRows x = motion.of(point);
  return {x.u[0], x.u[1], x.u[2], x.v[0], x.v[1], x.v[2]};
}

}  // namespace

PatchForce::PatchForce(ContactPatch patch, ModalShapes shapes)
    : PointwiseForce(at_rest(patch), along_p(std::move(shapes))), patch_(std::move(patch)) {}

ForceAndJacobian PatchForce::awake_force(double /*frequency*/, const Asked& asked,
                                         PointwiseWork& work) const {
  require_one(work.motion.n_harmonics());
  require_one(std::max(asked.n_harmonics, 1));
  const auto n = static_cast<std::size_t>(n_modes());
  std::vector<double> phi(2 * n * block_points);  // of one block: [u, v][mode][point of the block]
  double* const phi_u = phi.data();
  double* const phi_v = phi_u + n * block_points;
  ModalSums sums(n);
  for (std::span<const Eigen::Index> rest(work.sleep.awake()); !rest.empty();) {
    const auto block = rest.first(std::min(block_points, rest.size()));
    rest = rest.subspan(block.size());
    pack(shapes().u, block, phi_u);
    pack(shapes().v, block, phi_v);
    BlockForces forces{};
    for (std::size_t i = 0; i < block.size(); ++i) {
      const PointParameters& point = patch_.points()[static_cast<std::size_t>(block[i])];
      const PointMotion at = motion_of(block[i], work.motion);
      const SlipFunctions w = slip_functions(point, at);
      const CycleRegime regime = cycle_regime(w);
      const CyclePhases phases = cycle_phases(w, regime);
      forces.set(i, points().weights[block[i]], points().reference_load[block[i]],
                 cycle_force(point, at, w, regime, phases));
      keep(block[i], cycle_states(regime, phases), work);
    }
    const std::size_t n_lanes = (block.size() + lane_points - 1) / lane_points * lane_points;
    add_block(sums, n, n_lanes, phi_u, phi_v, forces, !asked.rows.empty());
  }
  return restricted(unpacked(sums, n), asked.rows);
}

void PatchForce::add_cycles(std::span<const Eigen::Index> points, double /*frequency*/,
                            PointwiseWork& work, ReportSum& sum) const {
  require_one(work.motion.n_harmonics());
  for (const Eigen::Index i : points) {
    const FrictionCycle cycle =
        friction_cycle(patch_.points()[static_cast<std::size_t>(i)], motion_of(i, work.motion));
    sum.add(cycle.segments(), cycle.dissipated_energy, this->points().weights[i]);
  }
}

}  // namespace microslip::contact
