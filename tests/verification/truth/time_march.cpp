#include "tests/verification/truth/time_march.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <Eigen/LU>
#include <unsupported/Eigen/MatrixFunctions>

#include "tests/verification/truth/return_step.hpp"

namespace microslip::truth {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What a step makes of a shape at its begin, and of the forces at both ends; n_shapes each.
struct StepFactors {
  VectorXd from_q, from_v, from_force, by_force;          // q at the end
  VectorXd v_from_q, v_from_v, v_from_force, v_by_force;  // q̇/ω at the end
};

/// In the time ωt of each shape, (q, q′, p/ω², its slope) has a matrix exponential.
StepFactors step_factors(const FaceModel& model, double h) {
  const Index n = model.frequency.size();
  StepFactors f;
  for (VectorXd* one : {&f.from_q, &f.from_v, &f.from_force, &f.by_force, &f.v_from_q, &f.v_from_v,
                        &f.v_from_force, &f.v_by_force}) {
    one->resize(n);
  }
  for (Index i = 0; i < n; ++i) {
    const double omega = model.frequency[i];
    const double turn = omega * h;
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
    A(0, 1) = A(1, 2) = A(2, 3) = 1.0;
    A(1, 0) = -1.0;
    A(1, 1) = -2.0 * model.damping_ratio;
    const Eigen::Matrix4d step = (turn * A).exp();
    const double flexibility = 1.0 / (omega * omega);
    f.from_q[i] = step(0, 0);
    f.from_v[i] = step(0, 1);
    f.from_force[i] = flexibility * (step(0, 2) - step(0, 3) / turn);
    f.by_force[i] = flexibility * step(0, 3) / turn;
    f.v_from_q[i] = step(1, 0);
    f.v_from_v[i] = step(1, 1);
    f.v_from_force[i] = flexibility * (step(1, 2) - step(1, 3) / turn);
    f.v_by_force[i] = flexibility * step(1, 3) / turn;
  }
  return f;
}

class March {
 public:
  March(const FaceModel& model, const ContactConstants& contact, bool planar,
        const MatrixXd& shapes, double omega, int steps)
      : model_(model),
        contact_(contact),
        planar_(planar),
        n_axes_(planar ? 3 : 2),
        n_nodes_(model.n_nodes()),
        steps_(steps),
        factors_(step_factors(model, 2.0 * std::numbers::pi / omega / steps)),
        face_(model.at_face.leftCols(n_axes_ * n_nodes_)),
        flexibility_(face_.transpose() * factors_.by_force.asDiagonal() * face_) {
    begin(shapes, omega);
  }

  /// @return half peak-to-peak of the output.
  double period() {
    double high = -1e300;
    double low = 1e300;
    for (int i = 1; i <= steps_; ++i) {
      step(std::sin(2.0 * std::numbers::pi * i / steps_));
      const double output = model_.output.dot(q_);
      high = std::max(high, output);
      low = std::min(low, output);
    }
    return 0.5 * (high - low);
  }

 private:
  /// A phase of the balance: motion of the shapes there.
  static VectorXd at_phase(const MatrixXd& shapes, double theta) {
    VectorXd q = shapes.col(0);
    for (Index k = 1; 2 * k < shapes.cols(); ++k) {
      q += std::sin(static_cast<double>(k) * theta) * shapes.col(2 * k - 1) +
           std::cos(static_cast<double>(k) * theta) * shapes.col(2 * k);
    }
    return q;
  }

  /// Sliders come to the cycle of the balance within two periods of its motion.
  void begin(const MatrixXd& shapes, double omega) {
    for (int i = 0; i <= 2 * steps_; ++i) {
      const VectorXd q = at_phase(shapes, 2.0 * std::numbers::pi * i / steps_);
      motion_ = face_.transpose() * q;
      const MatrixXd at = at_points(motion_);
      if (i == 0) sliders_.resize(static_cast<std::size_t>(at.rows()));
      for (Index j = 0; j < at.rows(); ++j) {
        Slider<double>& slider = sliders_[static_cast<std::size_t>(j)];
        slider = i == 0 ? first_instant<double>(contact_, planar_, triple(at, j))
                        : next_instant<double>(contact_, planar_, slider, triple(at, j));
      }
    }
    q_ = at_phase(shapes, 0.0);
    v_.setZero(q_.size());
    for (Index k = 1; 2 * k < shapes.cols(); ++k) {
      v_ += static_cast<double>(k) * omega * shapes.col(2 * k - 1);
    }
    v_ = v_.cwiseQuotient(model_.frequency);
    MatrixXd tractions(std::ssize(sliders_), n_axes_);
    for (Index j = 0; j < tractions.rows(); ++j) {
      set(tractions, j, sliders_[static_cast<std::size_t>(j)].force);
    }
    force_ = -face_ * on_nodes(tractions);
  }

