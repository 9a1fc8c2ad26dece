#include "contact/plane/planar_integrals.hpp"

#include <numbers>

#include "contact/numerics/trigonometric_moments.hpp"
#include "contact/plane/planar_quadrature.hpp"

namespace microslip::contact {
namespace {

using Eigen::Vector2d;

/// Sums values against the trigonometric basis; rows() is scaled once at the end.
class FourierSum {
 public:
  explicit FourierSum(int n_harmonics) : sum_(n_harmonics, 3) {}

  void add(double phase, double weight, const Eigen::RowVector3d& value) {
    trigonometric_basis(sum_.n_harmonics(), phase, basis_);
    sum_.rows().noalias() += (weight * basis_) * value;
  }

  void add_load(const Eigen::VectorXd& integrals) { sum_.rows().col(1) += integrals; }

  [[nodiscard]] Harmonics result() {
    sum_.rows() /= std::numbers::pi;
    sum_.rows().row(0) *= 0.5;
    return sum_;
  }

 private:
  Harmonics sum_;
  Eigen::VectorXd basis_;
};

/// Of all parts of the period in contact.
TrigonometricMoments contact_moments(const std::vector<PlanarInterval>& intervals, int highest) {
  TrigonometricMoments sum;
  TrigonometricMoments piece;
  sum.reset(highest);
  piece.reset(highest);
  for (const PlanarInterval& interval : intervals) {
    if (!interval.in_contact) continue;
    piece.set_piece(interval.begin, interval.end - interval.begin);
    sum.add(1.0, piece);
  }
  return sum;
}

/// ∮ n against the functions of the basis where n = n₀' + k_v v in contact.
Eigen::VectorXd smooth_load(const PlanarMotion& motion,
                            const std::vector<PlanarInterval>& intervals, int n_harmonics) {
  const PointParameters& point = motion.law().point();
  const auto approach = motion.harmonics().rows().col(1);
  const auto n = static_cast<int>(approach.size());
  const TrigonometricMoments moments =
      contact_moments(intervals, n_harmonics + motion.n_harmonics());
  Eigen::VectorXd load(2 * n_harmonics + 1);
  for (int i = 0; i < load.size(); ++i) {
    load[i] = point.rest_load * moments.single(i);
    for (int j = 0; j < n; ++j) {
      load[i] += point.normal_stiffness * approach[j] * moments.product(i, j);
    }
  }
  return load;
}

Eigen::MatrixXd smooth_load_derivative(const PlanarMotion& motion,
                                       const std::vector<PlanarInterval>& intervals) {
  const int n = 2 * motion.n_harmonics() + 1;
  const TrigonometricMoments moments = contact_moments(intervals, 2 * motion.n_harmonics());
  const double stiffness = motion.law().point().normal_stiffness / std::numbers::pi;
  Eigen::MatrixXd J(n, n);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) J(i, j) = stiffness * moments.product(i, j);
  }
  J.row(0) *= 0.5;
  return J;
}

Eigen::RowVector3d traction(const Vector2d& friction) { return {friction[0], 0.0, friction[1]}; }

void add_stick(const PlanarMotion& motion, const PlanarPiece& piece, int n_harmonics,
               FourierSum& sum) {
  visit_nodes(
      motion, piece.begin, piece.end, n_harmonics, [&](const PlanarInstant& now, double weight) {
        const Vector2d force =
            motion.force_scale() * now.surface.stiffness_ratio * now.held_force(piece.slider);
        sum.add(now.phase, weight, traction(force));
      });
}

void add_slip(const PlanarMotion& motion, const SlipStep& step, FourierSum& sum) {
  const RadauNodes& rule = radau_nodes();
  for (std::size_t i = 0; i < n_stages; ++i) {
    const PlanarInstant& now = step.instant[i];
    const double limit = motion.force_scale() * now.limit * now.surface.stiffness_ratio;
    sum.add(now.phase, step.length * rule.weight[i],
            traction(limit * step.direction.col(static_cast<Eigen::Index>(i))));
  }
}

}  // namespace

Harmonics planar_force(const PlanarMotion& motion, const std::vector<PlanarInterval>& intervals,
                       const PlanarOrbit& orbit, int n_harmonics) {
  FourierSum sum(n_harmonics);
  const bool is_smooth = motion.law().is_smooth();
  if (is_smooth) sum.add_load(smooth_load(motion, intervals, n_harmonics));
  for (const PlanarInterval& interval : intervals) {
    if (is_smooth || !interval.in_contact) continue;
    visit_nodes(motion, interval.begin, interval.end, n_harmonics,
                [&](const PlanarInstant& now, double weight) {
                  sum.add(now.phase, weight, {0.0, now.surface.load, 0.0});
                });
  }
  for (const PlanarPiece& piece : orbit.pieces) {
    if (piece.state == ContactState::stick) add_stick(motion, piece, n_harmonics, sum);
    for (const SlipStep& step : piece.steps) add_slip(motion, step, sum);
  }
  return sum.result();
}

Eigen::MatrixXd load_derivative(const PlanarMotion& motion,
                                const std::vector<PlanarInterval>& intervals) {
  const int H = motion.n_harmonics();
  if (motion.law().is_smooth()) return smooth_load_derivative(motion, intervals);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(2 * H + 1, 2 * H + 1);
  Eigen::VectorXd basis;
  for (const PlanarInterval& interval : intervals) {
    if (!interval.in_contact) continue;
    visit_nodes(
        motion, interval.begin, interval.end, H, [&](const PlanarInstant& now, double weight) {
          trigonometric_basis(H, now.phase, basis);
          J.noalias() += (weight * now.surface.load_by_approach * basis) * basis.transpose();
        });
  }
  J /= std::numbers::pi;
  J.row(0) *= 0.5;
  return J;
}

PlanarWork planar_work(const PlanarMotion& motion, const PlanarOrbit& orbit) {
  const RadauNodes& rule = radau_nodes();
  PlanarWork work;
  for (const PlanarPiece& piece : orbit.pieces) {
    for (const SlipStep& step : piece.steps) {
      for (std::size_t i = 0; i < n_stages; ++i) {
        const SurfaceState& surface = step.instant[i].surface;
        const double rate = step.rate(static_cast<int>(i));
        const double distance = step.length * rule.weight[i] * rate * motion.length_scale();
        work.slip_distance += distance;
        work.normal_slip += surface.load * distance;
        work.dissipated_energy += surface.friction_coefficient * surface.load * distance;
      }
    }
  }
  return work;
}

}  // namespace microslip::contact
