#include "tests/verification/truth/balance.hpp"

#include <cmath>
#include <numbers>

namespace microslip::truth {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

/// Values of 1, sin kθ, cos kθ at the instants: n × (2H+1).
MatrixXd trigonometric(int harmonics, int n) {
  MatrixXd result(n, 2 * harmonics + 1);
  for (int i = 0; i < n; ++i) {
    const double theta = 2.0 * std::numbers::pi * i / n;
    result(i, 0) = 1.0;
    for (int k = 1; k <= harmonics; ++k) {
      result(i, 2 * k - 1) = std::sin(k * theta);
      result(i, 2 * k) = std::cos(k * theta);
    }
  }
  return result;
}

VectorXcd amplitude(const MatrixXd& columns, int k) {
  if (k == 0) return columns.col(0).cast<std::complex<double>>();
  return columns.col(2 * k - 1) + std::complex<double>(0.0, 1.0) * columns.col(2 * k);
}

template <typename Columns>
void set_amplitude(Columns&& columns, int k, const VectorXcd& value) {
  if (k == 0) {
    columns.col(0) = value.real();
    return;
  }
  columns.col(2 * k - 1) = value.real();
  columns.col(2 * k) = value.imag();
}

}  // namespace

Balance::Balance(const FaceModel& model, const ContactConstants& contact,
                 const BalanceOptions& options)
    : model_(model),
      contact_(contact),
      options_(options),
      n_face_((options.planar ? 3 : 2) * model.n_nodes()),
      n_rows_(2 * options.harmonics + 1),
      shapes_(model.at_face.leftCols(n_face_)),
      to_time_(trigonometric(options.harmonics, options.instants)),
      from_time_(to_time_.transpose() * (2.0 / options.instants)),
      to_nodes_(model.weights.asDiagonal() * model.to_points) {
  from_time_.row(0) *= 0.5;
  static_flexibility_ = shapes_.transpose() *
                        model.frequency.array().square().inverse().matrix().asDiagonal() * shapes_;
}

PointHistory Balance::at_points(const VectorXd& x) const {
  const Index n = model_.n_nodes();
  const Eigen::Map<const MatrixXd> rows(x.data(), n_face_, n_rows_);
  const auto along = [&](Index axis) -> MatrixXd {
    return to_time_ * (model_.to_points * rows.middleRows(axis * n, n)).transpose();
  };
  PointHistory result{along(0), along(1), {}};
  if (options_.planar) result.w = along(2);
  return result;
}

MatrixXd Balance::harmonics_of(const PointHistory& tractions) const {
  const Index n = model_.n_nodes();
  MatrixXd result(n_face_, n_rows_);
  const auto set = [&](Index axis, const MatrixXd& history) {
    result.middleRows(axis * n, n) = to_nodes_.transpose() * (from_time_ * history).transpose();
  };
  set(0, tractions.u);
  set(1, tractions.v);
  if (options_.planar) set(2, tractions.w);
  return result;
}

VectorXcd Balance::compliance(int k) const {
  const double w = k * omega_;
  VectorXcd result(model_.frequency.size());
  for (Index n = 0; n < result.size(); ++n) {
    const double natural = model_.frequency[n];
    result[n] = 1.0 / std::complex<double>(natural * natural - w * w,
                                           2.0 * model_.damping_ratio * natural * w);
  }
  return result;
}

MatrixXd Balance::modal_answer(const MatrixXd& forces, bool excited) const {
  const MatrixXd modal = shapes_ * forces;
  MatrixXd result(modal.rows(), n_rows_);
  for (int k = 0; k <= options_.harmonics; ++k) {
    VectorXcd load = -amplitude(modal, k);
    if (excited && k == 1) load += model_.force.cast<std::complex<double>>();
    set_amplitude(result, k, compliance(k).cwiseProduct(load));
  }
  return result;
}

VectorXd Balance::answer(const MatrixXd& forces, bool excited) const {
  return (shapes_.transpose() * modal_answer(forces, excited)).reshaped();
}

VectorXd Balance::residual(const VectorXd& x, double omega) {
  omega_ = omega;
  motion_ = at_points(x);
  TractionResult at = tractions(contact_, motion_);
  if (contact_.pressure > 0.0) at.tractions.v.array() -= contact_.pressure;
  forces_ = harmonics_of(at.tractions);
  shares_ = std::move(at.shares);
  return x - answer(forces_, true);
}

VectorXd Balance::tangent(const VectorXd& change) const {
  return change - answer(harmonics_of(truth::tangent(contact_, motion_, at_points(change))), false);
}

VectorXd Balance::by_omega() const {
  MatrixXd q = modal_answer(forces_, true);
  for (int k = 0; k <= options_.harmonics; ++k) {
    VectorXcd rate(q.rows());
    for (Index n = 0; n < rate.size(); ++n) {
      rate[n] = std::complex<double>(-2.0 * k * k * omega_,
                                     2.0 * model_.damping_ratio * model_.frequency[n] * k);
    }
    set_amplitude(q, k, rate.cwiseProduct(compliance(k)).cwiseProduct(amplitude(q, k)));
  }
  return (shapes_.transpose() * q).reshaped();
}

void Balance::prepare() {
  const Index n = model_.n_nodes();
  MatrixXd stiffness = MatrixXd::Zero(n_face_, n_face_);
  const auto block = [&](const VectorXd& share, double k) -> MatrixXd {
    const VectorXd density = k * model_.weights.cwiseProduct(share);
    return model_.to_points.transpose() * density.asDiagonal() * model_.to_points;
  };
  const MatrixXd tangential = block(shares_.stick, contact_.tangential_stiffness);
  stiffness.topLeftCorner(n, n) = tangential;
  stiffness.block(n, n, n, n) = block(shares_.contact, contact_.normal_stiffness);
  if (options_.planar) stiffness.bottomRightCorner(n, n) = tangential;
  preconditioner_.clear();
  const MatrixXd at_rest = MatrixXd::Identity(n_face_, n_face_) + static_flexibility_ * stiffness;
  for (int k = 0; k <= options_.harmonics; ++k) {
    // Shapes far above kω answer as at rest: one product for all harmonics.
    const Index near = (model_.frequency.array() < 3.0 * k * omega_).count();
    const auto low = shapes_.topRows(near);
    const VectorXcd low_flexibility = compliance(k).head(near) - model_.frequency.head(near)
                                                                     .array()
                                                                     .square()
                                                                     .inverse()
                                                                     .matrix()
                                                                     .cast<std::complex<double>>();
    Eigen::MatrixXcd P = at_rest.cast<std::complex<double>>();
    if (near > 0) P += low.transpose() * low_flexibility.asDiagonal() * (low * stiffness);
    preconditioner_.emplace_back(P);
  }
}

VectorXd Balance::precondition(const VectorXd& r) const {
  const Eigen::Map<const MatrixXd> rows(r.data(), n_face_, n_rows_);
  MatrixXd result(n_face_, n_rows_);
  for (int k = 0; k <= options_.harmonics; ++k) {
    set_amplitude(result, k,
                  preconditioner_[static_cast<std::size_t>(k)].solve(amplitude(rows, k)));
  }
  return result.reshaped();
}

Balance::Output Balance::output() const {
  const VectorXd y = modal_answer(forces_, true).transpose() * model_.output;
  constexpr int instants = 4096;
  VectorXd history = trigonometric(options_.harmonics, instants) * y;
  return {0.5 * (history.maxCoeff() - history.minCoeff()), std::hypot(y[1], y[2])};
}

MatrixXd Balance::shapes() const { return modal_answer(forces_, true); }

}  // namespace microslip::truth
