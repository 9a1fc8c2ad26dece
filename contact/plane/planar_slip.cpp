#include "contact/plane/planar_slip.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace microslip::contact {
namespace {

using Stages = Eigen::Matrix<double, n_stages, 1>;
template <std::size_t N>
using Points = std::array<double, N>;
using StepPoints = Points<n_stages + 1>;

/// Legendre polynomials P_{n−1}, P_n at x.
std::array<double, 2> legendre(int n, double x) {
  double before = 1.0;
  double value = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
    before = value;
    value = next;
  }
  return {before, value};
}

/// Zeros of P_s − P_{s−1} in (−1, 1), ascending, and the end 1.
Points<n_stages> radau_points() {
  const auto f = [](double x) {
    const auto p = legendre(n_stages, x);
    return p[1] - p[0];
  };
  Points<n_stages> x{};
  std::size_t found = 0;
  constexpr int n_cells = 400;  // the nodes are 0.3 apart
  for (int i = 0; i + 1 < n_cells && found + 1 < x.size(); ++i) {
    double low = -1.0 + 2.0 * i / n_cells;
    double high = -1.0 + 2.0 * (i + 1) / n_cells;
    if (f(low) * f(high) > 0.0) continue;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (f(low) * f(middle) <= 0.0 ? high : low) = middle;
    }
    x[found++] = 0.5 * (low + high);
  }
  x.back() = 1.0;
  return x;
}

template <std::size_t N>
Points<N> barycentric_weights(const Points<N>& x) {
  Points<N> w;
  for (std::size_t j = 0; j < x.size(); ++j) {
    w[j] = 1.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      if (k != j) w[j] /= x[j] - x[k];
    }
  }
  return w;
}

StepPoints with_begin(const Points<n_stages>& node) {
  StepPoints x{};
  std::copy(node.begin(), node.end(), x.begin() + 1);
  return x;
}

/// Share of the Legendre polynomial of degree n − 2 in a polynomial through n points.
template <std::size_t N>
Eigen::Matrix<double, 1, static_cast<int>(N)> share_below_top(const Points<N>& point) {
  constexpr int n = static_cast<int>(N);
  Eigen::Matrix<double, n, n> values;
  for (int i = 0; i < n; ++i) {
    const double x = 2.0 * point[static_cast<std::size_t>(i)] - 1.0;
    values(i, 0) = 1.0;
    for (int k = 1; k < n; ++k) values(i, k) = legendre(k, x)[1];
  }
  return values.inverse().row(n - 2);
}

RadauNodes make_nodes() {
  RadauNodes rule;
  const Points<n_stages> x = radau_points();
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double p = legendre(n_stages - 1, x[i])[1];
    rule.node[i] = 0.5 * (1.0 + x[i]);
    rule.weight[i] = 0.5 * (1.0 + x[i]) / (n_stages * n_stages * p * p);
  }
  const StepPoints point = with_begin(rule.node);
  const StepPoints w = barycentric_weights(point);
  for (Eigen::Index i = 0; i < n_stages; ++i) {
    const auto row = static_cast<std::size_t>(i + 1);
    double sum = 0.0;
    for (Eigen::Index j = 0; j <= n_stages; ++j) {
      const auto column = static_cast<std::size_t>(j);
      if (column == row) continue;
      rule.derivative(i, j) = w[column] / w[row] / (point[row] - point[column]);
      sum += rule.derivative(i, j);
    }
    rule.derivative(i, i + 1) = -sum;
  }
  // Leading coefficients of the shifted Legendre polynomials of degree 5 and 4.
  constexpr double of_degree_five = 252.0;
  constexpr double of_degree_four = 70.0;
  const Points<n_stages> w_inner = barycentric_weights(rule.node);
  for (Eigen::Index j = 0; j <= n_stages; ++j) {
    rule.top[j] = w[static_cast<std::size_t>(j)] / of_degree_five;
    if (j < n_stages) rule.tail[j] = w_inner[static_cast<std::size_t>(j)] / of_degree_four;
  }
  rule.below_tail = share_below_top(rule.node);
  return rule;
}

Eigen::Vector2d across(const Eigen::Vector2d& e) { return {-e[1], e[0]}; }

/// (I + λK)⁻¹ f* with |f| = r to a tolerance.
Eigen::Vector2d returned(const Eigen::Vector2d& trial, const Eigen::Vector2d& stiffness,
                         double radius, double tolerance) {
  const double size = trial.norm();
  if (size <= radius) return trial;
  if (radius <= 0.0) return Eigen::Vector2d::Zero();
  if (stiffness[0] == stiffness[1]) return trial * (radius / size);
  // λK ≫ 1: what is left of the trial is its direction, and powers of λ would overflow.
  constexpr double vanishing = 1e-30;
  if (radius <= vanishing * (stiffness.minCoeff() / stiffness.maxCoeff()) * size) {
    return trial.cwiseQuotient(stiffness).normalized() * radius;
  }
  // 1/|f| is nearly linear and concave in λ: Newton's method on it rises to the root without
  // overshooting from λ = 0.
  double lambda = 0.0;
  Eigen::Vector2d force = trial;
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector2d divisor = (1.0 + lambda * stiffness.array()).matrix();
    force = trial.cwiseQuotient(divisor);
    const double f = force.norm();
    const double slope =
        force.cwiseProduct(force).cwiseProduct(stiffness).cwiseQuotient(divisor).sum();
    const double change = (f - radius) / radius * f * f / slope;
    lambda += change;
    if (std::abs(f - radius) <= tolerance * radius) break;
  }
  return force * (radius / force.norm());
}

