#include "contact/law_patch_force.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact/cycle_report.hpp"
#include "contact/mode_shape_check.hpp"
#include "contact/point_motions.hpp"

namespace microslip::contact {
namespace {

// Points whose Jacobians wait for one dense product: large enough for it to be fast, small enough for
// the rows to stay in cache.
constexpr Eigen::Index block_size = 32;

void require(bool condition, const std::string& message) {
  if (!condition) {
    throw std::invalid_argument("LawPatchForce: " + message);
  }
}

// J_i Φ_i of a block of points, harmonic row by harmonic row of those asked for: n_rows matrices of
// (n_signals · block) × (n_rows · n_modes), then Φᵀ times these.
class JacobianSum {
 public:
  JacobianSum(const std::vector<const Eigen::MatrixXd*>& shapes,
              const std::vector<Eigen::Index>& rows)
      : shapes_(shapes),
        rows_(rows),
        n_rows_(static_cast<Eigen::Index>(rows.size())),
        n_modes_(shapes.front()->cols()),
        phi_(block_rows(), n_modes_),
        moved_(rows.size(), Eigen::MatrixXd(block_rows(), n_rows_ * n_modes_)),
        sum_(Eigen::MatrixXd::Zero(n_rows_ * n_modes_, n_rows_ * n_modes_)) {}

  void add(Eigen::Index point, double weight, const Eigen::MatrixXd& jacobian) {
    const Eigen::Index n_signals = signals();
    const Eigen::Index first = n_signals * n_waiting_;
    for (Eigen::Index s = 0; s < n_signals; ++s) {
      phi_.row(first + s) = shapes_[static_cast<std::size_t>(s)]->row(point);
    }
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      Eigen::MatrixXd& moved = moved_[k];
      for (Eigen::Index l = 0; l < n_rows_; ++l) {
        const Eigen::Index column = rows_[static_cast<std::size_t>(l)];
        moved.block(first, l * n_modes_, n_signals, n_modes_).noalias() =
            weight *
            jacobian.block(n_point_signals * rows_[k], n_point_signals * column, n_signals,
                           n_signals) *
            phi_.middleRows(first, n_signals);
      }
    }
    if (++n_waiting_ == block_size) {
      flush();
    }
  }

  [[nodiscard]] Eigen::MatrixXd take() {
    flush();
    return std::move(sum_);
  }

 private:
  [[nodiscard]] Eigen::Index signals() const { return static_cast<Eigen::Index>(shapes_.size()); }
  [[nodiscard]] Eigen::Index block_rows() const { return signals() * block_size; }

  void flush() {
    const Eigen::Index n = signals() * n_waiting_;
    for (Eigen::Index k = 0; k < n_rows_ && n > 0; ++k) {
      sum_.middleRows(k * n_modes_, n_modes_).noalias() +=
          phi_.topRows(n).transpose() * moved_[static_cast<std::size_t>(k)].topRows(n);
    }
    n_waiting_ = 0;
  }

  const std::vector<const Eigen::MatrixXd*>& shapes_;
  const std::vector<Eigen::Index>& rows_;
  Eigen::Index n_rows_;
  Eigen::Index n_modes_;
  Eigen::Index n_waiting_ = 0;
  Eigen::MatrixXd phi_;
  std::vector<Eigen::MatrixXd> moved_;
  Eigen::MatrixXd sum_;
};

}  // namespace

LawPatchForce::LawPatchForce(Eigen::VectorXd weights,
                             std::vector<std::shared_ptr<const PointLaw>> laws, ModalShapes shapes)
    : weights_(std::move(weights)), laws_(std::move(laws)), shapes_(std::move(shapes)) {
  const Eigen::Index n = weights_.size();
  require(n >= 1 && static_cast<Eigen::Index>(laws_.size()) == n,
          std::to_string(n) + " weights for " + std::to_string(laws_.size()) + " laws");
  require(weights_.allFinite() && weights_.minCoeff() >= 0.0, "a weight is negative or not finite");
  require_mode_shape("LawPatchForce", "u", shapes_.u, n, shapes_.u.cols());
  require_mode_shape("LawPatchForce", "v", shapes_.v, n, shapes_.u.cols());
  shape_ = {&shapes_.u, &shapes_.v};
  if (shapes_.w.size() > 0) {
    require_mode_shape("LawPatchForce", "w", shapes_.w, n, shapes_.u.cols());
    shape_.push_back(&shapes_.w);
  }
}

