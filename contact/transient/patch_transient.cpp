#include "contact/transient/patch_transient.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact/patch/mode_shape_check.hpp"

namespace microslip::contact {
namespace {

double reference_load(const PointParameters& point) { return std::max(point.rest_load, 0.0); }

/// Load without its one-sidedness.
double signed_load(const PointParameters& point, double v) {
  return point.rest_load + point.normal_stiffness * v;
}

struct Tractions {
  double friction = 0.0;
  double normal = 0.0;
};

Tractions held_tractions(const PointParameters& point, ContactState state, double slider, double u,
                         double v) {
  const double normal = signed_load(point, v);
  switch (state) {
    case ContactState::stick:
      return {point.has_friction() ? point.tangential_stiffness * (u - slider) : 0.0, normal};
    case ContactState::positive_slip:
      return {point.friction_coefficient * normal, normal};
    case ContactState::negative_slip:
      return {-point.friction_coefficient * normal, normal};
    case ContactState::slip:
      return {0.0, normal};
    case ContactState::separated:
      break;
  }
  return {};
}

/// Where the slider is after the motion has pushed it, and the state that goes with it.
struct Pushed {
  double slider = 0.0;
  ContactState state = ContactState::stick;
  double friction = 0.0;
};

Pushed pushed(const PointParameters& point, double slider, double u, double v) {
  const double load = signed_load(point, v);
  const double k_u = point.tangential_stiffness;
  if (load <= 0.0) return {u, ContactState::separated, 0.0};
  if (!point.has_friction()) return {u, ContactState::slip, 0.0};
  const double limit = point.friction_coefficient * load;
  const double trial = k_u * (u - slider);
  if (trial > limit) return {u - limit / k_u, ContactState::positive_slip, limit};
  if (trial < -limit) return {u + limit / k_u, ContactState::negative_slip, -limit};
  return {slider, ContactState::stick, trial};
}

}  // namespace

/// Motion of one point.
struct PatchTransient::Instant {
  double u = 0.0;
  double v = 0.0;
  double u_rate = 0.0;
  double v_rate = 0.0;
};

PatchTransient::PatchTransient(const ContactPatch& patch, ModalShapes given)
    : PointwiseTransient(patch.weights(), std::move(given), 1), points_(patch.points()) {
  require_mode_shape("PatchTransient", "u", shapes().u, n_points(), n_modes());
  require_mode_shape("PatchTransient", "v", shapes().v, n_points(), n_modes());
  u_size_ = shapes().u.rowwise().norm();
  v_size_ = shapes().v.rowwise().norm();
}

Eigen::VectorXd PatchTransient::modal_force(const Eigen::VectorXd& friction,
                                            const Eigen::VectorXd& normal) const {
  return shapes().u.transpose().lazyProduct(friction) + shapes().v.transpose().lazyProduct(normal);
}

Eigen::VectorXd PatchTransient::trial_force(const ModalMotion& motion,
                                            const TransientMemory& memory) const {
  Eigen::VectorXd friction = shapes().u.lazyProduct(motion.q);
  Eigen::VectorXd normal = shapes().v.lazyProduct(motion.q);
  for (Eigen::Index i = 0; i < n_points(); ++i) {
    const PointParameters& point = points_[static_cast<std::size_t>(i)];
    const double load = std::max(0.0, signed_load(point, normal[i]));
    const double weight = weights()[i];
    friction[i] = weight * pushed(point, memory.slider[i], friction[i], normal[i]).friction;
    normal[i] = weight * (load - reference_load(point));
  }
  return modal_force(friction, normal);
}

double PatchTransient::commit(const ModalMotion& motion, TransientMemory& memory) const {
  const Eigen::VectorXd u = shapes().u.lazyProduct(motion.q);
  const Eigen::VectorXd v = shapes().v.lazyProduct(motion.q);
  double work = 0.0;
  for (Eigen::Index i = 0; i < n_points(); ++i) {
    const auto index = static_cast<std::size_t>(i);
    const Pushed next = pushed(points_[index], memory.slider[i], u[i], v[i]);
    work += weights()[i] * next.friction * (next.slider - memory.slider[i]);
    memory.slider[i] = next.slider;
    memory.state[index] = next.state;
  }
  return work;
}

Eigen::VectorXd PatchTransient::held_force(const ModalMotion& motion,
                                           const TransientMemory& memory) const {
  Eigen::VectorXd friction = shapes().u.lazyProduct(motion.q);
  Eigen::VectorXd normal = shapes().v.lazyProduct(motion.q);
  for (Eigen::Index i = 0; i < n_points(); ++i) {
    const auto index = static_cast<std::size_t>(i);
    const PointParameters& point = points_[index];
    const Tractions held =
        held_tractions(point, memory.state[index], memory.slider[i], friction[i], normal[i]);
    friction[i] = weights()[i] * held.friction;
    normal[i] = weights()[i] * (held.normal - reference_load(point));
  }
  return modal_force(friction, normal);
}

PatchTransient::Instant PatchTransient::instant(Eigen::Index point,
                                                const ModalMotion& motion) const {
  return {shapes().u.row(point).dot(motion.q), shapes().v.row(point).dot(motion.q),
          shapes().u.row(point).dot(motion.velocity), shapes().v.row(point).dot(motion.velocity)};
}

TransientForce::Guards PatchTransient::guards_at(Eigen::Index point, const Instant& now,
                                                 ContactState state, double slider,
                                                 const GuardScale& scale) const {
  constexpr double smallest = std::numeric_limits<double>::min();
  if (weights()[point] == 0.0) return {1.0, 1.0};
  const PointParameters& p = points_[static_cast<std::size_t>(point)];
  const double k_u = p.tangential_stiffness;
  const double mu = p.friction_coefficient;
  const double load = signed_load(p, now.v);
  const double load_size = std::max(
      smallest, std::abs(p.rest_load) + p.normal_stiffness * v_size_[point] * scale.displacement);
  if (state == ContactState::separated) return {-load / load_size, 1.0};
  if (state == ContactState::slip) return {load / load_size, 1.0};
  if (state == ContactState::stick) {
    const double spring = mu > 0.0 ? k_u : 0.0;
    const double friction = spring * (now.u - slider);
    const double size =
        std::max(smallest, spring * (u_size_[point] * scale.displacement + std::abs(slider)) +
                               (mu > 0.0 ? mu : 1.0) * load_size);
    const double limit = (mu > 0.0 ? mu : 1.0) * load;
    return {(limit - friction) / size, (limit + friction) / size};
  }
  const double rate_size = std::max(
      smallest, (k_u * u_size_[point] + mu * p.normal_stiffness * v_size_[point]) * scale.velocity);
  const double sign = state == ContactState::positive_slip ? 1.0 : -1.0;
  const double rate = sign * k_u * now.u_rate - mu * p.normal_stiffness * now.v_rate;
  return {rate / rate_size, load / load_size};
}

Eigen::Matrix<double, Eigen::Dynamic, TransientForce::guards_per_point> PatchTransient::guards(
    const ModalMotion& motion, const TransientMemory& memory, const GuardScale& scale) const {
  const Eigen::VectorXd u = shapes().u.lazyProduct(motion.q);
  const Eigen::VectorXd v = shapes().v.lazyProduct(motion.q);
  const Eigen::VectorXd u_rate = shapes().u.lazyProduct(motion.velocity);
  const Eigen::VectorXd v_rate = shapes().v.lazyProduct(motion.velocity);
  Eigen::Matrix<double, Eigen::Dynamic, guards_per_point> result(n_points(), guards_per_point);
  for (Eigen::Index i = 0; i < n_points(); ++i) {
    const Guards row =
        guards_at(i, {u[i], v[i], u_rate[i], v_rate[i]}, memory.state[static_cast<std::size_t>(i)],
                  memory.slider[i], scale);
    result(i, 0) = row[0];
    result(i, 1) = row[1];
  }
  return result;
}

TransientForce::Guards PatchTransient::guards_of(Eigen::Index point, const ModalMotion& motion,
                                                 const TransientMemory& memory,
                                                 const GuardScale& scale) const {
  return guards_at(point, instant(point, motion), memory.state[static_cast<std::size_t>(point)],
                   memory.slider[point], scale);
}

void PatchTransient::switch_state(Eigen::Index point, const ModalMotion& motion,
                                  TransientMemory& memory) const {
  const PointParameters& p = points_[static_cast<std::size_t>(point)];
  const Instant now = instant(point, motion);
  const double load = signed_load(p, now.v);
  ContactState& state = memory.state[static_cast<std::size_t>(point)];
  double& slider = memory.slider[point];
  const double k_u = p.tangential_stiffness;
  const double load_rate = p.friction_coefficient * p.normal_stiffness * now.v_rate;
  if (state != ContactState::separated && load <= 0.0) {
    state = ContactState::separated;
    slider = now.u;
  } else if (state == ContactState::stick) {
    state = now.u > slider ? ContactState::positive_slip : ContactState::negative_slip;
  } else if (state == ContactState::positive_slip || state == ContactState::negative_slip) {
    const double sign = state == ContactState::positive_slip ? 1.0 : -1.0;
    slider = now.u - sign * p.friction_coefficient * load / k_u;
    state = ContactState::stick;
  } else if (state == ContactState::separated) {
    slider = now.u;  // f = 0 where contact begins
    if (!p.has_friction()) {
      state = ContactState::slip;
    } else if (k_u * now.u_rate > load_rate) {
      state = ContactState::positive_slip;
    } else if (k_u * now.u_rate < -load_rate) {
      state = ContactState::negative_slip;
    } else {
      state = ContactState::stick;
    }
  }
}

double PatchTransient::slip_power(const ModalMotion& motion, const TransientMemory& memory) const {
  double power = 0.0;
  for (Eigen::Index i = 0; i < n_points(); ++i) {
    const ContactState state = memory.state[static_cast<std::size_t>(i)];
    if (state != ContactState::positive_slip && state != ContactState::negative_slip) continue;
    const PointParameters& p = points_[static_cast<std::size_t>(i)];
    const Instant now = instant(i, motion);
    const double sign = state == ContactState::positive_slip ? 1.0 : -1.0;
    const double slip_rate = sign * now.u_rate - p.friction_coefficient * p.normal_stiffness *
                                                     now.v_rate / p.tangential_stiffness;
    power += weights()[i] * p.friction_coefficient * signed_load(p, now.v) * slip_rate;
  }
  return power;
}

Eigen::MatrixXd PatchTransient::stuck_stiffness() const {
  Eigen::VectorXd k_u(n_points());
  Eigen::VectorXd k_v(n_points());
  for (Eigen::Index i = 0; i < n_points(); ++i) {
    const PointParameters& point = points_[static_cast<std::size_t>(i)];
    const double weight = weights()[i];
    k_u[i] = point.has_friction() ? weight * point.tangential_stiffness : 0.0;
    k_v[i] = weight * point.normal_stiffness;
  }
  return shapes().u.transpose() * k_u.asDiagonal() * shapes().u +
         shapes().v.transpose() * k_v.asDiagonal() * shapes().v;
}

}  // namespace microslip::contact
