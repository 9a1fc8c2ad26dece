#include "contact/plane/planar_variation.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/LU>

#include "contact/plane/planar_quadrature.hpp"
#include "contact/plane/planar_stick.hpp"

namespace microslip::contact {
namespace {

using Eigen::Index;
using Eigen::Vector2d;

Vector2d across(const Vector2d& e) { return {-e[1], e[0]}; }

/// Whether friction is too little to tell from rounding of x − s:
/// how long the point sticks is not known.
bool is_lost(const PlanarMotion& motion, const PlanarPiece& piece) {
  const auto is_little = [](const PlanarInstant& now) { return now.limit <= stick_slack; };
  return is_little(piece.at_begin) && is_little(motion.at(0.5 * (piece.begin + piece.end))) &&
         is_little(motion.at(piece.end));
}

}  // namespace

OrbitVariation::OrbitVariation(const PlanarMotion& motion, Columns columns)
    : motion_(motion),
      n_parameters_(columns == Columns::all ? 3 * (2 * motion.n_harmonics() + 1) + 1 : 0) {
  position_.setZero(2, n_parameters_);
  radius_.setZero(n_parameters_);
  stiffness_.setZero(n_parameters_);
  reach_.setZero(2, n_parameters_);
  ratio_.setZero(n_parameters_);
  force_now_.setZero(2, n_columns());
  stage_.setZero(2 * n_stages, n_parameters_);
  stage_radius_.setZero(n_stages, n_parameters_);
  stage_ratio_.setZero(n_stages, n_parameters_);
  right_.setZero(n_stages, n_columns());
  turn_.setZero(n_stages, n_columns());
  set_free_slider();
}

void OrbitVariation::set_free_slider() {
  slider_.setZero(2, n_columns());
  slider_.rightCols(2).setIdentity();
}

void OrbitVariation::set_virgin_slider() {
  slider_.setZero(2, n_columns());
  if (n_parameters_ == 0) return;
  slider_(0, 0) = -motion_.active()[0] / motion_.length_scale();
  slider_(1, 2) = -motion_.active()[1] / motion_.length_scale();
}

void OrbitVariation::set_corner_slider(const SliderCorner& corner) {
  slider_.setZero(2, n_columns());
  if (n_parameters_ == 0) return;
  Eigen::Matrix2d gradient;
  Eigen::Matrix2Xd excess(2, n_parameters_);
  for (Index i = 0; i < 2; ++i) {
    const CornerSide& side = corner.side[static_cast<std::size_t>(i)];
    const PlanarInstant now = motion_.at(side.phase);
    set_parameters(now);
    gradient.row(i) = side.gradient.transpose();
    // δ|K (x − s)| = e·(K δx + δK (x − s)), and K e = −∇G.
    const double second = side.force[1] / side.force.norm() * side.force[1] / now.stiffness[1];
    excess.row(i) = -side.gradient.transpose() * position_ + second * stiffness_ - radius_;
  }
  slider_.leftCols(n_parameters_) = -gradient.fullPivLu().solve(excess);
}

void OrbitVariation::carry(const PlanarOrbit& orbit) {
  integrates_ = false;
  pass(orbit);
}

void OrbitVariation::carry_and_integrate(const PlanarOrbit& orbit) {
  integrates_ = true;
  sum_.start(2 * motion_.n_harmonics() + 1, 2 * n_columns());
  pass(orbit);
  BasisProduct::Rows sum = sum_.sum() * (motion_.force_scale() / std::numbers::pi);
  sum.row(0) *= 0.5;
  force_ = {sum.leftCols(n_columns()), sum.rightCols(n_columns())};
}

void OrbitVariation::pass(const PlanarOrbit& orbit) {
  const PlanarPiece* before = nullptr;
  for (const PlanarPiece& piece : orbit.pieces) {
    const PlanarPiece* last = std::exchange(before, &piece);
    if (piece.state == ContactState::separated) continue;
    const bool stops =
        piece.state == ContactState::stick && last != nullptr && !last->steps.empty();
    if (stops) stop_at_turn(last->steps.back());
    if (piece.entry == PlanarEntry::touch_down) {
      touch_down(piece);
    } else if (piece.state == ContactState::slip) {
      begin_slip(piece);
    }
    for (const SlipStep& slip : piece.steps) step(slip);
    if (integrates_ && piece.state == ContactState::stick) integrate_stick(piece);
  }
}

void OrbitVariation::set_parameters(const PlanarInstant& now) {
  trigonometric_basis(motion_.n_harmonics(), now.phase, basis_);
  if (n_parameters_ == 0) return;
  const Vector2d x = motion_.active() / motion_.length_scale();
  for (Index k = 1; k < basis_.size(); ++k) {
    position_(0, 3 * k) = x[0] * basis_[k];
    position_(1, 3 * k + 2) = x[1] * basis_[k];
  }
  for (Index k = 0; k < basis_.size(); ++k) {
    radius_[3 * k + 1] = now.radius_by_approach * basis_[k];
  }
  if (motion_.law().is_rate_dependent()) set_rate_parameters(now);
  reach_.row(0) = radius_ / now.stiffness[0];
  reach_.row(1) = radius_ / now.stiffness[1];
  if (motion_.law().is_smooth()) return;
  for (Index k = 0; k < basis_.size(); ++k) {
    stiffness_[3 * k + 1] = now.stiffness_by_approach[1] * basis_[k];
    ratio_[3 * k + 1] = now.surface.stiffness_ratio_by_approach * basis_[k];
  }
  reach_.row(1) -= (now.reach()[1] / now.stiffness[1]) * stiffness_;
}

void OrbitVariation::set_rate_parameters(const PlanarInstant& now) {
  basis_rate(basis_, basis_rate_);
  const double by_rate = now.radius_by_rate * motion_.frequency();
  for (Index k = 0; k < basis_.size(); ++k) {
    radius_[3 * k] = by_rate * now.heading[0] * basis_rate_[k];
    radius_[3 * k + 2] = by_rate * now.heading[1] * basis_rate_[k];
  }
  radius_[n_parameters_ - 1] = now.radius_by_rate * now.speed;
}

void OrbitVariation::touch_down(const PlanarPiece& piece) {
  const PlanarInstant& now = piece.at_begin;
  set_parameters(now);
  slider_.setZero();
  slider_.leftCols(n_parameters_) = position_;
  if (n_parameters_ == 0 || now.approach_rate <= 0.0) return;
  Vector2d moved = now.velocity;
  if (piece.state == ContactState::slip) {
    // x' − ρe = r' C e, with e from the regular solution at r = 0.
    const Vector2d& k = now.stiffness;
    moved = returned_force(k.cwiseProduct(now.velocity), k, now.radius_rate).cwiseQuotient(k);
  }
  for (Index j = 0; j < basis_.size(); ++j) {
    slider_.col(3 * j + 1) -= moved * (basis_[j] / now.approach_rate);
  }
}

void OrbitVariation::stop_at_turn(const SlipStep& slip) {
  const PlanarInstant& now = slip.instant[n_stages - 1];
  const double rate = slip.rate(n_stages - 1);
  constexpr double stopped = 1e-9;  // slip that ends by itself has no rate left
  if (n_parameters_ == 0 || !motion_.law().is_rate_dependent() || rate <= stopped) return;
  const Vector2d acceleration = motion_.tangential_acceleration(now.phase);
  const double square = acceleration.squaredNorm();
  constexpr double standing = 1e-7;  // beside its acceleration: nearer to 0 than events are located
  if (!(square > 0.0) || now.speed > standing * std::sqrt(square)) return;
  trigonometric_basis(motion_.n_harmonics(), now.phase, basis_);
  basis_rate(basis_, basis_rate_);
  const Vector2d moved = rate * slip.direction.col(n_stages - 1);
  for (Index k = 1; k < basis_.size(); ++k) {
    slider_.col(3 * k) -= moved * (acceleration[0] * basis_rate_[k] / square);
    slider_.col(3 * k + 2) -= moved * (acceleration[1] * basis_rate_[k] / square);
  }
}

void OrbitVariation::begin_slip(const PlanarPiece& piece) {
  const PlanarInstant& now = piece.at_begin;
  const Vector2d force = now.force(piece.slider);
  const double size = force.norm();
  if (size <= 0.0) return;
  const Vector2d e = force / size;
  const Vector2d normal = across(e);
  const Vector2d turn = -now.reach().cwiseProduct(normal);
  const double distance =
      piece.entry == PlanarEntry::returned ? e.dot(piece.slider - piece.before) : 0.0;
  const double divisor = distance - normal.dot(turn);
  if (!(divisor > 0.0)) return;
  set_parameters(now);
  slider_ = -slider_;
  slider_.leftCols(n_parameters_) += position_ - e.asDiagonal() * reach_;
  const Eigen::RowVectorXd angle = (normal.transpose() * slider_) / divisor;
  slider_ = turn * angle;
  slider_.leftCols(n_parameters_) += position_ - e.asDiagonal() * reach_;
}

void OrbitVariation::step(const SlipStep& slip) {
  const RadauNodes& rule = radau_nodes();
  const Index n = n_parameters_;
  for (int j = 0; j < n_stages; ++j) {
    const Vector2d e = slip.direction.col(j);
    set_parameters(slip.instant[static_cast<std::size_t>(j)]);
    stage_basis_[static_cast<std::size_t>(j)] = basis_;
    stage_.row(2 * j) = position_.row(0) - e[0] * reach_.row(0);
    stage_.row(2 * j + 1) = position_.row(1) - e[1] * reach_.row(1);
    stage_radius_.row(j) = radius_;
    stage_ratio_.row(j) = ratio_;
  }
  for (int i = 0; i < n_stages; ++i) {
    const Vector2d normal = across(slip.direction.col(i));
    const Vector2d begin = -rule.derivative(i, 0) * normal;
    right_.row(i) = begin[0] * slider_.row(0) + begin[1] * slider_.row(1);
    for (int j = 0; j < n_stages; ++j) {
      const Vector2d moved = -rule.derivative(i, j + 1) * normal;
      right_.row(i).head(n) += moved[0] * stage_.row(2 * j) + moved[1] * stage_.row(2 * j + 1);
    }
  }
  slip.factor.solve(right_, turn_);
  for (int i = 0; i < n_stages && integrates_; ++i) integrate_slip(slip, i);
  const int last = n_stages - 1;
  const Vector2d e = slip.direction.col(last);
  const Vector2d turned = -slip.instant[last].reach().cwiseProduct(across(e));
  slider_.row(0) = turned[0] * turn_.row(last);
  slider_.row(1) = turned[1] * turn_.row(last);
  slider_.leftCols(n) += stage_.bottomRows<2>();
}

void OrbitVariation::integrate_slip(const SlipStep& step, int stage) {
  const auto i = static_cast<std::size_t>(stage);
  const PlanarInstant& now = step.instant[i];
  const Vector2d e = step.direction.col(stage);
  const Vector2d normal = (now.surface.stiffness_ratio * now.limit) * across(e);
  auto row = sum_.add(stage_basis_[i], step.length * radau_nodes().weight[i]);
  for (int k = 0; k < 2; ++k) {
    row.segment(k * n_columns(), n_columns()) = normal[k] * turn_.row(stage);
    row.segment(k * n_columns(), n_parameters_) +=
        (e[k] * now.surface.stiffness_ratio) * stage_radius_.row(stage) +
        (e[k] * now.limit) * stage_ratio_.row(stage);
  }
}

void OrbitVariation::integrate_lost_stick(const PlanarPiece& piece) {
  const PlanarInstant& now = piece.at_begin;
  const Vector2d active = motion_.active();
  const Vector2d bend = motion_.tangential_acceleration(now.phase).cwiseProduct(active);
  const double size = bend.norm();
  const double speed = now.velocity.norm() * motion_.length_scale();
  if (n_parameters_ == 0 || !(2.0 * speed < size * (piece.end - piece.begin))) return;
  trigonometric_basis(motion_.n_harmonics(), now.phase, basis_);
  basis_rate(basis_, basis_rate_);
  const Vector2d e = bend / size;
  const double jump = 2.0 * now.limit * now.surface.stiffness_ratio;
  force_now_.setZero();
  for (Index k = 1; k < basis_.size(); ++k) {
    force_now_.col(3 * k) = (jump * e[0] * active[0] * basis_rate_[k] / size) * e;
    force_now_.col(3 * k + 2) = (jump * e[1] * active[1] * basis_rate_[k] / size) * e;
  }
  add_force(1.0);
}

void OrbitVariation::integrate_stick(const PlanarPiece& piece) {
  if (is_lost(motion_, piece)) return integrate_lost_stick(piece);
  const auto add = [&](const PlanarInstant& now, double weight) {
    set_parameters(now);
    const double ratio = now.surface.stiffness_ratio;
    const Vector2d force = now.force(piece.slider);
    const Vector2d stiffness = ratio * now.stiffness;
    force_now_.noalias() = (-stiffness).asDiagonal() * slider_;
    force_now_.leftCols(n_parameters_).noalias() += stiffness.asDiagonal() * position_;
    force_now_.leftCols(n_parameters_).noalias() += force * ratio_;
    force_now_.row(1).leftCols(n_parameters_) += (ratio * force[1] / now.stiffness[1]) * stiffness_;
    add_force(weight);
  };
  visit_nodes(motion_, piece.begin, piece.end, motion_.n_harmonics(), add);
}

void OrbitVariation::add_force(double weight) {
  auto row = sum_.add(basis_, weight);
  row.head(n_columns()) = force_now_.row(0);
  row.tail(n_columns()) = force_now_.row(1);
}

}  // namespace microslip::contact