  /// n_points × axes.
  [[nodiscard]] MatrixXd at_points(const VectorXd& face) const {
    return model_.to_points * face.reshaped(n_nodes_, n_axes_);
  }

  [[nodiscard]] Triple<double> triple(const MatrixXd& rows, Index point) const {
    return {rows(point, 0), rows(point, 1), planar_ ? rows(point, 2) : 0.0};
  }

  /// The preload balances the static loads.
  void set(MatrixXd& rows, Index point, const Triple<double>& force) const {
    rows(point, 0) = force.u;
    rows(point, 1) = force.v - std::max(contact_.pressure, 0.0);
    if (planar_) rows(point, 2) = force.w;
  }

  [[nodiscard]] VectorXd on_nodes(const MatrixXd& tractions) const {
    return (model_.to_points.transpose() * (model_.weights.asDiagonal() * tractions)).reshaped();
  }

  /// Derivatives of a point's tractions: rows force, columns motion.
  [[nodiscard]] Eigen::Matrix3d derivatives(const Slider<double>& before,
                                            const Triple<double>& motion) const {
    const auto fixed = [](const Triple<double>& x) { return Triple<Dual>{x.u, x.v, x.w}; };
    const Slider<Dual> from{fixed(before.motion), before.gap, fixed(before.force), before.state};
    Eigen::Matrix3d result;
    for (Index axis = 0; axis < 3; ++axis) {
      Triple<Dual> x = fixed(motion);
      (axis == 0 ? x.u : (axis == 1 ? x.v : x.w)).rate = 1.0;
      const Triple<Dual> force = next_instant<Dual>(contact_, planar_, from, x).force;
      result.col(axis) << force.u.rate, force.v.rate, force.w.rate;
    }
    return result;
  }

  /// ∂F_c/∂X of the nodes, and F_c.
  [[nodiscard]] MatrixXd stiffness(const VectorXd& face, VectorXd& force) const {
    const MatrixXd at = at_points(face);
    MatrixXd tractions(at.rows(), n_axes_);
    MatrixXd density(at.rows(), n_axes_ * n_axes_);
    for (Index j = 0; j < at.rows(); ++j) {
      const Slider<double>& before = sliders_[static_cast<std::size_t>(j)];
      set(tractions, j, next_instant<double>(contact_, planar_, before, triple(at, j)).force);
      const Eigen::Matrix3d D = derivatives(before, triple(at, j));
      density.row(j) = model_.weights[j] * D.topLeftCorner(n_axes_, n_axes_).reshaped().transpose();
    }
    force = on_nodes(tractions);
    MatrixXd K(n_axes_ * n_nodes_, n_axes_ * n_nodes_);
    for (Index column = 0; column < n_axes_; ++column) {
      for (Index row = 0; row < n_axes_; ++row) {
        K.block(row * n_nodes_, column * n_nodes_, n_nodes_, n_nodes_) =
            model_.to_points.transpose() * density.col(column * n_axes_ + row).asDiagonal() *
            model_.to_points;
      }
    }
    return K;
  }

