#include "contact/transient/planar_transient.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact/patch/mode_shape_check.hpp"
#include "contact/plane/planar_slip.hpp"

namespace microslip::contact {
namespace {

using Eigen::Vector2d;

/// ε of the header.
constexpr double edge = 5e-4;
constexpr double wherever =
    -std::numeric_limits<double>::infinity();  // the law at the motion itself

/// K₀ times the motion [Pa].
double spring_size(const PlanarPoint& point, const GuardScale& scale) {
  return point.stiffness.maxCoeff() * point.tangential_size * scale.displacement;
}

void require_weights(const Eigen::VectorXd& weights, std::size_t n_laws) {
  if (static_cast<std::size_t>(weights.size()) != n_laws) {
    throw std::invalid_argument("PlanarTransient: " + std::to_string(weights.size()) +
                                " weights for " + std::to_string(n_laws) + " laws");
  }
  if (!weights.allFinite() || (weights.array() < 0.0).any()) {
    throw std::invalid_argument("PlanarTransient: weights must be finite and at least 0");
  }
}

ModalShapes in_three_directions(ModalShapes shapes) {
  if (shapes.w.size() == 0) {
    shapes.w = Eigen::MatrixXd::Zero(shapes.u.rows(), shapes.u.cols());
  }
  return shapes;
}

Vector2d slider_of(const TransientMemory& memory, Eigen::Index point) {
  return {memory.slider[point], memory.slider[point + memory.slider.size() / 2]};
}

void set_slider(TransientMemory& memory, Eigen::Index point, const Vector2d& position) {
  memory.slider[point] = position[0];
  memory.slider[point + memory.slider.size() / 2] = position[1];
}

}  // namespace

/// Rows: one per point.
struct PlanarTransient::Motions {
  Eigen::MatrixX3d value;  ///< u, v, w
  Eigen::MatrixX3d rate;
  Eigen::MatrixX3d second;  ///< 0 where the acceleration is not given
  [[nodiscard]] PlanarPointMotion of(Eigen::Index point) const {
    return {value.row(point), rate.row(point), second.row(point)};
  }
};

PlanarTransient::PlanarTransient(Eigen::VectorXd areas, std::vector<SurfaceLaw> laws,
                                 ModalShapes given)
    : PointwiseTransient(std::move(areas), in_three_directions(std::move(given)), 2) {
  require_weights(weights(), laws.size());
  for (const auto& [name, shape] :
       {std::pair{"u", &shapes().u}, std::pair{"v", &shapes().v}, std::pair{"w", &shapes().w}}) {
    require_mode_shape("PlanarTransient", name, *shape, n_points(), n_modes());
  }
  points_.reserve(laws.size());
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    points_.emplace_back(laws[i], shapes().u.row(row).norm() + shapes().w.row(row).norm(),
                         shapes().v.row(row).norm(), !shapes().w.row(row).isZero(0.0));
    const std::vector<double> kinks = laws[i].kinks();
    if (kinks.size() < 2 || weights()[row] == 0.0) continue;
    kinks_.push_back({row, kinks[1], kinks[1] - kinks[0]});
  }
}

PlanarTransient::Motions PlanarTransient::all_motions(const ModalMotion& motion) const {
  const auto of = [&](const Eigen::VectorXd& q) {
    Eigen::MatrixX3d columns(n_points(), 3);
    if (q.size() == 0) {
      columns.setZero();
    } else {
      columns.col(0) = shapes().u.lazyProduct(q);
      columns.col(1) = shapes().v.lazyProduct(q);
      columns.col(2) = shapes().w.lazyProduct(q);
    }
    return columns;
  };
  return {of(motion.q), of(motion.velocity), of(motion.acceleration)};
}

PlanarPointInstant PlanarTransient::instant_at(Eigen::Index i, const ModalMotion& motion,
                                               double least_approach) const {
  const auto of = [&](const Eigen::VectorXd& q) -> Eigen::Vector3d {
    if (q.size() == 0) return Eigen::Vector3d::Zero();
    return {shapes().u.row(i).dot(q), shapes().v.row(i).dot(q), shapes().w.row(i).dot(q)};
  };
  return instant_of(points_[static_cast<std::size_t>(i)],
                    {of(motion.q), of(motion.velocity), of(motion.acceleration)}, least_approach);
}

