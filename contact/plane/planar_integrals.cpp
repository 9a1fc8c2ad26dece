#include "contact/plane/planar_integrals.hpp"

#include <numbers>

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

  [[nodiscard]] Harmonics result() {
    sum_.rows() /= std::numbers::pi;
    sum_.rows().row(0) *= 0.5;
    return sum_;
  }

 private:
  Harmonics sum_;
  Eigen::VectorXd basis_;
};

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
  for (const PlanarInterval& interval : intervals) {
    if (!interval.in_contact) continue;
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