/// Good enough to begin Newton's method with.
Eigen::Vector2d rough_return(const Eigen::Vector2d& trial, const Eigen::Vector2d& stiffness,
                             double radius) {
  return returned(trial, stiffness, radius, 1e-3);
}

/// Stages from successive returns, direction by direction. Where a return finds stick the direction
/// is kept: slip is continued backwards, and its negative rate tells the walk where it ended.
void guess(SlipStep& step) {
  Eigen::Vector2d slider = step.slider;
  Eigen::Vector2d last = Eigen::Vector2d::Zero();
  for (int i = 0; i < n_stages; ++i) {
    const PlanarInstant& now = step.instant[static_cast<std::size_t>(i)];
    const Eigen::Vector2d trial = now.force(slider);
    const double size = trial.norm();
    if ((size > now.radius || i == 0) && size > 0.0) {
      last = now.radius > 0.0 ? rough_return(trial, now.stiffness, now.radius) : trial;
      last.normalize();
    } else if (i == 0) {
      last = Eigen::Vector2d::UnitX();
    }
    step.direction.col(i) = last;
    slider = now.edge(last);
  }
}

/// Stages from the polynomial of the step before, continued. Where it runs away from the first
/// return there is no guess.
bool guess_from(const SlipStep& before, SlipStep& step) {
  constexpr double farthest = 4.0;  // steps grow by no more; beyond, the polynomial is noise
  if (before.begin + before.length != step.begin || step.length > farthest * before.length) {
    return false;
  }
  Eigen::Vector2d last = before.direction.col(n_stages - 1);
  for (int i = 0; i < n_stages; ++i) {
    const PlanarInstant& now = step.instant[static_cast<std::size_t>(i)];
    const double x = (now.phase - before.begin) / before.length;
    Eigen::Vector2d force = now.force(before.slider_at(x));
    force.normalize();
    if (!(force.dot(last) > 0.8)) return false;
    step.direction.col(i) = last = force;
  }
  return true;
}

void set_stages(SlipStep& step) {
  const RadauNodes& rule = radau_nodes();
  for (int i = 0; i < n_stages; ++i) {
    step.stage.col(i) = step.instant[static_cast<std::size_t>(i)].edge(step.direction.col(i));
  }
  for (int i = 0; i < n_stages; ++i) {
    // Row sums of D vanish: differences from the first point keep small steps accurate.
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (int j = 0; j < n_stages; ++j) {
      sum += rule.derivative(i, j + 1) * (step.stage.col(j) - step.slider);
    }
    step.travel.col(i) = sum;
  }
}

void set_factor(SlipStep& step) {
  const RadauNodes& rule = radau_nodes();
  Eigen::Matrix<double, n_stages, n_stages> A;
  for (int j = 0; j < n_stages; ++j) {
    const PlanarInstant& now = step.instant[static_cast<std::size_t>(j)];
    const Eigen::Vector2d turn = -now.reach().cwiseProduct(across(step.direction.col(j)));
    for (int i = 0; i < n_stages; ++i) {
      A(i, j) = rule.derivative(i, j + 1) * across(step.direction.col(i)).dot(turn);
    }
    // A stage with neither way nor radius keeps its direction.
    constexpr double nothing = 1e-18;
    A(j, j) -= step.direction.col(j).dot(step.travel.col(j)) + nothing;
  }
  step.factor.compute(A);
}

/// One Newton step; returns the largest change of an angle, less what rounding of positions of
/// order one does to it where both the ellipse and the way are small.
double improve(SlipStep& step) {
  Stages residual;
  for (int i = 0; i < n_stages; ++i) {
    residual[i] = across(step.direction.col(i)).dot(step.travel.col(i));
  }
  Stages change;
  step.factor.solve(residual, change);
  constexpr double largest_turn = 0.7;
  double largest = 0.0;
  for (int i = 0; i < n_stages; ++i) {
    const double turn = std::clamp(-change[i], -largest_turn, largest_turn);
    if (!(std::abs(change[i]) <= 1e6)) return 1e6;
    constexpr double noise = 2e-14;
    const double way = step.instant[static_cast<std::size_t>(i)].radius + step.travel.col(i).norm();
    if (std::abs(change[i]) * way > noise) largest = std::max(largest, std::abs(change[i]));
    const Eigen::Vector2d e = step.direction.col(i);
    // By 2 atan(turn/2), the same to its third power, at the cost of no sine.
    const double half = 0.5 * turn;
    const double square = half * half;
    step.direction.col(i) = ((1.0 - square) * e + turn * across(e)) / (1.0 + square);
  }
  set_stages(step);
  return largest;
}

