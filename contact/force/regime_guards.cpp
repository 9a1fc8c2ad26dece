#include "contact/force/regime_guards.hpp"

#include <utility>

#include "contact/patch/point_motions.hpp"
#include "contact/closed_form/slip_functions.hpp"

namespace microslip::contact {
namespace {

constexpr int n_guards = 7;

Eigen::Matrix<double, 1, n_guards> guards_of(const PointParameters& point,
                                             const PointMotion& motion) {
  const SlipFunctions w = slip_functions(point, motion);
  const double mean = point.tangential_stiffness * motion.u_mean;
  const double cross = point.tangential_stiffness * point.normal_stiffness *
                       (motion.u_sin * motion.v_cos - motion.u_cos * motion.v_sin);
  const double range = w.above_open * w.below_closed;  // B² − n₀²
  return {w.excess,
          w.below_closed,
          w.above_open,
          mean - (w.negative - w.limit),
          (w.limit - w.positive) - mean,
          cross * cross - w.positive * w.positive * range,
          cross * cross - w.negative * w.negative * range};
}

}  // namespace

Guards regime_guards(ShapeField shapes, ParameterField parameters, std::vector<Harmonics> states) {
  Guards guards;
  for (std::size_t state = 0; state < states.size(); ++state) {
    const int excess = static_cast<int>(state) * n_guards;
    const int below_closed = excess + 1;
    for (int k = 0; k < 3; ++k) {
      guards.lines.push_back({.is_graded = true});
    }
    for (int k = 3; k < 5; ++k) {
      guards.lines.push_back({.domain = excess, .domain_sign = -1});
    }
    for (int k = 5; k < n_guards; ++k) {
      guards.lines.push_back({.domain = below_closed, .domain_sign = 1});
    }
  }
  guards.values = [shapes = std::move(shapes), parameters = std::move(parameters),
                   states = std::move(states)](const Eigen::VectorXd& p, const Eigen::VectorXd& r) {
    const ModalShapes at = shapes(p, r);
    const std::vector<PointParameters> points = parameters(p, r);
    Eigen::MatrixXd values(p.size(), n_guards * static_cast<Eigen::Index>(states.size()));
    for (std::size_t state = 0; state < states.size(); ++state) {
      const std::vector<PointMotion> motions = point_motions(at, states[state]);
      for (std::size_t i = 0; i < motions.size(); ++i) {
        values.block<1, n_guards>(static_cast<Eigen::Index>(i),
                                  n_guards * static_cast<Eigen::Index>(state)) =
            guards_of(points[i], motions[i]);
      }
    }
    return values;
  };
  return guards;
}

}  // namespace microslip::contact