/// @param tractions  (f_p, n − n_ref, f_r) of each point.
Eigen::VectorXd PlanarTransient::modal_force(Eigen::MatrixX3d tractions) const {
  tractions.array().colwise() *= weights().array();
  return shapes().u.transpose().lazyProduct(tractions.col(0)) +
         shapes().v.transpose().lazyProduct(tractions.col(1)) +
         shapes().w.transpose().lazyProduct(tractions.col(2));
}

Eigen::VectorXd PlanarTransient::trial_force(const ModalMotion& motion,
                                             const TransientMemory& memory) const {
  const Motions all = all_motions(motion);
  Eigen::MatrixX3d tractions = Eigen::MatrixX3d::Zero(n_points(), 3);
  for (Eigen::Index i = 0; i < n_points(); ++i) {
    const PlanarPoint& point = points_[static_cast<std::size_t>(i)];
    const PlanarPointInstant now = instant_of(point, all.of(i));
    tractions(i, 1) = -point.law.reference_load();
    if (now.load <= 0.0) continue;
    tractions(i, 1) += now.normal;
    if (!point.rubs) continue;
    const Vector2d force =
        now.ratio *
        returned_force(spring_force(point, now, slider_of(memory, i)), now.stiffness, now.radius);
    tractions(i, 0) = force[0];
    tractions(i, 2) = force[1];
  }
  return modal_force(std::move(tractions));
}

double PlanarTransient::commit(const ModalMotion& motion, TransientMemory& memory) const {
  const Motions all = all_motions(motion);
  double work = 0.0;
  for (Eigen::Index i = 0; i < n_points(); ++i) {
    const PlanarPoint& point = points_[static_cast<std::size_t>(i)];
    ContactState& state = memory.state[static_cast<std::size_t>(i)];
    const PlanarPointInstant now = instant_of(point, all.of(i));
    const Vector2d before = slider_of(memory, i);
    if (now.load <= 0.0) {
      state = ContactState::separated;
      set_slider(memory, i, now.position);
    } else if (!point.rubs) {
      state = point.law.has_friction() ? ContactState::stick : ContactState::slip;
      set_slider(memory, i, now.position);
    } else {
      const Vector2d trial = spring_force(point, now, before);
      state = trial.norm() <= now.radius ? ContactState::stick : ContactState::slip;
      if (state == ContactState::stick) continue;
      const Vector2d force = returned_force(trial, now.stiffness, now.radius);
      const Vector2d after = now.position - force.cwiseQuotient(now.stiffness);
      set_slider(memory, i, after);
      memory.internal[i] = std::atan2(force[1], force[0]);
      work += weights()[i] * now.ratio * force.dot(after - before);
    }
  }
  return work;
}

Eigen::VectorXd PlanarTransient::held_force(const ModalMotion& motion,
                                            const TransientMemory& memory) const {
  const Motions all = all_motions(motion);
  Eigen::MatrixX3d tractions = Eigen::MatrixX3d::Zero(n_points(), 3);
  for (Eigen::Index i = 0; i < n_points(); ++i) {
    const PlanarPoint& point = points_[static_cast<std::size_t>(i)];
    const ContactState state = memory.state[static_cast<std::size_t>(i)];
    tractions(i, 1) = -point.law.reference_load();
    if (state == ContactState::separated) continue;
    const PlanarPointInstant now = instant_of(point, all.of(i));
    tractions(i, 1) += now.normal;
    if (!point.rubs) continue;
    const Vector2d force = now.ratio * (state == ContactState::stick
                                            ? spring_force(point, now, slider_of(memory, i))
                                            : now.radius * slip_direction(memory.internal[i]));
    tractions(i, 0) = force[0];
    tractions(i, 2) = force[1];
  }
  return modal_force(std::move(tractions));
}

