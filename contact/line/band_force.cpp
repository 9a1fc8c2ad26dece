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
    visit_piece(band, piece, band.n_harmonics(), BandIntegrals::forces_and_slip,
                [&](const BandInstant& now, double friction, const auto&, double weight) {
                  const double way = weight * std::abs(now.velocity - sign * now.reach_rate);
                  work.slip_distance += way;
                  work.normal_slip += way * now.surface.load;
                  work.dissipated_energy += weight * band_slip_power(piece, now, friction);
                });
  }
  return work;
}

Harmonics band_force(SliderBand& band, const BandCycle& cycle, int n_harmonics) {
  Harmonics force(n_harmonics, n_point_signals);
  const Eigen::Index n = force.rows().rows();
  for (const BandPiece& piece : cycle.pieces) {
    if (piece.state == ContactState::separated) continue;
    visit_piece(band, piece, n_harmonics, BandIntegrals::forces,
                [&](const BandInstant& now, double friction, const auto& basis, double weight) {
                  force.rows().col(0) += (weight * friction) * basis.head(n);
                  force.rows().col(1) += (weight * now.surface.load) * basis.head(n);
                });
  }
  force.rows() /= std::numbers::pi;
  force.rows().row(0) *= 0.5;
  return force;
}

void BandTraction::set(SliderBand& band, const BandCycle& cycle, PointTraction& result) {
  const Eigen::Index n = 2 * band.n_harmonics() + 1;
  sums_.setZero(2 * n - 1, n_sums);
  virgin_.setZero(n);
  frequency_memory_.setZero(n);
  memory_by_u_.setZero(n, n);
  memory_by_v_.setZero(n, n);
  for (const BandPiece& piece : cycle.pieces) {
    result.period.set(piece.state, piece.begin, piece.end - piece.begin);
    if (piece.state != ContactState::separated) add_piece(band, piece);
  }
  result.regime = cycle.regime;
  result.defect = 0.0;
  write(result);
}

void BandTraction::add_piece(SliderBand& band, const BandPiece& piece) {
  piece_.setZero(sums_.rows(), n_sums);
  const double k_u = band.law().first_stiffness();
  const bool rate_dependent = band.law().is_rate_dependent();
  const bool sticks = piece.state == ContactState::stick;
  const double sign = piece.slip_sign();
  Eigen::Matrix<double, 1, n_sums> row = Eigen::Matrix<double, 1, n_sums>::Zero();
  visit_piece(band, piece, band.n_harmonics(), BandIntegrals::forces,
              [&](const BandInstant& now, double force, const auto& basis, double weight) {
                const SurfaceState& y = now.surface;
                row[friction] = force;
                row[load] = y.load;
                row[load_by_v] = y.load_by_approach;
                if (sticks && band.has_spring()) {
                  row[by_u] = k_u * y.stiffness_ratio;
                  row[by_v] = k_u * y.stiffness_ratio_by_approach * (now.position - piece.slider);
                } else if (!sticks) {
                  row[by_v] = sign * y.friction_coefficient * y.load_by_approach;
                }
                if (!sticks && rate_dependent) {
                  const double by_rate = sign * y.load * y.friction_coefficient_by_rate;
                  row[by_velocity] = by_rate * band.frequency() * std::copysign(1.0, now.velocity);
                  row[by_frequency] = by_rate * std::abs(now.velocity);
                }
                for (Eigen::Index j = 0; j < n_sums; ++j) {
                  if (row[j] != 0.0) piece_.col(j) += (weight * row[j]) * basis;
                }
              });
  sums_ += piece_;
  if (sticks && band.has_spring()) add_memory(band, piece);
}

void BandTraction::add_memory(SliderBand& band, const BandPiece& piece) {
  const auto held = piece_.col(by_u).head(virgin_.size());
  if (piece.origin == SliderOrigin::virgin) {
    virgin_ += held;
    return;
  }
  const BandInstant now = piece.stood ? band.at_turn(piece.memory.phase()) : band.at(piece.memory);
  const Eigen::VectorXd basis = band.basis().head(virgin_.size());
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
    result.force.rows()(i, 0) = norm(i) * sums_(i, friction);
    result.force.rows()(i, 1) = norm(i) * sums_(i, load);
    result.frequency_derivative[3 * i] = norm(i) * (sums_(i, by_frequency) + frequency_memory_[i]);
    for (Eigen::Index j = 1; j < n; ++j)
      result.jacobian(3 * i, 3 * j) = norm(i) * memory_by_u_(i, j);
    result.jacobian(3 * i, 0) = norm(i) * virgin_[i];
    for (Eigen::Index j = 0; j < n; ++j) {
      result.jacobian(3 * i, 3 * j + 1) = norm(i) * memory_by_v_(i, j);
    }
  }
  moments_.reset(2 * H);
  const auto add = [&](Sum sum, Eigen::Index row, Eigen::Index column, Eigen::Index first) {
    moments_.set_sums(sums_.col(sum).data());
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
  if (sums_.col(by_velocity).isZero(0.0)) return;
  moments_.set_sums(sums_.col(by_velocity).data());
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
