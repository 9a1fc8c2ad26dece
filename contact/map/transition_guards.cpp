#include "contact/map/transition_guards.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "contact/closed_form/slip_functions.hpp"
#include "contact/trigonometric_basis.hpp"

namespace microslip::contact {
namespace {

// What holds a resting slider at one instant.
struct Sample {
  double u = 0.0, w = 0.0;  // [m]
  double first = 0.0;       // stiffness along p [N/m³]
  double second = 0.0;      // along r
  double limit = 0.0;       // μ n*, [Pa]
  double load = 0.0;        // n* [Pa]
};

Sample sample_at(const SurfaceLaw& law, const Harmonics& motion, double frequency, bool along_r,
                 double phase) {
  Eigen::VectorXd basis;
  Eigen::VectorXd slope;
  trigonometric_basis(motion.n_harmonics(), phase, basis);
  basis_rate(basis, slope);
  const Eigen::VectorXd now = motion.rows().transpose() * basis;
  const Eigen::VectorXd change = motion.rows().transpose() * slope;
  const Eigen::Vector2d rate(change[0], along_r ? change[2] : 0.0);
  const SurfaceState state = law.at(now[1], frequency * rate.norm());
  return {now[0],
          along_r ? now[2] : 0.0,
          law.first_stiffness() * state.stiffness_ratio,
          law.second_stiffness() * state.second_stiffness_ratio,
          state.friction_coefficient * state.gap_load,
          state.gap_load};
}

// Largest of a periodic function from its samples: the top of the parabola through the largest and
// its neighbours.
double largest(const Eigen::VectorXd& y) {
  Eigen::Index i = 0;
  const double top = y.maxCoeff(&i);
  const double before = y[i > 0 ? i - 1 : y.size() - 1];
  const double after = y[i + 1 < y.size() ? i + 1 : 0];
  const double curvature = 2.0 * top - before - after;
  const double slope = 0.5 * (after - before);
  return curvature > 0.0 ? top + 0.5 * slope * slope / curvature : top;
}

// Least of a convex function on [low, high].
template <typename Function>
double least(const Function& f, double low, double high) {
  constexpr int n_steps = 24;  // 0.618^24 = 1e-5 of the interval
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double a = high - golden * (high - low);
  double b = low + golden * (high - low);
  double at_a = f(a);
  double at_b = f(b);
  for (int i = 0; i < n_steps; ++i) {
    if (at_a < at_b) {
      high = b;
      b = a;
      at_b = at_a;
      at_a = f(a = high - golden * (high - low));
    } else {
      low = a;
      a = b;
      at_a = at_b;
      at_b = f(b = low + golden * (high - low));
    }
  }
  return std::min(at_a, at_b);
}

// (1) in one direction, where the stiffness may change with the load: the sliders that hold at θ
// are a band.
double slip_along_p(const std::vector<Sample>& samples, double stiffness) {
  const auto n = static_cast<Eigen::Index>(samples.size());
  Eigen::VectorXd low(n);
  Eigen::VectorXd high(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Sample& now = samples[static_cast<std::size_t>(i)];
    const double share = now.first > 0.0 ? stiffness / now.first : 1.0;
    low[i] = stiffness * now.u - now.limit * share;
    high[i] = -stiffness * now.u - now.limit * share;
  }
  return largest(low) + largest(high);
}

double slip_in_the_plane(const std::vector<Sample>& samples) {
  Eigen::Array2d low = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array2d high = -low;
  for (const Sample& now : samples) {
    low = low.min(Eigen::Array2d(now.u, now.w));
    high = high.max(Eigen::Array2d(now.u, now.w));
  }
  const auto excess = [&](double s, double t) {
    double worst = -std::numeric_limits<double>::infinity();
    for (const Sample& now : samples) {
      const double x = now.first * (now.u - s);
      const double y = now.second * (now.w - t);
      worst = std::max(worst, std::sqrt(x * x + y * y) - now.limit);
    }
    return worst;
  };
  const auto along_r = [&](double s) {
    return least([&](double t) { return excess(s, t); }, low[1], high[1]);
  };
  return 2.0 * least(along_r, low[0], high[0]);
}

}  // namespace

TransitionGuards transition_guards(const PointParameters& point, const PointMotion& motion) {
  const SlipFunctions w = slip_functions(point, motion);
  return {w.excess, -w.below_closed, w.above_open};
}

TransitionGuards transition_guards(const SurfaceLaw& law, const Harmonics& motion, double frequency,
                                   bool along_r) {
  const int n_samples = (along_r ? 16 : 64) * std::clamp(motion.n_harmonics(), 4, 16);
  std::vector<Sample> samples;
  samples.reserve(static_cast<std::size_t>(n_samples));
  Eigen::VectorXd load(n_samples);
  for (int i = 0; i < n_samples; ++i) {
    const double phase = 2.0 * std::numbers::pi * i / n_samples;
    samples.push_back(sample_at(law, motion, frequency, along_r, phase));
    load[i] = samples.back().load;
  }
  TransitionGuards guards;
  guards.smallest_load = -largest(-load);
  guards.largest_load = largest(load);
  guards.slip = along_r ? slip_in_the_plane(samples) : slip_along_p(samples, law.first_stiffness());
  return guards;
}

}  // namespace microslip::contact