Eigen::VectorXd PlanarTransient::internal_rates(const ModalMotion& motion,
                                                const TransientMemory& memory,
                                                const GuardScale& scale) const {
  const Motions all = all_motions(motion);
  Eigen::VectorXd rates = Eigen::VectorXd::Zero(n_points());
  for (Eigen::Index i = 0; i < n_points(); ++i) {
    const PlanarPoint& point = points_[static_cast<std::size_t>(i)];
    if (memory.state[static_cast<std::size_t>(i)] != ContactState::slip) continue;
    if (!point.rubs) continue;
    const PlanarPointInstant now = instant_of(point, all.of(i));
    rates[i] = turn_rate(point, now, memory.internal[i], edge * spring_size(point, scale));
  }
  return rates;
}

Eigen::VectorXd PlanarTransient::internal_weights(const ModalMotion& motion,
                                                  const TransientMemory& memory,
                                                  const GuardScale& scale) const {
  constexpr double least = 1e-6;  // directions that do not matter stay in order all the same
  const Motions all = all_motions(motion);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(n_points());
  for (Eigen::Index i = 0; i < n_points(); ++i) {
    const PlanarPoint& point = points_[static_cast<std::size_t>(i)];
    if (memory.state[static_cast<std::size_t>(i)] != ContactState::slip || !point.rubs) continue;
    const double size = spring_size(point, scale);
    const double radius = std::abs(instant_of(point, all.of(i)).radius);
    if (radius < size) weights[i] = std::max(radius / size, least);
  }
  return weights;
}

TransientForce::Guards PlanarTransient::guards_at(Eigen::Index i, const PlanarPointInstant& now,
                                                  const TransientMemory& memory,
                                                  const GuardScale& scale) const {
  constexpr double smallest = std::numeric_limits<double>::min();
  const PlanarPoint& point = points_[static_cast<std::size_t>(i)];
  const ContactState state = memory.state[static_cast<std::size_t>(i)];
  if (weights()[i] == 0.0) return {1.0, 1.0};
  const PointParameters& p = point.law.point();
  const double normal_stiffness = p.normal_stiffness * point.normal_size;
  const double load_size =
      std::max(smallest, point.load_size + normal_stiffness * scale.displacement);
  if (state == ContactState::separated) return {-now.load / load_size, 1.0};
  if (!point.rubs) return {now.load / load_size, 1.0};
  if (state == ContactState::stick) {
    const Vector2d slider = slider_of(memory, i);
    const double size = spring_size(point, scale) + point.stiffness.maxCoeff() * slider.norm() +
                        p.friction_coefficient * load_size;
    return {(now.radius - spring_force(point, now, slider).norm()) / std::max(smallest, size),
            now.load / load_size};
  }
  const double softest =
      (point.active.array() > 0.0)
          .select(point.stiffness.array(), std::numeric_limits<double>::infinity())
          .minCoeff();
  const double rate_size =
      (point.tangential_size + p.friction_coefficient * normal_stiffness / softest) *
      scale.velocity;
  return {slip_speed(now, memory.internal[i]) / std::max(smallest, rate_size),
          now.load / load_size};
}

Eigen::Matrix<double, Eigen::Dynamic, TransientForce::guards_per_point> PlanarTransient::guards(
    const ModalMotion& motion, const TransientMemory& memory, const GuardScale& scale) const {
  const Motions all = all_motions(motion);
  Eigen::Matrix<double, Eigen::Dynamic, guards_per_point> result(n_points(), guards_per_point);
  for (Eigen::Index i = 0; i < n_points(); ++i) {
    const PlanarPointInstant now = instant_of(points_[static_cast<std::size_t>(i)], all.of(i));
    const Guards row = guards_at(i, now, memory, scale);
    result(i, 0) = row[0];
    result(i, 1) = row[1];
  }
  return result;
}

TransientForce::Guards PlanarTransient::guards_of(Eigen::Index i, const ModalMotion& motion,
                                                  const TransientMemory& memory,
                                                  const GuardScale& scale) const {
  return guards_at(i, instant_at(i, motion, wherever), memory, scale);
}

