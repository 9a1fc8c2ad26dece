#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/LU>

#include "contact/numerics/chebyshev_surface.hpp"

namespace microslip::contact {
namespace {

// A square inside the first one, with both surfaces on it.
struct Box {
  ChebyshevSurface f;
  ChebyshevSurface g;
  Eigen::Vector2d centre;
  double half;
};

// The system multiplied by the inverse of its linear part.
struct Preconditioned {
  Eigen::Vector2d constant;
  Eigen::Vector2d rest;       // Σ |c| beyond the linear terms
  Eigen::Vector2d curvature;  // bound of what these do to the derivatives
};

std::optional<Preconditioned> precondition(const Box& box) {
  const Eigen::MatrixXd& f = box.f.coefficients();
  const Eigen::MatrixXd& g = box.g.coefficients();
  Eigen::Matrix2d linear;
  linear << f(1, 0), f(0, 1), g(1, 0), g(0, 1);
  const double size = linear.row(0).norm() * linear.row(1).norm();
  // Nearly parallel gradients: the inverse would not say anything.
  if (!(std::abs(linear.determinant()) > 1e-10 * size)) {
    return std::nullopt;
  }
  const Eigen::Matrix2d A = linear.inverse();
  Preconditioned result{A * Eigen::Vector2d(f(0, 0), g(0, 0)), Eigen::Vector2d::Zero(),
                        Eigen::Vector2d::Zero()};
  for (Eigen::Index i = 0; i < f.rows(); ++i) {
    for (Eigen::Index j = 0; j < f.cols(); ++j) {
      if (i + j > 1) {
        const Eigen::Vector2d c = (A * Eigen::Vector2d(f(i, j), g(i, j))).cwiseAbs();
        result.rest += c;
        result.curvature += c * static_cast<double>(i * i + j * j);  // |T_k'| ≤ k²
      }
    }
  }
  return result;
}

std::optional<Eigen::Vector2d> newton(const Box& box) {
  const ChebyshevSurface fx = box.f.derivative_x();
  const ChebyshevSurface fy = box.f.derivative_y();
  const ChebyshevSurface gx = box.g.derivative_x();
  const ChebyshevSurface gy = box.g.derivative_y();
  Eigen::Vector2d x = Eigen::Vector2d::Zero();
  for (int step = 0; step < 30; ++step) {
    Eigen::Matrix2d J;
    J << fx.value(x[0], x[1]), fy.value(x[0], x[1]), gx.value(x[0], x[1]), gy.value(x[0], x[1]);
    const Eigen::Vector2d dx =
        J.inverse() * Eigen::Vector2d(box.f.value(x[0], x[1]), box.g.value(x[0], x[1]));
    if (!dx.allFinite()) {
      return std::nullopt;
    }
    x -= dx;
    if (x.cwiseAbs().maxCoeff() > 1.5) {
      return std::nullopt;
    }
    if (dx.norm() < 1e-13) {
      break;
    }
  }
  // A root on the side of two boxes may lie outside both by rounding; twice does no harm.
  if (x.cwiseAbs().maxCoeff() > 1.0 + 1e-9) {
    return std::nullopt;
  }
  return box.centre + box.half * x;
}

bool excluded(const ChebyshevSurface& surface) {
  return std::abs(surface.coefficients()(0, 0)) > surface.variation();
}

enum class Verdict { empty, one, open };

Verdict judge(const Box& box) {
  if (excluded(box.f) || excluded(box.g)) {
    return Verdict::empty;
  }
  const auto system = precondition(box);
  if (!system) {
    return Verdict::open;
  }
  const Eigen::Array2d reach = 1.0 + system->rest.array();
  if ((system->constant.array().abs() > reach).any()) {
    return Verdict::empty;
  }
  return system->curvature.maxCoeff() < 0.7 ? Verdict::one : Verdict::open;
}

std::vector<Box> children(const Box& box) {
  const auto f = box.f.quarters();
  const auto g = box.g.quarters();
  std::vector<Box> result;
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector2d side((k & 1U) != 0 ? 0.5 : -0.5, (k & 2U) != 0 ? 0.5 : -0.5);
    result.push_back({f[k], g[k], box.centre + box.half * side, 0.5 * box.half});
  }
  return result;
}

}  // namespace

std::vector<Eigen::Vector2d> common_roots(const ChebyshevSurface& f, const ChebyshevSurface& g) {
  // A curve of common zeros keeps about 2^level boxes open, isolated ones a few each.
  constexpr std::size_t too_many = 200;
  constexpr int levels = 14;
  std::vector<Eigen::Vector2d> roots;
  const int degree = std::max(f.degree(), g.degree());
  std::vector<Box> open{{f.raised_to(degree), g.raised_to(degree), Eigen::Vector2d::Zero(), 1.0}};
  for (int level = 0; level < levels && !open.empty() && open.size() < too_many; ++level) {
    std::vector<Box> next;
    for (const Box& box : open) {
      const Verdict verdict = judge(box);
      if (verdict == Verdict::one) {
        if (const auto root = newton(box)) {
          roots.push_back(*root);
        }
      } else if (verdict == Verdict::open) {
        std::ranges::move(children(box), std::back_inserter(next));
      }
    }
    open = std::move(next);
  }
  // Roots of higher order are never certified; the boxes left around them say where they are.
  constexpr std::size_t few = 16;
  if (open.size() <= few) {
    for (const Box& box : open) {
      roots.push_back(box.centre);
    }
  }
  return roots;
}

}  // namespace microslip::contact
