#include "contact/line/band_force.hpp"

#include <cmath>
#include <numbers>

#include "contact/line/band_quadrature.hpp"
#include "contact/trigonometric_basis.hpp"

namespace microslip::contact {
BandWork band_work(SliderBand& band, const BandCycle& cycle) {
  BandWork work;
  if (!band.has_spring()) return work;
  for (const BandPiece& piece : cycle.pieces) {
    if (piece.state == ContactState::separated || piece.state == ContactState::stick) continue;
    const double sign = piece.slip_sign();
    visit_piece(band, piece, {band.n_harmonics(), 0}, BandIntegrals::forces_and_slip,
                [&](const BandPanelNodes& panel) {
                  const BandInstants& now = panel.instants;
                  const BandPoints way =
                      panel.weight *
                      (points_of(now.motion.velocity) - sign * points_of(now.reach_rate)).abs();
                  work.slip_distance += way.sum();
                  work.normal_slip += (way * points_of(now.load)).sum();
                  work.dissipated_energy += (panel.weight * panel.slip_power).sum();
                });
  }
  return work;
}

Harmonics band_force(SliderBand& band, const BandCycle& cycle, int n_harmonics) {
  Harmonics force(n_harmonics, n_point_signals);
  const auto n = static_cast<int>(force.rows().rows());
  Eigen::Matrix<double, n_band_nodes, 4> weighted;
  weighted.setZero();
  Eigen::Matrix4Xd sums = Eigen::Matrix4Xd::Zero(4, n);
  for (const BandPiece& piece : cycle.pieces) {
    if (piece.state == ContactState::separated) continue;
    visit_piece(band, piece, {n_harmonics, n_harmonics}, BandIntegrals::forces,
                [&](const BandPanelNodes& panel) {
                  weighted.col(0) = panel.weight * panel.friction;
                  weighted.col(1) = panel.weight * points_of(panel.instants.load);
                  band_kernels().sums(n, 1, panel.basis.data(), weighted.data(), 4, sums.data());
                });
  }
  force.rows().leftCols(2) = sums.topRows(2).transpose() / std::numbers::pi;
  force.rows().row(0) *= 0.5;
  return force;
}

void set_states(const BandCycle& cycle, PointTraction& result) {
  result.regime = cycle.regime;
  for (const BandPiece& piece : cycle.pieces) {
    result.period.set(piece.state, piece.begin, piece.end - piece.begin);
  }
}

void BandTraction::set(SliderBand& band, const BandCycle& cycle, PointTraction& result) {
  const Eigen::Index n = 2 * band.n_harmonics() + 1;
  sums_.setZero(n_sums, 2 * n - 1);
  virgin_.setZero(n);
  frequency_memory_.setZero(n);
  memory_by_u_.setZero(n, n);
  memory_by_v_.setZero(n, n);
  for (const BandPiece& piece : cycle.pieces) {
    if (piece.state != ContactState::separated) add_piece(band, piece);
  }
  set_states(cycle, result);
  result.defect = 0.0;
  write(result);
}

void BandTraction::weigh(const SliderBand& band, const BandPiece& piece,
                         const BandPanelNodes& panel) {
  const BandInstants& now = panel.instants;
  const BandPoints load_change = points_of(now.load_by_approach);
  const auto put = [&](Sum sum, const BandPoints& values) {
    weighted_.col(sum) = panel.weight * values;
  };
  put(friction, panel.friction);
  put(load, points_of(now.load));
  put(load_by_v, load_change);
  if (piece.state == ContactState::stick) {
    if (!band.has_spring()) return;
    const double k_u = band.law().first_stiffness();
    put(by_u, k_u * points_of(now.stiffness_ratio));
    put(by_v, k_u * points_of(now.stiffness_ratio_by_approach) *
                  (points_of(now.motion.position) - piece.slider));
    return;
  }
  const double sign = piece.slip_sign();
  put(by_v, sign * points_of(now.friction_coefficient) * load_change);
  if (!band.law().is_rate_dependent()) return;
  const BandPoints by_rate =
      sign * points_of(now.load) * points_of(now.friction_coefficient_by_rate);
  const BandPoints velocity = points_of(now.motion.velocity);
  put(by_velocity, by_rate * band.frequency() * (velocity < 0.0).select(-1.0, BandPoints::Ones()));
  put(by_frequency, by_rate * velocity.abs());
}

void BandTraction::add_piece(SliderBand& band, const BandPiece& piece) {
  const int H = band.n_harmonics();
  const bool sticks = piece.state == ContactState::stick;
  const bool remembers = sticks && band.has_spring();
  Sums& sums = remembers ? piece_ : sums_;
  if (remembers) piece_.setZero(n_sums, sums_.cols());
  weighted_.setZero();
  const bool all = remembers || (!sticks && band.law().is_rate_dependent());
  visit_piece(band, piece, {H, 2 * H}, BandIntegrals::forces, [&](const BandPanelNodes& panel) {
    weigh(band, piece, panel);
    band_kernels().sums(static_cast<int>(sums.cols()), all ? 2 : 1, panel.basis.data(),
                        weighted_.data(), n_sums, sums.data());
  });
  if (!remembers) return;
  sums_ += piece_;
  add_memory(band, piece);
}

void BandTraction::add_memory(SliderBand& band, const BandPiece& piece) {
  const Eigen::VectorXd held = piece_.row(by_u).head(virgin_.size()).transpose();
  if (piece.origin == SliderOrigin::virgin) {
    virgin_ += held;
    return;
  }
  const BandInstant now = piece.stood ? band.at_turn(piece.memory.phase()) : band.at(piece.memory);
  const Eigen::VectorXd& basis = band.basis();
  basis_rate(basis, basis_rate_);
  double from_velocity = 0.0;
  double from_v = 0.0;
  if (piece.origin == SliderOrigin::touch_down) {
    if (now.approach_rate > 0.0) from_v = -now.velocity / now.approach_rate;
  } else {
    const double sign = piece.origin == SliderOrigin::positive_slip ? 1.0 : -1.0;
    from_v = -sign * now.reach_by_approach;
    if (!piece.stood) {
      const double by_rate = sign * now.reach_by_rate;
      from_velocity = -by_rate * band.frequency() * std::copysign(1.0, now.velocity);
      frequency_memory_ += (by_rate * std::abs(now.velocity)) * held;
    } else if (now.acceleration != 0.0) {
      from_velocity = sign * now.reach_by_approach * now.approach_rate / now.acceleration;
    }
  }
  memory_by_u_.noalias() -= held * (basis + from_velocity * basis_rate_).transpose();
  memory_by_v_.noalias() -= held * (from_v * basis).transpose();
}

void BandTraction::write(PointTraction& result) {
  const Eigen::Index n = virgin_.size();
  const int H = static_cast<int>(n / 2);
  result.force = Harmonics(H, n_point_signals);
  result.jacobian.setZero(n_point_signals * n, n_point_signals * n);
  result.frequency_derivative.setZero(n_point_signals * n);
  const auto norm = [](Eigen::Index i) { return (i == 0 ? 0.5 : 1.0) / std::numbers::pi; };
  for (Eigen::Index i = 0; i < n; ++i) {
    result.force.rows()(i, 0) = norm(i) * sums_(friction, i);
    result.force.rows()(i, 1) = norm(i) * sums_(load, i);
    result.frequency_derivative[3 * i] = norm(i) * (sums_(by_frequency, i) + frequency_memory_[i]);
    for (Eigen::Index j = 1; j < n; ++j)
      result.jacobian(3 * i, 3 * j) = norm(i) * memory_by_u_(i, j);
    result.jacobian(3 * i, 0) = norm(i) * virgin_[i];
    for (Eigen::Index j = 0; j < n; ++j) {
      result.jacobian(3 * i, 3 * j + 1) = norm(i) * memory_by_v_(i, j);
    }
  }
  moments_.reset(2 * H);
  const auto add = [&](Sum sum, Eigen::Index row, Eigen::Index column, Eigen::Index first) {
    of_one_ = sums_.row(sum).transpose();
    moments_.set_sums(of_one_.data());
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = first; j < n; ++j) {
        result.jacobian(3 * i + row, 3 * j + column) +=
            norm(i) * moments_.product(static_cast<int>(i), static_cast<int>(j));
      }
    }
  };
  add(load_by_v, 1, 1, 0);
  add(by_u, 0, 0, 1);
  add(by_v, 0, 1, 0);
  if (sums_.row(by_velocity).isZero(0.0)) return;
  of_one_ = sums_.row(by_velocity).transpose();
  moments_.set_sums(of_one_.data());
  for (int i = 0; i < static_cast<int>(n); ++i) {
    for (int j = 1; j < static_cast<int>(n); ++j) {
      const int h = (j + 1) / 2;  // the derivative of the basis is the basis, turned and scaled
      const double product =
          j % 2 == 1 ? h * moments_.product(i, j + 1) : -h * moments_.product(i, j - 1);
      result.jacobian(3 * i, 3 * j) += norm(i) * product;
    }
  }
}

}  // namespace microslip::contact
