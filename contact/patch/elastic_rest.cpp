#include "contact/patch/elastic_rest.hpp"

#include <sstream>
#include <stdexcept>

#include "contact/dense.hpp"
#include "contact/numerics/bracketed_root.hpp"

namespace microslip::contact {
namespace {

void require_sizes(const ElasticFace& face, const SpringLayer& layer) {
  const Eigen::Index n = face.approach.size();
  const Eigen::Index n_points = layer.to_points.rows();
  const bool fits = face.flexibility.rows() == n && face.flexibility.cols() == n &&
                    layer.to_points.cols() == n && layer.weights.size() == n_points &&
                    layer.stiffness.size() == n_points && layer.gap.size() == n_points;
  if (fits) return;
  std::ostringstream message;
  message << "contact at rest: flexibility " << face.flexibility.rows() << " x "
          << face.flexibility.cols() << ", " << n << " displacements, interpolation " << n_points
          << " x " << layer.to_points.cols() << ", " << layer.weights.size() << " weights, "
          << layer.stiffness.size() << " stiffnesses, " << layer.gap.size() << " gaps";
  throw std::invalid_argument(message.str());
}

class RestingFace {
 public:
  RestingFace(const ElasticFace& face, const SpringLayer& layer)
      : face_(face), layer_(layer), springs_(layer.weights.cwiseProduct(layer.stiffness)) {
    require_sizes(face, layer);
  }

  [[nodiscard]] Eigen::VectorXd displacement() const {
    constexpr int max_steps = 200;
    State now{face_.approach, Eigen::VectorXd::Zero(face_.approach.size())};
    for (int step = 0; step < max_steps; ++step) {
      const State linear = linear_state(now.v);
      if (same_state(points_at(linear.v), points_at(now.v))) return linear.v;
      now = along(now, linear);
    }
    std::ostringstream message;
    message << "contact at rest: forces of " << now.force.norm() << " N are out of balance by "
            << (force_at(now.v) - now.force).norm() << " N after " << max_steps << " steps";
    throw std::runtime_error(message.str());
  }

 private:
  /// v = v⁰ − C force, whether or not the springs carry that force.
  struct State {
    Eigen::VectorXd v;
    Eigen::VectorXd force;
  };

  [[nodiscard]] Eigen::VectorXd points_at(const Eigen::VectorXd& v) const {
    return layer_.to_points * v - layer_.gap;
  }

  /// Whether the same points are closed; those that touch to rounding may go on and off.
  [[nodiscard]] bool same_state(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b) const {
    const double rounding =
        1e-14 * (face_.approach.lpNorm<Eigen::Infinity>() + layer_.gap.lpNorm<Eigen::Infinity>());
    return ((a > 0.0) == (b > 0.0) || a.abs() <= rounding).all();
  }

  [[nodiscard]] Eigen::VectorXd force_at(const Eigen::VectorXd& v) const {
    return layer_.to_points.transpose() * springs_.cwiseProduct(points_at(v).cwiseMax(0.0));
  }

  /// (2) with the points that are closed at v.
  [[nodiscard]] State linear_state(const Eigen::VectorXd& v) const {
    const auto& B = layer_.to_points;
    const Eigen::VectorXd closed =
        (points_at(v).array() > 0.0).select(springs_, Eigen::VectorXd::Zero(springs_.size()));
    const Eigen::MatrixXd D = Eigen::MatrixXd(B.transpose() * closed.asDiagonal() * B);
    const Eigen::VectorXd of_gap = B.transpose() * closed.cwiseProduct(layer_.gap);
    const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(v.size(), v.size()) + face_.flexibility * D;
    const Eigen::VectorXd v_closed = solved(A, face_.approach + face_.flexibility * of_gap);
    return {v_closed, D * v_closed - of_gap};
  }

  /// The least energy between two states; its slope is monotone along the way.
  [[nodiscard]] State along(const State& from, const State& to) const {
    const State way{to.v - from.v, to.force - from.force};
    const auto at = [&](double t) -> State {
      return {from.v + t * way.v, from.force + t * way.force};
    };
    const auto slope = [&](double t) {
      const State state = at(t);
      return (force_at(state.v) - state.force).dot(way.v);
    };
    const double first = slope(0.0);
    const double last = slope(1.0);
    if (!(first < 0.0) || last <= 1e-12 * -first) return to;
    return at(bracketed_root(slope, 0.0, 1.0, first, last));
  }

  const ElasticFace& face_;
  const SpringLayer& layer_;
  Eigen::VectorXd springs_;  // w k
};

}  // namespace

Eigen::VectorXd elastic_rest(const ElasticFace& face, const SpringLayer& layer) {
  return RestingFace(face, layer).displacement();
}

}  // namespace microslip::contact
