#include "contact/linear_proof.hpp"

#include <cmath>

#include "contact/point_motions.hpp"
#include "contact/slip_functions.hpp"

namespace microslip::contact {
namespace {

// Sums over some hundred modes err by less.
constexpr double rounding = 1e-13;

/// Which linear laws a point keeps to for all motions of its set.
struct Possible {
  bool stuck = true;
  bool free = true;
};

Possible possible(const PointParameters& point, const PointMotion& motion, double radius_u,
                  double radius_v) {
  const double k_u = point.friction_coefficient > 0.0 ? point.tangential_stiffness : 0.0;
  const double k_v = point.normal_stiffness;
  const double mu = point.friction_coefficient;
  if (k_u == 0.0 && k_v == 0.0) return {};  // exerts no dynamic force in any state
  const SlipFunctions w = slip_functions(point, motion);
  const double spread_v = k_v * radius_v;
  const double load_scale =
      std::abs(point.preload) + std::abs(k_v * motion.v_mean) + w.load_amplitude + spread_v;
  const double slack = rounding * load_scale;
  Possible result;
  result.free = point.preload <= 0.0 && w.above_open + spread_v <= (w.above_open < 0.0 ? -slack : 0.0);
  result.stuck = point.preload >= 0.0 && w.below_closed + spread_v + slack <= 0.0;
  if (k_u == 0.0) return result;
  const double spread = k_u * radius_u + mu * spread_v;
  const double positive = w.positive + spread;
  const double negative = w.negative + spread;
  const double offset = k_u * motion.u_mean;
  const double rest = w.limit - rounding * (mu * load_scale + positive + negative + std::abs(offset));
  result.stuck = result.stuck && positive + negative <= 2.0 * rest && negative - rest <= offset &&
                 offset <= rest - positive;
  return result;
}

}  // namespace

LinearState linear_state(const ContactPatch& patch, const ModalShapes& shapes,
                         const Harmonics& centre, const Eigen::VectorXd& radius) {
  const std::vector<PointMotion> motions = point_motions(shapes, centre);
  const Eigen::VectorXd radius_u = shapes.u.cwiseAbs() * radius;
  const Eigen::VectorXd radius_v = shapes.v.cwiseAbs() * radius;
  Possible all;
  for (Eigen::Index i = 0; i < patch.n_points() && (all.stuck || all.free); ++i) {
    if (patch.weights()[i] == 0.0) continue;
    const auto point = static_cast<std::size_t>(i);
    const Possible here =
        possible(patch.points()[point], motions[point], radius_u[i], radius_v[i]);
    all.stuck = all.stuck && here.stuck;
    all.free = all.free && here.free;
  }
  if (all.stuck) return LinearState::stuck;
  return all.free ? LinearState::free : LinearState::unknown;
}

}  // namespace microslip::contact
