#include "tests/benchmarks/plain_return.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace microslip::benchmarks {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr int normal = 1;         // of the directions p, q, r
constexpr int most_periods = 50;  // the second repeats along a line; in a plane it may take many
constexpr double repeats = 1e-8;  // of the traction

/// Instants × harmonics: 1, sin θ, cos θ, sin 2θ, …
MatrixXd basis_of(int instants, Index n_rows) {
  MatrixXd basis = MatrixXd::Ones(instants, n_rows);
  for (int i = 0; i < instants; ++i) {
    const double phase = 2.0 * std::numbers::pi * i / instants;
    for (Index k = 1; k < n_rows; ++k) {
      const double angle = phase * static_cast<double>((k + 1) / 2);
      basis(i, k) = k % 2 == 1 ? std::sin(angle) : std::cos(angle);
    }
  }
  return basis;
}

/// Traction of a point at one instant, along each direction, and by the harmonics of each:
/// direction × (direction, harmonic).
struct Traction {
  Eigen::VectorXd value;
  MatrixXd change;

  explicit Traction(Index directions, Index n_rows)
      : value(Eigen::VectorXd::Zero(directions)),
        change(MatrixXd::Zero(directions, directions * n_rows)) {}
  void vanish() {
    value.setZero();
    change.setZero();
  }
};

class Point {
 public:
  Point(const contact::PointParameters& parameters, const MatrixXd& basis, const MatrixXd& motion)
      : at_(parameters), basis_(basis), motion_(motion), now_(motion.cols(), basis.cols()) {}

  /// Calls keep(i, traction) at all instants of all periods until they repeat.
  template <typename Keep>
  void march(const Keep& keep) {
    const Index n = basis_.rows();
    start(0);
    for (int period = 0; period < most_periods; ++period) {
      const Eigen::VectorXd before = now_.value;
      for (Index i = 1; i <= n; ++i) {
        step(i - 1, i % n);
        keep(i % n, now_);
      }
      if ((now_.value - before).norm() <= repeats * now_.value.norm() && period > 0) return;
    }
  }

 private:
  [[nodiscard]] double load(Index i) const {
    return at_.rest_load + at_.normal_stiffness * motion_(i, normal);
  }

  /// The spring relaxed at rest.
  void start(Index i) {
    if (load(i) <= 0.0) return;
    const Index n_rows = basis_.cols();
    for (Index d = 0; d < motion_.cols(); ++d) {
      if (d == normal) continue;
      now_.value[d] = at_.tangential_stiffness * motion_(i, d);
      now_.change.row(d).segment(d * n_rows, n_rows) = at_.tangential_stiffness * basis_.row(i);
    }
    return_to_cone(load(i), at_.normal_stiffness * basis_.row(i));
  }

  void step(Index before, Index i) {
    const double n = load(i);
    if (n <= 0.0) {
      now_.vanish();
      return;
    }
    const Index n_rows = basis_.cols();
    const Eigen::RowVectorXd change_of_load = at_.normal_stiffness * basis_.row(i);
    double share = 1.0;  // of the step in contact
    Eigen::RowVectorXd change_of_share = Eigen::RowVectorXd::Zero(n_rows);
    const double n_before = load(before);
    if (n_before < 0.0) {
      const double rise = n - n_before;
      share = n / rise;
      change_of_share = at_.normal_stiffness / (rise * rise) *
                        (n * basis_.row(before) - n_before * basis_.row(i));
    }
    for (Index d = 0; d < motion_.cols(); ++d) {
      if (d == normal) continue;
      const double way = at_.tangential_stiffness * (motion_(i, d) - motion_(before, d));
      now_.value[d] += share * way;
      auto change = now_.change.row(d);
      change.segment(d * n_rows, n_rows) +=
          share * at_.tangential_stiffness * (basis_.row(i) - basis_.row(before));
      change.segment(normal * n_rows, n_rows) += way * change_of_share;
    }
    now_.value[normal] = n;
    now_.change.row(normal).setZero();
    now_.change.row(normal).segment(normal * n_rows, n_rows) = change_of_load;
    return_to_cone(n, change_of_load);
  }

  void return_to_cone(double n, const Eigen::RowVectorXd& change_of_load) {
    const double limit = at_.friction_coefficient * n;
    Eigen::VectorXd along = now_.value;
    along[normal] = 0.0;
    const double size = along.norm();
    if (size <= limit) return;
    along /= size;
    const Eigen::RowVectorXd change_of_size = along.transpose() * now_.change;
    for (Index d = 0; d < along.size(); ++d) {
      if (d == normal) continue;
      now_.value[d] *= limit / size;
      now_.change.row(d) = limit / size * (now_.change.row(d) - along[d] * change_of_size);
      now_.change.row(d).segment(normal * basis_.cols(), basis_.cols()) +=
          along[d] * at_.friction_coefficient * change_of_load;
    }
  }