ForceAndJacobian LawPatchForce::evaluate(const Harmonics& q, double frequency) const {
  std::vector<Eigen::Index> all(static_cast<std::size_t>(q.rows().rows()));
  std::iota(all.begin(), all.end(), Eigen::Index{0});
  return evaluate_rows(q, frequency, all);
}

ForceAndJacobian LawPatchForce::evaluate_rows(const Harmonics& q, double frequency,
                                              const std::vector<Eigen::Index>& rows) const {
  const std::vector<Harmonics> motions = general_motions(shapes_, q);
  const Eigen::Index n_rows = q.rows().rows();
  const auto n_signals = static_cast<Eigen::Index>(shape_.size());
  // Weighted tractions and their derivatives by ω of all points: n_points × n_rows for each signal.
  std::vector<Eigen::MatrixXd> force(shape_.size(), Eigen::MatrixXd(weights_.size(), n_rows));
  std::vector<Eigen::MatrixXd> by_frequency = force;
  JacobianSum jacobian(shape_, rows);
  PointTraction traction;
  double defect = 0.0;
  for (Eigen::Index i = 0; i < weights_.size(); ++i) {
    const auto point = static_cast<std::size_t>(i);
    traction.defect = 0.0;  // a law that is exact does not mention it
    laws_[point]->traction(motions[point], frequency, traction);
    if (traction.defect > 0.0) {
      double shape = 0.0;
      for (const Eigen::MatrixXd* phi : shape_) shape += phi->row(i).squaredNorm();
      defect += weights_[i] * traction.defect * std::sqrt(shape);
    }
    traction.force.rows()(0, 1) -= laws_[point]->load_at_rest();
    for (Eigen::Index s = 0; s < n_signals; ++s) {
      const auto signal = static_cast<std::size_t>(s);
      force[signal].row(i) = weights_[i] * traction.force.rows().col(s).transpose();
      for (Eigen::Index k = 0; k < n_rows; ++k) {
        by_frequency[signal](i, k) =
            weights_[i] * traction.frequency_derivative[n_point_signals * k + s];
      }
    }
    if (traction.regime != CycleRegime::separated && !rows.empty()) {
      jacobian.add(i, weights_[i], traction.jacobian);
    }
  }
  ForceAndJacobian result{Harmonics(q.n_harmonics(), n_modes()), {}, {}, defect};
  Harmonics derivative(q.n_harmonics(), n_modes());
  for (std::size_t s = 0; s < shape_.size(); ++s) {
    result.force.rows() += force[s].transpose() * *shape_[s];
    derivative.rows() += by_frequency[s].transpose() * *shape_[s];
  }
  result.jacobian = jacobian.take();
  result.frequency_derivative.resize(static_cast<Eigen::Index>(rows.size()) * n_modes());
  Eigen::Index at = 0;
  for (const Eigen::Index row : rows) {
    result.frequency_derivative.segment(at, n_modes()) = derivative.rows().row(row).transpose();
    at += n_modes();
  }
  return result;
}

CycleReport LawPatchForce::report(const Harmonics& q, double frequency) const {
  const std::vector<Harmonics> motions = general_motions(shapes_, q);
  ReportSum sum;
  for (std::size_t point = 0; point < motions.size(); ++point) {
    const double weight = weights_[static_cast<Eigen::Index>(point)];
    if (weight == 0.0) {
      continue;
    }
    const PointHistory history = laws_[point]->history(motions[point], frequency, {}, 0);
    sum.add(history.segments, history.dissipated_energy, weight);
  }
  return sum.result();
}

Eigen::MatrixXd LawPatchForce::stuck_stiffness() const {
  Eigen::MatrixX3d k(weights_.size(), 3);
  for (Eigen::Index i = 0; i < weights_.size(); ++i) {
    k.row(i) = weights_[i] * laws_[static_cast<std::size_t>(i)]->stuck_stiffness().transpose();
  }
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n_modes(), n_modes());
  for (std::size_t s = 0; s < shape_.size(); ++s) {
    stiffness += shape_[s]->transpose() * k.col(static_cast<Eigen::Index>(s)).asDiagonal() * *shape_[s];
  }
  return stiffness;
}

}  // namespace microslip::contact