/// Newton's method on (2) from the directions of the step.
bool iterate(SlipStep& step) {
  constexpr double small_turn = 1e-9;  // the step after it, quadratic, is below rounding
  constexpr int most_iterations = 12;
  set_stages(step);
  for (int i = 0; i < most_iterations; ++i) {
    set_factor(step);
    const double largest = improve(step);
    if (largest >= 1e6) return false;
    if (largest < small_turn) return true;
  }
  return false;
}

/// Of the coefficient of friction, as a force: c₄ (c₄/c₃)⁵.
double rest_of(const PlanarMotion& motion, const SlipStep& step) {
  if (!motion.law().is_rate_dependent()) return 0.0;
  const RadauNodes& rule = radau_nodes();
  double fourth = 0.0;
  double third = 0.0;
  double load = 0.0;
  for (int j = 0; j < n_stages; ++j) {
    const PlanarInstant& now = step.instant[static_cast<std::size_t>(j)];
    const double mu = now.surface.friction_coefficient;
    fourth += rule.tail[j] * mu;
    third += rule.below_tail[j] * mu;
    if (mu > 0.0) load = std::max(load, now.limit * now.surface.stiffness_ratio / mu);
  }
  const double c4 = std::abs(fourth);
  const double ratio = c4 < std::abs(third) ? c4 / std::abs(third) : 1.0;
  return load * c4 * std::pow(ratio, 5.0);
}

/// Of the slider and, where the stiffness varies with the load, of the limit of friction.
double top_term(const PlanarMotion& motion, const SlipStep& step) {
  const RadauNodes& rule = radau_nodes();
  Eigen::Vector2d top = Eigen::Vector2d::Zero();
  double limit = 0.0;
  for (int j = 0; j < n_stages; ++j) {
    const PlanarInstant& now = step.instant[static_cast<std::size_t>(j)];
    top += rule.top[j + 1] * (step.stage.col(j) - step.slider);
    limit += rule.tail[j] * now.limit * now.surface.stiffness_ratio;
  }
  const double of_slider = motion.stiffness().cwiseProduct(top).norm();
  return motion.law().is_smooth() ? of_slider : std::max(of_slider, std::abs(limit));
}

}  // namespace

const RadauNodes& radau_nodes() {
  static const RadauNodes rule = make_nodes();
  return rule;
}

Eigen::Vector2d returned_force(const Eigen::Vector2d& trial, const Eigen::Vector2d& stiffness,
                               double radius) {
  return returned(trial, stiffness, radius, 4e-16);
}

double slip_rate(const PlanarInstant& now, const Eigen::Vector2d& direction) {
  const Eigen::Vector2d normal = across(direction);
  const Eigen::Vector2d d = now.velocity - now.reach_rate().cwiseProduct(direction);
  const Eigen::Vector2d Cn = normal.cwiseQuotient(now.stiffness);
  return direction.dot(d) - direction.dot(Cn) / normal.dot(Cn) * normal.dot(d);
}

Eigen::Vector2d SlipStep::slider_at(double x) const {
  static const StepPoints point = with_begin(radau_nodes().node);
  static const StepPoints weight = barycentric_weights(point);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double total = 0.0;
  for (std::size_t j = 0; j < point.size(); ++j) {
    Eigen::Vector2d value =
        j == 0 ? slider : Eigen::Vector2d(stage.col(static_cast<Eigen::Index>(j) - 1));
    if (x == point[j]) return value;
    const double w = weight[j] / (x - point[j]);
    sum += w * value;
    total += w;
  }
  return sum / total;
}

Eigen::Vector2d SlipStep::direction_at(double x) const {
  const auto& node = radau_nodes().node;
  static const Points<n_stages> weight = barycentric_weights(node);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double total = 0.0;
  for (std::size_t j = 0; j < node.size(); ++j) {
    Eigen::Vector2d value = direction.col(static_cast<Eigen::Index>(j));
    if (x == node[j]) return value;
    const double w = weight[j] / (x - node[j]);
    sum += w * value;
    total += w;
  }
  return sum / total;
}

bool solve_slip(const PlanarMotion& motion, double end_nudge, SlipStep& step,
                const SlipStep* before) {
  const RadauNodes& rule = radau_nodes();
  for (std::size_t i = 0; i < n_stages; ++i) {
    const double nudge = i + 1 == n_stages ? end_nudge : 0.0;
    step.instant[i] = motion.at(step.begin + rule.node[i] * step.length, nudge);
  }
  bool converged = before != nullptr && guess_from(*before, step) && iterate(step);
  if (!converged) {
    guess(step);
    converged = iterate(step);
  }
  if (!converged) {
    guess(step);
    set_stages(step);
    set_factor(step);
  }
  step.top_term = top_term(motion, step);
  step.rest = rest_of(motion, step);
  return converged;
}

}  // namespace microslip::contact
