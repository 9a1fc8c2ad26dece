#include "contact/planar_transient.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact/planar_slip.hpp"

namespace microslip::contact {
namespace {

using Eigen::Vector2d;

/// ε of the header, against K₀ times the motion.
constexpr double edge = 1e-5;

void require_shape(const char* name, const Eigen::MatrixXd& shape, Eigen::Index rows,
                   Eigen::Index columns) {
  if (shape.rows() != rows || shape.cols() != columns) {
    throw std::invalid_argument("PlanarTransient: mode shapes " + std::string(name) + " are " +
                                std::to_string(shape.rows()) + " x " +
                                std::to_string(shape.cols()) + ", expected " +
                                std::to_string(rows) + " x " + std::to_string(columns));
  }
  if (!shape.allFinite()) {
    throw std::invalid_argument("PlanarTransient: mode shapes " + std::string(name) +
                                " have a value that is not finite");
  }
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

Vector2d direction(double angle) { return {std::cos(angle), std::sin(angle)}; }
Vector2d across(const Vector2d& e) { return {-e[1], e[0]}; }

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
};

struct PlanarTransient::Instant {
  Vector2d position = Vector2d::Zero();  ///< x, in active directions
  Vector2d velocity = Vector2d::Zero();
  double load = 0.0;    ///< tells contact by its sign: of smooth surfaces of the same stiffness
  double normal = 0.0;  ///< n while in contact
  double ratio = 1.0;   ///< g
  double radius = 0.0;  ///< r
  double radius_rate = 0.0;

