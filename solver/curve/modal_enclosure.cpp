#include "solver/curve/modal_enclosure.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "contact/dense.hpp"

namespace microslip::solver {
namespace {

/// Relative error of a product of three n × n matrices, with room to spare.
double rounding_of(Eigen::Index n) {
  return 10.0 * static_cast<double>(n) * std::numeric_limits<double>::epsilon();
}

/// Room for the roundings of the bounds themselves.
constexpr double outwards = 1.0 + 1e-10;

/// Least |λ − ω² + iωc| of an interval of ω: a parabola of ω².
double least_distance(double lambda, double c, double low, double high) {
  const double square = std::clamp(lambda - 0.5 * c * c, low * low, high * high);
  return std::hypot(lambda - square, c * std::sqrt(square));
}

}  // namespace

/// Of every mode: (2), and δ; one that is not positive ends them.
struct ModalEnclosure::Discs {
  Eigen::VectorXcd centre;
  Eigen::VectorXd radius, largest, distance;
};

ModalEnclosure::ModalEnclosure(const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& damping,
                               const Eigen::VectorXcd& load) {
  const auto pairs = contact::symmetric_pairs(stiffness);
  if (!pairs) return;
  V_ = pairs->vectors;
  const Eigen::Index n = V_.rows();
  const double rounding = rounding_of(n);
  const Eigen::MatrixXd size = V_.cwiseAbs();
  const Eigen::MatrixXd K = V_.transpose() * stiffness * V_;
  const Eigen::MatrixXd C = V_.transpose() * damping.asDiagonal() * V_;
  const Eigen::MatrixXd W = V_.transpose() * V_ - Eigen::MatrixXd::Identity(n, n);
  lambda_ = K.diagonal();
  c_ = C.diagonal();
  of_stiffness_ = K.cwiseAbs();
  of_damping_ = C.cwiseAbs();
  of_stiffness_.diagonal().setZero();
  of_damping_.diagonal().setZero();
  of_stiffness_ += rounding * (size.transpose() * stiffness.cwiseAbs() * size);
  of_damping_ += rounding * (size.transpose() * damping.cwiseAbs().asDiagonal() * size);
  of_mass_ = W.cwiseAbs() + rounding * (size.transpose() * size);
  load_ = V_.transpose() * load;
  load_error_ = rounding * (size.transpose() * load.cwiseAbs());
}

ModalEnclosure::Discs ModalEnclosure::discs(double low, double high) const {
  const Eigen::Index n = lambda_.size();
  const double middle = 0.5 * (low + high);
  const double half = std::max(high - middle, middle - low);
  Discs all{Eigen::VectorXcd::Zero(n), Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n),
            Eigen::VectorXd::Zero(n)};
  for (Eigen::Index j = 0; j < n; ++j) {
    const std::complex<double> at(lambda_[j] - middle * middle, middle * c_[j]);
    // λ − ω² cancels at a resonance.
    const double lost = rounding_of(1) * (std::abs(lambda_[j]) + high * high);
    const double least = least_distance(lambda_[j], c_[j], low, high) - lost;
    all.distance[j] = least;
    if (!(least > 0.0)) break;  // an undamped resonance
    const double load = std::abs(load_[j]);
    const double error = (load_error_[j] + load * lost / std::abs(at)) / least;
    const double passed = half * (2.0 * middle + half + std::abs(c_[j]));
    const double apart = std::max(std::abs(at) - lost, least);
    const double narrow = load * passed / (apart * least);
    const double least_loss = low * c_[j];
    const double circle = least_loss > 0.0 ? 0.5 * load / least_loss : narrow;
    all.largest[j] = (load + load_error_[j]) / least;
    all.radius[j] = error + std::min({narrow, all.largest[j], circle});
    if (narrow <= std::min(all.largest[j], circle)) {
      all.centre[j] = load_[j] / at;
    } else if (circle < all.largest[j]) {
      all.centre[j] = std::complex<double>(0.0, -0.5 / least_loss) * load_[j];
    }
  }
  return all;
}

double ModalEnclosure::distance(double frequency) const {
  if (V_.size() == 0) return 0.0;
  const auto elastic = lambda_.array() - frequency * frequency;
  return std::sqrt((elastic.square() + (frequency * c_.array()).square()).minCoeff());
}

ModalBox ModalEnclosure::over(double low, double high) const {
  ModalBox box;
  if (V_.size() == 0) return box;
  const Discs own = discs(low, high);
  if (!(own.distance.minCoeff() > 0.0) || !own.radius.allFinite()) return box;  // NaN as well
  const Eigen::MatrixXd M = own.distance.cwiseInverse().asDiagonal() *
                            (of_stiffness_ + high * of_damping_ + high * high * of_mass_);
  // Modes without load are given some, so that the bound has room everywhere.
  constexpr double some = 1e-3;
  constexpr int rounds = 8;
  const Eigen::VectorXd first =
      own.largest + some * (M * own.largest) +
      Eigen::VectorXd::Constant(own.largest.size(), 1e-12 * own.largest.maxCoeff());
  Eigen::VectorXd bound = first;
  for (int i = 0; i < rounds; ++i) bound = first + M * bound;
  bound *= 1.01;
  const Eigen::VectorXd beside = outwards * (M * bound);
  if (!((first + beside).array() <= bound.array()).all()) return box;
  box.centre = V_ * own.centre;
  box.reach = outwards * (own.radius + beside);
  box.radius = rounding_of(V_.rows()) * (V_.cwiseAbs() * own.centre.cwiseAbs()).norm();
  return box;
}

}  // namespace microslip::solver
