#include "tests/verification/truth/sampled_return.hpp"

#include <algorithm>
#include <cmath>

#include "tests/verification/truth/dual_number.hpp"

namespace microslip::truth {
namespace {

using Eigen::Index;
using std::hypot;

constexpr int most_periods = 12;
constexpr double repeats =
    1e-8;  // of the friction limit: two-dimensional sliders have come to their cycle

template <typename T>
struct Traction {
  T u{}, v{}, w{};
};

enum class State : unsigned char { open, stick, slip };

/// F* returned to the cone of normal pressure n.
template <typename T>
State return_to_cone(T& u, T& w, const T& n, double mu, bool planar) {
  const T limit = mu * n;
  if (!planar) {
    if (std::abs(value_of(u)) <= value_of(limit)) return State::stick;
    u = value_of(u) > 0.0 ? limit : T(-1.0) * limit;
    return State::slip;
  }
  const T size = hypot(u, w);
  if (value_of(size) <= value_of(limit)) return State::stick;
  u = limit * u / size;
  w = limit * w / size;
  return State::slip;
}

/// One point through its periods. `motion(i)` gives (u, v, w) at instant i as Traction<T>,
/// `keep(i, traction, state)` is told the tractions, the last period last.
template <typename T, typename Motion, typename Keep>
void march(const ContactConstants& c, Index n, bool planar, const Motion& motion,
           const Keep& keep) {
  const double k = c.tangential_stiffness;
  Traction<T> x = motion(n - 1);
  T gap = T(c.pressure) + T(c.normal_stiffness) * x.v;
  Traction<T> f{T(k) * x.u, T{}, T(k) * x.w};
  if (value_of(gap) <= 0.0) {
    f = {};
  } else {
    return_to_cone(f.u, f.w, gap, c.friction_coefficient, planar);
  }
  for (int period = 0; period < (planar ? most_periods : 2); ++period) {
    const Traction<T> start = f;
    for (Index i = 0; i < n; ++i) {
      const Traction<T> before = x;
      const T gap_before = gap;
      x = motion(i);
      gap = T(c.pressure) + T(c.normal_stiffness) * x.v;
      if (value_of(gap) <= 0.0) {
        f = {};
        keep(i, f, State::open);
        continue;
      }
      T stiffness = T(k);
      if (value_of(gap_before) < 0.0) {
        stiffness = T(k) * gap / (gap - gap_before);
        f = {};
      }
      f.v = gap;
      f.u = f.u + stiffness * (x.u - before.u);
      if (planar) f.w = f.w + stiffness * (x.w - before.w);
      keep(i, f, return_to_cone(f.u, f.w, f.v, c.friction_coefficient, planar));
    }
    const double change =
        hypot(value_of(f.u) - value_of(start.u), value_of(f.w) - value_of(start.w));
    if (period > 0 && change <= repeats * c.friction_coefficient * std::abs(c.pressure)) break;
  }
}

PointHistory zeros(Index n, Index n_points, bool planar) {
  PointHistory result{Eigen::MatrixXd::Zero(n, n_points), Eigen::MatrixXd::Zero(n, n_points), {}};
  if (planar) result.w.setZero(n, n_points);
  return result;
}

}  // namespace

TractionResult tractions(const ContactConstants& constants, const PointHistory& motion) {
  const Index n = motion.u.rows();
  const Index n_points = motion.u.cols();
  const bool planar = motion.w.size() > 0;
  TractionResult result{zeros(n, n_points, planar),
                        {Eigen::VectorXd(n_points), Eigen::VectorXd(n_points)}};
  PointHistory& t = result.tractions;
  Eigen::Matrix<State, Eigen::Dynamic, 1> states(n);
  for (Index point = 0; point < n_points; ++point) {
    march<double>(
        constants, n, planar,
        [&](Index i) {
          return Traction<double>{motion.u(i, point), motion.v(i, point),
                                  planar ? motion.w(i, point) : 0.0};
        },
        [&](Index i, const Traction<double>& f, State state) {
          t.u(i, point) = f.u;
          t.v(i, point) = f.v;
          if (planar) t.w(i, point) = f.w;
          states[i] = state;
        });
    const auto share = [&](auto mask) {
      return static_cast<double>(mask.count()) / static_cast<double>(n);
    };
    result.shares.contact[point] = share(states.array() != State::open);
    result.shares.stick[point] = share(states.array() == State::stick);
  }
  return result;
}

PointHistory tangent(const ContactConstants& constants, const PointHistory& motion,
                     const PointHistory& change) {
  const Index n = motion.u.rows();
  const bool planar = motion.w.size() > 0;
  PointHistory t = zeros(n, motion.u.cols(), planar);
  for (Index point = 0; point < motion.u.cols(); ++point) {
    march<Dual>(
        constants, n, planar,
        [&](Index i) {
          Traction<Dual> x{{motion.u(i, point), change.u(i, point)},
                           {motion.v(i, point), change.v(i, point)},
                           {}};
          if (planar) x.w = {motion.w(i, point), change.w(i, point)};
          return x;
        },
        [&](Index i, const Traction<Dual>& f, State) {
          t.u(i, point) = f.u.rate;
          t.v(i, point) = f.v.rate;
          if (planar) t.w(i, point) = f.w.rate;
        });
  }
  return t;
}

}  // namespace microslip::truth