  const contact::PointParameters& at_;
  const MatrixXd& basis_;
  const MatrixXd& motion_;  // instants × directions
  Traction now_;
};

}  // namespace

PlainReturn::PlainReturn(Eigen::VectorXd weights, std::vector<contact::PointParameters> points,
                         contact::ModalShapes shapes, int instants)
    : FullForce(shapes.u.cols()),
      weights_(std::move(weights)),
      points_(std::move(points)),
      shapes_{std::move(shapes.u), std::move(shapes.v)},
      instants_(instants) {
  if (shapes.w.size() > 0) shapes_.push_back(std::move(shapes.w));
}

MatrixXd PlainReturn::stuck_stiffness() const {
  MatrixXd sum = MatrixXd::Zero(n_modes(), n_modes());
  for (std::size_t d = 0; d < shapes_.size(); ++d) {
    Eigen::VectorXd stiffness = weights_;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      stiffness[static_cast<Index>(i)] *=
          d == normal ? points_[i].normal_stiffness : points_[i].tangential_stiffness;
    }
    sum += shapes_[d].transpose() * stiffness.asDiagonal() * shapes_[d];
  }
  return sum;
}

contact::ForceAndJacobian PlainReturn::by_all(const contact::Harmonics& q,
                                              double /*frequency*/) const {
  const Index n_rows = q.rows().rows();
  const Index modes = n_modes();
  const auto directions = static_cast<Index>(shapes_.size());
  const MatrixXd basis = basis_of(instants_, n_rows);
  MatrixXd fourier = 2.0 / instants_ * basis.transpose();
  fourier.row(0) *= 0.5;
  std::vector<MatrixXd> motions;  // by direction: instants × points
  for (const MatrixXd& shape : shapes_)
    motions.push_back(basis * (q.rows() * shape.transpose()).eval());
  // By pairs of directions and of harmonics: what stands between the shapes of the points.
  std::vector<MatrixXd> forces(shapes_.size(), MatrixXd::Zero(n_rows, weights_.size()));
  std::vector<MatrixXd> changes(weights_.size());
  for (Index i = 0; i < weights_.size(); ++i) {
    MatrixXd motion(instants_, directions);
    for (Index d = 0; d < directions; ++d)
      motion.col(d) = motions[static_cast<std::size_t>(d)].col(i);
    MatrixXd tractions(instants_, directions);
    std::vector<MatrixXd> rates(shapes_.size(), MatrixXd(instants_, directions * n_rows));
    Point(points_[static_cast<std::size_t>(i)], basis, motion)
        .march([&](Index instant, const Traction& traction) {
          tractions.row(instant) = traction.value.transpose();
          // What holds the point at rest is no force of the motion.
          tractions(instant, normal) -=
              std::max(points_[static_cast<std::size_t>(i)].rest_load, 0.0);
          for (Index d = 0; d < directions; ++d) {
            rates[static_cast<std::size_t>(d)].row(instant) = traction.change.row(d);
          }
        });
    MatrixXd& change = changes[static_cast<std::size_t>(i)];
    change.resize(directions * n_rows, directions * n_rows);
    for (Index d = 0; d < directions; ++d) {
      forces[static_cast<std::size_t>(d)].col(i) = weights_[i] * (fourier * tractions.col(d));
      change.middleRows(d * n_rows, n_rows).noalias() =
          weights_[i] * (fourier * rates[static_cast<std::size_t>(d)]);
    }
  }
  contact::ForceAndJacobian result{contact::Harmonics(q.n_harmonics(), modes),
                                   MatrixXd::Zero(n_rows * modes, n_rows * modes),
                                   Eigen::VectorXd::Zero(n_rows * modes)};
  Eigen::VectorXd between(weights_.size());
  for (Index d = 0; d < directions; ++d) {
    const MatrixXd& shape = shapes_[static_cast<std::size_t>(d)];
    result.force.rows() += forces[static_cast<std::size_t>(d)] * shape;
    for (Index e = 0; e < directions; ++e) {
      const MatrixXd& other = shapes_[static_cast<std::size_t>(e)];
      for (Index k = 0; k < n_rows; ++k) {
        for (Index l = 0; l < n_rows; ++l) {
          for (Index i = 0; i < weights_.size(); ++i) {
            between[i] = changes[static_cast<std::size_t>(i)](d * n_rows + k, e * n_rows + l);
          }
          result.jacobian.block(k * modes, l * modes, modes, modes).noalias() +=
              shape.transpose() * between.asDiagonal() * other;
        }
      }
    }
  }
  return result;
}

}  // namespace microslip::benchmarks
