#include "contact/force/patch_force.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact/closed_form/cycle_states.hpp"
#include "contact/closed_form/friction_cycle.hpp"
#include "contact/force/block_kernels.hpp"
#include "contact/force/cycle_report.hpp"
#include "contact/force/linear_proof.hpp"
#include "contact/patch/mode_shape_check.hpp"
#include "contact/patch/point_motions.hpp"

namespace microslip::contact {
namespace {

ModalShapes checked(ModalShapes shapes, Eigen::Index n_points) {
  require_mode_shape("PatchForce", "u", shapes.u, n_points, shapes.u.cols());
  require_mode_shape("PatchForce", "v", shapes.v, n_points, shapes.u.cols());
  return shapes;
}

// Mode shapes of the points in this order.
std::vector<double> packed(const ModalShapes& shapes, const std::vector<Eigen::Index>& order) {
  const auto n_points = order.size();
  const auto n_modes = static_cast<std::size_t>(shapes.u.cols());
  const std::size_t n_blocks = (n_points + block_points - 1) / block_points;
  std::vector<double> blocks(n_blocks * 2 * n_modes * block_points, 0.0);
  for (std::size_t mode = 0; mode < n_modes; ++mode) {
    for (std::size_t point = 0; point < n_points; ++point) {
      const std::size_t row = point / block_points * 2 * n_modes + mode;
      const std::size_t column = point % block_points;
      const Eigen::Index i = order[point];
      const auto j = static_cast<Eigen::Index>(mode);
      blocks[row * block_points + column] = shapes.u(i, j);
      blocks[(row + n_modes) * block_points + column] = shapes.v(i, j);
    }
  }
  return blocks;
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

  void set(std::size_t i, double weight, double load_at_rest, const CycleForce& force) {
    const ForceCoefficients& f = force.friction;
    const ForceCoefficients& n = force.normal;
    fill(friction, i, weight, {f.mean, f.sin, f.cos});
    fill(normal, i, weight, {n.mean - load_at_rest, n.sin, n.cos});
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
               const double* phi_v, const BlockForces& forces) {
  const BlockKernels& kernels = block_kernels();
  // The normal force counts even where nothing touches: a preload that is gone.
  kernels.add_force(n_modes, n_points, phi_v, forces.normal[0].data(), sums.force.data());
  if (!forces.any_contact) {
    return;
  }
  kernels.add_force(n_modes, n_points, phi_u, forces.friction[0].data(), sums.force.data());
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

void add_sleeping(ForceAndJacobian& result, const SleepingPart& part, const Harmonics& q) {
  const Eigen::Index N = part.mean.size();
  result.force.rows() += q.rows() * part.stiffness;  // symmetric
  result.force.rows().row(0) += part.mean.transpose();
  for (Eigen::Index h = 0; h < 3; ++h) {
    result.jacobian.block(h * N, h * N, N, N) += part.stiffness;
  }
}

}  // namespace

PatchForce::PatchForce(ContactPatch patch, ModalShapes shapes)
    : ModalForce(shapes.u.cols()),
      patch_(std::move(patch)),
      shapes_(checked(std::move(shapes), patch_.n_points())),
      sleep_(patch_, shapes_),
      blocks_(packed(shapes_, sleep_.order())) {}

ForceAndJacobian PatchForce::evaluated(const Harmonics& q, double /*frequency*/,
                                       const Asked& asked) {
  require_single_harmonic(q, n_modes());
  if (asked.n_harmonics > 1) {
    throw std::invalid_argument("PatchForce: " + std::to_string(asked.n_harmonics) +
                                " harmonics of the force; the closed form has one");
  }
  const auto n = static_cast<std::size_t>(n_modes());
  if (sleep_.look_at(q, patch_, shapes_)) {
    blocks_ = packed(shapes_, sleep_.order());
  }
  const auto n_awake = static_cast<std::size_t>(sleep_.n_awake());
  const BlockKernels& kernels = block_kernels();
  ModalSums sums(n);
  for (std::size_t first = 0; first < n_awake; first += block_points) {
    const std::size_t last = std::min(first + block_points, n_awake);
    const std::size_t n_lanes = (last - first + lane_points - 1) / lane_points * lane_points;
    const double* phi_u = &blocks_[2 * n * first];
    const double* phi_v = phi_u + n * block_points;
    Rows<3> u;
    Rows<3> v;
    kernels.project(n, n_lanes, phi_u, q.rows().data(), u[0].data());
    kernels.project(n, n_lanes, phi_v, q.rows().data(), v[0].data());
    BlockForces forces{};
    for (std::size_t point = first; point < last; ++point) {
      const std::size_t i = point - first;
      const Eigen::Index which = sleep_.order()[point];
      const PointParameters& parameters = patch_.points()[static_cast<std::size_t>(which)];
      forces.set(i, patch_.weights()[which], std::max(parameters.preload, 0.0),
                 cycle_force(parameters, {u[0][i], u[1][i], u[2][i], v[0][i], v[1][i], v[2][i]}));
    }
    add_block(sums, n, n_lanes, phi_u, phi_v, forces);
  }
  ForceAndJacobian result = unpacked(sums, n);
  if (const SleepingPart* part = sleep_.part()) {
    add_sleeping(result, *part, q);
  }
  return restricted(std::move(result), asked.rows);
}

CycleReport PatchForce::report(const Harmonics& q, double /*frequency*/) {
  CycleReport report = cycle_report(patch_, point_motions(shapes_, q));
  report.awake_share = sleep_.awake_share_at(q);
  return report;
}

Eigen::MatrixXd PatchForce::stuck_stiffness() const {
  Eigen::VectorXd k_u(patch_.n_points());
  Eigen::VectorXd k_v(patch_.n_points());
  for (Eigen::Index i = 0; i < patch_.n_points(); ++i) {
    const PointParameters& point = patch_.points()[static_cast<std::size_t>(i)];
    const double weight = patch_.weights()[i];
    k_u[i] = point.friction_coefficient > 0.0 ? weight * point.tangential_stiffness : 0.0;
    k_v[i] = weight * point.normal_stiffness;
  }
  return shapes_.u.transpose() * k_u.asDiagonal() * shapes_.u +
         shapes_.v.transpose() * k_v.asDiagonal() * shapes_.v;
}

LinearState PatchForce::linear_state(const Harmonics& centre, double radius) const {
  return contact::linear_state(patch_, shapes_, centre, radius);
}

void PatchForce::states(const Harmonics& q, double /*frequency*/, ContactStates& result) {
  require_single_harmonic(q, n_modes());
  u_.noalias() = shapes_.u * q.rows().transpose();
  v_.noalias() = shapes_.v * q.rows().transpose();
  const double area = patch_.weights().sum();
  result.clear();
  for (Eigen::Index i = 0; i < patch_.n_points(); ++i) {
    const double weight = patch_.weights()[i];
    if (weight == 0.0) continue;
    const PointMotion motion{u_(i, 0), u_(i, 1), u_(i, 2), v_(i, 0), v_(i, 1), v_(i, 2)};
    result.push_back(
        {weight / area, cycle_states(patch_.points()[static_cast<std::size_t>(i)], motion)});
  }
}

}  // namespace microslip::contact