Eigen::VectorXd PlanarTransient::kink_distances(const ModalMotion& motion) const {
  Eigen::VectorXd distances(static_cast<Eigen::Index>(kinks_.size()));
  for (Eigen::Index i = 0; i < distances.size(); ++i) {
    const Kink& kink = kinks_[static_cast<std::size_t>(i)];
    distances[i] = (shapes().v.row(kink.point).dot(motion.q) - kink.approach) / kink.width;
  }
  return distances;
}

void PlanarTransient::touch_down(Eigen::Index i, const ModalMotion& motion,
                                 TransientMemory& memory) const {
  const PlanarPoint& point = points_[static_cast<std::size_t>(i)];
  const PlanarPointInstant now = instant_at(i, motion, just_inside(point));
  const Vector2d pull = now.stiffness.cwiseProduct(now.velocity);
  const bool slips = !point.law.has_friction() || (point.rubs && pull.norm() > now.radius_rate);
  memory.state[static_cast<std::size_t>(i)] = slips ? ContactState::slip : ContactState::stick;
  set_slider(memory, i, now.position);  // f = 0 where contact begins
  if (!slips || !point.rubs) return;
  const Vector2d along =
      now.radius_rate > 0.0 ? returned_force(pull, now.stiffness, now.radius_rate) : now.velocity;
  memory.internal[i] = std::atan2(along[1], along[0]);
}

void PlanarTransient::switch_state(Eigen::Index i, const ModalMotion& motion,
                                   TransientMemory& memory) const {
  const PlanarPoint& point = points_[static_cast<std::size_t>(i)];
  ContactState& state = memory.state[static_cast<std::size_t>(i)];
  if (state == ContactState::separated) return touch_down(i, motion, memory);
  const PlanarPointInstant now = instant_at(i, motion, wherever);
  if (now.load <= 0.0) {
    state = ContactState::separated;
    set_slider(memory, i, now.position);
  } else if (state == ContactState::stick) {
    const Vector2d force = spring_force(point, now, slider_of(memory, i));
    const GuardScale here{motion.q.norm(), motion.velocity.norm()};
    memory.internal[i] = starting_angle(point, now, force, edge * spring_size(point, here));
    state = ContactState::slip;
  } else {
    const Vector2d force = now.radius * slip_direction(memory.internal[i]);
    set_slider(memory, i, now.position - force.cwiseQuotient(now.stiffness));
    state = ContactState::stick;
  }
}

double PlanarTransient::slip_power(const ModalMotion& motion, const TransientMemory& memory) const {
  const Motions all = all_motions(motion);
  double power = 0.0;
  for (Eigen::Index i = 0; i < n_points(); ++i) {
    const PlanarPoint& point = points_[static_cast<std::size_t>(i)];
    if (memory.state[static_cast<std::size_t>(i)] != ContactState::slip || !point.rubs) continue;
    const PlanarPointInstant now = instant_of(point, all.of(i));
    power += weights()[i] * now.ratio * now.radius * slip_speed(now, memory.internal[i]);
  }
  return power;
}

Eigen::MatrixXd PlanarTransient::stuck_stiffness() const {
  Eigen::MatrixX3d k = Eigen::MatrixX3d::Zero(n_points(), 3);
  for (Eigen::Index i = 0; i < n_points(); ++i) {
    const PlanarPoint& point = points_[static_cast<std::size_t>(i)];
    k(i, 1) = point.law.point().normal_stiffness;
    if (!point.law.has_friction()) continue;
    k(i, 0) = point.law.first_stiffness();
    k(i, 2) = point.law.second_stiffness();
  }
  k.array().colwise() *= weights().array();
  return shapes().u.transpose() * k.col(0).asDiagonal() * shapes().u +
         shapes().v.transpose() * k.col(1).asDiagonal() * shapes().v +
         shapes().w.transpose() * k.col(2).asDiagonal() * shapes().w;
}

}  // namespace microslip::contact
