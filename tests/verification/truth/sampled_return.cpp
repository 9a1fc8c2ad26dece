#include "tests/verification/truth/sampled_return.hpp"

#include <algorithm>
#include <cmath>

#include "tests/verification/truth/return_step.hpp"

namespace microslip::truth {
namespace {

using Eigen::Index;
using std::hypot;

constexpr int most_periods = 12;
constexpr double repeats =
    1e-8;  // of the friction limit: two-dimensional sliders have come to their cycle

/// One point through its periods. `motion(i)` gives (u, v, w) at instant i as Triple<T>,
/// `keep(i, slider)` is told where it is then, the last period last.
template <typename T, typename Motion, typename Keep>
void march(const ContactConstants& c, Index n, bool planar, const Motion& motion,
           const Keep& keep) {
  Slider<T> at = first_instant<T>(c, planar, motion(n - 1));
  for (int period = 0; period < (planar ? most_periods : 2); ++period) {
    const Triple<T> start = at.force;
    for (Index i = 0; i < n; ++i) {
      at = next_instant<T>(c, planar, at, motion(i));
      keep(i, at);
    }
    const double change =
        hypot(value_of(at.force.u) - value_of(start.u), value_of(at.force.w) - value_of(start.w));
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
          return Triple<double>{motion.u(i, point), motion.v(i, point),
                                planar ? motion.w(i, point) : 0.0};
        },
        [&](Index i, const Slider<double>& at) {
          t.u(i, point) = at.force.u;
          t.v(i, point) = at.force.v;
          if (planar) t.w(i, point) = at.force.w;
          states[i] = at.state;
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
          Triple<Dual> x{{motion.u(i, point), change.u(i, point)},
                         {motion.v(i, point), change.v(i, point)},
                         {}};
          if (planar) x.w = {motion.w(i, point), change.w(i, point)};
          return x;
        },
        [&](Index i, const Slider<Dual>& at) {
          t.u(i, point) = at.force.u.rate;
          t.v(i, point) = at.force.v.rate;
          if (planar) t.w(i, point) = at.force.w.rate;
        });
  }
  return t;
}

}  // namespace microslip::truth
