#include "contact/plane/planar_reversal.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/bracketed_root.hpp"

namespace microslip::contact {
namespace {

constexpr int per_cell = 3;  // samples between two nodes, and between the begin and the first
constexpr int n_samples = n_stages * per_cell;
using Rates = Eigen::Matrix<double, n_stages, 1>;
using Samples = Eigen::Matrix<double, n_samples, 1>;

double begin_of_cell(int cell) {
  return cell == 0 ? 0.0 : radau_nodes().node[static_cast<std::size_t>(cell) - 1];
}

double end_of_cell(int cell) { return radau_nodes().node[static_cast<std::size_t>(cell)]; }

/// Fraction of the step at a sample of a cell.
double sample_point(int cell, int i) {
  const double begin = begin_of_cell(cell);
  return begin + (end_of_cell(cell) - begin) * (i + 1) / (per_cell + 1);
}

/// Values between the nodes of the polynomial through those at the nodes.
Eigen::Matrix<double, n_samples, n_stages> make_interpolation() {
  const auto& node = radau_nodes().node;
  Eigen::Matrix<double, n_samples, n_stages> P;
  for (int row = 0; row < n_samples; ++row) {
    const double x = sample_point(row / per_cell, row % per_cell);
    for (std::size_t j = 0; j < node.size(); ++j) {
      double product = 1.0;
      for (std::size_t k = 0; k < node.size(); ++k) {
        if (k != j) product *= (x - node[k]) / (node[j] - node[k]);
      }
      P(row, static_cast<Eigen::Index>(j)) = product;
    }
  }
  return P;
}

const Eigen::Matrix<double, n_samples, n_stages>& interpolation() {
  static const Eigen::Matrix<double, n_samples, n_stages> P = make_interpolation();
  return P;
}

/// Between two fractions of a step.
struct Descent {
  double high = 0.0;  ///< where the rate is above 0
  double rate_high = 0.0;
  double low = 0.0;  ///< where it is not
  double rate_low = 0.0;
};

class Reversal {
 public:
  Reversal(const PlanarMotion& motion, const SlipStep& step) : motion_(motion), step_(step) {
    for (int i = 0; i < n_stages; ++i) rate_[i] = step.rate(i);
  }

  [[nodiscard]] double first(bool begins_interval, bool ends_interval) const {
    if (begins_interval) {
      const double found = in_layer(0.0, end_of_cell(0), rate_[0]);
      if (found <= 1.0) return found;
    }
    const Samples between = interpolation() * rate_;
    for (int cell = 0; cell < n_stages; ++cell) {
      if (rate_[cell] <= 0.0) return end_within(cell);
      const double found = dip_within(cell, between.segment<per_cell>(cell * per_cell));
      if (found <= 1.0) return found;
    }
    return ends_interval ? in_layer(1.0, end_of_cell(n_stages - 2), rate_[n_stages - 2]) : 2.0;
  }

 private:
  [[nodiscard]] double root(const Descent& d) const {
    const auto rate = [this](double x) { return slip_rate_at(motion_, step_, x); };
    constexpr double enough = 1e-6;  // the step that ends there is solved for its length
    return bracketed_root(rate, d.high, d.low, d.rate_high, d.rate_low, enough);
  }

  /// The rate is above 0 where the cell begins and not where it ends; slip that is about to end as
  /// the step begins is taken to begin as fast as it has to turn back.
  [[nodiscard]] double end_within(int cell) const {
    const double before = cell > 0 ? rate_[cell - 1] : std::max(-rate_[0], 1e-300);
    return root({begin_of_cell(cell), before, end_of_cell(cell), rate_[cell]});
  }

  /// The rate is above 0 at both ends of the cell.
  [[nodiscard]] double dip_within(int cell,
                                  const Eigen::Matrix<double, per_cell, 1>& between) const {
    Eigen::Index lowest = 0;
    const double least = between.minCoeff(&lowest);
    const double before = cell > 0 ? rate_[cell - 1] : rate_[0];
    if (cell == 0 || least >= std::min(before, rate_[cell])) return 2.0;
    const double width = (end_of_cell(cell) - begin_of_cell(cell)) / (per_cell + 1);
    const double left = lowest > 0 ? between[lowest - 1] : before;
    const double right = lowest + 1 < per_cell ? between[lowest + 1] : rate_[cell];
    const double bend = left - 2.0 * least + right;
    const double aside = bend > 0.0 ? std::clamp(0.5 * (left - right) / bend, -1.0, 1.0) : 0.0;
    const double x = sample_point(cell, static_cast<int>(lowest)) + aside * width;
    const double rate = slip_rate_at(motion_, step_, x);
    return rate <= 0.0 ? root({begin_of_cell(cell), before, x, rate}) : 2.0;
  }

  /// Ever closer to an end of the interval, from the node next to it.
  [[nodiscard]] double in_layer(double end, double node, double rate_node) const {
    constexpr double narrowest = 1e-9;  // what may rest in less moves the forces by less
    if (rate_node <= 0.0) return 2.0;
    double x = node;
    double before = rate_node;
    for (double aside = 0.5 * (node - end); std::abs(aside) * step_.length > narrowest;
         aside *= 0.5) {
      const double next = end + aside;
      const double rate = slip_rate_at(motion_, step_, next);
      if (rate <= 0.0) return next > x ? root({x, before, next, rate}) : begin_of_rest(next);
      x = next;
      before = rate;
    }
    return 2.0;
  }

  /// Rest that is seen from its end, where slip begins with the interval.
  [[nodiscard]] double begin_of_rest(double inside) const {
    double x = inside;
    constexpr int enough = 60;
    for (int i = 0; i < enough; ++i) {
      const double rate = slip_rate_at(motion_, step_, 0.5 * x);
      if (rate > 0.0) return root({0.5 * x, rate, x, slip_rate_at(motion_, step_, x)});
      x *= 0.5;
    }
    return x;
  }

  const PlanarMotion& motion_;
  const SlipStep& step_;
  Rates rate_;
};

}  // namespace

double slip_rate_at(const PlanarMotion& motion, const SlipStep& step, double x) {
  const PlanarInstant now = motion.at(step.begin + x * step.length);
  // Of smaller ellipses the polynomial does not know on which side of x its slider lies.
  constexpr double lost = 1e-12;
  const Eigen::Vector2d force =
      now.radius > lost ? now.force(step.slider_at(x)) : step.direction_at(x);
  const double size = force.norm();
  return size > 0.0 ? slip_rate(now, force / size) : 0.0;
}

double first_reversal(const PlanarMotion& motion, const PlanarInterval& interval,
                      const SlipStep& step) {
  const bool layers = motion.law().is_rate_dependent();
  return Reversal(motion, step)
      .first(layers && step.begin <= interval.begin, layers && step.end() >= interval.end);
}

}  // namespace microslip::contact
