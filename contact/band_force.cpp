#include "contact/band_force.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "contact/gauss_legendre.hpp"
#include "contact/planar_quadrature.hpp"

namespace microslip::contact {
namespace {

using Points = Eigen::Matrix<double, n_gauss, 1>;

/// On [−1, 1], with the shares of the two highest Legendre polynomials: one alone would miss functions
/// that are even or odd about the middle.
struct Panel {
  Points node, weight, sixth, seventh;
};

Panel make_panel() {
  const LineRule rule = gauss_legendre(n_gauss);
  Panel panel;
  for (int i = 0; i < n_gauss; ++i) {
    const double x = 2.0 * rule.nodes[i] - 1.0;
    panel.node[i] = x;
    panel.weight[i] = 2.0 * rule.weights[i];
    panel.sixth[i] = 6.5 * panel.weight[i] * std::legendre(6, x);
    panel.seventh[i] = 7.5 * panel.weight[i] * std::legendre(7, x);
  }
  return panel;
}

const Panel& panel() {
  static const Panel rule = make_panel();
  return rule;
}

double top_term(const Points& values) {
  return std::max(std::abs(panel().sixth.dot(values)), std::abs(panel().seventh.dot(values)));
}

/// Nodes of one panel if forces are resolved there, else those of its halves.
template <typename Visit>
void visit_panel(SliderBand& band, const BandPiece& piece, double begin, double end, int depth,
                 const Visit& visit) {
  std::array<BandInstant, n_gauss> instant;
  Points friction, load;
  const double half = 0.5 * (end - begin);
  for (int i = 0; i < n_gauss; ++i) {
    BandInstant& now = instant[static_cast<std::size_t>(i)];
    now = band.at(begin + half * (1.0 + panel().node[i]));
    friction[i] = band_friction(band, piece, now);
    load[i] = now.surface.load;
  }
  // The rule is exact to degree 15: what is left out is about the square of the term of degree 7.
  constexpr double resolved = 1e-8;
  const bool smooth = band.law().is_smooth() && !band.law().is_rate_dependent();
  const bool done = smooth || depth == 0 ||
                    (top_term(friction) <= resolved * band.friction_size() &&
                     top_term(load) <= resolved * band.load_size());
  if (!done) {
    visit_panel(band, piece, begin, begin + half, depth - 1, visit);
    visit_panel(band, piece, begin + half, end, depth - 1, visit);
    return;
  }
  for (int i = 0; i < n_gauss; ++i) {
    visit(instant[static_cast<std::size_t>(i)], friction[i], half * panel().weight[i]);
  }
}

/// Calls visit(instant, friction, weight) at the nodes of a piece, for products with harmonics up to
/// `highest`.
template <typename Visit>
void visit_piece(SliderBand& band, const BandPiece& piece, int highest, const Visit& visit) {
  // A wave of k oscillations per 2π over a panel of length h errs by 2e-18 (kh/2)¹⁶.
  const double longest = 3.0 / (band.n_harmonics() + highest);
  const double length = piece.end - piece.begin;
  const int n = static_cast<int>(std::ceil(length / longest));
  constexpr int deepest = 30;  // of a layer that depends on the rate: to 1e-9 of a panel
  for (int i = 0; i < n; ++i) {
    visit_panel(band, piece, piece.begin + length * i / n, piece.begin + length * (i + 1) / n,
                deepest, visit);
  }
}

double sign_of(const BandPiece& piece) {
  return piece.state == ContactState::positive_slip ? 1.0 : -1.0;
}

}  // namespace

double band_friction(const SliderBand& band, const BandPiece& piece, const BandInstant& now) {
  if (!band.has_spring() || piece.state == ContactState::separated) return 0.0;
  const SurfaceState& y = now.surface;
  if (piece.state != ContactState::stick) {
    return sign_of(piece) * y.friction_coefficient * y.load;
  }
  return band.law().first_stiffness() * y.stiffness_ratio * (now.position - piece.slider);
}

BandWork band_work(SliderBand& band, const BandCycle& cycle) {
  BandWork work;
  if (!band.has_spring()) return work;
  for (const BandPiece& piece : cycle.pieces) {
    if (piece.state == ContactState::separated || piece.state == ContactState::stick) continue;
    const double sign = sign_of(piece);
    visit_piece(band, piece, band.n_harmonics(),
                [&](const BandInstant& now, double friction, double weight) {
                  const double way = weight * std::abs(now.velocity - sign * now.reach_rate);
                  work.slip_distance += way;
                  work.normal_slip += way * now.surface.load;
                  work.dissipated_energy += way * std::abs(friction);
                });
  }
  return work;
}

Harmonics band_force(SliderBand& band, const BandCycle& cycle, int n_harmonics) {
  Harmonics force(n_harmonics, n_point_signals);
  Eigen::VectorXd basis;
  for (const BandPiece& piece : cycle.pieces) {
    if (piece.state == ContactState::separated) continue;
    visit_piece(band, piece, n_harmonics,
                [&](const BandInstant& now, double friction, double weight) {
                  trigonometric_basis(n_harmonics, now.phase, basis);
                  force.rows().col(0) += (weight * friction) * basis;
                  force.rows().col(1) += (weight * now.surface.load) * basis;
                });
  }
  force.rows() /= std::numbers::pi;
  force.rows().row(0) *= 0.5;
  return force;
}

void BandTraction::set(SliderBand& band, const BandCycle& cycle, PointTraction& result) {
  const Eigen::Index n = 2 * band.n_harmonics() + 1;
  for (Eigen::VectorXd* sum : {&friction_, &load_, &by_frequency_, &virgin_}) sum->setZero(n);
  for (Eigen::MatrixXd* sum : {&by_u_, &by_v_, &load_by_v_}) sum->setZero(n, n);
  for (const BandPiece& piece : cycle.pieces) {
    if (piece.state != ContactState::separated) add_piece(band, piece);
  }
  by_u_.col(0) = virgin_;
  result.regime = cycle.regime;
  result.defect = 0.0;
  write(result);
}

void BandTraction::add_piece(SliderBand& band, const BandPiece& piece) {
  held_.setZero(friction_.size());
  const int H = band.n_harmonics();
  visit_piece(band, piece, H, [&](const BandInstant& now, double friction, double weight) {
    trigonometric_basis(H, now.phase, basis_);
    load_ += (weight * now.surface.load) * basis_;
    load_by_v_.noalias() += (weight * now.surface.load_by_approach * basis_) * basis_.transpose();
    if (!band.has_spring()) return;
    friction_ += (weight * friction) * basis_;
    if (piece.state == ContactState::stick) {
      add_stick(band, now, piece.slider, weight);
    } else {
      add_slip(band, now, sign_of(piece), weight);
    }
  });
  if (piece.state == ContactState::stick && band.has_spring()) add_memory(band, piece);
}

void BandTraction::add_stick(const SliderBand& band, const BandInstant& now, double slider,
                             double weight) {
  const SurfaceState& y = now.surface;
  const double stiffness = weight * band.law().first_stiffness() * y.stiffness_ratio;
  held_ += stiffness * basis_;
  by_u_.noalias() += (stiffness * basis_) * basis_.transpose();
  if (y.stiffness_ratio_by_approach == 0.0) return;
  const double by_v = weight * band.law().first_stiffness() * y.stiffness_ratio_by_approach *
                      (now.position - slider);
  by_v_.noalias() += (by_v * basis_) * basis_.transpose();
}

void BandTraction::add_slip(const SliderBand& band, const BandInstant& now, double sign,
                            double weight) {
  const SurfaceState& y = now.surface;
  const double by_v = sign * weight * y.friction_coefficient * y.load_by_approach;
  by_v_.noalias() += (by_v * basis_) * basis_.transpose();
  if (!band.law().is_rate_dependent()) return;
  const double by_rate = sign * weight * y.load * y.friction_coefficient_by_rate;
  basis_rate(basis_, basis_rate_);
  const double by_velocity = by_rate * band.frequency() * std::copysign(1.0, now.velocity);
  by_u_.noalias() += (by_velocity * basis_) * basis_rate_.transpose();
  by_frequency_ += (by_rate * std::abs(now.velocity)) * basis_;
}

void BandTraction::add_memory(SliderBand& band, const BandPiece& piece) {
  if (piece.origin == SliderOrigin::virgin) {
    virgin_ += held_;
    return;
  }
  const BandInstant now = piece.stood ? band.at_turn(piece.memory) : band.at(piece.memory);
  trigonometric_basis(band.n_harmonics(), piece.memory, basis_);
  basis_rate(basis_, basis_rate_);
  slider_by_u_ = basis_;
  double by_v = 0.0;
  if (piece.origin == SliderOrigin::touch_down) {
    if (now.approach_rate > 0.0) by_v = -now.velocity / now.approach_rate;
  } else {
    const double sign = piece.origin == SliderOrigin::positive_slip ? 1.0 : -1.0;
    by_v = -sign * now.reach_by_approach;
    if (!piece.stood) {
      const double heading = std::copysign(1.0, now.velocity);
      slider_by_u_ -= (sign * now.reach_by_rate * band.frequency() * heading) * basis_rate_;
      by_frequency_ += (sign * now.reach_by_rate * std::abs(now.velocity)) * held_;
    } else if (now.acceleration != 0.0) {
      const double drift = now.reach_by_approach * now.approach_rate / now.acceleration;
      slider_by_u_ += (sign * drift) * basis_rate_;
    }
  }
  by_u_.noalias() -= held_ * slider_by_u_.transpose();
  by_v_.noalias() -= held_ * (by_v * basis_).transpose();
}

void BandTraction::write(PointTraction& result) const {
  const Eigen::Index n = friction_.size();
  const int H = static_cast<int>(n / 2);
  result.force = Harmonics(H, n_point_signals);
  result.jacobian.setZero(n_point_signals * n, n_point_signals * n);
  result.frequency_derivative.setZero(n_point_signals * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double scale = (i == 0 ? 0.5 : 1.0) / std::numbers::pi;
    result.force.rows()(i, 0) = scale * friction_[i];
    result.force.rows()(i, 1) = scale * load_[i];
    result.frequency_derivative[3 * i] = scale * by_frequency_[i];
    for (Eigen::Index j = 0; j < n; ++j) {
      result.jacobian(3 * i, 3 * j) = scale * by_u_(i, j);
      result.jacobian(3 * i, 3 * j + 1) = scale * by_v_(i, j);
      result.jacobian(3 * i + 1, 3 * j + 1) = scale * load_by_v_(i, j);
    }
  }
}

}  // namespace microslip::contact