  void step(double sine) {
    const VectorXd load = sine * model_.force;
    const VectorXd begun = factors_.from_q.cwiseProduct(q_) + factors_.from_v.cwiseProduct(v_) +
                           factors_.from_force.cwiseProduct(force_);
    const VectorXd target = face_.transpose() * (begun + factors_.by_force.cwiseProduct(load));
    VectorXd X = motion_;
    VectorXd contact;
    solve(target, X, contact);
    const VectorXd force = load - face_ * contact;
    const VectorXd v = factors_.v_from_q.cwiseProduct(q_) + factors_.v_from_v.cwiseProduct(v_) +
                       factors_.v_from_force.cwiseProduct(force_) +
                       factors_.v_by_force.cwiseProduct(force);
    q_ = begun + factors_.by_force.cwiseProduct(force);
    v_ = v;
    force_ = force;
    motion_ = X;
    const MatrixXd at = at_points(X);
    for (Index j = 0; j < at.rows(); ++j) {
      Slider<double>& slider = sliders_[static_cast<std::size_t>(j)];
      slider = next_instant<double>(contact_, planar_, slider, triple(at, j));
    }
  }

  /// X + G F_c(X) = target.
  void solve(const VectorXd& target, VectorXd& X, VectorXd& force) const {
    constexpr int most = 40;
    constexpr double enough = 1e-11;
    const Index n = X.size();
    for (int i = 0; i < most; ++i) {
      const MatrixXd K = stiffness(X, force);
      const VectorXd residual = X + flexibility_ * force - target;
      if (residual.norm() <= enough * std::max(target.norm(), X.norm())) return;
      X -= (MatrixXd::Identity(n, n) + flexibility_ * K).partialPivLu().solve(residual);
    }
    throw std::runtime_error("time march: Newton's method did not end");
  }

  const FaceModel& model_;
  ContactConstants contact_;
  bool planar_;
  Index n_axes_;
  Index n_nodes_;
  int steps_;
  StepFactors factors_;
  MatrixXd face_;         // n_shapes × n_face
  MatrixXd flexibility_;  // of a step on the face
  VectorXd q_, v_, force_, motion_;
  std::vector<Slider<double>> sliders_;
};

}  // namespace

TimeResult integrate(const FaceModel& model, const ContactConstants& contact, bool planar,
                     const MatrixXd& shapes, double omega, const TimeOptions& options) {
  March march(model, contact, planar, shapes, omega, options.steps);
  TimeResult result;
  std::vector<double> amplitudes;
  int n_level = 0;
  while (result.periods < options.most_periods && n_level < 3) {
    amplitudes.push_back(march.period());
    ++result.periods;
    const double last = amplitudes.back();
    const double before =
        amplitudes[amplitudes.size() - std::min<std::size_t>(2, amplitudes.size())];
    const bool level = amplitudes.size() > 1 && std::abs(last - before) <= options.steady * last;
    n_level = level ? n_level + 1 : 0;
  }
  result.half_peak_to_peak = amplitudes.back();
  const std::size_t ten = std::min<std::size_t>(11, amplitudes.size());
  result.change = amplitudes.back() / amplitudes[amplitudes.size() - ten] - 1.0;
  return result;
}

TimePeak peak_in_time(const FaceModel& model, const ContactConstants& contact, bool planar,
                      const MatrixXd& shapes, double omega, const TimeOptions& options) {
  constexpr int farthest = 6;  // spacings
  std::map<int, TimeResult> at;
  const auto amplitude = [&](int i) {
    if (!at.contains(i)) {
      at[i] =
          integrate(model, contact, planar, shapes, omega * (1.0 + i * options.spacing), options);
    }
    return at[i].half_peak_to_peak;
  };
  int top = 0;
  while (std::abs(top) < farthest) {
    const double here = amplitude(top);
    if (amplitude(top + 1) > here) {
      ++top;
    } else if (amplitude(top - 1) > here) {
      --top;
    } else {
      break;
    }
  }
  TimePeak peak;
  for (const auto& [i, one] : at) peak.periods += one.periods;
  if (std::abs(top) == farthest) return peak;
  const double below = amplitude(top - 1);
  const double here = amplitude(top);
  const double above = amplitude(top + 1);
  const double bend = below - 2.0 * here + above;  // ≤ 0
  const double place = bend < 0.0 ? 0.5 * (below - above) / bend : 0.0;
  peak.amplitude = here - 0.25 * (below - above) * place;
  peak.omega = omega * (1.0 + (top + place) * options.spacing);
  for (const int i : {top - 1, top, top + 1}) {
    peak.change = std::max(peak.change, std::abs(at[i].change));
  }
  return peak;
}

}  // namespace microslip::truth
