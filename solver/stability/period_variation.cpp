#include "solver/stability/period_variation.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "contact/dense.hpp"

namespace microslip::solver {
namespace {

using contact::ContactState;
using contact::TransientForce;

/// A function of q, its value and gradient by differences: exact for what is linear,
/// up to rounding.
template <typename Function>
Eigen::VectorXd gradient(const Function& value, const ModalMotion& at, double step) {
  Eigen::VectorXd result(at.q.size());
  for (Eigen::Index i = 0; i < at.q.size(); ++i) {
    ModalMotion ahead = at;
    ModalMotion behind = at;
    ahead.q[i] += step;
    behind.q[i] -= step;
    result[i] = (value(ahead) - value(behind)) / (2.0 * step);
  }
  return result;
}

class PeriodVariation {
 public:
  PeriodVariation(const TimeSystem& system, Variation begin)
      : system_(system),
        contact_(system.contact()),
        n_(system.n_modes()),
        fastest_(system.largest_frequency()),
        now_(std::move(begin)) {}

  Variation run(const std::vector<HeldPart>& parts, const TransientMemory& end) {
    for (std::size_t k = 0; k < parts.size(); ++k) {
      hold(parts[k]);
      rest(parts[k], k + 1 < parts.size() ? parts[k + 1].memory : end);
    }
    return std::move(now_);
  }

 private:
  [[nodiscard]] static std::vector<Eigen::Index> stuck(const TransientMemory& memory) {
    std::vector<Eigen::Index> points;
    for (std::size_t i = 0; i < memory.state.size(); ++i) {
      if (memory.state[i] == ContactState::stick) points.push_back(static_cast<Eigen::Index>(i));
    }
    return points;
  }

  /// A of (1) for x = (q, q̇/w, sliders of the stuck points): all terms of order w.
  [[nodiscard]] Eigen::MatrixXd rates(const HeldPart& part,
                                      const std::vector<Eigen::Index>& points) const {
    const Scene& scene = system_.scene();
    const auto n_points = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n_ + n_points, 2 * n_ + n_points);
    A.block(0, n_, n_, n_).diagonal().setConstant(fastest_);
    A.block(n_, 0, n_, n_).diagonal() = -scene.natural_frequency.cwiseAbs2() / fastest_;
    A.block(n_, n_, n_, n_).diagonal() =
        -2.0 * scene.damping_ratio.cwiseProduct(scene.natural_frequency);
    if (contact_ == nullptr) return A;
    const ModalMotion rest{Eigen::VectorXd::Zero(n_), Eigen::VectorXd::Zero(n_)};
    const Eigen::VectorXd none = contact_->held_force(rest, part.memory);
    const auto force = [&](const ModalMotion& motion, const TransientMemory& memory) {
      return Eigen::VectorXd((contact_->held_force(motion, memory) - none) / fastest_);
    };
    for (Eigen::Index i = 0; i < n_; ++i) {
      ModalMotion unit = rest;
      unit.q[i] = 1.0;
      A.col(i).segment(n_, n_) -= force(unit, part.memory);
    }
    for (Eigen::Index i = 0; i < n_points; ++i) {
      TransientMemory moved = part.memory;
      moved.slider[points[static_cast<std::size_t>(i)]] += 1.0;
      A.col(2 * n_ + i).segment(n_, n_) -= force(rest, moved);
    }
    return A;
  }

  void hold(const HeldPart& part) {
    const std::vector<Eigen::Index> points = stuck(part.memory);
    Eigen::MatrixXd x(2 * n_ + static_cast<Eigen::Index>(points.size()), now_.q.cols());
    x << now_.q, now_.velocity / fastest_, now_.slider(points, Eigen::all);
    x = contact::exponential(part.duration * rates(part, points)) * x;
    now_.q = x.topRows(n_);
    now_.velocity = fastest_ * x.middleRows(n_, n_);
  }

  /// (2) and (3) for points that stick from here on.
  void rest(const HeldPart& part, const TransientMemory& next) {
    for (std::size_t i = 0; i < next.state.size(); ++i) {
      const bool begins =
          next.state[i] == ContactState::stick && part.memory.state[i] != ContactState::stick;
      const auto point = static_cast<Eigen::Index>(i);
      if (begins) now_.slider.row(point) = slider_change(point, part).transpose() * now_.q;
    }
  }

  /// Row that makes δs of δq.
  [[nodiscard]] Eigen::VectorXd slider_change(Eigen::Index point, const HeldPart& part) const {
    const auto slider = [&](const ModalMotion& motion) {
      TransientMemory memory = part.memory;
      contact_->switch_state(point, motion, memory);
      return memory.slider[point];
    };
    const contact::GuardScale size{part.end.q.norm(), part.end.velocity.norm()};
    constexpr double nearby = 1e-6;  // of the motion: the point comes to rest there as well
    const double step = nearby * size.displacement;
    Eigen::VectorXd along = gradient(slider, part.end, step);
    if (part.memory.state[static_cast<std::size_t>(point)] != ContactState::separated) return along;
    const auto guard = [&](const ModalMotion& motion) {
      const TransientForce::Guards guards = contact_->guards_of(point, motion, part.memory, size);
      return std::min(guards[0], guards[1]);
    };
    const Eigen::VectorXd closing = gradient(guard, part.end, step);
    const Eigen::VectorXd& velocity = part.end.velocity;
    return along - (along.dot(velocity) / closing.dot(velocity)) * closing;
  }

  const TimeSystem& system_;
  const TransientForce* contact_;  // nullptr: none
  Eigen::Index n_;
  double fastest_;  // [rad/s]
  Variation now_;
};

}  // namespace

Variation varied_period(const TimeSystem& system, const std::vector<HeldPart>& parts,
                        const TransientMemory& end, Variation begin) {
  return PeriodVariation(system, std::move(begin)).run(parts, end);
}

}  // namespace microslip::solver
