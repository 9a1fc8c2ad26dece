#include "contact/patch/elastic_rest.hpp"

#include <sstream>
#include <stdexcept>

#include "contact/bracketed_root.hpp"
#include "contact/dense.hpp"

namespace microslip::contact {
namespace {

void require_sizes(const ElasticFace& face, const ContactLayer& layer) {
  const Eigen::Index n = face.approach.size();
  const Eigen::Index n_points = layer.to_points.rows();
  const Eigen::Index n_surfaces = std::ssize(layer.surfaces);
  const bool fits = face.flexibility.rows() == n && face.flexibility.cols() == n &&
                    layer.to_points.cols() == n && layer.weights.size() == n_points &&
                    layer.stiffness.size() == n_points && layer.gap.size() == n_points &&
                    (n_surfaces == 0 || n_surfaces == n_points);
  if (fits) return;
  std::ostringstream message;
  message << "contact at rest: flexibility " << face.flexibility.rows() << " x "
          << face.flexibility.cols() << ", " << n << " displacements, interpolation " << n_points
          << " x " << layer.to_points.cols() << ", " << layer.weights.size() << " weights, "
          << layer.stiffness.size() << " stiffnesses, " << layer.gap.size() << " gaps, "
          << n_surfaces << " surfaces";
  throw std::invalid_argument(message.str());
}

class RestingFace {
 public:
  RestingFace(const ElasticFace& face, const ContactLayer& layer)
      : face_(face), layer_(layer), smooth_(RoughSurface::cubic(0.0)) {}

  [[nodiscard]] ElasticRest solve() const {
    constexpr int max_steps = 200;
    Balance now{face_.approach, Eigen::VectorXd::Zero(face_.approach.size())};
    for (int step = 0; step < max_steps; ++step) {
      const Layer at = layer_at(points_at(now.v));
      const Balance linear = linear_balance(at);
      if (is_state_of(points_at(linear.v), at)) return rest_at(linear.v);
      now = along(now, linear);
    }
    std::ostringstream message;
    message << "contact at rest: forces of " << now.force.norm() << " N are out of balance by "
            << (force_at(now.v) - now.force).norm() << " N after " << max_steps << " steps";
    throw std::runtime_error(message.str());
  }

 private:
  /// v = v⁰ − C force, whether or not the points carry that force.
  struct Balance {
    Eigen::VectorXd v;
    Eigen::VectorXd force;
  };

  /// Points at one approach: a, δ and δ' of each.
  struct Layer {
    Eigen::VectorXd approach;
    Eigen::VectorXd compression;
    Eigen::VectorXd share;
  };

  [[nodiscard]] Eigen::VectorXd points_at(const Eigen::VectorXd& v) const {
    return layer_.to_points * v - layer_.gap;
  }

  [[nodiscard]] const RoughSurface& surface(Eigen::Index i) const {
    return layer_.surfaces.empty() ? smooth_ : layer_.surfaces[static_cast<std::size_t>(i)];
  }

  [[nodiscard]] Layer layer_at(Eigen::VectorXd approach) const {
    const Eigen::Index n = approach.size();
    Layer layer{std::move(approach), Eigen::VectorXd(n), Eigen::VectorXd(n)};
    for (Eigen::Index i = 0; i < n; ++i) {
      const RoughState state = surface(i).at(layer.approach[i]);
      layer.compression[i] = state.compression;
      layer.share[i] = state.share;
    }
    return layer;
  }

  /// Whether points that were linear about `at` are what they are at `a`, to rounding.
  [[nodiscard]] bool is_state_of(const Eigen::VectorXd& a, const Layer& at) const {
    const double rounding =
        1e-14 * (face_.approach.lpNorm<Eigen::Infinity>() + layer_.gap.lpNorm<Eigen::Infinity>());
    const Eigen::VectorXd linear = at.compression + at.share.cwiseProduct(a - at.approach);
    return ((layer_at(a).compression - linear).array().abs() <= rounding).all();
  }

  [[nodiscard]] Eigen::VectorXd pressure_of(const Layer& at) const {
    return layer_.stiffness.cwiseProduct(at.compression);
  }

  [[nodiscard]] Eigen::VectorXd force_at(const Eigen::VectorXd& v) const {
    return layer_.to_points.transpose() *
           layer_.weights.cwiseProduct(pressure_of(layer_at(points_at(v))));
  }

  [[nodiscard]] ElasticRest rest_at(const Eigen::VectorXd& v) const {
    const Layer at = layer_at(points_at(v));
    return {v, at.approach, pressure_of(at)};
  }

  /// (2)
  [[nodiscard]] Balance linear_balance(const Layer& at) const {
    const auto& B = layer_.to_points;
    const Eigen::VectorXd springs =
        layer_.weights.cwiseProduct(layer_.stiffness).cwiseProduct(at.share);
    // Of smooth surfaces the second part is 0 to the last bit.
    const Eigen::VectorXd curved = at.share.cwiseProduct(at.approach) - at.compression;
    const Eigen::VectorXd offset =
        B.transpose() * (springs.cwiseProduct(layer_.gap) +
                         layer_.weights.cwiseProduct(layer_.stiffness).cwiseProduct(curved));
    const Eigen::MatrixXd D = Eigen::MatrixXd(B.transpose() * springs.asDiagonal() * B);
    const Eigen::Index n = face_.approach.size();
    const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n, n) + face_.flexibility * D;
    const Eigen::VectorXd v = solved(A, face_.approach + face_.flexibility * offset);
    return {v, D * v - offset};
  }

  /// The least energy between two states; its slope is monotone along the way.
  [[nodiscard]] Balance along(const Balance& from, const Balance& to) const {
    const Balance way{to.v - from.v, to.force - from.force};
    const auto at = [&](double t) -> Balance {
      return {from.v + t * way.v, from.force + t * way.force};
    };
    const auto slope = [&](double t) {
      const Balance state = at(t);
      return (force_at(state.v) - state.force).dot(way.v);
    };
    const double first = slope(0.0);
    const double last = slope(1.0);
    if (!(first < 0.0) || last <= 1e-12 * -first) return to;
    return at(bracketed_root(slope, 0.0, 1.0, first, last));
  }

  const ElasticFace& face_;
  const ContactLayer& layer_;
  RoughSurface smooth_;
};

}  // namespace

ElasticRest elastic_rest(const ElasticFace& face, const ContactLayer& layer) {
  require_sizes(face, layer);
  return RestingFace(face, layer).solve();
}

}  // namespace microslip::contact