  Instant(const Point& point, const Motions& all, Eigen::Index row, double least_approach);
  Instant(const Point& point, const Motions& all, Eigen::Index row)
      : Instant(point, all, row, -std::numeric_limits<double>::infinity()) {}
  [[nodiscard]] Vector2d trial(const Point& point, const Vector2d& slider) const {
    return point.stiffness.cwiseProduct(position - slider).cwiseProduct(point.active);
  }
  [[nodiscard]] double slip_speed(const Point& point, const Vector2d& e) const {
    PlanarInstant now;
    now.velocity = velocity;
    now.radius_rate = radius_rate;
    return slip_rate(now, e, point.compliance);
  }
};

PlanarTransient::Instant::Instant(const Point& point, const Motions& all, Eigen::Index row,
                                  double least_approach) {
  const SurfaceLaw& law = point.law;
  const Vector2d rate(all.rate(row, 0), all.rate(row, 2));
  position = Vector2d(all.value(row, 0), all.value(row, 2)).cwiseProduct(point.active);
  velocity = rate.cwiseProduct(point.active);
  const double speed = law.is_rate_dependent() ? rate.norm() : 0.0;
  const double speed_rate =
      speed > 0.0 ? rate.dot(Vector2d(all.second(row, 0), all.second(row, 2))) / speed : 0.0;
  const double approach = std::max(all.value(row, 1), least_approach);
  const double stiffness = law.point().normal_stiffness;
  const SurfaceState y = law.at(approach, speed);
  const bool smooth = law.is_smooth();
  normal = smooth ? y.gap_load : y.load;
  load = smooth ? y.gap_load
                : (std::isnan(point.touch) ? point.load_size : stiffness * (approach - point.touch));
  ratio = y.stiffness_ratio;
  const double per_ratio = smooth ? y.gap_load : y.load_per_ratio;
  const double per_ratio_by_approach = smooth ? stiffness : y.load_per_ratio_by_approach;
  radius = y.friction_coefficient * per_ratio;
  radius_rate = y.friction_coefficient * per_ratio_by_approach * all.rate(row, 1) +
                y.friction_coefficient_by_rate * per_ratio * speed_rate;
}

PlanarTransient::PlanarTransient(Eigen::VectorXd weights, std::vector<SurfaceLaw> laws,
                                 ModalShapes shapes)
    : weights_(std::move(weights)), shapes_(std::move(shapes)) {
  require_weights(weights_, laws.size());
  if (shapes_.w.size() == 0) {
    shapes_.w = Eigen::MatrixXd::Zero(shapes_.u.rows(), shapes_.u.cols());
  }
  for (const auto& [name, shape] :
       {std::pair{"u", &shapes_.u}, std::pair{"v", &shapes_.v}, std::pair{"w", &shapes_.w}}) {
    require_shape(name, *shape, weights_.size(), shapes_.u.cols());
  }
  points_.reserve(laws.size());
  for (const SurfaceLaw& law : laws) {
    points_.push_back(make_point(law, static_cast<Eigen::Index>(points_.size())));
  }
}

PlanarTransient::Point PlanarTransient::make_point(const SurfaceLaw& law, Eigen::Index row) const {
  const bool moves_along_r = !shapes_.w.row(row).isZero(0.0);
  const Vector2d k(law.first_stiffness(), moves_along_r ? law.second_stiffness() : 0.0);
  const std::vector<double> kinks = law.kinks();
  const double touch = kinks.empty() ? std::numeric_limits<double>::quiet_NaN() : kinks.front();
  const bool slides = law.at(0.0, 0.0).friction_coefficient > 0.0;
  const Vector2d stiffness = (k.array() > 0.0).select(k, 1.0);
  double load_size = std::max(law.load_at_rest(), std::abs(law.point().preload));
  if (!std::isnan(touch)) {
    load_size = std::max(load_size, law.point().normal_stiffness * std::abs(touch));
  }
  return {law,
          stiffness,
          stiffness.cwiseInverse(),
          (k.array() > 0.0).cast<double>(),
          touch,
          load_size,
          shapes_.u.row(row).norm() + shapes_.w.row(row).norm(),
          shapes_.v.row(row).norm(),
          slides,
          slides && (k.array() > 0.0).any()};
}

PlanarTransient::Motions PlanarTransient::all_motions(const ModalMotion& motion) const {
  const auto of = [&](const Eigen::VectorXd& q) {
    Eigen::MatrixX3d columns(n_points(), 3);
    if (q.size() == 0) {
      columns.setZero();
    } else {
      columns << shapes_.u * q, shapes_.v * q, shapes_.w * q;
    }
    return columns;
  };
  return {of(motion.q), of(motion.velocity), of(motion.acceleration)};
}

PlanarTransient::Motions PlanarTransient::motion_of(Eigen::Index i,
                                                    const ModalMotion& motion) const {
  const auto of = [&](const Eigen::VectorXd& q) {
    Eigen::MatrixX3d row = Eigen::MatrixX3d::Zero(1, 3);
    if (q.size() > 0) {
      row << shapes_.u.row(i).dot(q), shapes_.v.row(i).dot(q), shapes_.w.row(i).dot(q);
    }
    return row;
  };
  return {of(motion.q), of(motion.velocity), of(motion.acceleration)};
}

TransientMemory PlanarTransient::virgin_memory() const {
  TransientMemory memory{std::vector<ContactState>(points_.size()),
                         Eigen::VectorXd::Zero(2 * n_points()), Eigen::VectorXd::Zero(n_points())};
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(n_modes());
  commit({rest, rest}, memory);
  return memory;
}

/// @param tractions  (f_p, n − n_ref, f_r) of each point.
Eigen::VectorXd PlanarTransient::modal_force(Eigen::MatrixX3d tractions) const {
  tractions.array().colwise() *= weights_.array();
  return shapes_.u.transpose() * tractions.col(0) + shapes_.v.transpose() * tractions.col(1) +
         shapes_.w.transpose() * tractions.col(2);
}

Eigen::VectorXd PlanarTransient::trial_force(const ModalMotion& motion,
                                             const TransientMemory& memory) const {
  const Motions all = all_motions(motion);
  Eigen::MatrixX3d tractions = Eigen::MatrixX3d::Zero(n_points(), 3);
  for (Eigen::Index i = 0; i < n_points(); ++i) {
    const Point& point = points_[static_cast<std::size_t>(i)];
    const Instant now(point, all, i);
    tractions(i, 1) = -point.law.load_at_rest();
    if (now.load <= 0.0) continue;
    tractions(i, 1) += now.normal;
    if (!point.rubs) continue;
    const Vector2d force = now.ratio * returned_force(now.trial(point, slider_of(memory, i)),
                                                      point.stiffness, now.radius);
    tractions(i, 0) = force[0];
    tractions(i, 2) = force[1];
  }
  return modal_force(std::move(tractions));
}

double PlanarTransient::commit(const ModalMotion& motion, TransientMemory& memory) const {
  const Motions all = all_motions(motion);
  double work = 0.0;
  for (Eigen::Index i = 0; i < n_points(); ++i) {
    const Point& point = points_[static_cast<std::size_t>(i)];
    ContactState& state = memory.state[static_cast<std::size_t>(i)];
    const Instant now(point, all, i);
    const Vector2d before = slider_of(memory, i);
    if (now.load <= 0.0) {
      state = ContactState::separated;
      set_slider(memory, i, now.position);
    } else if (!point.rubs) {
      state = point.slides ? ContactState::stick : ContactState::slip;
      set_slider(memory, i, now.position);
    } else {
      const Vector2d trial = now.trial(point, before);
      state = trial.norm() <= now.radius ? ContactState::stick : ContactState::slip;
      if (state == ContactState::stick) continue;
      const Vector2d force = returned_force(trial, point.stiffness, now.radius);
      const Vector2d after = now.position - point.compliance.cwiseProduct(force);
      set_slider(memory, i, after);
      memory.internal[i] = std::atan2(force[1], force[0]);
      work += weights_[i] * now.ratio * force.dot(after - before);
    }
  }
  return work;
}

Eigen::VectorXd PlanarTransient::held_force(const ModalMotion& motion,
                                            const TransientMemory& memory) const {
  const Motions all = all_motions(motion);
  Eigen::MatrixX3d tractions = Eigen::MatrixX3d::Zero(n_points(), 3);
  for (Eigen::Index i = 0; i < n_points(); ++i) {
    const Point& point = points_[static_cast<std::size_t>(i)];
    const ContactState state = memory.state[static_cast<std::size_t>(i)];
    tractions(i, 1) = -point.law.load_at_rest();
    if (state == ContactState::separated) continue;
    const Instant now(point, all, i);
    tractions(i, 1) += now.normal;
    if (!point.rubs) continue;
    const Vector2d force =
        now.ratio * (state == ContactState::stick ? now.trial(point, slider_of(memory, i))
                                                  : now.radius * direction(memory.internal[i]));
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
    const Point& point = points_[static_cast<std::size_t>(i)];
    if (memory.state[static_cast<std::size_t>(i)] != ContactState::slip) continue;
    if (!point.rubs || point.active.sum() < 2.0) continue;  // along a line nothing turns
    const Instant now(point, all, i);
    const Vector2d e = direction(memory.internal[i]);
    const Vector2d turn = across(e);
    const Vector2d dragged = now.velocity - now.radius_rate * point.compliance.cwiseProduct(e);
    const double size = point.stiffness.maxCoeff() * point.tangential_size * scale.displacement;
    rates[i] = turn.dot(dragged) / (std::hypot(now.radius, edge * size) *
                                    turn.dot(point.compliance.cwiseProduct(turn)));
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
    const Point& point = points_[static_cast<std::size_t>(i)];
    if (memory.state[static_cast<std::size_t>(i)] != ContactState::slip || !point.rubs) continue;
    const double size = point.stiffness.maxCoeff() * point.tangential_size * scale.displacement;
    const double radius = std::abs(Instant(point, all, i).radius);
    if (radius < size) weights[i] = std::max(radius / size, least);
  }
  return weights;
}

TransientForce::Guards PlanarTransient::guards_at(Eigen::Index i, const Instant& now,
                                                  const TransientMemory& memory,
                                                  const GuardScale& scale) const {
  constexpr double smallest = std::numeric_limits<double>::min();
  const Point& point = points_[static_cast<std::size_t>(i)];
  const ContactState state = memory.state[static_cast<std::size_t>(i)];
  if (weights_[i] == 0.0) return {1.0, 1.0};
  const PointParameters& p = point.law.point();
  const double normal_stiffness = p.normal_stiffness * point.normal_size;
  const double load_size =
      std::max(smallest, point.load_size + normal_stiffness * scale.displacement);
  if (state == ContactState::separated) return {-now.load / load_size, 1.0};
  if (!point.rubs) return {now.load / load_size, 1.0};
  const double k = point.stiffness.maxCoeff();
  if (state == ContactState::stick) {
    const Vector2d slider = slider_of(memory, i);
    const double size =
        k * (point.tangential_size * scale.displacement + slider.norm()) +
        p.friction_coefficient * load_size;
    return {(now.radius - now.trial(point, slider).norm()) / std::max(smallest, size),
            now.load / load_size};
  }
  const double rate_size =
      (point.tangential_size +
       point.compliance.maxCoeff() * p.friction_coefficient * normal_stiffness) *
      scale.velocity;
  return {now.slip_speed(point, direction(memory.internal[i])) / std::max(smallest, rate_size),
          now.load / load_size};
}

Eigen::Matrix<double, Eigen::Dynamic, TransientForce::guards_per_point> PlanarTransient::guards(
    const ModalMotion& motion, const TransientMemory& memory, const GuardScale& scale) const {
  const Motions all = all_motions(motion);
  Eigen::Matrix<double, Eigen::Dynamic, guards_per_point> result(n_points(), guards_per_point);
  for (Eigen::Index i = 0; i < n_points(); ++i) {
    const Instant now(points_[static_cast<std::size_t>(i)], all, i);
    const Guards row = guards_at(i, now, memory, scale);
    result(i, 0) = row[0];
    result(i, 1) = row[1];
  }
  return result;
}

TransientForce::Guards PlanarTransient::guards_of(Eigen::Index i, const ModalMotion& motion,
                                                  const TransientMemory& memory,
                                                  const GuardScale& scale) const {
  const Instant now(points_[static_cast<std::size_t>(i)], motion_of(i, motion), 0);
  return guards_at(i, now, memory, scale);
}

void PlanarTransient::switch_state(Eigen::Index i, const ModalMotion& motion,
                                   TransientMemory& memory) const {
  const Point& point = points_[static_cast<std::size_t>(i)];
  const Motions here = motion_of(i, motion);
  const Instant now(point, here, 0);
  ContactState& state = memory.state[static_cast<std::size_t>(i)];
  if (state == ContactState::separated) {
    // Rough surfaces touch with a kink in r: the side that is meant is the closed one.
    const std::vector<double> kinks = point.law.kinks();
    const double inside =
        kinks.size() < 2 ? -std::numeric_limits<double>::infinity()
                         : kinks[0] + 1e-9 * (kinks[1] - kinks[0]);
    const double radius_rate = Instant(point, here, 0, inside).radius_rate;
    const Vector2d pull = point.stiffness.cwiseProduct(now.velocity);
    set_slider(memory, i, now.position);  // f = 0 where contact begins
    const bool slips = !point.slides || (point.rubs && pull.norm() > radius_rate);
    state = slips ? ContactState::slip : ContactState::stick;
    if (slips && point.rubs) {
      const Vector2d along =
          radius_rate > 0.0 ? returned_force(pull, point.stiffness, radius_rate) : now.velocity;
      memory.internal[i] = std::atan2(along[1], along[0]);
    }
  } else if (now.load <= 0.0) {
    state = ContactState::separated;
    set_slider(memory, i, now.position);
  } else if (state == ContactState::stick) {
    const Vector2d force = now.trial(point, slider_of(memory, i));
    memory.internal[i] = std::atan2(force[1], force[0]);
    state = ContactState::slip;
  } else {
    const Vector2d force = now.radius * direction(memory.internal[i]);
    set_slider(memory, i, now.position - point.compliance.cwiseProduct(force));
    state = ContactState::stick;
  }
}

double PlanarTransient::slip_power(const ModalMotion& motion, const TransientMemory& memory) const {
  const Motions all = all_motions(motion);
  double power = 0.0;
  for (Eigen::Index i = 0; i < n_points(); ++i) {
    const Point& point = points_[static_cast<std::size_t>(i)];
    if (memory.state[static_cast<std::size_t>(i)] != ContactState::slip || !point.rubs) continue;
    const Instant now(point, all, i);
    power += weights_[i] * now.ratio * now.radius *
             now.slip_speed(point, direction(memory.internal[i]));
  }
  return power;
}

StateShares PlanarTransient::shares(const TransientMemory& memory) const {
  StateShares area;
  for (Eigen::Index i = 0; i < n_points(); ++i) {
    const ContactState state = memory.state[static_cast<std::size_t>(i)];
    double& part = state == ContactState::stick       ? area.stick
                   : state == ContactState::separated ? area.separated
                                                      : area.slip;
    part += weights_[i];
  }
  const double total = weights_.sum();
  if (total == 0.0) return {};
  return {area.stick / total, area.slip / total, area.separated / total};
}

Eigen::MatrixXd PlanarTransient::stuck_stiffness() const {
  Eigen::MatrixX3d k = Eigen::MatrixX3d::Zero(n_points(), 3);
  for (Eigen::Index i = 0; i < n_points(); ++i) {
    const Point& point = points_[static_cast<std::size_t>(i)];
    k(i, 1) = point.law.point().normal_stiffness;
    if (!point.slides) continue;
    k(i, 0) = point.law.first_stiffness();
    k(i, 2) = point.law.second_stiffness();
  }
  k.array().colwise() *= weights_.array();
  return shapes_.u.transpose() * k.col(0).asDiagonal() * shapes_.u +
         shapes_.v.transpose() * k.col(1).asDiagonal() * shapes_.v +
         shapes_.w.transpose() * k.col(2).asDiagonal() * shapes_.w;
}

}  // namespace microslip::contact
